"""Gestures rendered lately, by content: the sound and the tables of one are asked for after it."""

import threading
from collections import OrderedDict

from vfcore.runs.gesture.render import RenderedGesture

KEPT = 8  # 30 s of voice are 70 MB


class GestureCache:
    """Thread-safe; the least recently used goes first."""

    def __init__(self, kept: int = KEPT):
        self._kept = kept
        self._found: OrderedDict[str, RenderedGesture] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, content: str) -> RenderedGesture | None:
        """The gesture of a content hash; None when it is not, or no longer, here."""
        with self._lock:
            if content in self._found:
                self._found.move_to_end(content)
            return self._found.get(content)

    def put(self, content: str, rendered: RenderedGesture) -> None:
        """Keep a gesture in the place of an old one."""
        with self._lock:
            self._found[content] = rendered
            self._found.move_to_end(content)
            while len(self._found) > self._kept:
                self._found.popitem(last=False)
