"""A fold on its way between two: every fixed number of the buffer and of the step goes along a straight line."""

from functools import lru_cache
from types import FunctionType

from vfcore.kernels.fold import step_kernel
from vfcore.kernels.jit import jit
from vfcore.kernels.layout import RECORD, Layout

COLUMNS = len(RECORD)
#: The step of the grid at hand, see ``glide_kernel``.
advance = None


@lru_cache(maxsize=32)
def glide_kernel(nx: int, ny: int, rotation: bool):
    """The compiled loop of a glide for one grid, over the step of vfcore/kernels/fold.py.

    The key under which compiled code is kept holds what a function closes over, and a compiled function in it would
    be another one in every process. So offsets are closed over, and the step stands among the globals.
    """
    L = Layout(nx, ny)
    # What may differ between two folds of a grid, three stretches of the buffer: the medial plane, the fixed lines, and
    # from the first numbers by row on what is no scratch.
    G, FIELDS_END = L.field("G"), L.field("G") + ny * L.stride
    LINES, LINES_END = L.line("beam_load"), L.line("column")
    K, K_END = L.K_coup, L.K_coup + ny
    BI, SIZE, turns = L.beam_inverse, L.size, int(rotation)

    def glide(
        buffer, origin, goal, way, scalars, scalars_from, scalars_to, pressure, begin, end, stretch, record, air=None
    ):  # fmt: skip
        """Steps ``begin`` to ``end`` of a block in stretches, each at the middle of its part of the way.

        ``buffer``, ``origin``, ``goal`` (Layout.size,): the fold in motion, and two at rest; ``scalars`` likewise
        (len(SCALARS),). ``way`` (Layout.size,) is scratch. ``pressure`` (steps,), Pa, and ``record``
        (steps·len(RECORD),) are those of the whole block. At the last step the buffer is left with the goal's numbers.
        Order 2 in the stretch.
        """
        steps = pressure.size + 0 * turns
        for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
            for k in range(first, last):
                way[k] = goal[k] - origin[k]
        while begin < end:
            until = min(begin + stretch, end)
            part = 0.5 * (begin + until) / steps
            for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
                for k in range(first, last):
                    buffer[k] = origin[k] + part * way[k]
            for k in range(scalars.size):
                scalars[k] = scalars_from[k] + part * (scalars_to[k] - scalars_from[k])
            advance(buffer, scalars, pressure[begin:until], 1, record[begin * COLUMNS : until * COLUMNS], air)
            begin = until
        if end == steps:
            for first, last in ((G, FIELDS_END), (LINES, LINES_END), (K, K_END), (BI, SIZE)):
                for k in range(first, last):
                    buffer[k] = goal[k]

    names = globals() | {"advance": step_kernel(nx, ny, rotation)}
    return jit(FunctionType(glide.__code__, names, glide.__name__, glide.__defaults__, glide.__closure__))
