"""A diverging run is stopped where it starts, with an error that has time, place and a remedy."""

import re
import sys

import numpy as np
import pytest

import vfcore
from tests.support.fold_harness import MODAL, advance, membrane, product_and_twin
from vfcore.errors import DivergenceError, VocalisError
from vfcore.fold.march import TimeMarch
from vfcore.fold.stability import SAFETY, longest_stable_step_s
from vfcore.fold.step import LARGEST_DISPLACEMENT_M
from vfcore.spec.simulation import Run, Simulation


def too_long_step(glottis):
    return 1.5 * longest_stable_step_s(glottis) / SAFETY


def diverging(glottis):
    march = TimeMarch(glottis, too_long_step(glottis), 1000.0)
    march.start(0, None)
    return march


def test_the_error_has_the_first_step_and_node_beyond_the_bound():
    glottis, _ = product_and_twin(**MODAL)
    with pytest.raises(DivergenceError) as caught:
        diverging(glottis).run(4000)
    error = caught.value
    march = diverging(glottis)
    steps = round(error.time_s / march.time_step_s)
    assert steps * march.time_step_s == pytest.approx(error.time_s, rel=1e-12)
    advance(march, steps - 1)
    assert np.abs(membrane(march)).max() < LARGEST_DISPLACEMENT_M
    advance(march, 1)
    beyond = np.abs(membrane(march)) >= LARGEST_DISPLACEMENT_M
    j, i = error.y_over_b * (glottis.ny - 1), error.x_over_L * (glottis.nx - 1)
    assert beyond[round(j), round(i)]


def test_the_message_has_time_place_reason_and_remedy():
    glottis, _ = product_and_twin(**MODAL)
    with pytest.raises(DivergenceError) as caught:
        diverging(glottis).run(4000)
    text, error = str(caught.value), caught.value
    assert isinstance(error, VocalisError)
    assert re.search(
        rf"t = {error.time_s * 1e3:.3f} ms, at x/L = {error.x_over_L:.2f}, y/b = {error.y_over_b:.2f}", text
    )
    assert "passed 20 mm" in text
    assert "Try a lower pressure or the constants' default values" in error.remedy
    assert f"a step below {too_long_step(glottis):.3g} s" in error.remedy


def test_divergence_is_found_in_the_chunk_in_which_it_starts():
    glottis, _ = product_and_twin(**MODAL)
    fractions = []
    with pytest.raises(DivergenceError) as caught:
        diverging(glottis).run(100_000, progress=fractions.append)
    reached = len(fractions) * 5e-3
    assert reached <= caught.value.time_s <= reached + 5.2e-3


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_displacement_beyond_the_bound_is_a_divergence(value):
    glottis, _ = product_and_twin(**MODAL)
    march = TimeMarch(glottis, 1e-6, 0.0)
    membrane(march)[3, 7] = value
    with pytest.raises(DivergenceError):
        march.run(10)


def test_a_run_that_diverges_raises_the_error(monkeypatch):
    too_long = lambda run, glottis: [too_long_step(glottis)]  # noqa: E731
    monkeypatch.setattr(sys.modules["vfcore.runs.one"], "steps_to_try", too_long)
    with pytest.raises(DivergenceError, match=r"the run diverged at t = .* ms"):
        vfcore.simulate(Simulation(run=Run(duration_s=0.2)))
