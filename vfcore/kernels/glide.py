"""A fold on its way between two: every fixed number of the buffer and of the step goes along a straight line."""

from functools import lru_cache
from types import FunctionType

from vfcore.kernels.fold import step_kernel
from vfcore.kernels.jit import jit
from vfcore.kernels.layout import RECORD

COLUMNS = len(RECORD)
#: The step of the grid at hand, see ``glide_kernel``.
advance = None


@jit
def differing(now, then, places, way):
    """Where two buffers differ: fill ``places`` and ``way`` (then less now), both (Layout.size,); return how many."""
    count = 0
    for k in range(now.size):
        difference = then[k] - now[k]
        if difference != 0.0:
            places[count], way[count] = k, difference
            count += 1
    return count


@jit
def put_between(buffer, places, origin, way, scalars, scalars_from, scalars_to, part):
    """Write the numbers that differ, at ``part`` (0 to 1) of the way.

    ``buffer``, ``origin`` (Layout.size,), the latter a buffer at rest; ``places``, ``way`` (n,) of ``differing``.
    ``scalars`` (len(SCALARS),) is written between the other two. Units as there.
    """
    for k in range(places.size):
        buffer[places[k]] = origin[places[k]] + part * way[k]
    for k in range(scalars.size):
        scalars[k] = scalars_from[k] + part * (scalars_to[k] - scalars_from[k])


@lru_cache(maxsize=32)
def glide_kernel(nx: int, ny: int, rotation: bool):
    """The compiled loop of a glide for one grid, over the step of vfcore/kernels/fold.py.

    The key under which compiled code is kept holds what a function closes over, and a compiled function in it would
    be another one in every process. So the grid is closed over, and the step stands among the globals.
    """
    grid = (nx, ny, int(rotation))

    def glide(
        buffer, places, origin, way, scalars, scalars_from, scalars_to, pressure, begin, end, stretch, record, air=None
    ):  # fmt: skip
        """Steps ``begin`` to ``end`` of a block in stretches, each at the middle of its part of the way.

        ``pressure`` (steps,), Pa, and ``record`` (steps·len(RECORD),) are those of the whole block, the rest as in
        ``put_between`` and in the step. Order 2 in the stretch.
        """
        steps = pressure.size + 0 * grid[0]
        while begin < end:
            until = min(begin + stretch, end)
            part = 0.5 * (begin + until) / steps
            put_between(buffer, places, origin, way, scalars, scalars_from, scalars_to, part)
            advance(buffer, scalars, pressure[begin:until], 1, record[begin * COLUMNS : until * COLUMNS], air)
            begin = until

    names = globals() | {"advance": step_kernel(nx, ny, rotation)}
    return jit(FunctionType(glide.__code__, names, glide.__name__, glide.__defaults__, glide.__closure__))
