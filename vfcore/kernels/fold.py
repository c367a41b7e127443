"""The step of the fold: flow → contact → membrane → beam. One file, because it is one compiled loop.

Scheme (docs/model/numerics.md, "Time stepping"). Velocities are defined on half steps:

    v^{n+½} = v^{n−½} + dt a(w^n, v*),   w^{n+1} = w^n + dt v^{n+½},   v* = v^{n−½} + ½ (v^{n−½} − v^{n−3/2})

v* extrapolates the velocity to time n, so every damper is second order. The membrane displacement has one more term
(kernels/displacement.py). The forces write it to a second field, because neighbours still need the old value; the two
fields swap roles each step. The beam uses the trapezoidal rule for its own stiffness A (tension, bending, end moments,
per mass):

    (w_b^{n+1} − 2 w_b^n + w_b^{n−1})/dt² = (I − dt²A/4)⁻¹ (A w_b^n + f/ρ_l)

which is unconditionally stable and undamped. With S = (I − dt²A/4)⁻¹ and SA = (4/dt²)(S − I) the right side is
S (f/ρ_l + 4/dt² w_b) − 4/dt² w_b. For one fold, vectorised over columns, S is a dense product per step. For several
folds it is a forward substitution, column by column as the loads become known, and a backward one, with the factors of
I − dt²A/4 (kernels/banded.py): a third of the operations and a sixth of the numbers.

Stored between steps: w, v^{n−½} and v*, so that no damper recomputes v*. With F/ρ_s = a, the new v^{n+½} and the next
v* = v^{n−½} + (3/2) dt a are one multiply-add each.
Shear is taken in differences between rows, with G̃/dy² and η̃/dy² (kernels/membrane.py). An edge row is a half cell
without flux through the edge; its traction and contact count half.
The air pressure at the first contact of a slice jumps as it closes or opens: it is averaged over the step (flow.py).

Columns go through three phases, BLOCK vectors at a time: gaps, flux, forces. From the last gap of a column to its flux
there is one long dependency chain (√, ÷); the chains of a block overlap, so the processor does not wait for one.

Symbols as in the paper; SI units. Order 2 in dt, dx and dy, but first order in dy where the air pressure ends on a node
(flow.py). Stability bound: vfcore/fold/stability.py. Boundary slices x = 0, L count by the trapezoid rule in area and
flow. Twin: tests/support/fold_twin.py. Not validated against measured vibration.
"""

import math
from collections.abc import Callable
from functools import lru_cache

from vfcore.kernels import airways, contact, flow, membrane
from vfcore.kernels.displacement import displaced
from vfcore.kernels.jit import inlined
from vfcore.kernels.layout import LANES, RECORD, Layout
from vfcore.kernels.simd import (
    all_of,
    broadcast,
    extract,
    hsum,
    load,
    load_param,
    maximum,
    minimum,
    select,
    store,
)

touching, contact_pressure = contact.touching, contact.contact_pressure
above_zero, reciprocals, opening = flow.above_zero, flow.reciprocals, flow.opening
gap_rate, closed_fraction, held_fraction = flow.gap_rate, flow.closed_fraction, flow.held_fraction
abs_, square, half_segment = flow.abs_, flow.square, flow.half_segment
separation_gap, attached = flow.separation_gap, flow.attached
viscous_drop, flux_root, slice_flux, pressure = flow.viscous_drop, flow.flux_root, flow.slice_flux, flow.pressure
tension, coupling, kelvin_voigt = membrane.tension, membrane.coupling, membrane.kelvin_voigt
advance_airways, viscous_share = airways.advance_airways, airways.viscous_share
DROP, FLOW, INLET, OUTLET = airways.DROP, airways.FLOW, airways.INLET, airways.OUTLET
SMALLEST_DROP_PA = airways.SMALLEST_DROP_PA
COLUMNS = len(RECORD)
#: A larger displacement, NaN or inf counts as divergence.
LARGEST_DISPLACEMENT_M = 0.02
#: Recorded samples, 5 ms, between two checks of the largest displacement.
LOOK_SAMPLES = 140


@lru_cache(maxsize=32)
def step_kernel(
    nx: int, ny: int, rotation: bool, precision: str = "float64", many: bool = False
) -> Callable[..., None]:
    """The compiled loop for one grid: ``advance(buf, par, P_s, record_every, record, air=None)``.

    Single-fold mode vectorises over x. With ``many`` there are n = LANES[precision] folds, one per vector element;
    otherwise n = 1. All arrays are flat and have the same precision:

    - ``buf`` (Layout.size,): state and fixed fields, changed in place
    - ``par`` (len(SCALARS)·n,): layout.SCALARS, n values each
    - ``P_s`` (steps·n,): lung pressure at each step, Pa
    - ``record`` (steps // record_every · len(RECORD)·n,): layout.RECORD of the state before the step, n values each
    - ``air``: buffer of the airways (kernels/airways.py), for two-way coupling of one fold in double precision. That
      signature is compiled separately and sweeps the columns twice, first for their flow.

    On return the first n numbers of the line ``beyond`` are 1 where a check (every LOOK_SAMPLES samples and at the last
    step) found a displacement beyond LARGEST_DISPLACEMENT_M, else 0. Verified in tests/physics.
    """
    W = LANES[precision]
    P = W if many else 1
    L = Layout(nx, ny, W, P)
    S, C1, END, NB = L.stride, L.first, L.first + L.worked, nx - 2
    WM, NEXT, V, VS, G = L.field("w"), L.field("w_next"), L.field("v"), L.field("v_star"), L.field("G")
    PH, VPH, VPHS = L.field("phi"), L.field("vphi"), L.field("vphi_star")
    K, ROWS, BLOCK = L.K_coup // P, ny * W, L.block
    R, M, I = L.scratch("square"), L.scratch("running_min"), L.scratch("viscous")
    LARGEST_HALF, SEP, INV_GAP_RATE = (L.scratch("slice") + row * BLOCK * W for row in range(3))
    Q = LARGEST_HALF  # the flux overwrites the largest half gap after its last use
    WB, VB, VBS, FB = L.line("w_b"), L.line("v_b"), L.line("v_star_b"), L.line("beam_force")
    LOAD, INV, WIDTH, COLUMN = L.line("beam_load"), L.line("inverse_density"), L.line("width"), L.line("column")
    BI, WORKED, BEYOND, HALF_MIN = L.beam_inverse, L.worked, L.line("beyond"), L.line("half_min")
    HELD = END - W if many else END  # with many folds the posterior end, which does not move, is a vector of its own
    ALWAYS_CONTACT = precision == "float32"  # with 16 folds some slice is almost always closed: do not test
    INV_D, A_1, A_2 = L.line("inv_D"), L.line("a"), L.line("c")

    # The closure may hold only plain constants: numba's cache key includes the closure cells, and a function in one of
    # them has another key in every process, so no process would find the code that another has compiled.
    @inlined
    def advance(buf, par, P_s_of, record_every, record, air=None):
        dt, dy, alpha_s = load_param(par, 0, P, W), load_param(par, 1, P, W), load_param(par, 2, P, W)
        half_rho_a, twelve_mu_a, T = load_param(par, 3, P, W), load_param(par, 4, P, W), load_param(par, 5, P, W)
        G_t, eta_t, C_coup = load_param(par, 6, P, W), load_param(par, 7, P, W), load_param(par, 8, P, W)
        K_col, C_col, K_foun = load_param(par, 9, P, W), load_param(par, 10, P, W), load_param(par, 11, P, W)
        C_foun, inv_rho_l, inv_J = load_param(par, 12, P, W), load_param(par, 13, P, W), load_param(par, 14, P, W)
        G_m, eta_m = load_param(par, 15, P, W), load_param(par, 16, P, W)
        six_mu_a_dy, inv_dy, four_over_dt2 = 0.5 * twelve_mu_a * dy, 1.0 / dy, 4.0 / (dt * dt)
        zero, far = broadcast(0.0, buf, W), broadcast(1.0, buf, W)
        turning = dt * inv_J * inv_dy
        beyond, look_every = zero, LOOK_SAMPLES * record_every
        now, later = WM, NEXT  # present displacements, and those after the step; swapped each step

        for n in range(P_s_of.size // P):
            P_s = load_param(P_s_of, n, P, W)
            inlet, outlet, drop = P_s, 0.0, P_s
            area = flow_rate = slope = contact_area = largest = column = zero
            sweeps = 1
            if air is not None:
                sweeps, drop = 2, max(abs(air[DROP]), SMALLEST_DROP_PA)

            y_1, y_2 = zero, zero
            for sweep in range(sweeps):
                area, flow_rate = zero, zero
                for first in range(C1, END, BLOCK * W):
                    groups = min(BLOCK, (END - first) // W)

                    # gaps, their running minimum from the inlet, and the viscous integral from the inlet
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        smallest, largest_half, integral = far, zero, zero
                        for k in range(0, ny, 2):  # rows in pairs
                            j = ny - 1 - k
                            o, to = j * S + i, here + j * W
                            half, half_next = load(buf, G + o, W) - load(buf, now + o, W), far
                            if j > 0:
                                half_next = load(buf, G + o - S, W) - load(buf, now + o - S, W)
                            r, r_next = reciprocals(above_zero(half), above_zero(half_next))
                            smallest, largest_half = minimum(half, smallest), maximum(half, largest_half)
                            inv_d2, inv_d2_next = square(r), square(r_next)
                            if k > 0:
                                integral = half_segment(integral, inv_d2, r)
                            store(buf, R + to, inv_d2)
                            store(buf, M + to, smallest)
                            store(buf, I + to, integral)
                            integral = half_segment(integral, inv_d2, r)
                            if j > 0:
                                smallest, largest_half = minimum(half_next, smallest), maximum(half_next, largest_half)
                                integral = half_segment(integral, inv_d2_next, r_next)
                                store(buf, R + to - W, inv_d2_next)
                                store(buf, M + to - W, smallest)
                                store(buf, I + to - W, integral)
                                integral = half_segment(integral, inv_d2_next, r_next)
                        store(buf, LARGEST_HALF + g * W, largest_half)

                    # separation and flux
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        half_min = load(buf, M + here, W)
                        d_min = 2.0 * above_zero(half_min)
                        d_sep = separation_gap(d_min, 2.0 * above_zero(load(buf, LARGEST_HALF + g * W, W)), alpha_s)
                        half_sep, integral = 0.5 * d_sep, zero
                        for k in range(ny - 1):
                            j = ny - 1 - k
                            on = attached(load(buf, M + here + j * W, W), half_sep)
                            integral = select(on, load(buf, I + here + j * W - W, W), integral)
                        Bd = viscous_drop(integral, d_sep, six_mu_a_dy)
                        root = flux_root(drop, Bd, half_rho_a)
                        pushed = dt * dt * load(buf, INV + i, W) * abs_(drop)
                        delta = gap_rate(half_min, load(buf, HALF_MIN + i, W), pushed)
                        inv_sum, inv_gap_rate = reciprocals(0.5 * (Bd + root), 0.5 * delta)
                        q = slice_flux(drop, d_min, d_sep, inv_sum)
                        store(buf, Q + g * W, q)
                        store(buf, SEP + g * W, half_sep)
                        store(buf, INV_GAP_RATE + g * W, inv_gap_rate)
                        width = load(buf, WIDTH + i, W)
                        area, flow_rate = area + opening(d_min) * width, flow_rate + q * width
                        if air is not None:
                            slope = slope + d_sep / root * width
                    if air is not None and sweep == 0:
                        continue

                    # contact, membrane and load on the beam
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        if i == HELD:  # at rest, but the folds may touch there
                            touched = zero
                            for j in range(ny):
                                touch = touching(load(buf, now + j * S + i, W), load(buf, G + j * S + i, W))
                                touched = select(touch, touched + (0.5 if j == 0 or j == ny - 1 else 1.0), touched)
                            contact_area = contact_area + touched * load(buf, WIDTH + i, W) * dy
                            continue
                        q, half_sep = load(buf, Q + g * W, W), load(buf, SEP + g * W, W)
                        half_min, inv_gap_rate = load(buf, M + here, W), load(buf, INV_GAP_RATE + g * W, W)
                        store(buf, HALF_MIN + i, half_min)
                        closed_part, upstream = closed_fraction(half_min, inv_gap_rate), far
                        in_contact = ALWAYS_CONTACT or not all_of(half_min * inv_gap_rate > 0.5)
                        w_b, beam_damper = load(buf, WB + i, W), C_coup * load(buf, VBS + i, W)
                        inverse = dt * load(buf, INV + i, W)
                        slice_largest, touched, to_beam, flux_below = zero, zero, zero, zero
                        w, v = load(buf, now + (ny - 1) * S + i, W), load(buf, VS + (ny - 1) * S + i, W)
                        shear = kelvin_voigt(w, v, G_t, eta_t)
                        for k in range(ny):
                            j = ny - 1 - k
                            o = j * S + i
                            edge = k == 0 or j == 0
                            running = load(buf, M + here + j * W, W)
                            on = attached(running, half_sep)
                            inv_d2, viscous = load(buf, R + here + j * W, W), load(buf, I + here + j * W, W)
                            p_aero = select(on, pressure(inlet, q, inv_d2, viscous, half_rho_a, six_mu_a_dy), outlet)
                            p_col = zero
                            if in_contact:
                                held = outlet + (inlet - outlet) * held_fraction(upstream, inv_gap_rate, closed_part)
                                p_aero, upstream = select(on, p_aero, held), running
                                G_j = load(buf, G + o, W)
                                p_col = contact_pressure(w, v, G_j, K_col, C_col)
                                slice_largest = maximum(p_col, slice_largest)
                                touched = select(touching(w, G_j), touched + (0.5 if edge else 1.0), touched)
                            traction = coupling(w, v, w_b, beam_damper, load_param(buf, K + j, P, W), C_coup)
                            to_beam = to_beam + (0.5 if edge else 1.0) * traction
                            w_next, v_next, shear_next, flux = w, v, shear, zero
                            if j > 0:
                                w_next, v_next = load(buf, now + o - S, W), load(buf, VS + o - S, W)
                                shear_next = kelvin_voigt(w_next, v_next, G_t, eta_t)
                                flux = shear - shear_next
                                if rotation:
                                    h = o - S  # φ on the half row between rows j−1 and j
                                    phi, vphi = load(buf, PH + h, W), load(buf, VPH + h, W)
                                    vphi_star = load(buf, VPHS + h, W)
                                    turn, rate = dy * phi, dy * vphi_star
                                    flux = flux - kelvin_voigt(turn, rate, G_t, eta_t)
                                    moment = kelvin_voigt(w - w_next - turn, v - v_next - rate, G_m, eta_m)
                                    store(buf, VPH + h, vphi + turning * moment)
                                    store(buf, VPHS + h, vphi + 1.5 * turning * moment)
                                    store(buf, PH + h, displaced(phi, vphi, vphi_star, turning, moment, dt))
                            if k == 0:
                                flux_below = 0.0 - flux
                            if j == 0:
                                flux = 0.0 - flux_below
                            along = tension(load(buf, now + o - P, W), w, load(buf, now + o + P, W), T)
                            force = along + (flux_below - flux - traction - p_col - p_aero)
                            before = load(buf, V + o, W)
                            store(buf, V + o, before + inverse * force)
                            store(buf, VS + o, before + 1.5 * inverse * force)
                            store(buf, later + o, displaced(w, before, v, inverse, force, dt))
                            flux_below, w, v, shear = flux, w_next, v_next, shear_next

                        # beam: right side of the implicit system
                        beam = to_beam * dy - K_foun * w_b - C_foun * load(buf, VBS + i, W)
                        rhs = beam * inv_rho_l + load(buf, LOAD + i, W) + four_over_dt2 * w_b
                        if many:
                            rhs = rhs - load(buf, A_1 + i, W) * y_1 - load(buf, A_2 + i, W) * y_2
                            y_1, y_2 = rhs, y_1
                        store(buf, FB + i, rhs)
                        if in_contact:
                            contact_area = contact_area + touched * load(buf, WIDTH + i, W) * dy
                            slice_largest = select(load(buf, INV + i, W) > 0.0, slice_largest, 0.0)
                            column = select(slice_largest > largest, load(buf, COLUMN + i, W), column)
                            largest = maximum(slice_largest, largest)
                if air is not None and sweep == 0:
                    passed = hsum(flow_rate)
                    share = viscous_share(passed, hsum(slope), drop)
                    advance_airways(air, P_s, passed / math.sqrt(drop), share)
                    inlet, outlet, drop = air[INLET], air[OUTLET], air[DROP]

            if n % record_every == 0:
                row = n // record_every * COLUMNS
                if P == 1:
                    record[row] = hsum(area)
                    record[row + 1] = hsum(flow_rate)
                    record[row + 2] = 0.0
                    record[row + 3] = math.nan
                    record[row + 4] = hsum(contact_area)
                    record[row + 5], record[row + 6] = inlet, outlet
                    if air is not None:
                        record[row + 1] = air[FLOW]
                    if record[row + 4] > 0.0:
                        for k in range(W):
                            p, c = extract(largest, k), extract(column, k)
                            if p > record[row + 2] or (p == record[row + 2] and c < record[row + 3]):
                                record[row + 2], record[row + 3] = p, c
                else:
                    store(record, row * W, area)
                    store(record, row * W + W, flow_rate)
                    store(record, row * W + 2 * W, largest)
                    store(record, row * W + 3 * W, select(largest > 0.0, column, math.nan))
                    store(record, row * W + 4 * W, contact_area)
                    store(record, row * W + 5 * W, P_s)
                    store(record, row * W + 6 * W, zero)

            # displacement of the beam
            near, far_off = zero, zero  # back substitution: to subtract at this column, and at the one after it
            for first in range(C1, HELD, W):
                i = C1 + HELD - W - first
                w_b = load(buf, WB + i, W)
                acceleration = 0.0 - four_over_dt2 * w_b
                if many:
                    solved = load(buf, FB + i, W) * load(buf, INV_D + i, W) - near
                    near, far_off = far_off + load(buf, A_1 + i, W) * solved, load(buf, A_2 + i, W) * solved
                    acceleration = acceleration + solved
                else:
                    for k in range(NB):
                        acceleration = acceleration + load(buf, BI + k * WORKED + i - C1, W) * load_param(
                            buf, (FB + C1) // P + k, P, W
                        )
                dv = dt * acceleration
                new = load(buf, VB + i, W) + dv
                store(buf, VB + i, new)
                store(buf, VBS + i, new + 0.5 * dv)
                store(buf, WB + i, w_b + dt * new)
            now, later = later, now

            if (n + 1) % look_every == 0 or n + 1 == P_s_of.size // P:
                for j in range(ny):
                    for i in range(C1, END, W):
                        beyond = select(abs_(load(buf, now + j * S + i, W)) < LARGEST_DISPLACEMENT_M, beyond, 1.0)
        for j in range(ny):  # in both fields: the state must not depend on whether the number of steps was odd
            for i in range(C1, END, W):
                w = load(buf, now + j * S + i, W)
                store(buf, WM + j * S + i, w)
                store(buf, NEXT + j * S + i, w)
        store(buf, BEYOND, beyond)

    return advance
