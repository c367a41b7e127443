"""The one place where a compile option is chosen, and where compiled code is kept.

- ``nogil``: a run never blocks the other threads of a server.
- ``error_model="numpy"``: a division by zero gives inf, as on paper, instead of a branch per division.
- ``fastmath``: contraction, reassociation, reciprocals and signed zeros are free. ``nnan``
  and ``ninf`` are left out on purpose: with them ``isnan`` may be optimised away, and a
  diverging run would go unnoticed.
- Cache: numba's own stamp looks at one file only, and is stale when a function called from
  another file changes. So the cache directory is named by a hash of all kernel sources, and of
  NUMBA_BOUNDSCHECK, which numba's key leaves out: a checked run would load unchecked code.
"""

import hashlib
import os
from pathlib import Path

import numba
from numba.extending import register_jitable

from vfcore.directories import data_directory


def _source_hash() -> str:
    digest = hashlib.sha256(os.environ.get("NUMBA_BOUNDSCHECK", "").encode())
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


if "NUMBA_CACHE_DIR" not in os.environ:  # not exported: a child process may have another data directory
    numba.config.CACHE_DIR = str(data_directory() / "kernels" / _source_hash())


def kernel_directory() -> Path:
    """Where the compiled kernels of this very source are kept."""
    return Path(numba.config.CACHE_DIR)


ARITHMETIC = {"error_model": "numpy", "fastmath": {"contract", "reassoc", "arcp", "nsz"}}
OPTIONS = {"nogil": True, "cache": True, **ARITHMETIC}


def jit(function):
    """Compile ``function`` with the project's options."""
    return numba.njit(**OPTIONS)(function)


def inlined(function):
    """The same for a function whose sums other compiled functions contain: it becomes part of each of them.

    Otherwise a call may end in a copy of it that was compiled apart, or not, by what else the process has compiled or
    loaded before; the copies differ in the order of their sums, and two processes in the last bit.
    """
    return numba.njit(forceinline=True, **OPTIONS)(function)


def formula(function):
    """``function`` as it stands for Python; compiled, as ``inlined`` is, where compiled code calls it.

    So that a formula which both need is written once, and Python keeps every bit of what it had without a compiler.
    """
    return register_jitable(forceinline=True, **ARITHMETIC)(function)
