"""The step of the fold: flow → contact → membrane → beam, one compiled loop per grid.

Scheme (see docs/model.md, "Time stepping"). Velocities live on half steps:

    v^{n+½} = v^{n−½} + dt a(w^n, v*),   w^{n+1} = w^n + dt v^{n+½},   v* = v^{n−½} + ½ (v^{n−½} − v^{n−3/2})

v* extrapolates the velocity to time n, so every damper is second order. The beam takes the
trapezoidal rule for its own stiffness A (tension, bending, end moments, per mass):

    (w_b^{n+1} − 2 w_b^n + w_b^{n−1})/dt² = (I − dt²A/4)⁻¹ (A w_b^n + f/ρ_l)

which is unconditionally stable and undamped. With S = (I − dt²A/4)⁻¹ and SA = (4/dt²)(S − I)
the right side is S (f/ρ_l + 4/dt² w_b) − 4/dt² w_b: one dense product per step.

Kept between steps: w, v^{n−½} and v*, so that every damper reads v* without computing it again. With F/ρ_s = a both
come from v^{n−½} by one multiply-add each, the next v* being v^{n−½} + (3/2) dt a.
Shear is taken in differences between rows, with G̃/dy² and η̃/dy²; an edge row is a half cell,
so its flux counts twice (``per_weight``) and its traction and contact half (``weight``).

Order 2 in dt, dx, dy. Stability: vfcore/stability.py. Boundary slices x = 0, L count by the
trapezoid rule in area and flow.
"""

import math
from functools import lru_cache

from vfcore.kernels import airways, contact, flow, membrane
from vfcore.kernels.jit import inlined
from vfcore.kernels.lanes import each, lane, load, maximum, minimum, spread, store, total, where
from vfcore.kernels.layout import LANES, RECORD, Layout

touching, contact_pressure = contact.touching, contact.contact_pressure
gap, reciprocal, separation_gap, attached = flow.gap, flow.reciprocal, flow.separation_gap, flow.attached
size = flow.size
cube, viscous_segment, viscous_drop, flux_root = flow.cube, flow.viscous_segment, flow.viscous_drop, flow.flux_root
slice_flux, pressure = flow.slice_flux, flow.pressure
tension, coupling = membrane.tension, membrane.coupling
shear_strain, shear_flux = membrane.shear_strain, membrane.shear_flux
advance_airways, viscous_share = airways.advance_airways, airways.viscous_share
DROP, FLOW, INLET, OUTLET, SMALLEST_DROP_PA = (
    airways.DROP, airways.FLOW, airways.INLET, airways.OUTLET, airways.SMALLEST_DROP_PA,
)  # fmt: skip
COLUMNS = len(RECORD)
#: A displacement beyond this is no larynx any more; NaN and inf count as beyond.
LARGEST_DISPLACEMENT_M = 0.02
#: Recorded samples, 5 ms, between two looks at the largest displacement.
LOOK_SAMPLES = 175


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
    WM, V, VS, G = L.field("w"), L.field("v"), L.field("v_star"), L.field("G")
    PH, VPH, VPHS = L.field("phi"), L.field("vphi"), L.field("vphi_star")
    K, WEIGHT, PER_WEIGHT = (L.row_numbers(name) // P for name in ("K_coup", "weight", "per_weight"))
    R, M, I = L.row_numbers("reciprocal"), L.row_numbers("running_min"), L.row_numbers("viscous")
    WB, VB, VBS, FB = L.line("w_b"), L.line("v_b"), L.line("v_star_b"), L.line("beam_force")
    LOAD, INV, WIDTH, COLUMN = L.line("beam_load"), L.line("inverse_density"), L.line("width"), L.line("column")
    BI, WORKED, BEYOND = L.beam_inverse, L.worked, L.line("beyond")

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
        beyond, look_every = zero, LOOK_SAMPLES * record_every

        for n in range(P_s_of.size // P):
            P_s = each(P_s_of, n, P, W)
            inlet, outlet, drop = P_s, 0.0, P_s
            area = flow_rate = slope = contact_area = largest = column = zero
            sweeps = 1
            if air is not None:
                sweeps, drop = 2, max(abs(air[DROP]), SMALLEST_DROP_PA)

            for sweep in range(sweeps):
                for i in range(C1, END, W):
                    # flow: gaps, running minimum from the inlet, separation, flux
                    smallest, d_max = far, zero
                    for k in range(ny):
                        j = ny - 1 - k
                        d = gap(load(buf, G + j * S + i, W), load(buf, WM + j * S + i, W))
                        smallest = minimum(d, smallest)
                        d_max = maximum(d, d_max)
                        store(buf, M + j * W, smallest)
                        store(buf, R + j * W, reciprocal(d))
                    d_min = smallest
                    d_sep = separation_gap(d_min, d_max, alpha_s)
                    integral, upstream = zero, far
                    here = cube(load(buf, R + (ny - 1) * W, W))
                    for k in range(ny - 1):
                        j = ny - 1 - k
                        running = load(buf, M + j * W, W)
                        on = attached(running, upstream, d_sep, d_min)
                        upstream = running
                        above = cube(load(buf, R + j * W - W, W))
                        store(buf, I + j * W, integral)
                        integral = where(on, integral + viscous_segment(here, above), integral)
                        here = above
                    store(buf, I, integral)
                    Bd = viscous_drop(integral, d_sep, six_mu_a_dy)
                    root = flux_root(drop, Bd, half_rho_a)
                    q = slice_flux(drop, d_sep, Bd, root)
                    if air is not None and sweep == 0:
                        width = load(buf, WIDTH + i, W)
                        flow_rate, slope = flow_rate + q * width, slope + d_sep / root * width
                        continue

                    # contact and membrane
                    w_b, v_b = load(buf, WB + i, W), load(buf, VBS + i, W)
                    inverse = dt * load(buf, INV + i, W)
                    three_halves = 1.5 * inverse
                    slice_largest, touched, to_beam, flux_below = zero, zero, zero, zero
                    w, v, upstream = load(buf, WM + (ny - 1) * S + i, W), load(buf, VS + (ny - 1) * S + i, W), far
                    for k in range(ny):
                        j = ny - 1 - k
                        o = j * S + i
                        G_j, r = load(buf, G + o, W), load(buf, R + j * W, W)
                        running = load(buf, M + j * W, W)
                        on = attached(running, upstream, d_sep, d_min)
                        upstream = running
                        p_attached = pressure(inlet, q, r, load(buf, I + j * W, W), half_rho_a, six_mu_a_dy)
                        p_aero = where(on, p_attached, outlet)
                        p_col = contact_pressure(w, v, G_j, K_col, C_col)
                        traction = coupling(w, v, w_b, v_b, each(buf, K + j, P, W), C_coup)
                        weight, per_weight = each(buf, WEIGHT + j, P, W), each(buf, PER_WEIGHT + j, P, W)
                        slice_largest = maximum(p_col, slice_largest)
                        touched = where(touching(w, G_j), touched + weight, touched)
                        to_beam = to_beam + weight * traction
                        flux, w_next, v_next = zero, w, v
                        if j > 0:
                            w_next, v_next = load(buf, WM + o - S, W), load(buf, VS + o - S, W)
                            if rotation:
                                h = o - S  # φ on the half node between rows j−1 and j
                                strain = shear_strain(w_next, w, dy * load(buf, PH + h, W))
                                rate = shear_strain(v_next, v, dy * load(buf, VPHS + h, W))
                                d_vphi = dt * per_J * per_dy * shear_flux(strain, rate, G_m, eta_m)
                                vphi = load(buf, VPH + h, W) + d_vphi
                                store(buf, VPH + h, vphi)
                                store(buf, VPHS + h, vphi + 0.5 * d_vphi)
                                store(buf, PH + h, load(buf, PH + h, W) + dt * vphi)
                            else:
                                strain, rate = shear_strain(w_next, w, 0.0), shear_strain(v_next, v, 0.0)
                            flux = shear_flux(strain, rate, G_t, eta_t)
                        along = tension(load(buf, WM + o - P, W), w, load(buf, WM + o + P, W), T)
                        force = along + (per_weight * (flux_below - flux) - traction - p_col - p_aero)
                        before = load(buf, V + o, W)
                        store(buf, V + o, before + inverse * force)
                        store(buf, VS + o, before + three_halves * force)
                        flux_below, w, v = flux, w_next, v_next

                    # beam: load per mass, ready for the implicit product
                    beam = to_beam * dy - K_foun * w_b - C_foun * v_b
                    store(buf, FB + i, beam * per_rho_l + load(buf, LOAD + i, W) + four_per_dt2 * w_b)
                    width = load(buf, WIDTH + i, W)
                    area = area + d_min * width
                    flow_rate = flow_rate + q * width
                    contact_area = contact_area + touched * width * dy
                    slice_largest = where(load(buf, INV + i, W) > 0.0, slice_largest, 0.0)
                    column = where(slice_largest > largest, load(buf, COLUMN + i, W), column)
                    largest = maximum(slice_largest, largest)
                if air is not None and sweep == 0:
                    passed = total(flow_rate)
                    share = viscous_share(passed, total(slope), drop)
                    advance_airways(air, P_s, passed / math.sqrt(drop), share)
                    inlet, outlet, drop, flow_rate = air[INLET], air[OUTLET], air[DROP], zero

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

            # membrane and beam: displacement
            for j in range(ny):
                for i in range(C1, END, W):
                    o = j * S + i
                    store(buf, WM + o, load(buf, WM + o, W) + dt * load(buf, V + o, W))
            for i in range(C1, END, W):
                w_b = load(buf, WB + i, W)
                acceleration = 0.0 - four_per_dt2 * w_b
                for k in range(NB):
                    acceleration = acceleration + load(buf, BI + k * WORKED + i - C1, W) * each(
                        buf, (FB + C1) // P + k, P, W
                    )
                dv = dt * acceleration
                new = load(buf, VB + i, W) + dv
                store(buf, VB + i, new)
                store(buf, VBS + i, new + 0.5 * dv)
                store(buf, WB + i, w_b + dt * new)

            if (n + 1) % look_every == 0 or n + 1 == P_s_of.size // P:
                for j in range(ny):
                    for i in range(C1, END, W):
                        beyond = where(size(load(buf, WM + j * S + i, W)) < LARGEST_DISPLACEMENT_M, beyond, 1.0)
        store(buf, BEYOND, beyond)

    return advance
