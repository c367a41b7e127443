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
import threading
from pathlib import Path

import llvmlite.binding as llvm
import numba
import platformdirs


def data_directory() -> Path:
    """Where Vocalis keeps compiled kernels and results: ``VOCALIS_DATA`` or the user's data folder."""
    return Path(os.environ.get("VOCALIS_DATA") or platformdirs.user_data_dir("vocalis", appauthor=False))


def _source_hash() -> str:
    digest = hashlib.sha256(os.environ.get("NUMBA_BOUNDSCHECK", "").encode())
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


if "NUMBA_CACHE_DIR" not in os.environ:  # not exported: a child process may have another data directory
    numba.config.CACHE_DIR = str(data_directory() / "kernels" / _source_hash())

NO_JIT = bool(numba.config.DISABLE_JIT)

FASTMATH = {"contract", "reassoc", "arcp", "nsz"}


def jit(function):
    """Compile ``function`` with the project's options."""
    return numba.njit(nogil=True, cache=True, error_model="numpy", fastmath=FASTMATH)(function)


# A column loop (kernels/fold.py) is vectorised over x only after its rows are unrolled, which
# LLVM's default budget does not allow; it then runs three times faster (benchmarks/). LLVM takes
# these options process-wide only, so they are set for one compilation and put back.
_UNROLL_DEFAULT = 300
_COLUMN_CODE = {
    "-unroll-threshold": (2500, _UNROLL_DEFAULT),
    "-force-vector-width": (4, 0),  # 256 bits, layout.VECTOR: wider was slower
    "-force-vector-interleave": (1, 0),
    "-prefer-predicate-over-epilogue": ("predicate-else-scalar-epilogue", "scalar-epilogue"),  # no rest columns
}
#: More rows than this exceed the unroll budget; the loop then stays scalar.
MOST_UNROLLED_ROWS = 40
_compiling = threading.Lock()


def compile_columns(dispatcher, signature, rows: int) -> None:
    """Compile a jitted column loop over ``rows`` rows for one signature (or load it from the cache)."""
    if NO_JIT:
        return
    with _compiling:
        wanted = rows <= MOST_UNROLLED_ROWS
        try:
            for option, (value, _) in _COLUMN_CODE.items():
                if wanted:
                    llvm.set_option("vocalis", f"{option}={value}")
            dispatcher.compile(signature)
        finally:
            for option, (_, value) in _COLUMN_CODE.items():
                if wanted:
                    llvm.set_option("vocalis", f"{option}={value}")
