"""Processes that compute batch after batch keep freed memory, so that the next batch needs no new pages.

A new page takes 0.5 to 2 µs on a virtual machine, and a batch of runs has over a thousand of them.
"""

import ctypes
import sys
from contextlib import suppress

# mallopt(3) of the GNU C library; other systems keep their own rules.
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3
KEPT_BYTES = 64 * 2**20  # freed memory that is kept; a batch of either precision has about 10 MB
LARGEST_KEPT_BYTES = 32 * 2**20  # the most that the library allows


def keep_freed_memory() -> None:
    """Keep up to KEPT_BYTES of what this process frees, from now on."""
    if sys.platform == "linux":
        with suppress(OSError, AttributeError):
            library = ctypes.CDLL(None)
            library.mallopt(_M_MMAP_THRESHOLD, LARGEST_KEPT_BYTES)
            library.mallopt(_M_TRIM_THRESHOLD, KEPT_BYTES)
