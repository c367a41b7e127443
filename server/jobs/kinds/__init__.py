"""The kinds of jobs. Each module or package in here is one kind; it registers itself, and all are loaded by
``registry``.

A new kind is one new module: a subclass of ``base.JobKind`` (or of ``base.SingleKind``, when it is one computation
with one result), and a call of ``registry.register``. Its wire schema is ``JobKind.body``.
"""
