"""The choice of the time step: the default choice, and the refusal of too long a step."""

import numpy as np
import pytest

import vfcore
from vfcore.errors import ParameterError, StabilityError
from vfcore.fold.stability import longest_stable_step_s, time_step_s
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S, Run, Simulation


def glottis_on(nx, ny):
    return prepare(Simulation(run=Run(nx=nx, ny=ny))).glottis


def test_the_default_step_on_the_papers_grid_is_five_tract_sections():
    assert time_step_s(Run(), glottis_on(20, 10)) == DEFAULT_STEP_S == 5 * (0.0025 / 350)


@pytest.mark.parametrize(("nx", "ny"), [(20, 20), (20, 40), (80, 10), (30, 60)])
def test_a_finer_grid_gets_the_longest_stable_whole_fraction_of_the_default_step(nx, ny):
    glottis = glottis_on(nx, ny)
    limit = longest_stable_step_s(glottis)
    parts = DEFAULT_STEP_S / time_step_s(Run(nx=nx, ny=ny), glottis)
    assert parts == pytest.approx(round(parts), rel=1e-12)
    assert DEFAULT_STEP_S / round(parts) <= limit
    if round(parts) > 1:
        assert DEFAULT_STEP_S / (round(parts) - 1) > limit


def test_the_viscous_limit_falls_with_the_square_of_the_row_spacing():
    rows = np.array([11, 21, 41, 81])
    limits = np.array([longest_stable_step_s(glottis_on(20, ny)) for ny in rows])
    slopes = np.diff(np.log(limits)) / np.diff(np.log(rows - 1.0))
    assert slopes[-1] == pytest.approx(-2, abs=0.05)


def test_the_limit_on_the_papers_grid_is_that_of_the_shear_damper():
    """4 η̃ dt / (ρ_s dy²) = 1 for the alternating mode of the shear damper alone: 77 µs at ten rows."""
    glottis = glottis_on(20, 10)
    [fold] = glottis.walls
    c = fold.coefficients
    shear_alone = c.membrane_density_kg_m2 * fold.dy**2 / (4 * c.membrane_shear_viscosity_n_s_m)
    assert shear_alone == pytest.approx(77e-6, rel=0.05)
    assert 0.8 * shear_alone < longest_stable_step_s(glottis) < shear_alone


def test_a_requested_step_is_used_unchanged():
    assert time_step_s(Run(time_step_s=PAPER_STEP_S), glottis_on(20, 10)) == PAPER_STEP_S


@pytest.mark.parametrize(("nx", "ny"), [(20, 20), (20, 30), (20, 40), (80, 10), (30, 60)])
def test_too_long_a_step_is_refused_with_the_field_and_a_step_that_works(nx, ny):
    request = Simulation(run=Run(nx=nx, ny=ny, duration_s=0.02, time_step_s=1e-4))
    with pytest.raises(StabilityError) as refusal:
        vfcore.simulate(request, progress=lambda fraction: pytest.fail("the run was started"))
    error = refusal.value
    assert isinstance(error, ParameterError) and error.path == "run.time_step_s"
    assert "0.0001 s" in error.message and f"{nx}×{ny}" in error.message
    named = float(error.allowed.removeprefix("up to ").split(" s ")[0])
    glottis = glottis_on(nx, ny)
    assert named == pytest.approx(longest_stable_step_s(glottis), rel=0.01)
    assert time_step_s(Run(nx=nx, ny=ny, time_step_s=named), glottis) == named
