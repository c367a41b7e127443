"""The step of a glottis: flow → contact → membrane → beam, for each wall. One file, because it is one compiled loop.

Scheme (docs/model/numerics.md, "Time stepping"). Velocities are defined on half steps:

    v^{n+½} = v^{n−½} + dt a(w^n, v*),   w^{n+1} = w^n + dt v^{n+½},   v* = v^{n−½} + ½ (v^{n−½} − v^{n−3/2})

v* extrapolates the velocity to time n, so every damper is second order. The membrane displacement has one more term
(fold/displacement.py). The forces write it to a second field, because neighbours still need the old value; the two
fields swap roles each step. The beam uses the trapezoidal rule for its own stiffness A (tension, bending, end moments,
per mass):

    (w_b^{n+1} − 2 w_b^n + w_b^{n−1})/dt² = (I − dt²A/4)⁻¹ (A w_b^n + f/ρ_l)

which is unconditionally stable and undamped. With S = (I − dt²A/4)⁻¹ and SA = (4/dt²)(S − I) the right side is
S (f/ρ_l + 4/dt² w_b) − 4/dt² w_b. For one fold, vectorised over columns, S is a dense product per step. For several
folds it is a forward substitution, column by column as the loads become known, and a backward one, with the factors of
I − dt²A/4 (kernels/banded.py): a third of the operations and a sixth of the numbers.

Stored between steps: w, v^{n−½} and v*, so that no damper recomputes v*. With F/ρ_s = a, the new v^{n+½} and the next
v* = v^{n−½} + (3/2) dt a are one multiply-add each.
Shear is taken in differences between rows, with G̃/dy² and η̃/dy² (terms/shear.py). An edge row is a half cell
without flux through the edge; its traction and contact count half.
The air pressure at the first contact of a slice jumps as it closes or opens: it is averaged over the step
(terms/air.py).

Columns go through three phases, BLOCK vectors at a time: gaps, flux, forces. From the last gap of a column to its flux
there is one long dependency chain (√, ÷); the chains of a block overlap, so the processor does not wait for one.

Two different walls share the flow, the contact and the airways, which see the half opening of both; every other term
is a wall's own. Then the pressures of a column on its nodes come first, and the forces of both walls after them.
With finite stretch a pass over all rows finds their tension before the forces (terms/tension.py). A form without
patches keeps mass, tension, shear, dampers and contact as numbers, and coupling as one number per row.

Symbols as in the paper; SI units. Order 2 in dt, dx and dy, but first order in dy where the air pressure ends on a node
(terms/air.py). Stability bound: vfcore/fold/stability.py. Boundary slices x = 0, L count by the trapezoid rule in area
and flow. Twin: tests/support/fold_twin.py. Not validated against measured vibration.
"""

import math
from collections.abc import Callable
from functools import lru_cache

from vfcore.fold.displacement import displaced
from vfcore.fold.form import StepForm
from vfcore.fold.layout import LAW, layout_of
from vfcore.fold.terms import air, contact, coupling, shear, tension
from vfcore.kernels import airways, airways_many
from vfcore.kernels.elementary import abs_
from vfcore.kernels.jit import inlined
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
    square_root,
    store,
)

touching, contact_pressure = contact.touching, contact.contact_pressure
above_zero, reciprocals, opening = air.above_zero, air.reciprocals, air.opening
gap_rate, closed_fraction, held_fraction = air.gap_rate, air.closed_fraction, air.held_fraction
square, half_segment = air.square, air.half_segment
separation_gap, attached = air.separation_gap, air.attached
viscous_drop, flux_root, slice_flux, pressure = air.viscous_drop, air.flux_root, air.slice_flux, air.pressure
along_fold, along_varying = tension.tension, tension.varying_tension
stretched, active_tension, sums_of_eight = tension.stretched, tension.active_tension, tension.sums_of_eight
traction_of, kelvin_voigt = coupling.coupling, shear.kelvin_voigt
advance_airways, viscous_share = airways.advance_airways, airways.viscous_share
advance_airways_many = airways_many.advance_airways_many
DROP, FLOW, INLET, OUTLET = airways.DROP, airways.FLOW, airways.INLET, airways.OUTLET
SMALLEST_DROP_PA = airways.SMALLEST_DROP_PA
#: A larger displacement, NaN or inf counts as divergence.
LARGEST_DISPLACEMENT_M = 0.02
#: Recorded samples, 5 ms, between two checks of the largest displacement.
LOOK_SAMPLES = 140


@lru_cache(maxsize=64)
def step_kernel(form: StepForm) -> Callable[..., None]:
    """The compiled loop of a form: ``advance(buf, P_s, record_every, record, air, start, target, glide)``.

    n glottises side by side, 1 or one per vector element. All arrays are flat and have the form's precision:

    - ``buf`` (Layout.size,): state and fixed numbers, changed in place
    - ``P_s`` (steps·n,): lung pressure at each step, Pa
    - ``record`` (steps // record_every · len(form.record)·n,): form.record of the state before the step, n values each
    - ``air``: buffer of the airways (kernels/airways.py) in a coupled form; else not read
    - ``start``, ``target`` (Layout.size − Layout.fixed,): the fixed numbers that a block glides from and to, linearly;
      ``glide`` is (stretch, begin, total): steps over which they are held at the value of the middle, the step of the
      block at which this call begins, and the steps of the block. A stretch of 0: nothing glides, both are not read.

    On return the first n numbers of ``beyond`` are 1 where a check (every LOOK_SAMPLES samples and at the last step)
    found a displacement beyond LARGEST_DISPLACEMENT_M, else 0. Verified in tests/physics.
    """
    L = layout_of(form)
    nx, ny = form.nx, form.ny
    W, P = form.lanes, form.glottises
    many, rotation, finite = form.many, form.rotation, form.finite
    patched, coupled, two, WALLS = form.patched, form.coupled, form.walls == 2, form.walls
    S, C1, END, NB = L.stride, L.first, L.first + L.worked, nx - 2
    ROWS, BLOCK, COLUMNS = ny * W, L.block, len(form.record)
    WM, NEXT, V, VS = L.at("w"), L.at("w_next"), L.at("v"), L.at("v_star")
    # From one wall to the other:
    FIELD, LINE, KROWS, WALL_PARAMS = L.wall("w"), L.wall("w_b"), L.wall("K_coup"), L.wall("wall_numbers") // P
    BI_WALL = 0 if many else L.wall("beam_inverse")
    PH, VPH, VPHS = (L.at(name) for name in ("phi", "vphi", "vphi_star")) if rotation else (0, 0, 0)
    G, K = L.at("G"), L.at("K_coup") // P
    R, M, I, PRESSED = L.at("square"), L.at("running_min"), L.at("viscous"), L.at("pressure")
    LARGEST_HALF, SEP, INV_GAP_RATE, Q = (L.at("slice") + row * BLOCK * W for row in range(4))
    WB, VB, VBS, FB = L.at("w_b"), L.at("v_b"), L.at("v_star_b"), L.at("beam_force")
    LOAD, INV, WIDTH, COLUMN = L.at("beam_load"), L.at("inverse_density"), L.at("width"), L.at("column")
    WORKED, BEYOND, HALF_MIN = L.worked, L.at("beyond"), L.at("half_min")
    BI = 0 if many else L.at("beam_inverse")
    INV_D, A_1, A_2 = (L.at(name) for name in ("inv_D", "a", "c")) if many else (0, 0, 0)
    SUMS, TENSION, STRETCH = (
        (L.at(name) for name in ("slot_sum", "slot_tension", "slot_stretch")) if finite else (0, 0, 0)
    )
    SLOTS, SUMS_WALL = L.slots * (W if many else 1), L.wall("slot_sum") if finite else 0
    LAW_GAIN, LAW_A, LAW_B, LAW_C, LAW_Z, LAW_ALPHA = (L.at(name) for name in LAW) if finite else (0,) * 6
    IM, TS, GH, EH, KC, CC = (
        (L.at(name) for name in ("inverse_mass", "tension_share", "shear", "shear_viscosity", "coupling",
                                 "coupling_damper")) if patched else (0,) * 6
    )  # fmt: skip
    KN, CN = (L.at("contact"), L.at("contact_damper")) if patched else (0, 0)
    HELD = END - W if many else END  # with many folds the posterior end, which does not move, is a vector of its own
    ALWAYS_CONTACT = form.precision == "float32"  # with 16 folds some slice is almost always closed: do not test
    SWEEPS = 2 if coupled else 1
    FIXED, FIXED_SIZE = L.fixed, L.size - L.fixed
    MIDDLE = C1 + ((nx - 1) // 2 - 1) * P  # the column at mid-length
    N_DT, N_DY, N_ALPHA, N_RHO, N_MU, N_KCOL, N_CCOL = (
        L.number(name) for name in ("dt", "dy", "alpha_s", "half_rho_a", "twelve_mu_a", "K_col", "C_col")
    )
    W_DY, W_INV_RHO, W_T, W_G, W_ETA, W_INV_J, W_GROT, W_EROT, W_SHARE, W_C, W_KF, W_CF = (
        L.wall_number(name)
        for name in ("dy", "inv_beam_density", "T_over_dx2", "G_shear_over_dy2", "eta_shear_over_dy2",
                     "inv_rotation_inertia", "G_rotation", "eta_rotation", "rotation_share", "C_coup", "K_foun",
                     "C_foun")
    )  # fmt: skip
    W_ACTIVE = L.wall_number("N_active")  # followed by the other numbers of the active stress

    # The closure may hold only plain constants: numba's cache key includes the closure cells, and a function in one of
    # them has another key in every process, so no process would find the code that another has compiled.
    @inlined
    def advance(buf, P_s_of, record_every, record, air, start, target, glide):
        zero, far = broadcast(0.0, buf, W), broadcast(1.0, buf, W)
        beyond, look_every = zero, LOOK_SAMPLES * record_every
        now, later = WM, NEXT  # present displacements, and those after the step; swapped each step
        steps = P_s_of.size // P
        stretch = glide[0] if glide[0] > 0 else steps
        for since in range(0, steps, max(stretch, 1)):
            until = min(since + stretch, steps)
            if glide[0] > 0:
                part = 0.5 * (2 * glide[1] + since + until) / glide[2]
                for k in range(FIXED_SIZE):
                    buf[FIXED + k] = start[k] + part * (target[k] - start[k])
            dt, dy, alpha_s = load_param(buf, N_DT, P, W), load_param(buf, N_DY, P, W), load_param(buf, N_ALPHA, P, W)
            half_rho_a, twelve_mu_a = load_param(buf, N_RHO, P, W), load_param(buf, N_MU, P, W)
            K_col, C_col = load_param(buf, N_KCOL, P, W), load_param(buf, N_CCOL, P, W)
            dy_w, inv_rho_l, T = (
                load_param(buf, W_DY, P, W),
                load_param(buf, W_INV_RHO, P, W),
                load_param(buf, W_T, P, W),
            )
            G_t, eta_t, C_coup = load_param(buf, W_G, P, W), load_param(buf, W_ETA, P, W), load_param(buf, W_C, P, W)
            K_foun, C_foun, inv_J = (
                load_param(buf, W_KF, P, W),
                load_param(buf, W_CF, P, W),
                load_param(buf, W_INV_J, P, W),
            )
            G_m, eta_m = load_param(buf, W_GROT, P, W), load_param(buf, W_EROT, P, W)
            six_mu_a_dy, four_over_dt2 = 0.5 * twelve_mu_a * dy, 4.0 / (dt * dt)
            turning = dt * inv_J * (1.0 / dy_w)

            for n in range(since, until):
                P_s = load_param(P_s_of, n, P, W)
                inlet, drop = P_s, P_s
                outlet = zero if many else 0.0
                area = flow_rate = slope = contact_area = largest = column = zero
                if coupled:
                    drop = maximum(abs_(load_param(air, DROP, P, W)), SMALLEST_DROP_PA)

                # tension of each row, and what it adds to that of the beam, at the present stretch
                if finite:
                    for s in range(WALLS):
                        sums, tensions, stretches = SUMS + s * SUMS_WALL, TENSION + s * SLOTS, STRETCH + s * SLOTS
                        for j in range(ny):
                            o, total = now + s * FIELD + j * S, zero
                            for i in range(C1, END, W):
                                differ = load(buf, o + i, W) - load(buf, o + i - P, W)
                                if patched:
                                    share = load(buf, TS + s * FIELD + j * S + i - P, W)
                                    total = total + share * differ * differ
                                else:
                                    total = total + differ * differ
                            store(buf, sums + j * W, total)
                        total = zero
                        for i in range(C1, END, W):
                            differ = load(buf, WB + s * LINE + i, W) - load(buf, WB + s * LINE + i - P, W)
                            total = total + differ * differ
                        store(buf, sums + ny * W, total)
                        store(buf, sums + ny * W + W, total)
                        for slot in range(0, SLOTS, W):
                            total = load(buf, sums + slot, W) if many else sums_of_eight(buf, sums + slot * W)
                            law = s * SLOTS + slot
                            e = load(buf, LAW_GAIN + law, W) * total
                            T_slot = stretched(
                                e,
                                load(buf, LAW_A + law, W),
                                load(buf, LAW_B + law, W),
                                load(buf, LAW_C + law, W),
                                load(buf, LAW_Z + law, W),
                                load(buf, LAW_ALPHA + law, W),
                            )
                            store(buf, stretches + slot, e)
                            store(buf, tensions + slot, T_slot)

                y_1, y_2, y_1_right, y_2_right = zero, zero, zero, zero
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
                            if two:
                                other = load(buf, G + FIELD + o, W) - load(buf, now + FIELD + o, W)
                                half = 0.5 * (half + other)
                            if j > 0:
                                half_next = load(buf, G + o - S, W) - load(buf, now + o - S, W)
                                if two:
                                    other = load(buf, G + FIELD + o - S, W) - load(buf, now + FIELD + o - S, W)
                                    half_next = 0.5 * (half_next + other)
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

                    # separation and flux; with airways first the flow at the last drop, then the flux at the new one
                    for sweep in range(SWEEPS):
                        if coupled:
                            area, flow_rate, slope = zero, zero, zero
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
                            inv_density = load(buf, INV + i, W)
                            if two:
                                inv_density = 0.5 * (inv_density + load(buf, INV + LINE + i, W))
                            pushed = dt * dt * inv_density * abs_(drop)
                            delta = gap_rate(half_min, load(buf, HALF_MIN + i, W), pushed)
                            inv_sum, inv_gap_rate = reciprocals(0.5 * (Bd + root), 0.5 * delta)
                            q = slice_flux(drop, d_min, d_sep, inv_sum)
                            store(buf, Q + g * W, q)
                            store(buf, SEP + g * W, half_sep)
                            store(buf, INV_GAP_RATE + g * W, inv_gap_rate)
                            width = load(buf, WIDTH + i, W)
                            area, flow_rate = area + opening(d_min) * width, flow_rate + q * width
                            if coupled:
                                slope = slope + d_sep / root * width
                        if coupled and sweep == 0:
                            if many:
                                share = viscous_share(flow_rate, slope, drop)
                                advance_airways_many(air, P_s, flow_rate / square_root(drop), share)
                                inlet, outlet = load_param(air, INLET, P, W), load_param(air, OUTLET, P, W)
                                drop = load_param(air, DROP, P, W)
                            else:
                                passed = hsum(flow_rate)
                                share = viscous_share(passed, hsum(slope), drop)
                                advance_airways(air, P_s, passed / math.sqrt(drop), share)
                                inlet, outlet, drop = air[INLET], air[OUTLET], air[DROP]

                    # contact, membrane and load on the beam
                    for g in range(groups):
                        i, here = first + g * W, g * ROWS
                        width = load(buf, WIDTH + i, W)
                        if i == HELD:  # at rest, but the folds may touch there
                            touched = zero
                            for j in range(ny):
                                depth = load(buf, now + j * S + i, W) - load(buf, G + j * S + i, W)
                                if two:
                                    o = FIELD + j * S + i
                                    depth = 0.5 * (depth + (load(buf, now + o, W) - load(buf, G + o, W)))
                                more = touched + (0.5 if j == 0 or j == ny - 1 else 1.0)
                                touched = select(touching(depth), more, touched)
                            contact_area = contact_area + touched * width * dy
                            continue
                        q, half_sep = load(buf, Q + g * W, W), load(buf, SEP + g * W, W)
                        half_min, inv_gap_rate = load(buf, M + here, W), load(buf, INV_GAP_RATE + g * W, W)
                        store(buf, HALF_MIN + i, half_min)
                        closed_part, upstream = closed_fraction(half_min, inv_gap_rate), far
                        in_contact = ALWAYS_CONTACT or not all_of(half_min * inv_gap_rate > 0.5)
                        slice_largest, touched = zero, zero
                        if two:  # pressures on both walls
                            for k in range(ny):
                                j = ny - 1 - k
                                o, running = j * S + i, load(buf, M + here + j * W, W)
                                on = attached(running, half_sep)
                                inv_d2, viscous = load(buf, R + here + j * W, W), load(buf, I + here + j * W, W)
                                p = pressure(inlet, q, inv_d2, viscous, half_rho_a, six_mu_a_dy)
                                p = select(on, p, outlet)
                                if in_contact:
                                    held = outlet + (inlet - outlet) * held_fraction(
                                        upstream, inv_gap_rate, closed_part
                                    )
                                    p, upstream = select(on, p, held), running
                                    o_2 = FIELD + o
                                    depth = load(buf, now + o, W) - load(buf, G + o, W)
                                    depth = 0.5 * (depth + (load(buf, now + o_2, W) - load(buf, G + o_2, W)))
                                    speed = 0.5 * (load(buf, VS + o, W) + load(buf, VS + o_2, W))
                                    if patched:
                                        p_col = contact_pressure(
                                            depth, speed, load(buf, KN + o, W), load(buf, CN + o, W)
                                        )
                                    else:
                                        p_col = contact_pressure(depth, speed, K_col, C_col)
                                    slice_largest = maximum(p_col, slice_largest)
                                    more = touched + (0.5 if k == 0 or j == 0 else 1.0)
                                    touched = select(touching(depth), more, touched)
                                    p = p + p_col
                                store(buf, PRESSED + here + j * W, p)

                        for s in range(WALLS):
                            if two:
                                p_s = s * WALL_PARAMS
                                dy_w, inv_rho_l = (
                                    load_param(buf, W_DY + p_s, P, W),
                                    load_param(buf, W_INV_RHO + p_s, P, W),
                                )
                                T, G_t = load_param(buf, W_T + p_s, P, W), load_param(buf, W_G + p_s, P, W)
                                eta_t, C_coup = load_param(buf, W_ETA + p_s, P, W), load_param(buf, W_C + p_s, P, W)
                                K_foun, C_foun = load_param(buf, W_KF + p_s, P, W), load_param(buf, W_CF + p_s, P, W)
                                G_m, eta_m = load_param(buf, W_GROT + p_s, P, W), load_param(buf, W_EROT + p_s, P, W)
                                turning = dt * load_param(buf, W_INV_J + p_s, P, W) * (1.0 / dy_w)
                            F, at_x = s * FIELD, s * LINE + i
                            w_b = load(buf, WB + at_x, W)
                            v_b = load(buf, VBS + at_x, W)
                            beam_damper = C_coup * v_b
                            inverse = dt * load(buf, INV + at_x, W)
                            to_beam, flux_below = zero, zero
                            w, v = load(buf, now + F + (ny - 1) * S + i, W), load(buf, VS + F + (ny - 1) * S + i, W)
                            shear_here = kelvin_voigt(w, v, G_t, eta_t)
                            for k in range(ny):
                                j = ny - 1 - k
                                o = F + j * S + i
                                edge = k == 0 or j == 0
                                if two:
                                    p_wall, p_col = load(buf, PRESSED + here + j * W, W), zero
                                else:
                                    running = load(buf, M + here + j * W, W)
                                    on = attached(running, half_sep)
                                    inv_d2, viscous = load(buf, R + here + j * W, W), load(buf, I + here + j * W, W)
                                    p_wall = pressure(inlet, q, inv_d2, viscous, half_rho_a, six_mu_a_dy)
                                    p_wall = select(on, p_wall, outlet)
                                    p_col = zero
                                    if in_contact:
                                        held = outlet + (inlet - outlet) * held_fraction(
                                            upstream, inv_gap_rate, closed_part
                                        )
                                        p_wall, upstream = select(on, p_wall, held), running
                                        depth = w - load(buf, G + o, W)
                                        if patched:
                                            p_col = contact_pressure(
                                                depth, v, load(buf, KN + o, W), load(buf, CN + o, W)
                                            )
                                        else:
                                            p_col = contact_pressure(depth, v, K_col, C_col)
                                        slice_largest = maximum(p_col, slice_largest)
                                        touched = select(touching(depth), touched + (0.5 if edge else 1.0), touched)
                                if patched:
                                    C_node = load(buf, CC + o, W)
                                    traction = traction_of(w, v, w_b, C_node * v_b, load(buf, KC + o, W), C_node)
                                    inverse = dt * load(buf, IM + o, W)
                                else:
                                    K_row = load_param(buf, K + s * (KROWS // P) + j, P, W)
                                    traction = traction_of(w, v, w_b, beam_damper, K_row, C_coup)
                                to_beam = to_beam + (0.5 if edge else 1.0) * traction
                                w_next, v_next, shear_next, flux = w, v, shear_here, zero
                                if j > 0:
                                    w_next, v_next = load(buf, now + o - S, W), load(buf, VS + o - S, W)
                                    if patched:
                                        G_h, eta_h = load(buf, GH + o - S, W), load(buf, EH + o - S, W)
                                        flux = kelvin_voigt(w - w_next, v - v_next, G_h, eta_h)
                                    else:
                                        shear_next = kelvin_voigt(w_next, v_next, G_t, eta_t)
                                        flux = shear_here - shear_next
                                    if rotation:
                                        h = o - S  # φ on the half row between rows j−1 and j
                                        phi, vphi = load(buf, PH + h, W), load(buf, VPH + h, W)
                                        vphi_star = load(buf, VPHS + h, W)
                                        turn, rate = dy_w * phi, dy_w * vphi_star
                                        if patched:
                                            flux = flux - kelvin_voigt(turn, rate, G_h, eta_h)
                                            moment = load_param(buf, W_SHARE + s * WALL_PARAMS, P, W) * flux
                                        else:
                                            flux = flux - kelvin_voigt(turn, rate, G_t, eta_t)
                                            moment = kelvin_voigt(w - w_next - turn, v - v_next - rate, G_m, eta_m)
                                        store(buf, VPH + h, vphi + turning * moment)
                                        store(buf, VPHS + h, vphi + 1.5 * turning * moment)
                                        store(buf, PH + h, displaced(phi, vphi, vphi_star, turning, moment, dt))
                                if k == 0:
                                    flux_below = 0.0 - flux
                                if j == 0:
                                    flux = 0.0 - flux_below
                                if finite:
                                    T = load_param(buf, (TENSION + s * SLOTS) // P + j, P, W)
                                before, after = load(buf, now + o - P, W), load(buf, now + o + P, W)
                                if patched:
                                    share_before, share_after = load(buf, TS + o - P, W), load(buf, TS + o, W)
                                    along = along_varying(before, w, after, share_before, share_after, T)
                                else:
                                    along = along_fold(before, w, after, T)
                                force = along + (flux_below - flux - traction - p_col - p_wall)
                                speed_before = load(buf, V + o, W)
                                store(buf, V + o, speed_before + inverse * force)
                                store(buf, VS + o, speed_before + 1.5 * inverse * force)
                                store(buf, later + o, displaced(w, speed_before, v, inverse, force, dt))
                                flux_below, w, v, shear_here = flux, w_next, v_next, shear_next

                            # beam: right side of the implicit system
                            beam = to_beam * dy_w - K_foun * w_b - C_foun * v_b
                            if finite:
                                slot = (s * SLOTS + ny * P) // P
                                ligament = load_param(buf, TENSION // P + slot, P, W)
                                muscle = load_param(buf, TENSION // P + slot + 1, P, W)
                                law = W_ACTIVE + s * WALL_PARAMS
                                pull = (
                                    ligament
                                    + muscle
                                    + active_tension(
                                        load_param(buf, STRETCH // P + slot, P, W),
                                        load_param(buf, law, P, W),
                                        load_param(buf, law + 1, P, W),
                                        load_param(buf, law + 2, P, W),
                                    )
                                )
                                beam = beam + along_fold(
                                    load(buf, WB + at_x - P, W), w_b, load(buf, WB + at_x + P, W), pull
                                )
                            rhs = beam * inv_rho_l + load(buf, LOAD + at_x, W) + four_over_dt2 * w_b
                            if many:
                                if s == 0:
                                    rhs = rhs - load(buf, A_1 + at_x, W) * y_1 - load(buf, A_2 + at_x, W) * y_2
                                    y_1, y_2 = rhs, y_1
                                else:
                                    rhs = rhs - load(buf, A_1 + at_x, W) * y_1_right
                                    rhs = rhs - load(buf, A_2 + at_x, W) * y_2_right
                                    y_1_right, y_2_right = rhs, y_1_right
                            store(buf, FB + at_x, rhs)
                        if in_contact:
                            contact_area = contact_area + touched * width * dy
                            slice_largest = select(load(buf, INV + i, W) > 0.0, slice_largest, 0.0)
                            column = select(slice_largest > largest, load(buf, COLUMN + i, W), column)
                            largest = maximum(slice_largest, largest)

                if n % record_every == 0:
                    row = n // record_every * COLUMNS
                    if many:
                        store(record, row * W, area)
                        store(record, row * W + W, flow_rate)
                        store(record, row * W + 2 * W, largest)
                        store(record, row * W + 3 * W, select(largest > 0.0, column, math.nan))
                        store(record, row * W + 4 * W, contact_area)
                        store(record, row * W + 5 * W, inlet)
                        store(record, row * W + 6 * W, outlet)
                        if coupled:
                            store(record, row * W + W, load_param(air, FLOW, P, W))
                        if two:
                            for s in range(WALLS):
                                edge_m = far
                                for j in range(ny):
                                    o = s * FIELD + j * S + MIDDLE
                                    edge_m = minimum(load(buf, G + o, W) - load(buf, now + o, W), edge_m)
                                store(record, row * W + (7 + s) * W, edge_m)
                    else:
                        record[row] = hsum(area)
                        record[row + 1] = hsum(flow_rate)
                        record[row + 2] = 0.0
                        record[row + 3] = math.nan
                        record[row + 4] = hsum(contact_area)
                        record[row + 5], record[row + 6] = inlet, outlet
                        if coupled:
                            record[row + 1] = air[FLOW]
                        if record[row + 4] > 0.0:
                            for k in range(W):
                                p, c = extract(largest, k), extract(column, k)
                                if p > record[row + 2] or (p == record[row + 2] and c < record[row + 3]):
                                    record[row + 2], record[row + 3] = p, c
                        if two:
                            for s in range(WALLS):
                                edge_1 = 1.0
                                for j in range(ny):
                                    o = s * FIELD + j * S + MIDDLE
                                    edge_1 = min(buf[G + o] - buf[now + o], edge_1)
                                record[row + 7 + s] = edge_1

                # displacement of the beam
                for s in range(WALLS):
                    near, far_off = zero, zero  # back substitution: to subtract at this column, and at the one after it
                    for first in range(C1, HELD, W):
                        i = s * LINE + C1 + HELD - W - first
                        w_b = load(buf, WB + i, W)
                        acceleration = 0.0 - four_over_dt2 * w_b
                        if many:
                            solved = load(buf, FB + i, W) * load(buf, INV_D + i, W) - near
                            near = far_off + load(buf, A_1 + i, W) * solved
                            far_off = load(buf, A_2 + i, W) * solved
                            acceleration = acceleration + solved
                        else:
                            column_at = BI + s * BI_WALL + (C1 + HELD - W - first) - C1
                            for k in range(NB):
                                loaded = load_param(buf, (FB + s * LINE + C1) // P + k, P, W)
                                acceleration = acceleration + load(buf, column_at + k * WORKED, W) * loaded
                        dv = dt * acceleration
                        new = load(buf, VB + i, W) + dv
                        store(buf, VB + i, new)
                        store(buf, VBS + i, new + 0.5 * dv)
                        store(buf, WB + i, w_b + dt * new)
                now, later = later, now

                if (n + 1) % look_every == 0 or n + 1 == steps:
                    for j in range(WALLS * ny):
                        for i in range(C1, END, W):
                            beyond = select(abs_(load(buf, now + j * S + i, W)) < LARGEST_DISPLACEMENT_M, beyond, 1.0)
        for j in range(WALLS * ny):  # in both fields: the state must not depend on whether the number of steps was odd
            for i in range(C1, END, W):
                w = load(buf, now + j * S + i, W)
                store(buf, WM + j * S + i, w)
                store(buf, NEXT + j * S + i, w)
        store(buf, BEYOND, beyond)

    return advance
