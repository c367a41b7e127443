"""Error bars against a run on a grid four times as fine."""

from dataclasses import replace

import pytest

from vfcore.errors import DivergenceError
from vfcore.fold.march import TimeMarch
from vfcore.runs.one import simulate
from vfcore.spec.simulation import DEFAULT_STEP_S, Activation, Run, Simulation

VOICES = {
    "modal": Activation(),
    "posterior gap": Activation(pca=0.5),
    "high pitch": Activation(ct=1.0, ta=0.1),
}


@pytest.mark.parametrize("voice", ["modal", *(pytest.param(v, marks=pytest.mark.slow) for v in list(VOICES)[1:])])
def test_the_bars_cover_what_a_much_finer_grid_gives(voice):
    request = Simulation(activation=VOICES[voice], run=Run(error_estimate=True))
    result = simulate(request)
    fine = simulate(replace(request, run=Run(nx=77, ny=37))).report
    barred = {key: bar for key, bar in result.error_estimate.bars.items() if bar.half_width is not None}
    moved = {key: bar for key, bar in barred.items() if bar.half_width > 0.0}
    differences = {key: abs(fine.measures[key].value - result.report.measures[key].value) for key in barred}
    covered = [key for key, bar in barred.items() if differences[key] <= bar.half_width + 1e-12]
    assert len(moved) >= 12
    assert len(covered) >= 0.9 * len(barred), sorted(set(barred) - set(covered))
    # Bars must also be narrow: f_o to 1 %, mean flow to 10 %.
    assert moved["fo_hz"].half_width < 0.01 * fine.measures["fo_hz"].value
    assert moved["mean_flow_ml_s"].half_width < 0.1 * fine.measures["mean_flow_ml_s"].value


def test_a_march_with_error_bars_that_diverges_is_tried_at_half_the_step(monkeypatch):
    run = TimeMarch.run

    def diverging_at_the_usual_step(march, *arguments):
        if march.time_step_s == DEFAULT_STEP_S:
            raise DivergenceError(0.01, 0.5, 0.5, "the displacement passed 20 mm", "")
        return run(march, *arguments)

    monkeypatch.setattr(TimeMarch, "run", diverging_at_the_usual_step)
    result = simulate(Simulation(run=Run(error_estimate=True, duration_s=0.2)))
    steps_s = [level.time_step_s for level in result.error_estimate.levels]
    assert result.provenance.time_step_s == steps_s[0] == DEFAULT_STEP_S / 2
    assert max(steps_s[1:]) <= steps_s[0] / 2
