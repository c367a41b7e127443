"""Sweeps as jobs: submitted, watched, shared, stopped, refused, and their answers."""

import os
import signal
import time

import numpy as np
import pytest
import xarray

import vfcore
from tests.server.live_server import SHORT, events, finish, run, serving, wait_until
from tests.server.test_server_refusals import problem
from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vfcore.spec.address import address

MAP = {
    "kind": "sweep",
    "base": {"run": {"duration_s": 0.2}},
    "axes": [
        {"parameter": "activation.ct", "values": [k / 10 for k in range(11)]},
        {"parameter": ["activation.lca", "activation.ia"], "values": [0.5, 0.7, 0.9]},
    ],
}
#: A minute of work on two cores.
LONG_SWEEP = {
    "kind": "sweep",
    "base": {"run": {"duration_s": 2}},
    "axes": [{"parameter": "activation.ct", "values": [k / 999 for k in range(1000)]}],
}


@pytest.fixture(scope="module")
def two():
    with serving(workers=2) as server:
        yield server


@pytest.fixture
def own(two, request):
    with two.client(Authorization=f"Bearer {request.node.name}") as client:
        yield client


def result(client, job, query="") -> dict:
    return client.get(f"/jobs/{job['id']}/result{query}").json()


def test_a_sweep_gives_the_tables_of_a_sweep_without_a_server(own):
    job = run(own, MAP)
    assert (job["kind"], job["n_total"]) == ("sweep", 33)
    done = finish(own, job)
    assert (done["status"], done["n_done"], done["n_failed"], done["progress"]) == ("successful", 33, 0, 1.0)
    found, wanted = result(own, job), run_sweep(sweep_from_dict(MAP), workers=1).document()
    for part in ("axes", "shape", "phonation_state", "problems"):
        assert found[part] == wanted[part]
    for key, measure in wanted["measures"].items():
        # Code that was just compiled and code from the cache round differently.
        given, expected = (np.array(one["values"], float) for one in (found["measures"][key], measure))
        np.testing.assert_allclose(given, expected, rtol=1e-6, atol=0, err_msg=key)
        assert found["measures"][key]["reasons"] == measure["reasons"]
    assert done["request"]["axes"] == sweep_axes(MAP)
    selected = result(own, job, "?measures=fo_hz,spl_lips_db")
    assert list(selected["measures"]) == ["fo_hz", "spl_lips_db"]
    assert problem(own.get(f"/jobs/{job['id']}/result?measures=f0"), 422)["errors"][0]["path"] == "measures"


def sweep_axes(body: dict) -> list[dict]:
    return [axis | {"values": [float(value) for value in axis["values"]]} for axis in body["axes"]]


def test_all_points_are_sent_as_they_are_computed(own):
    job = run(own, MAP | {"fresh": True})
    positions, states, frequencies = [], {}, {}
    for event in events(own, f"/jobs/{job['id']}/events"):
        if event.name == "point":
            positions += event.data["index"]
            states |= zip(event.data["index"], event.data["phonation_state"], strict=True)
            frequencies |= zip(event.data["index"], event.data["measures"]["fo_hz"], strict=True)
    assert event.name == "done" and sorted(positions) == list(range(33))
    whole = result(own, job)
    assert [states[k] for k in range(33)] == whole["phonation_state"]
    assert [frequencies[k] for k in range(33)] == whole["measures"]["fo_hz"]["values"]


def test_overlapping_sweeps_share_points(two, own):
    finish(own, run(own, MAP))
    larger = MAP | {"axes": [MAP["axes"][0], MAP["axes"][1] | {"values": [0.5, 0.6, 0.7, 0.9]}]}
    began = {job.id for job in two.services.storage.jobs.active()}
    done = finish(own, run(own, larger))
    assert done["n_done"] == 44 and not began
    assert two.services.storage.points.recomputed() <= 33, "only those of fresh jobs"
    point = {"activation": {"ct": 0.3, "lca": 0.5, "ia": 0.5}}
    shared = finish(own, run(own, {"kind": "sweep", "base": MAP["base"], "points": [point]}))
    values = result(own, shared)["measures"]["fo_hz"]["values"]
    assert values == result(own, done)["measures"]["fo_hz"]["values"][3 * 4 : 3 * 4 + 1]


def test_another_client_gets_a_finished_sweep_at_once(two, own):
    finish(own, run(own, MAP))
    with two.client(Authorization="Bearer somebody else") as other:
        job = run(other, MAP)
        assert job["status"] == "successful" and result(other, job)["n_done"] == 33


def test_partial_results_are_visible_and_a_stop_takes_effect_within_a_second(two, own):
    job = run(own, LONG_SWEEP)
    wait_until(lambda: own.get(f"/jobs/{job['id']}").json()["n_done"] > 0)
    problem(own.get(f"/jobs/{job['id']}/result"), 409)
    partial = result(own, job, "?partial=true&measures=fo_hz")
    assert 0 < partial["n_done"] < 1000 and len(partial["pending"]) == 1000 - partial["n_done"]
    asked = time.monotonic()
    own.delete(f"/jobs/{job['id']}")
    wait_until(lambda: not two.services.jobs.scheduler.busy, 1.0)
    assert time.monotonic() - asked < 1.0
    again = run(own, LONG_SWEEP)
    wait_until(lambda: own.get(f"/jobs/{again['id']}").json()["n_done"] >= partial["n_done"], 5)
    own.delete(f"/jobs/{again['id']}")
    assert two.services.storage.points.recomputed() <= 33, "what was computed before the stop is not computed again"


def test_single_runs_overtake_a_sweep(own):
    sweep = run(own, LONG_SWEEP)
    wait_until(lambda: own.get(f"/jobs/{sweep['id']}").json()["n_done"] > 0)
    single = finish(own, run(own, SHORT | {"fresh": True}))
    assert single["status"] == "successful"
    assert own.get(f"/jobs/{sweep['id']}").json()["status"] == "running"
    own.delete(f"/jobs/{sweep['id']}")


def test_failed_points_carry_their_reason_and_the_sweep_succeeds(own):
    steps = {"parameter": "run.time_step_s", "values": [2e-5, 1e-3]}
    done = finish(own, run(own, {"kind": "sweep", "base": {"run": {"duration_s": 0.1}}, "axes": [steps]}))
    assert (done["status"], done["n_done"], done["n_failed"]) == ("successful", 2, 1)
    (failed,) = result(own, done)["problems"]
    assert failed["index"] == 1 and "run.time_step_s" in failed["detail"]


def test_a_sweep_survives_the_death_of_a_worker(own, two):
    job = run(own, MAP | {"base": {"run": {"duration_s": 1}}, "fresh": True})
    wait_until(lambda: own.get(f"/jobs/{job['id']}").json()["n_done"] > 0)
    os.kill(two.services.jobs.scheduler.worker_pids[0], signal.SIGKILL)
    done = finish(own, job, 60)
    assert (done["status"], done["n_done"], done["n_failed"]) == ("successful", 33, 0)


def test_files_of_a_sweep(own, tmp_path):
    job = finish(own, run(own, MAP))
    (tmp_path / "sweep.nc").write_bytes(own.get(job["links"]["netcdf"].removeprefix("/api/v1")).content)
    with xarray.open_dataset(tmp_path / "sweep.nc") as opened:
        assert opened.fo_hz.dims == ("activation_ct", "activation_lca")
        expected = result(own, job)["measures"]["fo_hz"]["values"]
        np.testing.assert_array_equal(opened.fo_hz.values.ravel(), np.array(expected, dtype=float))
    lines = own.get(job["links"]["csv"].removeprefix("/api/v1")).text.splitlines()
    assert len(lines) == 34 and lines[0].startswith("activation.ct [1],activation.lca [1],activation.ia [1],phonation")
    assert "audio" not in job["links"]
    for part in ("arrays/time_s", "audio.wav"):
        problem(own.get(f"/jobs/{job['id']}/{part}"), 404)


def test_waveforms_of_points_are_kept_where_asked(own):
    ct = {"parameter": "activation.ct", "values": [0.15, 0.45]}
    body = {"kind": "sweep", "base": SHORT, "axes": [ct], "keep_waveforms": True}
    finish(own, run(own, body))
    single = run(own, SHORT | {"activation": {"ct": 0.45}})
    assert single["status"] == "successful", "the run of a point is there at once"
    flow = np.frombuffer(own.get(f"/jobs/{single['id']}/arrays/glottal_flow_m3_s").content, "<f4")
    alone = vfcore.simulate(vfcore.Simulation(activation=vfcore.Activation(ct=0.45), run=vfcore.Run(duration_s=0.1)))
    np.testing.assert_array_equal(flow, alone.arrays["glottal_flow_m3_s"].astype("<f4"))


def test_waveforms_are_kept_also_of_points_whose_numbers_are_stored(two, own):
    ct = {"parameter": "activation.ct", "values": [0.16, 0.46]}
    too_long = {"parameter": "run.pressure_rise_s", "values": [0.01, 0.2]}
    plain = {"kind": "sweep", "base": SHORT, "axes": [ct, too_long]}
    finish(own, run(own, plain))
    addresses = [
        address(vfcore.resolve({"activation.ct": value, "run": SHORT["run"] | {"pressure_rise_s": 0.01}}))
        for value in ct["values"]
    ]
    archive = two.services.storage.results
    for gone in ([], addresses[:1], addresses):
        archive.drop(gone)
        job = finish(own, run(own, plain | {"keep_waveforms": True}))
        assert (job["status"], job["n_done"], job["n_failed"]) == ("successful", 4, 2)
        assert all(archive.is_stored(address) for address in addresses)
    again = finish(own, run(own, plain | {"keep_waveforms": True}))
    assert again["id"] == job["id"], "nothing is missing, so nothing is computed"


@pytest.mark.parametrize(
    "change, path, allowed",
    [
        ({"axes": [{"parameter": "activation.ct", "values": [0, 0.1, 0.2, 7]}]}, "axes.0.values.3", "0 to 1"),
        ({"axes": [{"parameter": "activation.ctt", "values": [0]}]}, "axes.0.parameter", "activation.ct"),
        ({"axes": [{"parameter": ["activation.ct", 3], "values": [0]}]}, "axes.0.parameter.1", ""),
        ({"axes": [{"parameter": "activation.ct", "values": ["a"]}]}, "axes.0.values.0", "number"),
        ({"base": {"activation": {"ta": 7}}}, "base.activation.ta", "0 to 1"),
        ({"base": {"volume": 7}}, "base.volume", "vowel"),
        ({"base": {"kind": "sweep"}}, "base.kind", "simulation"),
        ({"axes": None}, "axes", "axes or points"),
        ({"points": [{}]}, "axes", "axes or points"),
        ({"axes": None, "points": [{"activation.ct": 9}]}, "points.0.activation.ct", "0 to 1"),
        ({"measures": ["f0"]}, "measures.0", "fo_hz"),
        ({"colour": 1}, "colour", ""),
        ({"axes": [{"parameter": "activation.ct", "values": [k / 1e6 for k in range(600)]},
                   {"parameter": "activation.ta", "values": [k / 1e6 for k in range(600)]}]},
         "axes", "VOCALIS_SWEEP_POINTS"),
        ({"base": {"run": {"nx": 200, "ny": 100, "duration_s": 60, "time_step_s": 1e-7}}},
         "axes", "VOCALIS_SWEEP_NODE_STEPS"),
    ],
)  # fmt: skip
def test_a_bad_field_of_a_sweep_is_named(own, change, path, allowed):
    errors = problem(own.post("/jobs", json=MAP | change), 422)["errors"]
    assert path in [error["path"] for error in errors], errors
    (found,) = [error for error in errors if error["path"] == path]
    assert allowed in found["allowed"]


def test_long_lists_are_complete_only_in_the_job_itself(own):
    body = {"kind": "sweep", "base": MAP["base"], "points": [{"activation.ct": k / 200} for k in range(150)]}
    job = run(own, body)
    assert len(job["request"]["points"]) == 150
    assert own.get("/jobs?limit=1").json()["jobs"][0]["request"]["points"] is None
    finish(own, job)
