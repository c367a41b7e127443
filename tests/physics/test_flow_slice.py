"""Flow through one slice: Bernoulli with viscous loss. Gaps are ordered from outlet to inlet."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from tests.support.fold_harness import advance, membrane, product_and_twin
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.fold.surface import surface_pressures
from vfcore.fold.terms.air import closed_fraction, held_fraction

NX, NY = 12, 6
RHO, MU, ALPHA_S, P_S = 1.14, 1.8e-5, 1.3, 1000.0
THICKNESS_M = 4.86e-3
SLICE = 5


def pressures(gaps, pressure_pa=P_S, mu=MU, alpha_s=ALPHA_S):
    """p_aero (ny,) of a slice with these gaps, m."""
    half = np.array(gaps)[:, None] / 2
    p_aero, p_col = np.full((2, *half.shape), np.nan)
    dy = THICKNESS_M / (len(gaps) - 1)
    still, K, C = np.zeros_like(half), np.full_like(half, 1e6), np.full_like(half, 100.0)
    surface_pressures(half, still, pressure_pa, 0.0, dy, alpha_s, RHO / 2, 12 * mu, K, C, p_aero, p_col)
    return p_aero[:, 0]


def flux(gaps, pressure_pa=P_S, mu=MU, alpha_s=ALPHA_S):
    """Flow per width, m²/s, of a slice with these gaps: one step of the kernel with every other slice closed."""
    glottis, _ = product_and_twin(0.057, 0.4, 0.0, nx=NX, ny=NY, mu_a_pa_s=mu, rho_a_kg_m3=RHO, alpha_s=alpha_s)
    march = TimeMarch(glottis, 1e-6, pressure_pa)
    medial = np.full((NY, NX), -1.0)
    medial[:, SLICE] = np.array(gaps) / 2
    membrane(march, "G")[:] = medial
    march.buffer[march.layout.number("dy")] = THICKNESS_M / (NY - 1)
    return advance(march, 1)[0, RECORD.index("glottal_flow_m3_s")] / glottis.walls[0].dx


GAPS = st.lists(st.floats(2e-5, 4e-3), min_size=NY, max_size=NY)


@pytest.mark.kernel
def test_without_viscosity_the_flux_is_the_bernoulli_speed_times_the_separation_gap():
    gaps = np.array([1.0, 1.2, 1.9, 2.5, 3.0, 4.0]) * 1e-3
    assert flux(gaps, mu=0.0) == pytest.approx(np.sqrt(2 * P_S / RHO) * ALPHA_S * 1e-3, rel=1e-12)


@pytest.mark.kernel
def test_a_slice_of_one_gap_separates_at_its_inlet():
    """α_s d_min exceeds every gap: the largest gap bounds it, no node is attached, there is no viscous loss."""
    gaps = np.full(NY, 5e-4)
    assert flux(gaps) == pytest.approx(np.sqrt(2 * P_S / RHO) * 5e-4, rel=1e-12)
    assert (pressures(gaps) == 0).all()


@pytest.mark.parametrize("mu", [1e-6, 1e-7, 1e-8])
def test_as_viscosity_vanishes_the_flux_tends_to_the_bernoulli_flux_at_first_order(mu):
    """To first order the relative deficit is half the viscous drop over P_s, 6 μ q ∫dy/d³ / P_s."""
    gaps = np.linspace(2e-4, 2e-3, NY)
    ideal = np.sqrt(2 * P_S / RHO) * ALPHA_S * 2e-4
    way = np.trapezoid(gaps**-3, dx=THICKNESS_M / (NY - 1))
    deficit = 6 * mu * ideal * way / P_S
    assert 1 - flux(gaps, mu=mu) / ideal == pytest.approx(deficit, rel=3 * deficit)


@pytest.mark.kernel
@given(gaps=GAPS, closed=st.integers(0, NY - 1), overlap=st.floats(0, 1e-3))
@settings(max_examples=30, deadline=None)
def test_a_closed_slice_has_no_flow_and_lung_pressure_upstream_of_its_first_contact(gaps, closed, overlap):
    gaps[closed] = -2 * overlap
    assert flux(gaps) == 0
    p = pressures(gaps)
    assert (p[closed:] == P_S).all()
    assert (p[:closed] == 0).all()


def test_with_several_contacts_the_pressure_ends_at_the_one_nearest_the_lungs():
    assert pressures([1e-3, 0, 1e-3, 0, 1e-3, 1e-3]).tolist() == [0, 0, 0, P_S, P_S, P_S]


@given(gaps=GAPS, mu=st.sampled_from([0.0, MU, 1e-3]))
@example(gaps=[2e-5, 4e-3, 3e-3, 4e-3, 2.5e-5, 4e-3], mu=MU)
@settings(max_examples=60, deadline=None)
def test_the_flow_is_the_same_at_every_attached_node_and_the_pressure_ends_at_separation(gaps, mu):
    q, p = flux(gaps, mu=mu), pressures(gaps, mu=mu)
    separation_gap = min(ALPHA_S * min(gaps), max(gaps))
    loss, j, dy = 0.0, NY - 1, THICKNESS_M / (NY - 1)
    while gaps[j] > separation_gap:  # from the inlet
        dynamic = P_S - p[j] - loss
        assert np.sqrt(max(2 * dynamic / RHO, 0.0)) * gaps[j] == pytest.approx(q, rel=1e-5)
        assert 0 < p[j] <= P_S
        loss += 12 * mu * q * (gaps[j] ** -3 + gaps[j - 1] ** -3) / 2 * dy
        j -= 1
    assert RHO / 2 * (q / separation_gap) ** 2 + loss == pytest.approx(P_S, rel=1e-9)  # p = 0 at y_sep
    assert (p[: j + 1] == 0).all()


def test_separation_is_found_from_the_inlet_even_if_the_glottis_is_narrower_downstream():
    gaps = np.array([1.0, 3.0, 1.2, 3.0, 3.5, 4.0]) * 1e-3  # d_min is at the outlet, d_sep = 1.3 mm upstream of it
    p = pressures(gaps)
    assert (p[3:] > 0).all() and (p[:3] == 0).all()


@given(gaps=GAPS, grow=st.floats(1.001, 3), widen=st.floats(1e-6, 1e-3))
@settings(max_examples=40, deadline=None)
def test_a_wider_slice_has_more_flow(gaps, grow, widen):
    here = flux(gaps)
    assert here > 0
    assert flux(np.array(gaps) * grow) > here
    assert flux(np.array(gaps) + widen) > here


@given(gaps=GAPS, low=st.floats(1, 4000), more=st.floats(1, 1000))
@settings(max_examples=30, deadline=None)
def test_more_pressure_drives_more_flow(gaps, low, more):
    assert flux(gaps, pressure_pa=low + more) > flux(gaps, pressure_pa=low)


@pytest.mark.kernel
def test_without_lung_pressure_there_is_no_flow_and_no_pressure():
    gaps = np.linspace(2e-4, 2e-3, NY)
    assert flux(gaps, pressure_pa=0.0) == 0
    assert (pressures(gaps, pressure_pa=0.0) == 0).all()


@given(gaps=GAPS, alpha_s=st.floats(1.0, 2.5))
@settings(max_examples=30, deadline=None)
def test_separation_is_at_the_requested_ratio(gaps, alpha_s):
    d_sep = min(alpha_s * min(gaps), max(gaps))
    assume(all(abs(gap - d_sep) > 1e-9 for gap in gaps if gap != max(gaps)))
    inner = np.flatnonzero(np.array(gaps) <= d_sep)
    p = pressures(gaps, alpha_s=alpha_s)
    assert (p[: inner[-1] + 1] == 0).all()
    assert (p[inner[-1] + 1 :] > 0).all()


@given(first=st.floats(-2.0, 2.0), behind=st.floats(0.0, 2.0), speed=st.sampled_from([-1.0, 1.0]))
@example(first=-0.2, behind=0.1, speed=1.0)
@settings(max_examples=40, deadline=None)
def test_the_pressure_of_a_node_is_its_mean_over_the_step_in_which_the_slice_closes(first, behind, speed):
    """All rows move by Δ in the step. The folds meet in row 1 at half gap ``first`` Δ, in row 3 ``behind`` Δ later."""
    change, instants = 1e-5, (np.arange(400) + 0.5) / 400 - 0.5
    half_gaps = np.array([1e-3, first * change, 1e-3, (first + behind) * change, 1e-3, 1e-3])
    through = np.mean([pressures(2 * (half_gaps + speed * change * at)) for at in instants], axis=0)
    shut = closed_fraction(half_gaps[1], 1 / change)
    assert P_S * held_fraction(half_gaps[3], 1 / change, shut) == pytest.approx(through[1], abs=P_S / 200)
