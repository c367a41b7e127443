"""The airways of several folds side by side, one fold per vector element. Equations and symbols as in airways.py.

W folds in a Vec. The number of sections and of steps is the same for all; areas, losses, ends and state are not.

Scaled waves. Let a_i be the wave that has arrived at the far end of section i, b_i the one at its glottal end, t_i the
transmission of the section and r_i the reflection at the junction beyond it:

    a_{i+1}' = t_{i+1} (a_i + r_i (a_i − b_{i+1})),   b_i' = t_i (b_{i+1} + r_i (a_i − b_{i+1}))

Write a_i = α_i A_i and b_i = β_i B_i, where α_0 = t_0, α_{i+1} = t_{i+1} (1 + r_i) α_i and, from the last section e
back, β_e = t_e, β_i = t_i (1 − r_i) β_{i+1}. Then a junction costs two multiply-adds instead of five operations, and
none where the area does not change:

    A_{i+1}' = A_i + g_i B_{i+1},   g_i = −r_i β_{i+1} / ((1 + r_i) α_i)
    B_i'     = B_{i+1} + h_i A_i,   h_i =  r_i α_i / ((1 − r_i) β_{i+1})

A_0' is the wave that leaves the glottis and B_e' the one that the far end reflects. The glottis receives β_0 B_0. The
filter of the far end takes A_e; its coefficients β_0 and β_1 (tract.py) contain the factor α_e.

Below the glottis the area changes at a few junctions only. Waves between them stay where they are in memory: after n
steps A_i is at the place i − n, and B_i at i + n, modulo the number of sections. A step changes A and B at the
junctions, takes A_e and B_0 out, and puts A_0' and B_e' at their places.

Above the glottis every junction reflects. Waves are updated in place: a junction reads A_i, loaded before A_i' was
written, and B_{i+1}. Step l + 1 may pass junction i as soon as step l has passed junction i + 1. So DEPTH steps go
through the sections together, each one junction behind the one before, and the sections are read and written once in
DEPTH steps. The first junctions of a step are passed before that, because each step begins with the flow; the last
junctions of a step come after it. Steps that are left over, fewer than DEPTH, go through the sections one by one.

Differs from airways.py by rounding. Twin: advance_airways, one fold at a time.
"""

from vfcore.kernels import airways
from vfcore.kernels.elementary import abs_
from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.simd import load, maximum, multiply_add, square_root, store, width

glottal_flow = airways.glottal_flow
SMALLEST_DROP_PA = airways.SMALLEST_DROP_PA
#: Steps of the airways that go through the sections together.
DEPTH = 5
# Number k of the buffer is W neighbours from k W on, one per fold. The header begins with the numbers of airways.py.
SUBSTEPS, SECTIONS_S, SECTIONS_V = airways.SUBSTEPS, airways.SECTIONS_S, airways.SECTIONS_V
IMPEDANCE_S, IMPEDANCE_V, END_S, END_V = airways.IMPEDANCE_S, airways.IMPEDANCE_V, airways.END_S, airways.END_V
MEMORY_S, MEMORY_V, DROP, CONDUCTANCE = airways.MEMORY_S, airways.MEMORY_V, airways.DROP, airways.CONDUCTANCE
VISCOUS_SHARE, FLOW, INLET, OUTLET = airways.VISCOUS_SHARE, airways.FLOW, airways.INLET, airways.OUTLET
EXCESS_S, EXCESS_V, SLOW_SHARE, SLOW_FLOW = airways.EXCESS_S, airways.EXCESS_V, airways.SLOW_SHARE, airways.SLOW_FLOW
# β_0 of both airways; number of junctions below; steps so far, modulo the sections below; A of the section at which
# each of DEPTH steps has ended. What is common to all folds is read from the first.
ARRIVAL_S, ARRIVAL_V, JUNCTIONS_S, SHIFT, ENDED = 23, 24, 25, 26, 27
HEADER = ENDED + DEPTH
# Below: A, B (one number per section each), then three numbers per junction: section before it, g, h.
# Above: four numbers per section: A, B, g, h.
JUNCTION, SECTION = 3, 4


@inlined
def cross(air, at, arrived, junctions):
    """One step across some junctions above the glottis. Returns A of the section after them, as before the step.

    ``at``: offset of the section before them; its A in ``air`` is that after the step, ``arrived`` that before it.
    """
    W = width(arrived)
    a = arrived
    for _ in range(junctions):
        following = at + SECTION * W
        g, h = load(air, at + 2 * W, W), load(air, at + 3 * W, W)
        a_next, b = load(air, following, W), load(air, following + W, W)
        store(air, at + W, multiply_add(h, a, b))
        store(air, following, multiply_add(g, b, a))
        a, at = a_next, following
    return a


@inlined
def cross_together(air, ended, at, junctions, like):
    """DEPTH steps across ``junctions`` junctions each; step l begins l sections before the section at ``at``.

    ``ended``: offset of A of the sections at which the steps begin, as before each step; on return, of those at which
    they end. ``like``: any Vec of the batch.
    """
    W = width(like)
    size = SECTION * W
    # At its junction step l needs a_l, g_l and h_l; at the next one it will need n_l.
    a_0, a_1, a_2 = load(air, ended, W), load(air, ended + W, W), load(air, ended + 2 * W, W)
    a_3, a_4 = load(air, ended + 3 * W, W), load(air, ended + 4 * W, W)
    n_1, n_2 = load(air, at, W), load(air, at - size, W)
    n_3, n_4 = load(air, at - 2 * size, W), load(air, at - 3 * size, W)
    g_1, h_1 = load(air, at - size + 2 * W, W), load(air, at - size + 3 * W, W)
    g_2, h_2 = load(air, at - 2 * size + 2 * W, W), load(air, at - 2 * size + 3 * W, W)
    g_3, h_3 = load(air, at - 3 * size + 2 * W, W), load(air, at - 3 * size + 3 * W, W)
    g_4, h_4 = load(air, at - 4 * size + 2 * W, W), load(air, at - 4 * size + 3 * W, W)
    for _ in range(junctions):
        g_0, h_0 = load(air, at + 2 * W, W), load(air, at + 3 * W, W)
        n_0, b = load(air, at + size, W), load(air, at + size + W, W)
        m_1, b = multiply_add(g_0, b, a_0), multiply_add(h_0, a_0, b)
        m_2, b = multiply_add(g_1, b, a_1), multiply_add(h_1, a_1, b)
        m_3, b = multiply_add(g_2, b, a_2), multiply_add(h_2, a_2, b)
        m_4, b = multiply_add(g_3, b, a_3), multiply_add(h_3, a_3, b)
        store(air, at - 3 * size, multiply_add(g_4, b, a_4))
        store(air, at - 4 * size + W, multiply_add(h_4, a_4, b))
        a_0, a_1, a_2, a_3, a_4 = n_0, n_1, n_2, n_3, n_4
        n_1, n_2, n_3, n_4 = m_1, m_2, m_3, m_4
        g_1, g_2, g_3, g_4 = g_0, g_1, g_2, g_3
        h_1, h_2, h_3, h_4 = h_0, h_1, h_2, h_3
        at = at + size
    store(air, ended, a_0)
    store(air, ended + W, a_1)
    store(air, ended + 2 * W, a_2)
    store(air, ended + 3 * W, a_3)
    store(air, ended + 4 * W, a_4)
    store(air, at, n_1)
    store(air, at - size, n_2)
    store(air, at - 2 * size, n_3)
    store(air, at - 3 * size, n_4)


@inlined
def reflected(air, arrived, end, memory):
    """The wave that the far end reflects. ``end``, ``memory``: offsets of its filter and of the filter's state."""
    W = width(arrived)
    wave = load(air, end, W) * arrived + load(air, memory, W)
    store(air, memory, load(air, end + W, W) * arrived - load(air, end + 2 * W, W) * wave)
    return wave


@inlined
def step_below(air, leaving, shift, n_s, junctions):
    """One step of the airway below the glottis, which ``leaving`` enters. ``shift``: steps so far, modulo ``n_s``."""
    W = width(leaving)
    away, back = HEADER * W, (HEADER + n_s) * W
    at = back + n_s * W
    for _ in range(junctions):
        i = int(air[at])
        place_a, place_b = i - shift, i + 1 + shift
        if place_a < 0:
            place_a += n_s
        if place_b >= n_s:
            place_b -= n_s
        a, b = load(air, away + place_a * W, W), load(air, back + place_b * W, W)
        store(air, away + place_a * W, multiply_add(load(air, at + W, W), b, a))
        store(air, back + place_b * W, multiply_add(load(air, at + 2 * W, W), a, b))
        at = at + JUNCTION * W
    last = away + (n_s - 1 - shift) * W
    store(air, back + shift * W, reflected(air, load(air, last, W), END_S * W, MEMORY_S * W))
    store(air, last, leaving)


@inlined
def advance_together(air, P_s, conductance, viscous, dy, dphi, left, depth):
    """``depth`` steps of the airways, 1 or DEPTH; after them ``left`` are left in this step of the folds.

    ``conductance`` and ``viscous`` at its end, ``dy`` and ``dphi`` their changes per step of the airways.
    """
    W = width(P_s)
    size = SECTION * W
    n_s, n_v, junctions = int(air[SECTIONS_S * W]), int(air[SECTIONS_V * W]), int(air[JUNCTIONS_S * W])
    begin = (HEADER + 2 * n_s + JUNCTION * junctions) * W  # of the sections above the glottis
    last = begin + (n_v - 1) * size
    Z_s, Z_v = load(air, IMPEDANCE_S * W, W), load(air, IMPEDANCE_V * W, W)
    root_drop = square_root(maximum(abs_(load(air, DROP * W, W)), SMALLEST_DROP_PA))
    slow, flow, shift = load(air, SLOW_FLOW * W, W), load(air, FLOW * W, W), int(air[SHIFT * W])

    # the flow of each step, the airway below, and the first junctions above
    for step in range(depth):
        to_come = left + depth - 1 - step
        y = maximum(conductance - to_come * dy, 0.0)  # exact in the last step: 0 for a closed glottis
        phi = viscous - to_come * dphi
        arrived_s = load(air, ARRIVAL_S * W, W) * load(air, (HEADER + n_s + shift) * W, W)
        arrived_v = load(air, ARRIVAL_V * W, W) * load(air, begin + W, W)
        base_s = P_s + 2.0 * arrived_s + load(air, EXCESS_S * W, W) * slow
        base_v = 2.0 * arrived_v - load(air, EXCESS_V * W, W) * slow
        flow = glottal_flow(base_s - base_v, Z_s + Z_v, y, phi, root_drop)
        slow = slow + load(air, SLOW_SHARE * W, W) * (flow - slow)
        store(air, INLET * W, base_s - Z_s * flow)
        store(air, OUTLET * W, base_v + Z_v * flow)
        step_below(air, arrived_s - Z_s * flow, shift, n_s, junctions)
        shift = shift + 1 if shift + 1 < n_s else 0
        a_0 = load(air, begin, W)
        store(air, begin, arrived_v + Z_v * flow)
        store(air, (ENDED + step) * W, cross(air, begin, a_0, depth - 1 - step))
    store(air, SLOW_FLOW * W, slow)
    store(air, FLOW * W, flow)
    air[SHIFT * W] = shift

    # all other junctions above
    if depth == DEPTH:
        cross_together(air, ENDED * W, begin + (DEPTH - 1) * size, n_v - DEPTH, P_s)
    else:
        store(air, ENDED * W, cross(air, begin, load(air, ENDED * W, W), n_v - 1))
    for step in range(depth):
        arrived = cross(air, last - step * size, load(air, (ENDED + step) * W, W), step)
        store(air, last + W, reflected(air, arrived, END_V * W, MEMORY_V * W))


@jit
def advance_airways_many(air, P_s, conductance, viscous):
    """Advance the airways of W folds by one step of the folds, at the end of which each glottis has the given law.

    ``air``: buffer of vfcore.airways.coupled, Airways.new_buffers, of the precision of the Vecs. ``P_s`` in Pa,
    ``conductance`` in m³/(s √Pa), ``viscous`` the share φ: Vecs of W elements. FLOW, INLET, OUTLET and DROP of the last
    step of the airways are written to ``air``, W numbers each, from FLOW W on and so forth.
    """
    W = width(P_s)
    left = int(air[SUBSTEPS * W])
    dy = (conductance - load(air, CONDUCTANCE * W, W)) / left
    dphi = (viscous - load(air, VISCOUS_SHARE * W, W)) / left
    if air[SECTIONS_V * W] >= DEPTH:
        while left >= DEPTH:
            left -= DEPTH
            advance_together(air, P_s, conductance, viscous, dy, dphi, left, DEPTH)
    while left > 0:
        left -= 1
        advance_together(air, P_s, conductance, viscous, dy, dphi, left, 1)
    store(air, CONDUCTANCE * W, conductance)
    store(air, VISCOUS_SHARE * W, viscous)
    store(air, DROP * W, load(air, INLET * W, W) - load(air, OUTLET * W, W))
