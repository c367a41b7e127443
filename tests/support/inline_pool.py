"""Worker processes that are none: each call is done where it is made, so that a test can count and change it."""

from concurrent.futures import Future


class InlinePool:
    """``submit`` and ``map`` as of an executor."""

    def __init__(self):
        self.calls = 0

    def submit(self, call, *arguments) -> Future:
        self.calls += 1
        future = Future()
        future.set_result(call(*arguments))
        return future

    def map(self, call, *arguments, chunksize: int = 1):
        return [self.submit(call, *row).result() for row in zip(*arguments, strict=True)]
