"""A fold that moves between two postures: every fixed number of the buffer and of the step changes linearly.

With s the fraction of the block that has passed, each fixed number of the buffer and each scalar of the step is

    c(s) = c_from + s (c_to − c_from)

held constant over a stretch of a few steps at the value of its middle. Order 2 in the length of a stretch. The state
(displacements, velocities) is left alone: nodes are material points (vfcore/runs/gesture/glide.py). Stability: both
ends must allow the step, which the caller checks. Twin: tests/physics/test_kernel_glide.py. Not validated against
measurements.
"""

from collections.abc import Callable
from functools import lru_cache

from vfcore.kernels.fold import step_kernel
from vfcore.kernels.jit import chosen_by_constants, jit
from vfcore.kernels.layout import RECORD, Layout

COLUMNS = len(RECORD)


def advance(nx, ny, rotation, buffer, scalars, pressure, record, air):
    """The step of one grid, every step recorded; ``nx``, ``ny`` and ``rotation`` (0 or 1) are constants."""
    step_kernel(nx, ny, rotation > 0)(buffer, scalars, pressure, 1, record, air)


@chosen_by_constants(advance, 3)
def _advance(nx, ny, rotation):
    """The step of the grid. As a variable of the caller it would be part of numba's cache key, and it has another key
    in every process, so no process would find the code that another has compiled.
    """
    step = step_kernel(nx, ny, rotation > 0)

    def advanced(nx, ny, rotation, buffer, scalars, pressure, record, air):
        step(buffer, scalars, pressure, 1, record, air)

    return advanced


@lru_cache(maxsize=32)
def glide_kernel(nx: int, ny: int, rotation: bool) -> Callable[..., None]:
    """The compiled loop of a glide for one grid, around the step of vfcore/kernels/fold.py."""
    L, turns = Layout(nx, ny), int(rotation)
    # The three ranges of the buffer that may differ between two folds of a grid: the medial plane, the fixed lines, and
    # from K_coup on everything but scratch.
    G, FIELDS_END = L.field("G"), L.field("G") + ny * L.stride
    LINES, LINES_END = L.line("beam_load"), L.line("column")
    K, K_END = L.K_coup, L.K_coup + ny
    BI, SIZE = L.beam_inverse, L.size

    @jit
    def glide(
        buffer, start, target, difference, scalars, scalars_from, scalars_to, pressure, begin, end, stretch, record, air
    ):
        """Advance steps ``begin`` to ``end`` of a block, in stretches of ``stretch`` steps.

        ``buffer``, ``start``, ``target`` (Layout.size,): the fold in motion, and the two folds at rest that the block
        leads from and to; ``scalars``, ``scalars_from``, ``scalars_to`` (len(SCALARS),) likewise. ``difference``
        (Layout.size,) is scratch. ``pressure`` (steps,), Pa, and ``record`` (steps·len(RECORD),) are those of the whole
        block. ``air``: as for the step, or None. After the last step the buffer holds the numbers of the target.
        """
        steps = pressure.size
        for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
            for k in range(first, last):
                difference[k] = target[k] - start[k]
        while begin < end:
            until = min(begin + stretch, end)
            part = 0.5 * (begin + until) / steps
            for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
                for k in range(first, last):
                    buffer[k] = start[k] + part * difference[k]
            for k in range(scalars.size):
                scalars[k] = scalars_from[k] + part * (scalars_to[k] - scalars_from[k])
            rows = record[begin * COLUMNS : until * COLUMNS]
            advance(nx, ny, turns, buffer, scalars, pressure[begin:until], rows, air)
            begin = until
        if end == steps:
            for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
                for k in range(first, last):
                    buffer[k] = target[k]

    return glide
