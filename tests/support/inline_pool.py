"""An executor that runs each call at once in the calling thread, so that a test can count and change it."""

from concurrent.futures import Future


class InlinePool:
    """``submit`` and ``map`` of an executor."""

    def __init__(self):
        self.calls = 0

    def submit(self, call, *arguments) -> Future:
        self.calls += 1
        future = Future()
        future.set_result(call(*arguments))
        return future

    def map(self, call, *arguments, chunksize: int = 1):
        return [self.submit(call, *row).result() for row in zip(*arguments, strict=True)]
