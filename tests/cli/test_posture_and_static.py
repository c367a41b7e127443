"""`vocalis posture` and `vocalis static`: the numbers of the Python API, as JSON, table and curves."""

import csv
import json
import math
import re

import numpy as np
import pytest

import vfcore
from vfcore.io.result_document import posture_document
from vfcore.runs.setup import prepare
from vfcore.spec.posture_sets import constant_names
from vfcore.spec.simulation import Activation, Run, Simulation
from vocalis.cli.main import main

BREATHY = Simulation(activation=Activation(pca=0.5), run=Run(nx=15))


@pytest.mark.parametrize("command", ["posture", "static"])
def test_json_is_the_answer_of_the_python_api(capsys, command):
    assert main([command, "--pca", "0.5", "--set", "run.nx=15", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document == json.loads(json.dumps(posture_document(prepare(BREATHY))))
    posture = vfcore.solve_posture(BREATHY.activation, BREATHY.posturing)
    assert document["posture"]["glottal_half_angle_rad"] == posture.glottal_half_angle_rad
    assert posture.glottal_half_angle_rad == pytest.approx(0.192, abs=1e-3)  # published check value


def test_the_posture_table_has_millimetres_and_degrees(capsys):
    assert main(["posture", "--pca", "0.5"]) == 0
    shown = capsys.readouterr().out
    angle = float(re.search(r"half-angle +(\S+) +°", shown)[1])
    length = float(re.search(r"fold length +(\S+) +mm", shown)[1])
    assert angle == pytest.approx(math.degrees(0.192), abs=0.06)  # published check value
    assert length == pytest.approx(15 * (1 - 0.004), abs=0.02)
    assert "N/m" in shown and "open" in shown


def test_the_static_curves_are_written_in_metres(capsys, tmp_path):
    path = tmp_path / "shape.csv"
    assert main(["static", "--pca", "0.5", "--nx", "15", "--csv", str(path)]) == 0
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    shape = vfcore.static_shape(BREATHY)
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    assert np.array_equal(columns["x_m"], shape.x_m) and np.array_equal(columns["beam_m"], shape.w_b)
    assert np.array_equal(columns["superior_m"], shape.w_m[0]) and np.array_equal(columns["inferior_m"], shape.w_m[-1])
    assert np.array_equal(columns["medial_inferior_m"], shape.medial_m[-1])
    gap_mm = 2e3 * max(shape.medial_m[0, -1] - shape.w_m[0, -1], 0)
    assert f"{gap_mm:.3f}" in capsys.readouterr().out


def test_the_constants_are_listed_with_range_and_unit(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["posture", "--constants"]) == 0
    shown = capsys.readouterr().out
    names = {line.split()[0] for line in shown.splitlines() if line.strip()}
    assert set(constant_names()) | {"K_col_pa_m", "rest_angle_rad"} <= names
    line = next(line for line in shown.splitlines() if line.startswith("K_col_pa_m"))
    assert "1e+06" in line and "10000 … 1e+09" in line and "Pa/m" in line
