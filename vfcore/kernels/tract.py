"""Wave-reflection vocal tract (Kelly & Lochbaum 1962; paper, Acoustic output): one section of travel per step.

The tract is N tubes of equal length δ. In each tube the pressure is the sum of two plane waves that travel one
section per time step τ = δ/c:

    p = f + b,   u = (f − b)/Z_i,   Z_i = ρc/A_i

    glottis                                                lips
      Q_g → | f_0 →   | f_1 →   |  …  | f_{N−1} →   | p_lip, u_mouth
            |   ← b_0 |   ← b_1 |     |     ← b_{N−1}|

``f_i`` is the wave that has just entered tube i at its glottal end, ``b_i`` at its lip end. In one step both
cross the tube and lose the fraction 1 − α_i (Titze 2006, section 6.4):

    F_i = α_i f_i   at the lip end,       B_i = α_i b_i   at the glottal end,     α_i = 1 − 3.8e-3 δ/√A_i

Then every junction scatters. Continuity of pressure and flow between tubes i and i+1 gives

    r_i = (A_i − A_{i+1})/(A_i + A_{i+1})
    f'_{i+1} = (1 + r_i) F_i − r_i B_{i+1}
    b'_i     = r_i F_i + (1 − r_i) B_{i+1}
    f'_0     = B_0 + Z_0 Q_g                            (paper: P_e⁺ = P_e⁻ + ρ_a c_a Q_g/A_e)

The lip end is a one-pole reflection, in transposed direct form with one state variable m (coefficients β_0, β_1,
a_1 from ``vfcore.airways.tract``, which derives them from the radiation impedance):

    b'_{N−1} = β_0 F_{N−1} + m,     m' = β_1 F_{N−1} − a_1 b'_{N−1}
    p_lip = F_{N−1} + b'_{N−1},     u_mouth = (F_{N−1} − b'_{N−1})/Z_{N−1}

Exact for lossless plane waves in a stepped tube; no stability limit: with 0 < α ≤ 1 and |reflection| ≤ 1 the wave
energy Σ A_i (f_i² + b_i²) cannot grow. Not modelled: yielding walls, frequency-dependent losses, side branches.
Twin: tests/support/tract_twin.py. Not validated against measured tracts.
"""

import math

from vfcore.kernels.jit import jit

FINITE = 0
NOT_FINITE = 1


@jit
def advance_tract(
    flow,
    transmission,
    reflection,
    entry_impedance,
    exit_impedance,
    lip_reflection,
    forward,
    backward,
    lip_memory,
    lip_pressure,
    mouth_flow,
):
    """Advance the waves by ``len(flow)`` steps, in place.

    In: ``flow`` (n) Q_g, m³/s, one value per section travel; ``transmission`` (N) α; ``reflection`` (N−1) r;
    ``entry_impedance`` Z_0 and ``exit_impedance`` Z_{N−1}, Pa·s/m³; ``lip_reflection`` (3) β_0, β_1, a_1.
    In and out: ``forward`` (N) f, ``backward`` (N) b, ``lip_memory`` (1) m, all Pa.
    Out: ``lip_pressure`` (n) Pa, ``mouth_flow`` (n) m³/s.
    Returns FINITE, or NOT_FINITE if a wave is NaN or infinite.
    """
    last = forward.size - 1
    for n in range(flow.size):
        arriving = transmission[0] * backward[0]  # B_0
        leaving = transmission[0] * forward[0]  # F_i, read before f_i is overwritten
        forward[0] = arriving + entry_impedance * flow[n]
        for i in range(last):
            next_leaving = transmission[i + 1] * forward[i + 1]
            returning = transmission[i + 1] * backward[i + 1]
            scattered = reflection[i] * (leaving - returning)
            forward[i + 1] = leaving + scattered
            backward[i] = returning + scattered
            leaving = next_leaving
        reflected = lip_reflection[0] * leaving + lip_memory[0]
        lip_memory[0] = lip_reflection[1] * leaving - lip_reflection[2] * reflected
        backward[last] = reflected
        lip_pressure[n] = leaving + reflected
        mouth_flow[n] = (leaving - reflected) / exit_impedance
    total = lip_memory[0]
    for i in range(last + 1):
        total += forward[i] + backward[i]
    return FINITE if math.isfinite(total) else NOT_FINITE
