"""The one place where a compile option is chosen, and where compiled code is kept.

- ``nogil``: a run never blocks the other threads of a server.
- ``error_model="numpy"``: a division by zero gives inf, as on paper, instead of a branch per division.
- ``fastmath``: contraction, reassociation, reciprocals and signed zeros are free. ``nnan``
  and ``ninf`` are left out on purpose: with them ``isnan`` may be optimised away, and a
  diverging run would go unnoticed.
- The step's rows must be unrolled before its columns can be vectorised; LLVM's default budget
  stops short of that. The three code-generation options below cost other functions nothing
  that could be measured and make the step three times faster (benchmarks/).
- Cache: numba's own stamp looks at one file only, and is stale when a function called from
  another file changes. So the cache directory is named by a hash of all kernel sources.
"""

import hashlib
import os
from pathlib import Path

import platformdirs


def data_directory() -> Path:
    """Where Vocalis keeps compiled kernels and results: ``VOCALIS_DATA`` or the user's data folder."""
    return Path(os.environ.get("VOCALIS_DATA") or platformdirs.user_data_dir("vocalis", appauthor=False))


def _source_hash() -> str:
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


os.environ.setdefault("NUMBA_CACHE_DIR", str(data_directory() / "kernels" / _source_hash()))

import llvmlite.binding as llvm  # noqa: E402

CODE_GENERATION = (
    "-unroll-threshold=2500",  # rows of the column loop
    "-force-vector-width=4",  # 256-bit: layout.VECTOR
    "-force-vector-interleave=1",
    "-prefer-predicate-over-epilogue=predicate-else-scalar-epilogue",  # no scalar rest columns
)
for _option in CODE_GENERATION:
    llvm.set_option("vocalis", _option)

import numba  # noqa: E402  (the cache directory must be set first)

FASTMATH = {"contract", "reassoc", "arcp", "nsz"}


def jit(function):
    """Compile ``function`` with the project's options."""
    return numba.njit(nogil=True, cache=True, error_model="numpy", fastmath=FASTMATH)(function)


def compiled(function) -> bool:
    """Whether a jitted function has machine code for at least one signature already."""
    return bool(getattr(function, "signatures", True))
