"""A cache in memory with a limit on the total size; the least recently used entries go first."""

import threading
from collections import OrderedDict
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class LruCache(Generic[T]):
    """Thread-safe. ``size_of`` measures one value; a value larger than ``limit`` is still kept, alone."""

    def __init__(self, limit: int, size_of: Callable[[T], int] = lambda _: 1):
        self._limit, self._size_of = limit, size_of
        self._kept: OrderedDict[str, T] = OrderedDict()
        self._size = 0
        self._lock = threading.Lock()

    def get(self, key: str) -> T | None:
        """The value of a key, now the most recently used; None when it is not, or no longer, here."""
        with self._lock:
            found = self._kept.get(key)
            if found is not None:
                self._kept.move_to_end(key)
            return found

    def put(self, key: str, value: T) -> None:
        """Keep a value; make room for it."""
        with self._lock:
            if (old := self._kept.pop(key, None)) is not None:
                self._size -= self._size_of(old)
            self._kept[key] = value
            self._size += self._size_of(value)
            while self._size > self._limit and len(self._kept) > 1:
                _, dropped = self._kept.popitem(last=False)
                self._size -= self._size_of(dropped)
