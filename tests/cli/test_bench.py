"""The benchmarks: the plain loop gives the same voice, operation counts are those of the source, tables are
complete.
"""

import json
import time
from pathlib import Path

import numpy as np
import pytest

from tests.support.fold_harness import MODAL, product_and_twin
from vfcore.kernels.layout import Layout
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import PAPER_STEP_S, Run, Simulation
from vocalis.bench import history, suite
from vocalis.bench.answers import answers
from vocalis.bench.count import Counted, count_step
from vocalis.bench.reference import plain_run
from vocalis.bench.rounds import interleaved, turns
from vocalis.bench.sweeps import served, to_table
from vocalis.cli.main import main


def rate(area, sample_s):
    """Cycles per second of the second half of an area wave, from its upward crossings of a third of the peak."""
    late = area[len(area) // 2 :]
    level = late.max() / 3
    before, after = late[:-1], late[1:]
    at = np.flatnonzero((before < level) & (after >= level))
    exact = at + (level - before[at]) / (after[at] - before[at])
    return (len(exact) - 1) / ((exact[-1] - exact[0]) * sample_s)


def test_the_plain_loop_is_the_same_voice():
    request = Simulation(run=Run(duration_s=0.3))
    area = plain_run(prepare(request).fold, request.subglottal_pressure_pa, 0.3)[:, 0]
    product = simulate(request).arrays["glottal_area_m2"]
    assert rate(area[::5], 1 / 28000) == pytest.approx(rate(product, 1 / 28000), rel=1e-3)
    assert area.max() == pytest.approx(product.max(), rel=5e-3)


def test_the_plain_loop_is_the_slow_twin_of_the_tests():
    fold, twin = product_and_twin(**MODAL)
    plain = plain_run(fold, 1000.0, 0.01, PAPER_STEP_S)
    slow = twin.run(twin.initial_state(), 1000.0, PAPER_STEP_S, len(plain), "euler")
    for column, wave in enumerate((slow.A_g_min, slow.Q_g, slow.p_col_max)):
        assert plain[:, column] == pytest.approx(np.maximum(wave, 0.0), rel=1e-6, abs=1e-9 * np.abs(wave).max())


def test_counting_numbers_count_operations():
    Counted.tally.update(dict.fromkeys(Counted.tally, 0))
    a = np.array([2.0, 3.0, 5.0, 7.0]).view(Counted)
    value = 1.0 + a[0:2] * a[2:4] - np.where(a[0:2] > 2.5, a[0:2], 0.5) / 4
    a[0:2] = value
    assert a.tolist() == [10.875, 21.25, 5.0, 7.0]
    assert Counted.tally == {"arithmetic": 8, "comparisons": 2, "accesses": 10}


def test_a_step_costs_in_proportion_to_its_nodes():
    small, large = count_step(20, 10), count_step(20, 20)
    columns = Layout(20, 10).columns
    per_node = (large["arithmetic"] - small["arithmetic"]) / (10 * columns)
    assert 30 < per_node < 100  # about twenty terms in flow, contact and membrane, two or three operations each
    assert per_node * 10 * columns < small["arithmetic"] < 1.2 * per_node * 10 * columns


def test_rounds_are_interleaved_and_the_first_does_not_count():
    order = []
    seconds = turns({"a": lambda: order.append("a"), "b": lambda: order.append("b")}, 3, turn_s=0.0)
    assert order == ["a", "b"] * 4
    assert set(seconds) == {"a", "b"}
    assert all(len(took) == 3 and 0 <= min(took) and max(took) < 0.1 for took in seconds.values())


def test_the_median_of_the_rounds_counts():
    naps = iter((0.2, 0.001, 0.05, 0.01))  # the first does not count
    seconds = interleaved({"uneven": lambda: time.sleep(next(naps))}, 3, turn_s=0.0)
    assert 0.01 <= seconds["uneven"] < 0.05


def test_a_short_task_is_called_until_its_turn_is_over():
    calls = []
    seconds = interleaved({"short": lambda: calls.append(time.sleep(0.004))}, 1, turn_s=0.02)
    assert 2 * 2 <= len(calls) <= 2 * 5
    assert 0.004 <= seconds["short"] < 0.02


def run_on(processor, ratio):
    return {"processor": processor, "values": dict.fromkeys(history.WATCHED, ratio)}


def test_a_ratio_that_fell_by_more_than_fifteen_percent_is_named():
    runs = [run_on("x", ratio) for ratio in (19.0, 20.0, 30.0)]
    now = dict.fromkeys(history.WATCHED, 17.5)
    assert history.regressions(now, runs) == []
    now["batch_ratio"] = 16.5
    [sentence] = history.regressions(now, runs)
    assert "batch_ratio" in sentence and "18 % below 20" in sentence


def test_the_history_keeps_processors_apart(tmp_path):
    file = tmp_path / "new" / "history.jsonl"
    assert history.earlier(file, "x") == []
    for processor in ("x", "y", "x"):
        history.keep(file, processor, {"batch_ratio": 1.0})
    assert [run["processor"] for run in history.earlier(file, "x")] == ["x", "x"]


def test_a_check_that_finds_a_loss_exits_with_one(monkeypatch, capsys):
    monkeypatch.setattr(history, "earlier", lambda file, processor: [run_on(processor, 1e6)])
    assert main(["bench", "--quick", "--check", "--json"]) == 1
    assert "slower than before: reference_ratio" in capsys.readouterr().err


def test_the_table_is_json_too(capsys):
    assert main(["bench", "--quick", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    rows = {row["key"]: row for row in document["rows"]}
    assert {"posture_us", "static_ms", "kernel_s", "kernel_paper_step_s", "stored_s", "reference_ratio"} <= set(rows)
    assert rows["stored_s"]["target"] == 0.08 and rows["stored_s"]["value"] > rows["kernel_s"]["value"] > 0
    assert rows["kernel_paper_step_s"]["value"] > 4 * rows["kernel_s"]["value"]
    assert {"batch_ratio", "single_precision_ratio", "paper_minute_ratio"} <= set(rows)
    assert document["machine"]["cores"] >= 1


def test_an_answer_is_timed_from_request_to_last_byte():
    seconds = answers(rounds=1, points=2, voices=2)
    assert {name: len(took) for name, took in seconds.items()} == {"http": 2, "map": 1, "map_single": 1}
    assert all(0.001 < took < 60 for of_kind in seconds.values() for took in of_kind)


def test_an_incomplete_map_is_an_error(tmp_path):
    body = {"kind": "sweep", "axes": [{"parameter": "run.time_step_s", "values": [1e-5, 1e-3]}]}
    with (
        served(str(tmp_path), 1) as (client, _),
        pytest.raises(RuntimeError, match="2 of 2 points, 1 without an answer"),
    ):
        to_table(client, body, 0)


def test_the_table_shows_the_targets(capsys, monkeypatch):
    rows = [
        suite.Row("a", "kernel", 0.5, "s", target=1.0),
        suite.Row("b", "ratio", 30.0, "×", at_least=20.0),
        suite.Row("c", "free", 7.0, "MB"),
    ]
    monkeypatch.setattr("vocalis.cli.bench.run", lambda rounds, **named: rows)
    assert main(["bench", "--quick"]) == 0
    lines = capsys.readouterr().out.splitlines()
    endings = {line.split()[0]: line.rstrip() for line in lines if line.strip()}
    assert endings["kernel"].endswith("≤ 1") and endings["ratio"].endswith("≥ 20") and endings["free"].endswith("MB")


def test_rows_have_median_and_quickest_round(monkeypatch):
    took = dict.fromkeys(suite._tasks(Path("unused")), [3.0, 1.0, 2.0]) | {"reference": [80.0, 50.0, 60.0]}
    monkeypatch.setattr(suite, "turns", lambda tasks, rounds: took)
    rows = {row.key: row for row in suite.run(3, fresh_processes=False)}
    assert (rows["kernel_s"].value, rows["kernel_s"].quickest) == (2.0, 1.0)
    assert (rows["reference_ratio"].value, rows["reference_ratio"].quickest) == (30.0, 50.0)
