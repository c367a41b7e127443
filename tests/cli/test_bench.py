"""The benchmarks: the plain loop gives the same voice, operation counts are those of the source, tables are
complete.
"""

import json
import time
from pathlib import Path

import numpy as np
import pytest

from tests.support.fold_harness import MODAL, product_and_twin
from vfcore.fold.form import StepForm
from vfcore.fold.layout import layout_of
from vfcore.kernels.simd import paired
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import PAPER_STEP_S, Run, Simulation
from vocalis.bench import forms, history, machine, suite
from vocalis.bench.answers import answers
from vocalis.bench.count import Counted, count_step
from vocalis.bench.played import share_of_a_core
from vocalis.bench.reference import plain_run
from vocalis.bench.rounds import interleaved, turns
from vocalis.bench.sweeps import served, to_table
from vocalis.cli.main import main
from vocalis.server.live.player import Player


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
    glottis, twin = product_and_twin(**MODAL)
    plain = plain_run(glottis.walls[0], 1000.0, 0.01, PAPER_STEP_S)
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


def test_joined_numbers_stay_counted():
    Counted.tally.update(dict.fromkeys(Counted.tally, 0))
    a = np.array([2.0, 3.0, 5.0, 7.0]).view(Counted)
    joined = paired(a[0:2], a[2:4], 1)
    assert joined.tolist() == [5.0, 12.0] and isinstance(joined, Counted)
    assert Counted.tally == {"arithmetic": 2, "comparisons": 0, "accesses": 4}


def test_a_step_costs_in_proportion_to_its_nodes():
    small, large = count_step(20, 10), count_step(20, 20)
    columns = layout_of(StepForm(20, 10)).columns
    per_node = (large["arithmetic"] - small["arithmetic"]) / (10 * columns)
    assert 30 < per_node < 100  # about twenty terms in flow, contact and membrane, two or three operations each
    assert per_node * 10 * columns < small["arithmetic"] < 1.2 * per_node * 10 * columns


def test_every_form_of_the_step_is_counted():
    """Two walls: each its own membrane, one flow for both. Finite stretch: a pass over the rows. A batch: no idle
    columns, and a sparse beam."""
    alone = count_step(20, 10)["arithmetic"]
    finite, two, batch = (count_step(20, 10, name)["arithmetic"] for name in ("finite", "two", "many"))
    assert 1.05 * alone < finite < 1.15 * alone
    assert 1.5 * alone < two < 2 * alone
    assert 0.6 * alone < batch < 0.9 * alone


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


def test_waiting_is_not_cpu_time():
    seconds = turns({"nap": lambda: time.sleep(0.02)}, 2, turn_s=0.0, clock=time.thread_time)
    assert max(seconds["nap"]) < 0.01


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
    wanted = {"finite_ratio": 1.15, "two_ratio": 2.1, "finite_batch_ratio": 1.15, "two_single_ratio": 2.1}
    assert {key: rows[key]["target"] for key in wanted} == wanted
    assert all(1.0 < rows[key]["value"] < 2 * most for key, most in wanted.items())
    assert 0 < rows["live_share"]["value"] < 100 and rows["live_share"]["target"] == 12
    assert document["machine"]["cores"] >= 1


def test_an_answer_is_timed_from_request_to_last_byte():
    seconds = answers(rounds=1, points=2, voices=2)
    assert {name: len(took) for name, took in seconds.items()} == {
        "http": 2,
        "map": 1,
        "map_single": 1,
        "map_human": 1,
        "map_human_single": 1,
    }
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
    took = dict.fromkeys((*suite._tasks(Path("unused")), "peak", "l1"), [3.0, 1.0, 2.0])
    took["reference"] = [80.0, 50.0, 60.0]
    monkeypatch.setattr(suite, "turns", lambda tasks, rounds, **clock: took)
    steps = dict.fromkeys(forms.FORMS, [2e-7, 1e-7]) | {"finite": [4e-7, 3e-7, 5e-7]}
    monkeypatch.setattr(forms, "step_seconds", lambda rounds: steps)
    monkeypatch.setattr(suite, "share_of_a_core", lambda seconds: [0.1, 0.05, 0.2])
    rows = {row.key: row for row in suite.run(3, fresh_processes=False)}
    assert (rows["kernel_s"].value, rows["kernel_s"].quickest) == (2.0, 1.0)
    assert (rows["reference_ratio"].value, rows["reference_ratio"].quickest) == (30.0, 50.0)
    assert (rows["finite_ratio"].value, rows["finite_ratio"].quickest) == pytest.approx((4 / 1.5, 3.0))
    assert (rows["live_share"].value, rows["live_share"].quickest) == (10.0, 5.0)


def test_the_ratio_of_the_maps_is_human_over_paper():
    seconds = {"http": 0.04, "reference": 1.0, "map": 2.0, "map_single": 1.0, "map_human": 3.0, "map_human_single": 1.8}
    rows = {row.key: row for row in suite._answers(seconds)}
    assert (rows["map_human_ratio"].value, rows["map_human_single_ratio"].value) == (1.5, 1.8)
    assert rows["map_human_ratio"].target == rows["map_human_single_ratio"].target == 2.2


def test_every_form_has_its_distance_from_the_floor():
    """An operation at each multiply-add slot: 1000 operations at 10 Gflop/s take 100 ns, half of it in single
    precision."""
    counted = {form.options: {"arithmetic": 1000, "accesses": 100} for form in forms.FORMS.values()}
    peak_s, l1_s = machine.peak_task()[1] / 10e9, 1.0
    rows = suite._efficiency(dict.fromkeys(forms.FORMS, 3e-7) | {"peak": peak_s, "l1": l1_s}, counted)
    over = {row.key: row.value for row in rows if row.key.endswith("_over_floor")}
    assert over == pytest.approx(
        {f"{name}_over_floor": 6.0 if name.endswith("single") else 3.0 for name in forms.FORMS}
    )


def test_a_played_voice_takes_a_share_of_a_core_and_has_two_walls(monkeypatch):
    players = []
    monkeypatch.setattr("vocalis.bench.played.Player", lambda client: players.append(Player(client)) or players[-1])
    [share] = share_of_a_core(1)
    assert 0.005 < share < 1.0
    voice = players[0]._voice
    assert (voice.form.walls, voice.form.finite) == (2, True)
    assert 100 <= voice.blocks <= 200, "1.5 s"
