"""Error bars from three grids: exact on manufactured convergence, and absent with a reason where there is no order."""

from dataclasses import replace

import pytest

from vfcore.errors import ParameterError
from vfcore.io.result_document import result_document
from vfcore.measures.catalogue import CATALOGUE, MeasureReport
from vfcore.measures.measure import Measure
from vfcore.runs.error_estimate import ErrorBar, Level, companion_step_s, companions, richardson
from vfcore.runs.one import simulate
from vfcore.spec.simulation import Run, Simulation

GRIDS = ((21, 11), (31, 16), (41, 21))  # spacings 1, 2/3, 1/2 exactly
LEVELS = [Level(nx, ny, 1e-5, "periodic") for nx, ny in GRIDS]


def report(value, state="periodic"):
    measures = {spec.key: Measure(value, spec.unit) for spec in CATALOGUE}
    return MeasureReport(state, "", None, measures, 0, None)


def bar_of(values, states=("periodic",) * 3) -> ErrorBar:
    reports = [report(value, state) for value, state in zip(values, states, strict=True)]
    return richardson(LEVELS, reports).bars["fo_hz"]


@pytest.mark.parametrize("order", [0.7, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("size", [8.0, -0.03])
def test_a_manufactured_order_is_found_and_the_bar_is_the_error_times_its_factor(order, size):
    bar = bar_of([150.0 + size * h**order for h in (1.0, 2 / 3, 0.5)])
    assert bar.observed and bar.order == pytest.approx(order, rel=1e-6)
    assert bar.limit == pytest.approx(150.0, rel=1e-9)
    assert bar.half_width == pytest.approx(1.25 * abs(size), rel=1e-6)


def test_an_order_above_that_of_the_scheme_is_limited():
    bar = bar_of([150.0 + h**4 for h in (1.0, 2 / 3, 0.5)])
    assert bar.order == 2.0 and bar.half_width > 1.25


def test_without_a_clear_order_the_first_order_is_taken_with_the_wide_factor():
    bar = bar_of([150.0, 150.1, 150.4])
    assert not bar.observed and bar.order == 1.0
    assert bar.limit == pytest.approx(150.8) and bar.half_width == pytest.approx(3 * 0.8)


@pytest.mark.parametrize(("values", "states", "why"), [
    ((150.0, 151.0, 150.5), ("periodic",) * 3, "does not change one way"),
    ((150.0, 151.0, 151.0), ("periodic",) * 3, "does not change one way"),
    ((150.0, 149.0, 148.5), ("periodic", "periodic", "subharmonic"), "periodic, periodic, subharmonic"),
    ((150.0, 149.0, 148.5), ("irregular",) * 3, "does not repeat"),
    ((None, 149.0, 148.5), ("periodic",) * 3, "no value here"),
    ((150.0, None, 148.5), ("periodic",) * 3, "finer grid gives no value"),
])  # fmt: skip
def test_there_is_no_bar_without_a_reason(values, states, why):
    bar = bar_of(values, states)
    assert (bar.half_width, bar.limit, bar.order) == (None, None, None) and why in bar.reason


def test_a_value_equal_on_all_grids_has_no_error():
    bar = bar_of([0.057, 0.057, 0.057])
    assert (bar.half_width, bar.limit, bar.reason) == (0.0, 0.057, None)


def test_companions_refine_both_spacings_and_the_step():
    request = Simulation(run=Run(error_estimate=True))
    grids = [(one.run.nx, one.run.ny, one.run.error_estimate) for one in companions(request)]
    assert grids == [(29, 15, False), (39, 19, False)]
    assert companion_step_s(8.0, 1.5, 100.0) == 4.0
    assert companion_step_s(8.0, 2.0, 1.9) == pytest.approx(8 / 5)


def test_a_grid_too_fine_to_be_refined_is_refused_with_the_finest_that_would_do():
    with pytest.raises(ParameterError, match="run.nx up to 100") as refusal:
        companions(Simulation(run=Run(nx=101, error_estimate=True)))
    assert refusal.value.path == "run.error_estimate"
    companions(Simulation(run=Run(nx=100, ny=50, error_estimate=True)))


def test_error_bars_are_optional_and_do_not_change_the_run():
    short = Run(duration_s=0.2)
    alone = simulate(Simulation(run=short))
    fractions = []
    barred = simulate(Simulation(run=replace(short, error_estimate=True)), progress=fractions.append)
    assert alone.error_estimate is None and result_document(alone)["error_estimate"] is None
    assert barred.report.measures == alone.report.measures
    assert fractions == sorted(fractions) and fractions[-1] == pytest.approx(1.0)
    document = result_document(barred)["error_estimate"]
    assert [(level["nx"], level["ny"]) for level in document["levels"]] == [(20, 10), (29, 15), (39, 19)]
    assert set(document["measures"]) == set(CATALOGUE.keys())
    assert document["measures"]["fo_hz"]["unit"] == "Hz" and document["measures"]["fo_hz"]["half_width"] > 0
    assert document["measures"]["strain"]["half_width"] == 0.0
    assert document["measures"]["jitter_percent"]["reason"]
