"""The twin of the fold against exact solutions; one file, because one twin has every law of the fold."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.coefficient_twin import coefficients
from tests.support.fold_twin import FoldTwin
from vfcore.fold.constants import FoldConstants

MODAL = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.0}
P_S = 1000.0
STEP = 4 * 0.0025 / 350
UNDAMPED = FoldConstants(C_coup_pa_s_m=0.0, C_foun_pa_s=0.0, C_col_pa_s_m=0.0, eta_m_pa_s=0.0)
SHEARS = ("kelvin_voigt", "rotation")


def random_state(fold, seed=0, size=1e-4):
    rng = np.random.default_rng(seed)
    shape = fold.zero_state()
    return type(shape)(*(size * rng.standard_normal(part.shape) for part in shape))


# ---- coefficients ---------------------------------------------------------------------------------

HAND_VALUES = {  # at strain 0.057, a_ta 0.4, computed by hand: (value, half a unit of its last digit)
    "L": (15.85e-3, 0.0051e-3), "b": (4.86e-3, 0.005e-3), "sigma_muc": (6490, 5), "sigma_lig": (9230, 5),
    "sigma_ta": (40500, 50), "E_lig": (79200, 50), "E_ta": (38000, 50), "T_m_tilde": (7.25, 0.005),
    "N_b": (1.71, 0.005), "N_b_tilde": (1.86, 0.005), "M_bar": (7.58e-3, 0.005e-3), "mu_c": (1.69e-5, 0.005e-5),
    "mu_c_tilde": (1.83e-5, 0.005e-5), "rho_s": (0.973, 0.0005), "rho_l": (0.0466, 0.00005),
}  # fmt: skip


@pytest.mark.parametrize("name", HAND_VALUES)
def test_coefficients_have_the_hand_computed_values(name):
    value, half_digit = HAND_VALUES[name]
    assert abs(getattr(coefficients(FoldConstants(), 0.057, 0.4), name) - value) <= half_digit


def test_the_beam_carries_no_net_axial_increment_in_bending():
    k = coefficients(FoldConstants(), 0.1, 0.7)
    assert k.E_lig * k.A_lig * k.alpha_lig == pytest.approx(-k.E_ta * k.A_ta * k.alpha_ta, rel=1e-12)
    assert k.alpha_ta - k.alpha_lig == pytest.approx((k.d_lig + k.d_ta) / 2, rel=1e-12)


# ---- flow -----------------------------------------------------------------------------------------


def test_uniform_gaps_without_viscosity_have_the_bernoulli_flow():
    fold = FoldTwin(0.057, 0.4, 0.1, theta_conv=0.0, constants=FoldConstants(mu_a_pa_s=0.0))
    air = fold.flow(fold.zero_state().w_m, P_S)
    area = fold.k.L**2 * np.tan(0.1)  # ∫ 2 x tan θ_g dx, exact by the trapezoid rule
    assert air.A_g_min == pytest.approx(area, rel=1e-12)
    assert air.Q_g == pytest.approx(np.sqrt(2 * P_S / 1.14) * area, rel=1e-12)


def test_a_wedge_without_viscosity_separates_at_the_ratio_of_the_paper():
    fold = FoldTwin(0.057, 0.4, 0.02, theta_conv=0.2, ny=201, constants=FoldConstants(mu_a_pa_s=0.0))
    air = fold.flow(fold.zero_state().w_m, P_S)
    i = 10
    outlet = 2 * fold.x[i] * np.tan(0.02)
    assert air.flow_per_width[i] == pytest.approx(1.3 * outlet * np.sqrt(2 * P_S / 1.14), rel=1e-12)
    y_sep = 0.3 * outlet / (2 * np.tan(0.2))
    assert 0 <= y_sep - fold.y[air.j_sep[i]] < fold.dy


@pytest.mark.parametrize("seed", range(3))
def test_every_slice_obeys_the_momentum_balance_at_every_node(seed):
    """Volume flow v·d_g is the same at every attached row, from p and the viscous loss up to that row."""
    fold = FoldTwin(0.057, 0.4, 0.05, theta_conv=0.05)
    c = fold.constants
    air = fold.flow(random_state(fold, seed).w_m, P_S)
    attached_rows = 0
    for gap, p, q in zip(air.gap, air.p_aero, air.flow_per_width, strict=True):
        if gap.min() == 0:
            continue
        separation_gap = min(c.alpha_s * gap.min(), gap.max())
        loss, j = 0.0, fold.ny - 1
        while gap[j] > separation_gap:
            speed = np.sqrt(2 * (P_S - p[j] - loss) / c.rho_a_kg_m3)
            assert speed * gap[j] == pytest.approx(q, rel=1e-9)
            assert 0 < p[j] < P_S
            loss += 12 * c.mu_a_pa_s * q * (gap[j] ** -3 + gap[j - 1] ** -3) / 2 * fold.dy
            attached_rows += 1
            j -= 1
        assert c.rho_a_kg_m3 / 2 * (q / separation_gap) ** 2 + loss == pytest.approx(P_S, rel=1e-9)
        assert (p[: j + 1] == 0).all()
    assert attached_rows > 50


def test_a_closed_slice_has_no_flow_and_lung_pressure_upstream_of_its_first_contact():
    fold = FoldTwin(**MODAL)
    w_m = np.zeros((fold.n, fold.ny))
    w_m[:, [3, 6]] = 1e-3
    air = fold.flow(w_m, P_S)
    assert air.Q_g == 0 and air.A_g_min == 0
    assert (air.p_aero[1:-1, 6:] == P_S).all() and (air.p_aero[1:-1, :6] == 0).all()


def test_contact_acts_only_where_the_fold_crosses_the_medial_plane():
    fold = FoldTwin(**MODAL)
    overlap = np.where(np.arange(fold.ny) % 2, 1e-4, -1e-4)
    w_m = fold.medial[1:-1] + overlap
    pressure = fold.contact_pressure(w_m, np.full_like(w_m, -0.5))[1:-1]
    assert pressure[:, 1::2] == pytest.approx(1e6 * 1e-4 - 100 * 0.5, rel=1e-9)
    assert (pressure[:, ::2] == 0).all()


# ---- the linear system ----------------------------------------------------------------------------


@pytest.mark.parametrize("shear", SHEARS)
@pytest.mark.parametrize("gradient", ["inferior_stiff", "superior_stiff"])
def test_forces_at_the_nodes_are_those_of_the_energies_between_them(shear, gradient):
    fold = FoldTwin(0.1, 0.7, 0.05, nx=9, ny=5, shear=shear, coupling_gradient=gradient)
    state = random_state(fold)
    system, (q, v) = fold.linear_operators(), fold.pack(state)
    expected = fold.unpack((system.load - system.K @ q - system.C @ v) / np.diag(system.M), v)
    a_m, a_b, a_phi = fold.acceleration(state, 0.0, contact=False)
    for got, want in ((a_m, expected.w_m), (a_b, expected.w_b), (a_phi, expected.phi)):
        assert got == pytest.approx(want, rel=1e-9, abs=1e-9 * np.abs(want).max())


def test_the_coupling_is_stiffest_at_the_edge_that_it_is_named_after():
    inferior, superior = FoldTwin(**MODAL), FoldTwin(**MODAL, coupling_gradient="superior_stiff")
    assert (inferior.K_coup[-1], inferior.K_coup[0]) == pytest.approx((5e5, 5e4))
    assert (superior.K_coup[-1], superior.K_coup[0]) == pytest.approx((5e4, 5e5))


def test_a_hinged_beam_has_the_euler_bernoulli_frequencies_under_tension():
    fold = FoldTwin(**MODAL, constants=FoldConstants(K_r_a_n_m=0.0, K_r_p_n_m=0.0))
    k, dx = fold.k, fold.dx
    wavenumber = np.arange(1, fold.n + 1) * np.pi / k.L
    squared = (2 / dx * np.sin(wavenumber * dx / 2)) ** 2  # of the second difference on a sine
    exact = (k.N_b_tilde * squared + k.mu_c_tilde * squared**2) / k.rho_l
    assert np.sort(np.linalg.eigvals(-fold.beam_operator).real) == pytest.approx(exact, rel=1e-9)


def exact_beam_deflection(fold):
    """Beam alone under its end moments: Ñ w'' = μ̃ w'''', four conditions for four exponentials."""
    k, c = fold.k, fold.constants
    s = np.sqrt(k.N_b_tilde / k.mu_c_tilde)

    def basis(x, order):
        polynomial = [(1, x), (0, 1), (0, 0)][order]
        return np.array([*polynomial, s**order * np.exp(s * (x - k.L)), (-s) ** order * np.exp(-s * x)])

    turn = k.lam**1.5
    rows = [
        basis(0, 0),
        basis(k.L, 0),
        k.mu_c_tilde * basis(0, 2) - c.K_r_a_n_m * turn * basis(0, 1),
        k.mu_c_tilde * basis(k.L, 2) + c.K_r_p_n_m * turn * basis(k.L, 1),
    ]
    moments = [0, 0, -k.M_bar - c.K_r_a_n_m * (fold.theta_g - c.rest_angle_rad), -k.M_bar]
    factors = np.linalg.solve(rows, moments)
    return np.array([basis(x, 0) @ factors for x in fold.x[1:-1]])


def test_the_beam_bends_under_its_end_moments_as_the_exact_solution_to_second_order():
    errors = []
    for nx in (20, 39):
        fold = FoldTwin(0.057, 0.4, 0.1, nx=nx)
        exact = exact_beam_deflection(fold)
        deflection = np.linalg.solve(-fold.beam_operator, fold.beam_load)
        errors.append(np.abs(deflection - exact).max() / np.abs(exact).max())
    assert exact[nx // 2] > 1e-4  # the prestress moment bulges the fold medially
    assert errors[1] < 2e-3
    assert np.log2(errors[0] / errors[1]) > 1.8


@pytest.mark.parametrize("shear", SHEARS)
def test_the_undamped_linear_system_keeps_its_energy(shear):
    fold = FoldTwin(**MODAL, nx=10, ny=5, shear=shear, constants=UNDAMPED)
    states = fold.linear_reference(random_state(fold)._replace(**zero_velocity(fold)), np.linspace(0, 2e-3, 5))
    energy = np.array([fold.linear_energy(state) for state in states])
    exchanged = max(v @ fold.linear_operators().M @ v / 2 for v in (fold.pack(state)[1] for state in states))
    assert np.abs(energy - energy[0]).max() < 1e-6 * exchanged


@pytest.mark.parametrize("shear", SHEARS)
def test_dampers_only_take_energy(shear):
    fold = FoldTwin(**MODAL, nx=10, ny=5, shear=shear)
    states = fold.linear_reference(random_state(fold)._replace(**zero_velocity(fold)), np.linspace(0, 2e-3, 21))
    assert (np.diff([fold.linear_energy(state) for state in states]) < 0).all()


def zero_velocity(fold):
    zero = fold.zero_state()
    return {"v_m": zero.v_m, "v_b": zero.v_b, "v_phi": zero.v_phi}


# ---- time stepping --------------------------------------------------------------------------------


@pytest.mark.parametrize("shear", SHEARS)
@pytest.mark.parametrize(("scheme", "order"), [("leapfrog", 2), ("euler", 1)])
def test_a_scheme_converges_to_the_adaptive_integrator_at_its_order(scheme, order, shear):
    fold = FoldTwin(0.057, 0.4, 0.5, nx=10, ny=5, theta_conv=0.3, shear=shear)  # too wide open to touch
    end = 112 * STEP
    start = fold.zero_state()
    [exact] = fold.linear_reference(start, [end])
    errors = []
    for split in (8, 16):
        dt = STEP / split
        state = start
        if scheme == "leapfrog":  # its velocity is at the previous half step
            a_m, a_b, a_phi = fold.acceleration(start, 0.0)
            state = start._replace(v_m=-dt / 2 * a_m, v_b=-dt / 2 * a_b, v_phi=-dt / 2 * a_phi)
        record = fold.run(state, 0.0, dt, 112 * split, scheme)
        assert record.p_col_max.max() == 0
        errors.append(np.abs(record.final.w_m - exact.w_m).max() / np.abs(exact.w_m).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)
    assert errors[1] < 2e-3


def test_the_two_schemes_agree_through_contact_and_flow():
    fold = FoldTwin(**MODAL)
    dt, steps = STEP / 8, 2240
    leapfrog = fold.run(fold.initial_state(), P_S, dt, steps)
    euler = fold.run(fold.initial_state(), P_S, dt, steps, "euler")
    assert leapfrog.Q_g.max() > 5e-4 and leapfrog.p_col_max.max() > 500
    scale = np.abs(leapfrog.final.w_m).max()
    assert np.abs(leapfrog.final.w_m - euler.final.w_m).max() < 0.01 * scale
    assert np.abs(leapfrog.Q_g - euler.Q_g).max() < 0.01 * leapfrog.Q_g.max()


def modal_measures(dt, scheme):
    """f_o (Hz), fraction of the cycle exactly closed, mean flow (m³/s), over whole cycles of the last 0.1 s."""
    fold = FoldTwin(**MODAL)
    record = fold.run(fold.initial_state(), P_S, dt, round(0.2 / dt), scheme)
    shut = record.A_g_min == 0
    openings = np.flatnonzero(shut[:-1] & ~shut[1:] & (record.t[1:] > 0.1))
    periods = np.diff(openings) * dt
    assert periods.size > 10 and np.ptp(periods) <= 2 * dt * (1 + 1e-9)
    cycles = slice(openings[0], openings[-1])
    return 1 / periods.mean(), shut[cycles].mean(), record.Q_g[cycles].mean()


@pytest.mark.parametrize(
    ("dt", "scheme"),
    [
        (STEP, "leapfrog"),
        pytest.param(STEP / 4, "leapfrog", marks=pytest.mark.slow),
        pytest.param(STEP / 4, "euler", marks=pytest.mark.slow),
    ],
)
def test_the_modal_case_has_the_frequency_closure_and_flow_of_two_earlier_prototypes(dt, scheme):
    f_o, closed_quotient, mean_flow = modal_measures(dt, scheme)
    assert f_o == pytest.approx(149.6, abs=0.1)
    half_a_sample = 0.5 * dt * f_o  # closed samples are counted, and every cycle may open at the same part of a step
    assert closed_quotient == pytest.approx(0.506, abs=max(0.001, half_a_sample))
    assert mean_flow == pytest.approx(1.29e-3, abs=0.005e-3)


# ---- static shape ---------------------------------------------------------------------------------


@pytest.mark.parametrize("shear", SHEARS)
def test_the_static_shape_is_at_rest_in_contact_and_leads_inferiorly(shear):
    fold = FoldTwin(**MODAL, shear=shear)
    w_m, w_b = fold.static_shape_reference()
    phi = np.diff(w_m, axis=1)[1:-1] / fold.dy if shear == "rotation" else fold.zero_state().phi
    rest = fold.zero_state()._replace(w_m=w_m[1:-1], w_b=w_b[1:-1], phi=phi)
    a_m, a_b, _ = fold.acceleration(rest, 0.0)
    # In units of the acceleration that a 1 µm displacement of the lowest mode would cause.
    scale = 1e-6 * (2 * np.pi * fold.mode_frequencies(1)[0]) ** 2
    assert np.abs(a_m).max() < 0.1 * scale and np.abs(a_b).max() < 0.1 * scale
    assert 0.1e-3 < (w_m - fold.medial).max() < 0.2e-3
    assert w_m[fold.nx // 2, -1] - w_m[fold.nx // 2, 0] > 0.2e-3


def test_a_tighter_bound_moves_the_static_shape_by_less_than_the_bound():
    fold = FoldTwin(strain=-0.004, a_ta=0.4, theta_g=0.192)
    loose, tight = fold.static_shape_reference(1e-7)[0], fold.static_shape_reference(1e-10)[0]
    assert 0 < np.sqrt(((loose - tight) ** 2).mean()) < 1e-7


def test_a_diverging_run_is_refused():
    fold = replace(FoldTwin(**MODAL), nx=80)
    with pytest.raises(FloatingPointError, match="diverged"), np.errstate(all="ignore"):
        fold.run(fold.initial_state(), P_S, STEP, 400, "euler")
