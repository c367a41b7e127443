"""A sweep without a server: its table, its files, its journal, and workers that die."""

import csv
import json
import os
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray

import vfcore
from vfcore.errors import Cancelled, ParameterError
from vfcore.fold.form import LANES
from vfcore.runs.cost import node_steps, walls_of
from vfcore.runs.many import run_points
from vfcore.runs.sweep import SweepTable, run_sweep, sweep_from_dict
from vfcore.runs.sweep.cost import Portions, point_node_steps
from vfcore.runs.sweep.dataset import dataset
from vfcore.runs.sweep.files import write_csv, write_netcdf
from vfcore.runs.sweep.journal import Journal
from vfcore.runs.sweep.row import decode, encode
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import DEFAULT_STEP_S

SHORT = {"run": {"duration_s": 0.2}}
CT = {"parameter": "activation.ct", "values": [0.1, 0.5]}
#: The second step is too long for the grid: those points fail.
STEP = {"parameter": "run.time_step_s", "values": [2e-5, 1e-3]}


@pytest.fixture(scope="module")
def table():
    return run_sweep(sweep_from_dict({"base": SHORT, "axes": [CT, STEP]}), workers=1)


def test_a_point_has_the_numbers_of_its_own_run(table):
    for place, ct in enumerate(CT["values"]):
        run = vfcore.Run(duration_s=0.2, time_step_s=2e-5)
        (point,) = run_points([vfcore.Simulation(activation=vfcore.Activation(ct=ct), run=run)])
        alone = point.report
        assert table.states()[place, 0] == alone.state
        for key, measure in alone.measures.items():
            value = table.measure(key)[place, 0]
            assert value == measure.value if measure.value is not None else np.isnan(value)
            assert table.reason(key, table.sweep.shape[1] * place) == measure.reason


def test_a_point_that_cannot_be_computed_has_a_reason(table):
    assert table.n_failed == 2 and list(table.problems) == [1, 3]
    assert "run.time_step_s" in table.problems[1] and table.states()[0, 1] == "failed"
    assert table.reason("fo_hz", 1) == table.problems[1]


NX = {"parameter": "run.nx", "values": [20, 40, 10]}


@pytest.mark.parametrize(
    "document, wanted",
    [
        ({"axes": [CT]}, 20 * 10 * 0.2 / DEFAULT_STEP_S),
        ({"axes": [NX, STEP]}, 40 * 10 * 0.2 / 2e-5),
        ({"axes": [{"parameter": "run.duration_s", "values": [1, 3]}]}, 20 * 10 * 3 / DEFAULT_STEP_S),
        ({"points": [{"run.nx": 10}, {"run.time_step_s": 1e-5, "run.ny": 6}]}, 20 * 10 * 0.2 / 1e-5),
        ({"points": [{"run.nx": 10}, {"activation.ct": 1}]}, 20 * 10 * 0.2 / DEFAULT_STEP_S),
    ],
)
def test_the_cost_of_a_point_is_that_of_the_largest_run(document, wanted):
    assert point_node_steps(sweep_from_dict({"base": SHORT} | document)) == pytest.approx(wanted, rel=1e-12)


def test_two_folds_coupling_and_lesions_cost_more():
    plain = {"base": SHORT, "axes": [CT]}
    alone = point_node_steps(sweep_from_dict(plain))
    for more, least, most in (
        ({"right": {"activation": {"ta": 0.1}}}, 1.4, 2.0),
        ({"model": {"coupling": "two_way"}}, 2.0, 4.0),
        ({"model": {"stretch": "finite"}}, 1.1, 1.6),
        ({"lesions": [{"kind": "polyp", "side": "left"}]}, 1.8, 2.6),
    ):
        found = point_node_steps(sweep_from_dict({"base": SHORT | more, "axes": [CT]}))
        assert least < found / alone < most, more
    one_side = sweep_from_dict({"base": SHORT, "axes": [{"parameter": "right.activation.ct", "values": [0.1, 0.4]}]})
    assert point_node_steps(one_side) > 1.4 * alone, "the points have two folds, though the base has one"


CLOSER = {"parameter": "activation.ta", "values": [0.1, 0.4]}
HEIGHT = {"parameter": "lesions.0.height_mm", "values": [0.0, 0.3]}


@pytest.mark.parametrize(
    ("base", "axis"),
    [
        ({}, HEIGHT),
        ({"lesions": [{"side": "left"}]}, HEIGHT),
        ({"lesions": [{"side": "both"}]}, HEIGHT),
        ({}, {"parameter": "left.activation.ta", "values": [0.1, 0.4]}),
        ({"right": {"activation": {"ta": 0.4}}}, CLOSER),
        ({"lesions": [{"kind": "polyp", "side": "left"}]}, CLOSER),
    ],
)
def test_no_point_costs_more_than_the_bound_of_its_sweep(base, axis):
    """Also where the base has one fold without lesions and a point has two, or lesions."""
    sweep = sweep_from_dict({"base": SHORT | base, "axes": [axis]})
    points = [sweep.request(position) for position in range(len(sweep))]
    lesioned = [any(fold.lesions for fold in folds_of(one)) for one in points]
    costs = [
        node_steps(one, one.run, one.run.step_s, walls_of(one), patched)
        for one, patched in zip(points, lesioned, strict=True)
    ]
    assert max(costs) <= point_node_steps(sweep)


def test_every_null_of_the_document_is_explained(table):
    document = json.loads(json.dumps(table.document(), allow_nan=False))
    failed = {problem["index"] for problem in document["problems"]}
    for measure in document["measures"].values():
        explained = failed | {point for entry in measure["reasons"] for point in entry["points"]}
        assert {k for k, value in enumerate(measure["values"]) if value is None} == explained


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_tasks_are_whole_batches_of_the_step(precision):
    values = [k / 40 for k in range(41)]
    axes = [{"parameter": f"activation.{muscle}", "values": values} for muscle in ("ct", "ta")]
    portions = Portions(sweep_from_dict({"axes": axes, "precision": precision}), workers=2)
    for seconds in (0.03, 0.015, 0.01):
        portions.learn(1, seconds)
        assert portions.next_size(len(values) ** 2) % LANES[precision] == 0


def test_the_last_points_are_shared_out():
    axes = [{"parameter": "activation.ct", "values": [k / 400 for k in range(400)]}]
    portions = Portions(sweep_from_dict({"axes": axes}), workers=2)
    for _ in range(4):
        portions.learn(1, 1e-3)
    assert portions.next_size(400) > portions.next_size(50) > portions.next_size(10) == LANES["float64"]


def test_points_not_computed_yet_are_pending():
    empty = SweepTable(sweep_from_dict({"axes": [CT]}))
    assert empty.document()["pending"] == [0, 1] and empty.states().tolist() == ["pending"] * 2
    assert "not computed yet" in empty.reason("fo_hz", 0)


def test_a_netcdf_file_opens_as_the_dataset(table, tmp_path):
    write_netcdf(table, tmp_path / "sweep.nc")
    with xarray.open_dataset(tmp_path / "sweep.nc") as opened:
        xarray.testing.assert_identical(opened.load(), dataset(table))
        assert dict(opened.sizes) == {"activation_ct": 2, "run_time_step_s": 2}
        assert opened.fo_hz.attrs["units"] == "Hz" and opened.activation_ct.attrs["units"] == "1"
        assert opened.phonation_state.sel(activation_ct=0.5, run_time_step_s=1e-3).item() == "failed"
        assert json.loads(opened.attrs["request"])["kind"] == "sweep"
        meanings = json.loads(opened.jitter_percent_reason.attrs["meanings"])
        code = opened.jitter_percent_reason.isel(activation_ct=0, run_time_step_s=0).item()
        assert meanings[code] == table.reason("jitter_percent", 0)


def test_a_list_of_points_is_a_dataset_over_points(tmp_path):
    sweep = sweep_from_dict({"base": SHORT, "points": [{"activation.ct": 0.2}, {"subglottal_pressure_pa": 100}]})
    write_netcdf(run_sweep(sweep, workers=1), tmp_path / "points.nc")
    with xarray.open_dataset(tmp_path / "points.nc") as opened:
        assert opened.fo_hz.dims == ("point",)
        assert opened.activation_ct.values[0] == 0.2 and np.isnan(opened.activation_ct.values[1])
        assert opened.phonation_state.values[1] == "none"


def test_csv_has_a_line_per_point_that_reads_back_exactly(table, tmp_path):
    write_csv(table, tmp_path / "sweep.csv")
    lines = list(csv.DictReader((tmp_path / "sweep.csv").open()))
    assert len(lines) == 4
    assert float(lines[2]["activation.ct [1]"]) == 0.5
    assert float(lines[0]["mean_flow_ml_s [mL/s]"]) == table.measure("mean_flow_ml_s")[0, 0]
    assert lines[1]["fo_hz [Hz]"] == "" and "time_step_s" in lines[1]["problem"]


def test_a_selection_keeps_only_that(tmp_path):
    sweep = sweep_from_dict({"base": SHORT, "axes": [CT], "measures": ["fo_hz"]})
    assert list(run_sweep(sweep, workers=1).columns) == ["fo_hz", "periodicity"]


def test_a_row_reads_back_and_damage_is_noticed(table):
    sweep = table.sweep
    from vfcore.runs.sweep.task import run_task

    (row,) = run_task(sweep.part([0]), vfcore.MODEL_VERSION).rows
    again = decode(encode(row))
    assert again.state == row.state and again.reasons == row.reasons and again.problem is None
    np.testing.assert_array_equal(again.values, row.values)
    data = bytearray(encode(row))
    data[len(data) // 2] ^= 255
    with pytest.raises(Exception, match="."):
        decode(bytes(data))


def test_a_journal_is_resumed_and_nothing_is_computed_twice(tmp_path):
    sweep = sweep_from_dict({"base": SHORT, "points": [{"activation.ct": k / 120} for k in range(120)]})
    journal, counts = Journal(tmp_path / "journal", sweep), []
    with pytest.raises(Cancelled):
        run_sweep(
            sweep, 1, journal=journal, progress=lambda done, *_: counts.append(done), stop=lambda: len(counts) > 1
        )
    kept = dict(journal.rows())
    assert 0 < len(kept) < 120
    journal.close()
    again = Journal(tmp_path / "journal", sweep)
    asked = []
    table = run_sweep(sweep, 1, journal=again, progress=lambda done, *_: asked.append(done))
    assert asked[0] == len(kept) and table.n_done == 120
    np.testing.assert_array_equal(table.values, run_sweep(sweep, 1).values)


def test_a_journal_of_something_else_is_refused(tmp_path):
    Journal(tmp_path / "journal", sweep_from_dict({"axes": [CT]})).close()
    with pytest.raises(ParameterError, match="of another sweep"):
        Journal(tmp_path / "journal", sweep_from_dict({"axes": [STEP]}))
    (tmp_path / "text").write_text("not a database, but some text that is long enough to look like one" * 50)
    with pytest.raises(ParameterError, match="not a database"):
        Journal(tmp_path / "text", sweep_from_dict({"axes": [CT]}))


_DIES = """
import os, sys, vfcore.runs.many, vfcore.runs.sweep.task as task
from vfcore.runs.sweep import run_sweep, sweep_from_dict
if __name__ == "__main__":
    points = [{"activation.ct": k / 16} for k in range(16)]
    sweep = sweep_from_dict({"base": {"run": {"duration_s": 0.2}}, "points": points})
    table = run_sweep(sweep, workers=2)
    print(table.n_failed, sorted(table.problems), table.problems.get(3))
else:
    true = task.run_points
    def deadly(requests, *how, **asked):
        if any(request.activation.ct == 3 / 16 for request in requests):
            os._exit(7)
        return true(requests, *how, **asked)
    task.run_points = deadly
"""


def test_a_point_that_kills_its_worker_twice_fails_alone(tmp_path):
    script = tmp_path / "dies.py"
    script.write_text(_DIES)
    ended = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120)
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout == "1 [3] The worker process ended while it computed this point, twice.\n"


def test_workers_end_with_a_parent_that_is_killed(tmp_path):
    script = tmp_path / "long.py"
    script.write_text(
        "from vfcore.runs.sweep import run_sweep, sweep_from_dict\n"
        "if __name__ == '__main__':\n"
        "    run_sweep(sweep_from_dict({'points': [{'activation.ct': k / 5000} for k in range(5000)]}), 2,\n"
        "              progress=lambda done, *_: print(done, flush=True))\n"
    )
    parent = subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True)
    parent.stdout.readline()
    parent.stdout.readline()
    children = children_of(parent.pid)
    assert children
    parent.kill()
    parent.wait()
    deadline = time.monotonic() + 10
    while any(is_alive(pid) for pid in children):
        assert time.monotonic() < deadline, "a worker outlives its parent"
        time.sleep(0.1)


def children_of(pid: int) -> list[int]:
    text = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(word) for word in text.split()]


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return "Z" not in subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True).stdout
