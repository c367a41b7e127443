"""The step of the fold: flow → contact → membrane → beam; longer than other files, for it is one compiled loop.

Scheme (see docs/model/numerics.md, "Time stepping"). Velocities live on half steps:

    v^{n+½} = v^{n−½} + dt a(w^n, v*),   w^{n+1} = w^n + dt v^{n+½},   v* = v^{n−½} + ½ (v^{n−½} − v^{n−3/2})

v* extrapolates the velocity to time n, so every damper is second order. The membrane's displacement has one term more
(kernels/displacement.py), and the forces write it to a second field, for neighbours still need the first: the two take
turns. The beam takes the trapezoidal rule for its own stiffness A (tension, bending, end moments, per mass):

    (w_b^{n+1} − 2 w_b^n + w_b^{n−1})/dt² = (I − dt²A/4)⁻¹ (A w_b^n + f/ρ_l)

which is unconditionally stable and undamped. With S = (I − dt²A/4)⁻¹ and SA = (4/dt²)(S − I)
the right side is S (f/ρ_l + 4/dt² w_b) − 4/dt² w_b. Of one fold, whose columns are the lanes, that is one dense
product per step. Of many it is a substitution forwards, column by column as the loads come up, and one backwards, with
the factors of I − dt²A/4 (kernels/banded.py): a third of the operations and a sixth of the numbers.

Kept between steps: w, v^{n−½} and v*, so that every damper reads v* without computing it again. With F/ρ_s = a both
come from v^{n−½} by one multiply-add each, the next v* being v^{n−½} + (3/2) dt a.
Shear is taken in differences between rows, with G̃/dy² and η̃/dy²; an edge row is a half cell, with no flux through the
edge: the flux beyond mirrors the one within, and its traction and contact count half.
The air pressure at the first contact of a slice jumps as it closes or opens: it is averaged over the step (flow.py).

Columns go through three phases, BLOCK groups of them at a time: gaps, flux, forces. The flux is one long chain (√, ÷)
from the last gap on, during which a processor would idle: the chains of a block run side by side.

Order 2 in dt, dx, dy. Stability: vfcore/fold/stability.py. Boundary slices x = 0, L count by the
trapezoid rule in area and flow.
"""

import math
from functools import lru_cache

from vfcore.kernels import airways, contact, flow, membrane
from vfcore.kernels.displacement import displaced
from vfcore.kernels.jit import inlined
from vfcore.kernels.layout import LANES, RECORD, Layout
from vfcore.kernels.simd import all_of, each, lane, load, maximum, minimum, spread, store, total, where

touching, contact_pressure = contact.touching, contact.contact_pressure
above_zero, reciprocals, opening = flow.above_zero, flow.reciprocals, flow.opening
change, share_shut, share_held = flow.change, flow.share_shut, flow.share_held
size, square, half_segment = flow.size, flow.square, flow.half_segment
separation_gap, attached = flow.separation_gap, flow.attached
viscous_drop, flux_root, slice_flux, pressure = flow.viscous_drop, flow.flux_root, flow.slice_flux, flow.pressure
tension, coupling, kelvin_voigt = membrane.tension, membrane.coupling, membrane.kelvin_voigt
advance_airways, viscous_share = airways.advance_airways, airways.viscous_share
DROP, FLOW, INLET, OUTLET, SMALLEST_DROP_PA = (
    airways.DROP, airways.FLOW, airways.INLET, airways.OUTLET, airways.SMALLEST_DROP_PA,
)  # fmt: skip
COLUMNS = len(RECORD)
#: A displacement beyond this is no larynx any more; NaN and inf count as beyond.
LARGEST_DISPLACEMENT_M = 0.02
#: Recorded samples, 5 ms, between two looks at the largest displacement.
LOOK_SAMPLES = 140


@lru_cache(maxsize=32)
def step_kernel(nx: int, ny: int, rotation: bool, precision: str = "float64", many: bool = False):
    """The compiled loop for one grid: ``advance(buf, par, P_s, record_every, record, air=None)``.

    Of one fold, whose columns are the lanes, or of ``many``: LANES[precision] folds, one in each lane. With n of them:
    ``buf`` (Layout.size,); ``par`` (n·len(SCALARS),) layout.SCALARS, n neighbours each; ``P_s`` (n·steps,) lung
    pressure at each step, Pa; ``record`` (n·7·(steps//record_every),) layout.RECORD at the state before the step, n
    neighbours each. All flat, of the same precision. On return the first n numbers of the line ``beyond`` are 1 where a
    displacement was beyond LARGEST_DISPLACEMENT_M at a look (every LOOK_SAMPLES and at the last step), else 0.
    ``air``: buffer of the airways (kernels/airways.py), for two-way coupling of one fold in double precision; the loop
    is compiled apart for it and sweeps the columns twice, first for their flow. Not validated against measurements;
    verified in tests/physics.
    """
    W = LANES[precision]
    P = W if many else 1
    L = Layout(nx, ny, W, P)
    S, C1, END, NB = L.stride, L.first, L.first + L.worked, nx - 2
    WM, NEXT, V, VS, G = L.field("w"), L.field("w_next"), L.field("v"), L.field("v_star"), L.field("G")
    PH, VPH, VPHS = L.field("phi"), L.field("vphi"), L.field("vphi_star")
    K, ROWS, BLOCK = L.K_coup // P, ny * W, L.block
    R, M, I = L.scratch("square"), L.scratch("running_min"), L.scratch("viscous")
    MOST, SEP, PER_CHANGE = (L.scratch("slice") + row * BLOCK * W for row in range(3))
    Q = MOST  # put in the place of a number that has been read for the last time
    WB, VB, VBS, FB = L.line("w_b"), L.line("v_b"), L.line("v_star_b"), L.line("beam_force")
    LOAD, INV, WIDTH, COLUMN = L.line("beam_load"), L.line("inverse_density"), L.line("width"), L.line("column")
    BI, WORKED, BEYOND, LAST = L.beam_inverse, L.worked, L.line("beyond"), L.line("half_min")
    HELD = END - W if many else END  # the posterior end: of many folds a group of its own, in which nothing moves
    NEARLY_ALWAYS = precision == "float32"  # one of sixteen folds is closed, and asking would take longer
    PER_D, A_1, A_2 = L.line("per_D"), L.line("a"), L.line("c")

    # Only constants and compiled functions of other modules in here: a function made in here would be written into the
    # cache's key, differently in each process, and none would find what another has compiled.
    @inlined
    def advance(buf, par, P_s_of, record_every, record, air=None):
        dt, dy, alpha_s = each(par, 0, P, W), each(par, 1, P, W), each(par, 2, P, W)
        half_rho_a, twelve_mu_a, T = each(par, 3, P, W), each(par, 4, P, W), each(par, 5, P, W)
        G_t, eta_t, C_coup = each(par, 6, P, W), each(par, 7, P, W), each(par, 8, P, W)
        K_col, C_col, K_foun = each(par, 9, P, W), each(par, 10, P, W), each(par, 11, P, W)
        C_foun, per_rho_l, per_J = each(par, 12, P, W), each(par, 13, P, W), each(par, 14, P, W)
        G_m, eta_m = each(par, 15, P, W), each(par, 16, P, W)
        six_mu_a_dy, per_dy, four_per_dt2 = 0.5 * twelve_mu_a * dy, 1.0 / dy, 4.0 / (dt * dt)
        zero, far = spread(0.0, buf, W), spread(1.0, buf, W)
        turning = dt * per_J * per_dy
        beyond, look_every = zero, LOOK_SAMPLES * record_every
        now, later = WM, NEXT  # where the displacements stand, and where the next ones go; in turn

        for n in range(P_s_of.size // P):
            P_s = each(P_s_of, n, P, W)
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

                    # gaps, the smallest from the inlet on, and the viscous integral from there
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
                            per_d2, per_d2_next = square(r), square(r_next)
                            if k > 0:
                                integral = half_segment(integral, per_d2, r)
                            store(buf, R + to, per_d2)
                            store(buf, M + to, smallest)
                            store(buf, I + to, integral)
                            integral = half_segment(integral, per_d2, r)
                            if j > 0:
                                smallest, largest_half = minimum(half_next, smallest), maximum(half_next, largest_half)
                                integral = half_segment(integral, per_d2_next, r_next)
                                store(buf, R + to - W, per_d2_next)
                                store(buf, M + to - W, smallest)
                                store(buf, I + to - W, integral)
                                integral = half_segment(integral, per_d2_next, r_next)
                        store(buf, MOST + g * W, largest_half)

                    # separation and flux
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        half_min = load(buf, M + here, W)
                        d_min = 2.0 * above_zero(half_min)
                        d_sep = separation_gap(d_min, 2.0 * above_zero(load(buf, MOST + g * W, W)), alpha_s)
                        half_sep, integral = 0.5 * d_sep, zero
                        for k in range(ny - 1):
                            j = ny - 1 - k
                            on = attached(load(buf, M + here + j * W, W), half_sep)
                            integral = where(on, load(buf, I + here + j * W - W, W), integral)
                        Bd = viscous_drop(integral, d_sep, six_mu_a_dy)
                        root = flux_root(drop, Bd, half_rho_a)
                        pushed = dt * dt * load(buf, INV + i, W) * size(drop)
                        moves = change(half_min, load(buf, LAST + i, W), pushed)
                        per_sum, per_change = reciprocals(0.5 * (Bd + root), 0.5 * moves)
                        q = slice_flux(drop, d_min, d_sep, per_sum)
                        store(buf, Q + g * W, q)
                        store(buf, SEP + g * W, half_sep)
                        store(buf, PER_CHANGE + g * W, per_change)
                        width = load(buf, WIDTH + i, W)
                        area, flow_rate = area + opening(d_min) * width, flow_rate + q * width
                        if air is not None:
                            slope = slope + d_sep / root * width
                    if air is not None and sweep == 0:
                        continue

                    # contact, membrane and what the beam feels of it
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        if i == HELD:  # at rest, yet the folds may touch there
                            touched = zero
                            for j in range(ny):
                                met = touching(load(buf, now + j * S + i, W), load(buf, G + j * S + i, W))
                                touched = where(met, touched + (0.5 if j == 0 or j == ny - 1 else 1.0), touched)
                            contact_area = contact_area + touched * load(buf, WIDTH + i, W) * dy
                            continue
                        q, half_sep = load(buf, Q + g * W, W), load(buf, SEP + g * W, W)
                        half_min, per_change = load(buf, M + here, W), load(buf, PER_CHANGE + g * W, W)
                        store(buf, LAST + i, half_min)
                        shut, upstream = share_shut(half_min, per_change), far
                        closed = NEARLY_ALWAYS or not all_of(half_min * per_change > 0.5)
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
                            per_d2, viscous = load(buf, R + here + j * W, W), load(buf, I + here + j * W, W)
                            p_aero = where(on, pressure(inlet, q, per_d2, viscous, half_rho_a, six_mu_a_dy), outlet)
                            p_col = zero
                            if closed:
                                held = outlet + (inlet - outlet) * share_held(upstream, per_change, shut)
                                p_aero, upstream = where(on, p_aero, held), running
                                G_j = load(buf, G + o, W)
                                p_col = contact_pressure(w, v, G_j, K_col, C_col)
                                slice_largest = maximum(p_col, slice_largest)
                                touched = where(touching(w, G_j), touched + (0.5 if edge else 1.0), touched)
                            traction = coupling(w, v, w_b, beam_damper, each(buf, K + j, P, W), C_coup)
                            to_beam = to_beam + (0.5 if edge else 1.0) * traction
                            w_next, v_next, shear_next, flux = w, v, shear, zero
                            if j > 0:
                                w_next, v_next = load(buf, now + o - S, W), load(buf, VS + o - S, W)
                                shear_next = kelvin_voigt(w_next, v_next, G_t, eta_t)
                                flux = shear - shear_next
                                if rotation:
                                    h = o - S  # φ on the half node between rows j−1 and j
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

                        # beam: load per mass, ready for the implicit product
                        beam = to_beam * dy - K_foun * w_b - C_foun * load(buf, VBS + i, W)
                        rhs = beam * per_rho_l + load(buf, LOAD + i, W) + four_per_dt2 * w_b
                        if many:
                            rhs = rhs - load(buf, A_1 + i, W) * y_1 - load(buf, A_2 + i, W) * y_2
                            y_1, y_2 = rhs, y_1
                        store(buf, FB + i, rhs)
                        if closed:
                            contact_area = contact_area + touched * load(buf, WIDTH + i, W) * dy
                            slice_largest = where(load(buf, INV + i, W) > 0.0, slice_largest, 0.0)
                            column = where(slice_largest > largest, load(buf, COLUMN + i, W), column)
                            largest = maximum(slice_largest, largest)
                if air is not None and sweep == 0:
                    passed = total(flow_rate)
                    share = viscous_share(passed, total(slope), drop)
                    advance_airways(air, P_s, passed / math.sqrt(drop), share)
                    inlet, outlet, drop = air[INLET], air[OUTLET], air[DROP]

            if n % record_every == 0:
                row = n // record_every * COLUMNS
                if P == 1:
                    record[row] = total(area)
                    record[row + 1] = total(flow_rate)
                    record[row + 2] = 0.0
                    record[row + 3] = math.nan
                    record[row + 4] = total(contact_area)
                    record[row + 5], record[row + 6] = inlet, outlet
                    if air is not None:
                        record[row + 1] = air[FLOW]
                    if record[row + 4] > 0.0:
                        for k in range(W):
                            p, c = lane(largest, k), lane(column, k)
                            if p > record[row + 2] or (p == record[row + 2] and c < record[row + 3]):
                                record[row + 2], record[row + 3] = p, c
                else:
                    store(record, row * W, area)
                    store(record, row * W + W, flow_rate)
                    store(record, row * W + 2 * W, largest)
                    store(record, row * W + 3 * W, where(largest > 0.0, column, math.nan))
                    store(record, row * W + 4 * W, contact_area)
                    store(record, row * W + 5 * W, P_s)
                    store(record, row * W + 6 * W, zero)

            # displacement of the beam
            near, far_off = zero, zero  # what the node behind takes from the last one, and the one behind that
            for first in range(C1, HELD, W):
                i = C1 + HELD - W - first
                w_b = load(buf, WB + i, W)
                acceleration = 0.0 - four_per_dt2 * w_b
                if many:
                    solved = load(buf, FB + i, W) * load(buf, PER_D + i, W) - near
                    near, far_off = far_off + load(buf, A_1 + i, W) * solved, load(buf, A_2 + i, W) * solved
                    acceleration = acceleration + solved
                else:
                    for k in range(NB):
                        acceleration = acceleration + load(buf, BI + k * WORKED + i - C1, W) * each(
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
                        beyond = where(size(load(buf, now + j * S + i, W)) < LARGEST_DISPLACEMENT_M, beyond, 1.0)
        for j in range(ny):  # in both places: what is kept does not depend on how many steps went before
            for i in range(C1, END, W):
                w = load(buf, now + j * S + i, W)
                store(buf, WM + j * S + i, w)
                store(buf, NEXT + j * S + i, w)
        store(buf, BEYOND, beyond)

    return advance
