"""Results in memory, by content: bounded in bytes, the least recently used go first."""

import threading
from collections import OrderedDict

from vfcore.runs.result import SimulationResult


class ResultCache:
    """Thread-safe. A result larger than the whole cache is still kept, alone."""

    def __init__(self, limit_bytes: int):
        self._limit = limit_bytes
        self._kept: OrderedDict[str, SimulationResult] = OrderedDict()
        self._bytes = 0
        self._lock = threading.Lock()

    def get(self, content: str) -> SimulationResult | None:
        """The result of a content hash, now the most recently used; None when it is not (or no longer) here."""
        with self._lock:
            found = self._kept.get(content)
            if found is not None:
                self._kept.move_to_end(content)
            return found

    def put(self, content: str, result: SimulationResult) -> None:
        """Keep a result; make room for it."""
        with self._lock:
            if (old := self._kept.pop(content, None)) is not None:
                self._bytes -= size_bytes(old)
            self._kept[content] = result
            self._bytes += size_bytes(result)
            while self._bytes > self._limit and len(self._kept) > 1:
                _, dropped = self._kept.popitem(last=False)
                self._bytes -= size_bytes(dropped)


def size_bytes(result: SimulationResult) -> int:
    """Memory of a result's arrays."""
    return sum(array.nbytes for array in result.arrays.values())
