"""The two airways and the glottis between them: the flow of two-way source–tract coupling.

Both airways are tubes as in tract.py, each seen from the glottis: the trachea (subscript s) ends at the lungs, the
vocal tract (subscript v) at the lips. Waves below the glottis are deviations from the lung pressure P_s, so a closed
glottis at rest carries exactly P_s. With B_s, B_v the waves that have just arrived at the glottis, Z_s, Z_v = ρc/A the
impedances of the two adjacent tubes, and Q the flow towards the mouth:

    f_s = B_s − Z_s Q,   p_s = P_s + B_s + f_s = P_s + 2 B_s − Z_s Q          pressure at the inlet, y = b
    f_v = B_v + Z_v Q,   p_v =       B_v + f_v =       2 B_v + Z_v Q          pressure at the outlet, y = 0
    Δp = p_s − p_v = D − Z Q,    D = P_s + 2 B_s − 2 B_v,    Z = Z_s + Z_v    transglottal pressure

(Titze 2008, with the paper's viscous Bernoulli law in place of his coefficient.) Each slice obeys A q² + B q = Δp
(flow.py), so Q(Δp) = Σ q_i dx_i is increasing and concave, and the equation has one root. Q and its slope are computed
at Δp_0, the drop of the previous step. Q(Δp) is then replaced by the law of one slice with the same value and slope:

    Q_0 = Σ q_i dx_i,   S_0 = dQ/dΔp = Σ dx_i/√(B_i² + 4 A_i Δp_0)
    y = Q_0/√Δp_0  (conductance),   φ = 2 − Q_0/(S_0 Δp_0)  (share of the drop that is viscous, in [0, 1])
    (1 − φ) Q²/y² + φ √Δp_0 Q/y = Δp

This is exact for equal slices and at Δp_0. With Δp = D − Z Q it is a quadratic equation for Q. For Δp < 0 the law is
odd: a backward flow through the same opening, without a separation law of its own. One step of the fold holds m steps
of the airways, τ each; y and φ change linearly from the previous step to this one, so the flow is second order in time.
Passive, hence stable: the tubes lose energy, and the glottis takes Q Δp ≥ 0.

The loss per section does not depend on frequency. That suits formants, but at 0 Hz it is a flow resistance R_0 of
about 0.5 kPa per L/s in each airway, far above the true resistance R (vfcore.airways.coupled). So the excess
R_e = R_0 − R acts only on the fast part of the flow:  p_s + R_e,s Q̂,  p_v − R_e,v Q̂,  T dQ̂/dt = Q − Q̂.

Not modelled: inertia of the air between the folds, the volume they displace, pressure recovery behind the jet.
Twin: tests/support/airways_twin.py. Not validated against measured pressures.
"""

import math

from vfcore.kernels.elementary import abs_
from vfcore.kernels.jit import jit
from vfcore.kernels.simd import load, maximum, minimum, select, square_root, store

# Header of the airways buffer: fixed numbers, then the state. The rows of both airways follow it.
SUBSTEPS, SECTIONS_S, SECTIONS_V, IMPEDANCE_S, IMPEDANCE_V, END_S, END_V = 0, 1, 2, 3, 4, 5, 8
MEMORY_S, MEMORY_V, DROP, CONDUCTANCE, VISCOUS_SHARE, FLOW, INLET, OUTLET = 11, 12, 13, 14, 15, 16, 17, 18
EXCESS_S, EXCESS_V, SLOW_SHARE, SLOW_FLOW = 19, 20, 21, 22
HEADER = 24
#: Arrays of each airway, one value per section: waves that have arrived at the far end and at the glottal end (Pa,
#: deviations), the same for the next step, transmission of a section, reflection at the junction beyond the section.
#: A row is padded with zeros, so that the last section fits in a whole vector.
ROWS = ("away", "back", "next_away", "next_back", "transmission", "reflection")
WIDTH = 8  # sections per SIMD vector
# The law is linearised at this drop or more, so that its viscous share is finite.
SMALLEST_DROP_PA = 1.0
#: Keeps the flow through a closed glottis finite, m³/s·√Pa; far below any opening, and normal in single precision.
SMALLEST_ROOT = 1e-30


@jit
def row_length(sections):
    """Length of one row of an airway with this number of sections."""
    return (sections // WIDTH + 2) * WIDTH


@jit
def viscous_share(flow, slope, drop):
    """φ of the law through (``drop``, ``flow``) with slope dQ/dΔp ``slope``; 1 for a closed glottis. Floats or Vecs."""
    return select(flow > 0.0, minimum(maximum(2.0 - flow / (slope * drop), 0.0), 1.0), 1.0)


@jit
def glottal_flow(D, Z, conductance, viscous, root_drop):
    """Q, m³/s, from the law of the glottis and Δp = D − Z Q; ``root_drop`` is √Δp_0, √Pa. Floats or Vecs."""
    y2 = conductance * conductance
    B = viscous * root_drop * conductance + Z * y2
    return 2.0 * D * y2 / (B + square_root(B * B + 4.0 * (1.0 - viscous) * abs_(D) * y2) + SMALLEST_ROOT)


@jit
def wave_step(air, away, back, next_away, next_back, transmission, reflection, last, entering, end, memory):
    """One step of one airway: all waves cross a section and scatter. Returns the new state of the far end's filter.

    ``away`` … ``reflection``: offsets of the rows of the airway in ``air``. ``last``: index of its last section.
    ``entering``: the wave that leaves the glottis, Pa. ``end``: offset of β_0, β_1, a_1, the reflection at the far
    end; ``memory``: state of that filter, Pa.
    """
    for i in range(0, last, WIDTH):
        a, b = load(air, away + i, WIDTH), load(air, back + i + 1, WIDTH)
        scattered = load(air, reflection + i, WIDTH) * (a - b)
        store(air, next_away + i + 1, load(air, transmission + i + 1, WIDTH) * (a + scattered))
        store(air, next_back + i, load(air, transmission + i, WIDTH) * (b + scattered))
    air[next_away] = air[transmission] * entering
    arrived = air[away + last]
    reflected = air[end] * arrived + memory
    air[next_back + last] = air[transmission + last] * reflected
    return air[end + 1] * arrived - air[end + 2] * reflected


@jit
def advance_airways(air, P_s, conductance, viscous):
    """Advance both airways by one step of the fold, at the end of which the glottis has the given law.

    ``air``: buffer of vfcore.airways.coupled; FLOW, INLET, OUTLET and DROP of the last airway step are written to it.
    ``P_s`` in Pa, ``conductance`` in m³/(s √Pa), ``viscous`` the share φ.
    """
    m, n_s, n_v = int(air[SUBSTEPS]), int(air[SECTIONS_S]), int(air[SECTIONS_V])
    Z_s, Z_v = air[IMPEDANCE_S], air[IMPEDANCE_V]
    row_s, row_v = row_length(n_s), row_length(n_v)
    begin_v = HEADER + 6 * row_s
    now_s, next_s, now_v, next_v = HEADER, HEADER + 2 * row_s, begin_v, begin_v + 2 * row_v
    dy, dphi = (conductance - air[CONDUCTANCE]) / m, (viscous - air[VISCOUS_SHARE]) / m
    root_drop = math.sqrt(max(abs(air[DROP]), SMALLEST_DROP_PA))
    excess_s, excess_v, slow = air[EXCESS_S], air[EXCESS_V], air[SLOW_FLOW]
    flow, base_s, base_v = 0.0, 0.0, 0.0
    for k in range(m):
        y = max(conductance - (m - 1 - k) * dy, 0.0)  # exact in the last substep: 0 for a closed glottis
        phi = viscous - (m - 1 - k) * dphi
        arrived_s, arrived_v = air[now_s + row_s], air[now_v + row_v]
        base_s = P_s + 2.0 * arrived_s + excess_s * slow
        base_v = 2.0 * arrived_v - excess_v * slow
        flow = glottal_flow(base_s - base_v, Z_s + Z_v, y, phi, root_drop)
        slow += air[SLOW_SHARE] * (flow - slow)
        air[MEMORY_S] = wave_step(
            air,
            now_s,
            now_s + row_s,
            next_s,
            next_s + row_s,
            HEADER + 4 * row_s,
            HEADER + 5 * row_s,
            n_s - 1,
            arrived_s - Z_s * flow,
            END_S,
            air[MEMORY_S],
        )
        air[MEMORY_V] = wave_step(
            air,
            now_v,
            now_v + row_v,
            next_v,
            next_v + row_v,
            begin_v + 4 * row_v,
            begin_v + 5 * row_v,
            n_v - 1,
            arrived_v + Z_v * flow,
            END_V,
            air[MEMORY_V],
        )
        now_s, next_s = next_s, now_s
        now_v, next_v = next_v, now_v
    if m % 2 == 1:  # the newest waves are in the rows next_away and next_back: copy them back
        for i in range(2 * row_s):
            air[next_s + i] = air[now_s + i]
        for i in range(2 * row_v):
            air[next_v + i] = air[now_v + i]
    air[CONDUCTANCE], air[VISCOUS_SHARE], air[FLOW] = conductance, viscous, flow
    air[SLOW_FLOW] = slow
    air[INLET], air[OUTLET] = base_s - Z_s * flow, base_v + Z_v * flow
    air[DROP] = air[INLET] - air[OUTLET]
