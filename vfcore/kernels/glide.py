"""A fold part of the way between two: every fixed number of the buffer and of the step on a straight line."""

from vfcore.kernels.jit import jit


@jit
def put_between(buffer, places, origin, way, scalars, scalars_from, scalars_to, part):
    """Write the numbers that differ, at ``part`` (0 to 1) of the way.

    ``buffer`` (Layout.size,); ``places`` (n,) where two buffers at rest differ, ``origin`` (n,) what stands there in
    the first, ``way`` (n,) second less first. ``scalars`` (len(SCALARS),) is written between the other two. Units as
    there.
    """
    for k in range(places.size):
        buffer[places[k]] = origin[k] + part * way[k]
    for k in range(scalars.size):
        scalars[k] = scalars_from[k] + part * (scalars_to[k] - scalars_from[k])
