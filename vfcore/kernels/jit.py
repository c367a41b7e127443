"""Compile options of every kernel, and the directory of the kernel cache.

- ``nogil``: a run never blocks the other threads of a server.
- ``error_model="numpy"``: a division by zero gives inf, so there is no branch per division.
- ``fastmath``: the compiler may contract, reassociate, use reciprocals and ignore signed zeros. ``nnan`` and ``ninf``
  are excluded on purpose: with them ``isnan`` may be optimised away, and a diverging run would go unnoticed.
- Cache: numba's own stamp covers one file only, and is stale when a function called from another file changes. So the
  cache directory is named by a hash of the sources of all rooms with compiled code and of NUMBA_BOUNDSCHECK, which
  numba's key leaves out: a checked run would otherwise load unchecked code.
"""

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numba
from numba.extending import overload, register_jitable

from vfcore.directories import data_directory

#: The rooms of vfcore that hold compiled code.
COMPILED_ROOMS = ("kernels", "fold", "larynx/tissue")


def _source_hash() -> str:
    digest = hashlib.sha256(os.environ.get("NUMBA_BOUNDSCHECK", "").encode())
    core = Path(__file__).parent.parent
    for room in COMPILED_ROOMS:
        for path in sorted((core / room).rglob("*.py")):
            digest.update(path.relative_to(core).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


config: Any = numba.config  # its attributes are made at run time
if "NUMBA_CACHE_DIR" not in os.environ:  # not exported: a child process may have another data directory
    config.CACHE_DIR = str(data_directory() / "kernels" / _source_hash())


def kernel_directory() -> Path:
    """Cache directory of the present kernel sources."""
    return Path(config.CACHE_DIR)


ARITHMETIC: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract", "reassoc", "arcp", "nsz"}}
OPTIONS: dict[str, Any] = {"nogil": True, "cache": True, **ARITHMETIC}

Function = TypeVar("Function", bound=Callable[..., Any])


def jit(function: Function) -> Function:
    """Compile ``function`` with the project's options."""
    return numba.njit(**OPTIONS)(function)


def inlined(function: Function) -> Function:
    """Compile ``function`` and force it inline wherever another compiled function calls it.

    Without forced inlining numba may call a separately compiled copy, and the order of summation (the last bit) would
    depend on what the process has compiled or loaded before.
    """
    return numba.njit(forceinline=True, **OPTIONS)(function)


def formula(function: Function) -> Function:
    """A plain Python function that compiled code can call too, forced inline.

    A formula that both need is written once, and its Python result does not depend on the compiler.
    """
    return register_jitable(forceinline=True, **ARITHMETIC)(function)


def written_out(function: Function) -> Function:
    """A plain Python function whose lines are copied into every compiled caller before the caller is compiled.

    So a formula of one function can move to its own without changing the last bit of the result, which forced inlining
    of compiled code does not warrant. The arithmetic is the caller's.
    """
    return register_jitable(inline="always")(function)


def chosen_by_constants(function: Function, count: int) -> Callable[[Callable[..., Function]], Any]:
    """Decorator of a chooser: a compiled call of ``function`` runs what the chooser returns, forced inline.

    The first ``count`` arguments of ``function`` must be integer constants of the caller. The chooser gets their values
    while the caller is compiled, so they, and not what is chosen, are part of the caller's cache key. Interpreted,
    ``function`` itself is called.
    """
    options: Any = {"forceinline": True, **ARITHMETIC}

    def decorate(chooser: Callable[..., Function]) -> Any:
        def choose(*arguments):
            constants = arguments[:count]
            if all(isinstance(constant, numba.types.IntegerLiteral) for constant in constants):
                return chooser(*(constant.literal_value for constant in constants))
            return None

        return overload(function, prefer_literal=True, strict=False, jit_options=options)(choose)

    return decorate
