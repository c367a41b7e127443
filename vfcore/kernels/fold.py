"""The step of the fold: flow → contact → membrane → beam, one compiled loop per grid.

Scheme (see docs/model.md, "Time stepping"). Velocities live on half steps:

    v^{n+½} = v^{n−½} + dt a(w^n, v*),   w^{n+1} = w^n + dt v^{n+½},   v* = v^{n−½} + ½ (v^{n−½} − v^{n−3/2})

v* extrapolates the velocity to time n, so every damper is second order. The beam takes the
trapezoidal rule for its own stiffness A (tension, bending, end moments, per mass):

    (w_b^{n+1} − 2 w_b^n + w_b^{n−1})/dt² = (I − dt²A/4)⁻¹ (A w_b^n + f/ρ_l)

which is unconditionally stable and undamped. With S = (I − dt²A/4)⁻¹ and SA = (4/dt²)(S − I)
the right side is S (f/ρ_l + 4/dt² w_b) − 4/dt² w_b: one dense product per step.

Order 2 in dt, dx, dy. Stability: vfcore/stability.py. Boundary slices x = 0, L count by the
trapezoid rule in area and flow. Written column by column (all y at one x) without branches:
the compiler unrolls the rows and vectorises over x. nx, ny and the shear form are constants
of the compiled loop.
"""

import math
from functools import lru_cache

import numpy as np

from vfcore.kernels import airways, contact, flow, membrane
from vfcore.kernels.jit import compile_columns, jit
from vfcore.kernels.layout import FIRST, Layout

touching, contact_pressure = contact.touching, contact.contact_pressure
gap, reciprocal, separation_gap, attached = flow.gap, flow.reciprocal, flow.separation_gap, flow.attached
viscous_segment, flux, pressure = flow.viscous_segment, flow.flux, flow.pressure
tension, coupling = membrane.tension, membrane.coupling
shear_strain, shear_flux = membrane.shear_strain, membrane.shear_flux
advance_airways, viscous_share = airways.advance_airways, airways.viscous_share
DROP, FLOW, INLET, OUTLET, SMALLEST_DROP_PA = (
    airways.DROP, airways.FLOW, airways.INLET, airways.OUTLET, airways.SMALLEST_DROP_PA,
)  # fmt: skip

NO_AIRWAYS = np.zeros(0)


@lru_cache(maxsize=32)
def step_kernel(nx: int, ny: int, rotation: bool, coupled: bool = False):
    """The compiled loop for one grid: ``advance(buf, par, P_s, record_every, record) -> None``.

    ``coupled``: the airways act back, and ``advance`` takes their buffer ``air`` (kernels/airways.py) as well.

    ``buf``: Layout(nx, ny).size float64. ``par``: layout.SCALARS. ``P_s``: lung pressure at
    each of the steps, Pa. ``record``: (len(P_s)//record_every, 5), layout.RECORD at the state
    before the step. Not validated against measurements; verified in tests/physics.
    """
    L = Layout(nx, ny)
    S, N, NB = L.stride, L.columns, nx - 2
    C1 = FIRST + 1  # column 1
    W, V, DV = L.field("w"), L.field("v"), L.field("dv")
    PH, VPH, DPH = L.field("phi"), L.field("vphi"), L.field("dvphi")
    G, K = L.field("G"), L.field("K_coup")
    R, M, I = L.field("reciprocal"), L.field("running_min"), L.field("viscous")
    AT, F, Q = L.field("attached"), L.field("force"), L.field("flux")
    WB, VB, DB = L.line("w_b"), L.line("v_b"), L.line("dv_b")
    FB, AB, LOAD = L.line("beam_force"), L.line("beam_acceleration"), L.line("beam_load")
    INV, WIDTH, PC = L.line("inverse_density"), L.line("width"), L.line("slice_contact")
    QA, QB, QS = L.line("bernoulli"), L.line("viscous_line"), L.line("slice_flow")
    BI = L.beam_inverse

    @jit
    def advance(buf, par, P_s_of, record_every, record, air):
        dt, dy, alpha_s, half_rho_a, twelve_mu_a, T = par[0], par[1], par[2], par[3], par[4], par[5]
        G_t, eta_t, C_coup, K_col, C_col, K_foun = par[6], par[7], par[8], par[9], par[10], par[11]
        C_foun, per_rho_l, per_J, G_m, eta_m = par[12], par[13], par[14], par[15], par[16]
        per_dy, half_dy, four_per_dt2 = 1.0 / dy, 0.5 * dy, 4.0 / (dt * dt)

        for n in range(P_s_of.size):
            inlet, outlet, drop = P_s_of[n], 0.0, P_s_of[n]
            area, flow_rate, slope, contact_area = 0.0, 0.0, 0.0, 0.0
            if coupled:
                drop = max(abs(air[DROP]), SMALLEST_DROP_PA)

            # flow: gaps, running minimum from the inlet, separation, each slice's resistance
            for i in range(C1, C1 + N):
                buf[M + ny * S + i] = 1.0
                d_max = 0.0
                for k in range(ny):
                    o = (ny - 1 - k) * S + i
                    d = gap(buf[G + o], buf[W + o])
                    buf[M + o] = min(d, buf[M + o + S])
                    d_max = max(d, d_max)
                    buf[R + o] = reciprocal(d)
                d_min = buf[M + i]
                d_sep = separation_gap(d_min, d_max, alpha_s)
                integral = 0.0
                for k in range(ny):
                    o = (ny - 1 - k) * S + i
                    on = attached(buf[M + o], buf[M + o + S], d_sep, d_min)
                    buf[AT + o] = on
                    buf[I + o] = integral
                    if k < ny - 1:
                        integral += on * viscous_segment(buf[R + o], buf[R + o - S], half_dy)
                r_sep = reciprocal(d_sep)
                A, B = half_rho_a * r_sep * r_sep, twelve_mu_a * integral
                q = flux(drop, A, B) if d_min > 0.0 else 0.0
                buf[QA + i], buf[QB + i], buf[QS + i] = A, B, q
                area += d_min * buf[WIDTH + i]
                flow_rate += q * buf[WIDTH + i]
                if coupled:
                    slope += buf[WIDTH + i] / math.sqrt(B * B + 4.0 * A * drop) if d_min > 0.0 else 0.0
            if coupled:
                advance_airways(air, P_s_of[n], flow_rate / math.sqrt(drop), viscous_share(flow_rate, slope, drop))
                inlet, outlet, drop, flow_rate = air[INLET], air[OUTLET], air[DROP], air[FLOW]

            for i in range(C1, C1 + N):
                q = buf[QS + i]
                if coupled:
                    q = flux(drop, buf[QA + i], buf[QB + i]) if buf[M + i] > 0.0 else 0.0
                # contact and membrane: all forces but shear; the beam's share of the coupling
                w_b = buf[WB + i]
                v_b = buf[VB + i] + 0.5 * buf[DB + i]
                largest, touched, to_beam = 0.0, 0.0, 0.0
                for j in range(ny):
                    o = j * S + i
                    w = buf[W + o]
                    v = buf[V + o] + 0.5 * buf[DV + o]
                    weight = 0.5 if j == 0 or j == ny - 1 else 1.0
                    p_aero = pressure(inlet, q, buf[R + o], buf[I + o], half_rho_a, twelve_mu_a)
                    p_aero = outlet + buf[AT + o] * (p_aero - outlet) if coupled else buf[AT + o] * p_aero
                    p_col = contact_pressure(w, v, buf[G + o], K_col, C_col)
                    traction = coupling(w, v, w_b, v_b, buf[K + o], C_coup)
                    largest = max(p_col, largest)
                    touched += weight * touching(w, buf[G + o])
                    to_beam += weight * traction
                    buf[F + o] = tension(buf[W + o - 1], w, buf[W + o + 1], T) - traction - p_aero - p_col
                # membrane: shear between rows
                for j in range(ny - 1):
                    o = j * S + i
                    v0 = buf[V + o] + 0.5 * buf[DV + o]
                    v1 = buf[V + o + S] + 0.5 * buf[DV + o + S]
                    if rotation:
                        rate = shear_strain(v0, v1, buf[VPH + o] + 0.5 * buf[DPH + o], per_dy)
                        strain = shear_strain(buf[W + o], buf[W + o + S], buf[PH + o], per_dy)
                        d_vphi = dt * per_J * shear_flux(strain, rate, G_m, eta_m)
                        buf[DPH + o] = d_vphi
                        buf[VPH + o] += d_vphi
                        buf[PH + o] += dt * buf[VPH + o]
                    else:
                        rate = shear_strain(v0, v1, 0.0, per_dy)
                        strain = shear_strain(buf[W + o], buf[W + o + S], 0.0, per_dy)
                    buf[Q + o] = shear_flux(strain, rate, G_t, eta_t) * per_dy
                for j in range(ny):
                    o = j * S + i
                    if j == 0:
                        shear = 2.0 * buf[Q + o]
                    elif j == ny - 1:
                        shear = -2.0 * buf[Q + o - S]
                    else:
                        shear = buf[Q + o] - buf[Q + o - S]
                    buf[F + o] = dt * (buf[F + o] + shear) * buf[INV + i]
                # beam: load per mass, ready for the implicit product
                load = to_beam * dy - K_foun * w_b - C_foun * v_b
                buf[FB + i] = load * per_rho_l + buf[LOAD + i] + four_per_dt2 * w_b
                buf[PC + i] = largest
                contact_area += touched * buf[WIDTH + i]

            if n % record_every == 0:
                row = n // record_every
                record[row, 0] = area
                record[row, 1] = flow_rate
                record[row, 2] = 0.0
                record[row, 3] = math.nan
                record[row, 4] = contact_area * dy
                record[row, 5] = inlet
                record[row, 6] = outlet
                if contact_area > 0.0:
                    for i in range(C1, C1 + NB):
                        if buf[PC + i] > record[row, 2]:
                            record[row, 2] = buf[PC + i]
                            record[row, 3] = i - FIRST

            # membrane and beam: advance velocity, then displacement
            for o in range(ny * S):
                dv = buf[F + o]
                v = buf[V + o] + dv
                buf[DV + o] = dv
                buf[V + o] = v
                buf[W + o] += dt * v
            for i in range(C1, C1 + N):
                acceleration = -four_per_dt2 * buf[WB + i]
                for k in range(NB):
                    acceleration += buf[BI + k * N + i - C1] * buf[FB + C1 + k]
                buf[AB + i] = acceleration
            for i in range(C1, C1 + N):
                dv = dt * buf[AB + i]
                v = buf[VB + i] + dv
                buf[DB + i] = dv
                buf[VB + i] = v
                buf[WB + i] += dt * v

    compile_columns(advance, "void(f8[::1], f8[::1], f8[::1], i8, f8[:, ::1], f8[::1])", ny)
    if coupled:
        return advance
    return lambda buf, par, P_s_of, record_every, record: advance(buf, par, P_s_of, record_every, record, NO_AIRWAYS)
