"""The convergence tables: which runs, which changes, and why the rotation equation has no limit in y."""

import numpy as np
import pytest

from tests.support.inline_pool import InlinePool
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Model, Run, Simulation
from vocalis.studies.paper.convergence import refinement
from vocalis.studies.paper.convergence.refinement import (
    DIVISORS,
    GRIDS,
    VOICES,
    cells,
    convergence_document,
    last_changes,
)
from vocalis.studies.paper.convergence.shear import mode_rates, shear_row
from vocalis.studies.paper.convergence.text import convergence_tables
from vocalis.studies.paper.run.gather import Failure


def rows(fo, cq, pressure=3000.0):
    """Rows of all voices, with one value per grid for f_o and CQ at every step."""
    return [
        {"voice": voice, "nx": nx, "ny": ny, "time_step_us": 1.0 / divisor, "state": "periodic",
         "measures": {"fo_hz": fo[k], "closed_quotient": cq[k], "speed_quotient": 1.5, "mean_flow_ml_s": 1.0,
                      "contact_pressure_max_pa": pressure}}
        for voice in VOICES for k, (nx, ny) in enumerate(GRIDS) for divisor in DIVISORS
    ]  # fmt: skip


def modal(found):
    return {row["measure"]: row for row in found if row["voice"] == "modal"}


def test_every_voice_runs_on_every_grid_with_three_steps_that_halve():
    asked = list(cells())
    assert len(asked) == len(VOICES) * len(GRIDS) * len(DIVISORS) == 27
    own, half, quarter = (cell.request.run.step_s for cell in asked[:3])
    assert own == pytest.approx(2 * half) and own == pytest.approx(4 * quarter)
    assert [(c.request.run.nx, c.request.run.ny) for c in asked[:9:3]] == [(20, 10), (40, 20), (80, 40)]


def test_the_last_change_decides_and_a_voice_that_never_closes_has_no_cq_to_change():
    found = modal(last_changes(rows((150.0, 149.0, 148.8), (0.5, 0.45, 0.42))))
    assert found["f_o"]["last_grid"] == pytest.approx(148.8 / 149 - 1) and found["f_o"]["met"]
    assert found["f_o"]["first_grid"] == pytest.approx(149 / 150 - 1) and found["f_o"]["last_step"] == 0.0
    assert found["CQ"]["last_grid"] == pytest.approx(-1 / 15) and not found["CQ"]["met"]
    never = modal(last_changes(rows((150.0, 149.0, 147.0), (0.0, 0.0, 0.0))))
    assert never["CQ"]["absent"] and never["CQ"]["last_grid"] is None and not never["f_o"]["met"]


def test_a_run_without_an_answer_keeps_its_reason_and_meets_nothing(monkeypatch):
    monkeypatch.setattr(refinement, "measured", lambda request: Failure("the run diverged"))
    monkeypatch.setattr(refinement, "shear_rows", lambda pool: [])
    seen = []
    document = convergence_document(InlinePool(), lambda voice, done, total: seen.append((voice, done, total)))
    assert {row["reason"] for row in document["rows"]} == {"the run diverged"}
    assert not any(row["met"] for row in last_changes(document["rows"]))
    assert seen[-1] == (list(VOICES)[-1], 27, 27)
    assert "| failed | – | – |" in convergence_tables(document)["convergence"]


@pytest.mark.parametrize("ny", [10, 20, 40])
def test_kelvin_voigt_has_three_modes_in_the_voice_on_any_grid_and_the_rotation_one_for_each_row(ny):
    found = {}
    for shear in ("kelvin_voigt", "rotation"):
        rates = mode_rates(prepare(Simulation(model=Model(shear=shear), run=Run(ny=ny))).fold)
        assert rates.real.max() < 0.0
        found[shear] = rates[(rates.imag > 0.0) & (rates.imag < 2 * np.pi * 500.0)]
    assert (len(found["kelvin_voigt"]), len(found["rotation"])) == (3, ny)
    assert -found["kelvin_voigt"].real.max() > 50.0 and -found["rotation"].real.max() < 8.0


def test_neighbouring_rows_come_closer_with_the_spacing_in_a_kelvin_voigt_membrane():
    coarse, fine = (shear_row("kelvin_voigt", ny) for ny in (10, 20))
    assert coarse["state"] == fine["state"] == "periodic"
    assert fine["jump"] / coarse["jump"] == pytest.approx(9 / 19, rel=0.1)
    assert shear_row("rotation", 10)["jump"] > 4 * coarse["jump"]
