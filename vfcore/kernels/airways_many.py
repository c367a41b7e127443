"""The airways of several folds side by side, one fold per vector element. Equations and symbols as in airways.py.

Every number of the buffer is W neighbours, one per fold; areas, losses, ends and state differ between folds. Number of
sections and of steps are common to all.

Scaled waves. Let a_i be the wave that has arrived at the far end of section i, b_i the one at its glottal end, t_i the
transmission of the section and r_i the reflection at the junction beyond it:

    a_{i+1}' = t_{i+1} (a_i + r_i (a_i − b_{i+1})),   b_i' = t_i (b_{i+1} + r_i (a_i − b_{i+1}))

With a_i = α_i A_i and b_i = β_i B_i, where α_0 = t_0, α_{i+1} = t_{i+1} (1 + r_i) α_i and, from the far end (section e)
back, β_e = t_e, β_i = t_i (1 − r_i) β_{i+1}, a junction costs two multiply-adds instead of five operations:

    A_{i+1}' = A_i + g_i B_{i+1},   g_i = −r_i β_{i+1} / ((1 + r_i) α_i)      AHEAD
    B_i'     = B_{i+1} + h_i A_i,   h_i =  r_i α_i / ((1 − r_i) β_{i+1})      BEHIND

A_0' is the wave that leaves the glottis and B_e' the one that the far end reflects. The glottis receives β_0 B_0
(ARRIVAL_S, ARRIVAL_V). The filter at the far end takes A_e; its first two coefficients contain α_e.

Waves are updated in place: a junction reads A_i, held since A_i' was written, and B_{i+1}. A wave needs
one step of the airways for each section, so step l + 1 may pass junction i as soon as step l has passed junction i + 1.
DEPTH steps go through the sections together, each one junction behind the one before. The sections are then read and
written once in DEPTH steps, which is what limits the speed. The first junctions of all but the last step come before
that, because every step begins with the glottis; the last junctions of all but the first come after it.

Exact in the sense that it differs from airways.py by rounding only. Twin: advance_airways, one fold at a time.
"""

from vfcore.kernels import airways
from vfcore.kernels.flow import abs_
from vfcore.kernels.jit import inlined, jit
from vfcore.kernels.simd import load, maximum, multiply_add, square_root, store, width

glottal_flow = airways.glottal_flow
SMALLEST_DROP_PA = airways.SMALLEST_DROP_PA
# Header: the numbers of airways.py in the same order, W of each, then those of this file.
SUBSTEPS, SECTIONS_S, SECTIONS_V = airways.SUBSTEPS, airways.SECTIONS_S, airways.SECTIONS_V
IMPEDANCE_S, IMPEDANCE_V, END_S, END_V = airways.IMPEDANCE_S, airways.IMPEDANCE_V, airways.END_S, airways.END_V
MEMORY_S, MEMORY_V, DROP, CONDUCTANCE = airways.MEMORY_S, airways.MEMORY_V, airways.DROP, airways.CONDUCTANCE
VISCOUS_SHARE, FLOW, INLET, OUTLET = airways.VISCOUS_SHARE, airways.FLOW, airways.INLET, airways.OUTLET
EXCESS_S, EXCESS_V, SLOW_SHARE, SLOW_FLOW = airways.EXCESS_S, airways.EXCESS_V, airways.SLOW_SHARE, airways.SLOW_FLOW
#: Steps of the airways that go through the sections together.
DEPTH = 5
ARRIVAL_S, ARRIVAL_V, HELD_S, HELD_V = 23, 24, 25, 25 + DEPTH
HEADER = 25 + 2 * DEPTH
#: Numbers of one section, W of each: scaled waves A and B, and the coefficients of the junction beyond it.
SECTION = ("away", "back", "ahead", "behind")
PER_SECTION = len(SECTION)


@inlined
def cross(air, at, arrived, junctions):
    """One step across some junctions, the first of them beyond the section at ``at``. Returns A of the last section.

    ``arrived``: A of the section at ``at`` before the step; its place holds A after the step already.
    """
    W = width(arrived)
    a = arrived
    for _ in range(junctions):
        following = at + PER_SECTION * W
        ahead, behind = load(air, at + 2 * W, W), load(air, at + 3 * W, W)
        a_next, b = load(air, following, W), load(air, following + W, W)
        store(air, at + W, multiply_add(behind, a, b))
        store(air, following, multiply_add(ahead, b, a))
        a, at = a_next, following
    return a


@inlined
def cross_together(air, held, at, junctions, like):
    """DEPTH steps across ``junctions`` junctions each; step l begins l sections before the section at ``at``.

    ``held``: offset of DEPTH Vecs, for each step A of the section at which it begins, as it was before the step; on
    return, of the section at which it ends. ``like``: any Vec of the batch.
    """
    W = width(like)
    size = PER_SECTION * W
    # At its junction step l needs a_l; it will need n_l at the next one.
    a_0, a_1, a_2 = load(air, held, W), load(air, held + W, W), load(air, held + 2 * W, W)
    a_3, a_4 = load(air, held + 3 * W, W), load(air, held + 4 * W, W)
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
    store(air, held, a_0)
    store(air, held + W, a_1)
    store(air, held + 2 * W, a_2)
    store(air, held + 3 * W, a_3)
    store(air, held + 4 * W, a_4)
    store(air, at, n_1)
    store(air, at - size, n_2)
    store(air, at - 2 * size, n_3)
    store(air, at - 3 * size, n_4)


@inlined
def reflect(air, at, arrived, end, memory):
    """The far end, whose section is at ``at``, reflects ``arrived``; ``end``, ``memory``: as in airways.wave_step."""
    W = width(arrived)
    reflected = load(air, end, W) * arrived + load(air, memory, W)
    store(air, at + W, reflected)
    store(air, memory, load(air, end + W, W) * arrived - load(air, end + 2 * W, W) * reflected)


@inlined
def advance_together(air, P_s, conductance, viscous, dy, dphi, left, depth):
    """``depth`` steps of the airways, 1 or DEPTH; after them ``left`` are left in this step of the folds.

    ``conductance`` and ``viscous`` at its end, ``dy`` and ``dphi`` their changes per step of the airways.
    """
    W = width(P_s)
    n_s, n_v = int(air[SECTIONS_S * W]), int(air[SECTIONS_V * W])
    size = PER_SECTION * W
    begin_s = HEADER * W
    begin_v = begin_s + n_s * size
    Z_s, Z_v = load(air, IMPEDANCE_S * W, W), load(air, IMPEDANCE_V * W, W)
    slow, flow = load(air, SLOW_FLOW * W, W), load(air, FLOW * W, W)
    root_drop = square_root(maximum(abs_(load(air, DROP * W, W)), SMALLEST_DROP_PA))
    for step in range(depth):
        to_come = left + depth - 1 - step
        y, phi = maximum(conductance - to_come * dy, 0.0), viscous - to_come * dphi
        arrived_s = load(air, ARRIVAL_S * W, W) * load(air, begin_s + W, W)
        arrived_v = load(air, ARRIVAL_V * W, W) * load(air, begin_v + W, W)
        base_s = P_s + 2.0 * arrived_s + load(air, EXCESS_S * W, W) * slow
        base_v = 2.0 * arrived_v - load(air, EXCESS_V * W, W) * slow
        flow = glottal_flow(base_s - base_v, Z_s + Z_v, y, phi, root_drop)
        slow = slow + load(air, SLOW_SHARE * W, W) * (flow - slow)
        store(air, INLET * W, base_s - Z_s * flow)
        store(air, OUTLET * W, base_v + Z_v * flow)
        a_s, a_v = load(air, begin_s, W), load(air, begin_v, W)
        store(air, begin_s, arrived_s - Z_s * flow)
        store(air, begin_v, arrived_v + Z_v * flow)
        store(air, (HELD_S + step) * W, cross(air, begin_s, a_s, depth - 1 - step))
        store(air, (HELD_V + step) * W, cross(air, begin_v, a_v, depth - 1 - step))
    store(air, SLOW_FLOW * W, slow)
    store(air, FLOW * W, flow)
    end_s, end_v = begin_s + (n_s - 1) * size, begin_v + (n_v - 1) * size
    if depth == DEPTH:
        cross_together(air, HELD_S * W, begin_s + (DEPTH - 1) * size, n_s - DEPTH, P_s)
        cross_together(air, HELD_V * W, begin_v + (DEPTH - 1) * size, n_v - DEPTH, P_s)
    else:
        store(air, HELD_S * W, cross(air, begin_s, load(air, HELD_S * W, W), n_s - 1))
        store(air, HELD_V * W, cross(air, begin_v, load(air, HELD_V * W, W), n_v - 1))
    for step in range(depth):
        a_s = cross(air, end_s - step * size, load(air, (HELD_S + step) * W, W), step)
        a_v = cross(air, end_v - step * size, load(air, (HELD_V + step) * W, W), step)
        reflect(air, end_s, a_s, END_S * W, MEMORY_S * W)
        reflect(air, end_v, a_v, END_V * W, MEMORY_V * W)


@jit
def advance_airways_many(air, P_s, conductance, viscous):
    """Advance the airways of W folds by one step of the folds, at the end of which the glottes have the given laws.

    ``air``: buffer of vfcore.airways.coupled, Airways.new_buffers, of the precision of the Vecs. ``P_s`` in Pa,
    ``conductance`` in m³/(s √Pa), ``viscous`` the share φ: Vecs of W elements. FLOW, INLET, OUTLET and DROP of the last
    airway step are written to ``air``, each W numbers from its place times W on.
    """
    W = width(P_s)
    m = int(air[SUBSTEPS * W])
    dy = (conductance - load(air, CONDUCTANCE * W, W)) / m
    dphi = (viscous - load(air, VISCOUS_SHARE * W, W)) / m
    left = m
    if min(air[SECTIONS_S * W], air[SECTIONS_V * W]) >= DEPTH:
        while left >= DEPTH:
            left -= DEPTH
            advance_together(air, P_s, conductance, viscous, dy, dphi, left, DEPTH)
    while left > 0:
        left -= 1
        advance_together(air, P_s, conductance, viscous, dy, dphi, left, 1)
    store(air, CONDUCTANCE * W, conductance)
    store(air, VISCOUS_SHARE * W, viscous)
    store(air, DROP * W, load(air, INLET * W, W) - load(air, OUTLET * W, W))
