"""The default step against the plain loop at the paper's step, over random postures."""

import numpy as np
import pytest

import vfcore
from tests.support.equivalence import BOUNDS, SAME_STATE, compare, report, survey
from vfcore.spec.simulation import DEFAULT_STEP_S, Activation, Run, Simulation


def test_the_modal_voice_is_that_of_the_papers_step():
    found = compare(Simulation())
    assert found.states == ("periodic", "periodic")
    assert all(deviation <= bound for deviation, (_, bound, _) in zip(found.deviations, BOUNDS, strict=True))


@pytest.mark.parametrize(
    ("ta", "ct", "lca", "ia", "pressure_pa"),
    [(0.4233, 0.8277, 0.4092, 0.5496, 541.3), (0.2718, 0.5764, 0.8054, 0.2672, 924.8)],
)
def test_a_voice_whose_period_is_a_whole_number_of_steps_flows_as_at_a_finer_step(ta, ct, lca, ia, pressure_pa):
    """Periods of 160 and 157 steps: the voice locks to the step and closes at the same part of it in every cycle."""
    flows = []
    for step_s in (DEFAULT_STEP_S, DEFAULT_STEP_S / 4):
        request = Simulation(
            activation=Activation(ta=ta, ct=ct, lca=lca, ia=ia, pca=0.0),
            subglottal_pressure_pa=pressure_pa,
            run=Run(time_step_s=step_s),
        )
        report = vfcore.simulate(request).report
        assert report.state == "periodic"
        steps = 1 / (report.measures["fo_hz"].value * DEFAULT_STEP_S)
        assert abs(steps - round(steps)) < 0.05
        flows.append(report.measures["mean_flow_ml_s"].value)
    assert flows[0] == pytest.approx(flows[1], rel=6e-4)


@pytest.mark.slow
def test_random_voices_are_those_of_the_papers_step():
    found = survey(300)
    same = [one for one in found if one.states[0] == one.states[1]]
    assert len(same) >= SAME_STATE * len(found), report(found)
    periodic = np.array([one.deviations for one in same if one.states[0] == "periodic"])
    assert len(periodic) > 100
    for k, (key, bound, _) in enumerate(BOUNDS):
        assert np.nanmax(periodic[:, k]) <= bound, f"{key}: {report(found)}"
