"""What a restart, a second server, a full disk and old age do to jobs and results."""

import json
import os
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import replace

import httpx
import numpy as np
import pytest

import vfcore
from tests.server.jobs_harness import JobSystem
from tests.server.live_server import LONG, SHORT, events, finish, run, serving, wait_until
from tests.server.test_server_process import address, started
from tests.server.test_server_refusals import problem
from tests.server.test_sweep_jobs import LONG_SWEEP, MAP
from vfcore.errors import ParameterError
from vfcore.io.result_document import result_document
from vfcore.io.stored import DamagedFile, load_result, save_result
from vfcore.runs.sweep import sweep_from_dict, sweep_to_dict
from vfcore.runs.sweep.row import columns, failed_row
from vfcore.spec.request import document_of, resolve
from vocalis.server.exceptions import ResultGone
from vocalis.server.jobs.model import Status
from vocalis.server.jobs.retention import Limits


def test_a_result_is_the_same_after_a_restart_in_every_form(tmp_path):
    forms = ("result", "result.nc", "result.csv", "audio.wav", "arrays/cycle_w_m")
    with serving(jobs_directory=tmp_path) as server, server.client() as client:
        job = finish(client, run(client, SHORT, **{"Idempotency-Key": "k"}))
        sweep = finish(client, run(client, MAP))
        before = [client.get(f"/jobs/{job['id']}/{form}").content for form in forms]
        table = client.get(f"/jobs/{sweep['id']}/result").json()
    with serving(jobs_directory=tmp_path) as server, server.client() as client:
        assert client.get(f"/jobs/{job['id']}").json() == job
        assert [client.get(f"/jobs/{job['id']}/{form}").content for form in forms] == before
        assert client.get(f"/jobs/{sweep['id']}/result").json() == table
        assert run(client, SHORT)["id"] == job["id"] and run(client, MAP)["id"] == sweep["id"]
        assert run(client, SHORT, **{"Idempotency-Key": "k"})["id"] == job["id"]
        assert client.post("/jobs", json=LONG, headers={"Idempotency-Key": "k"}).status_code == 422


def test_unfinished_jobs_go_on_after_a_restart_and_streams_resume(tmp_path):
    with serving(jobs_directory=tmp_path, workers=1) as server, server.client() as client:
        sweep = run(client, LONG_SWEEP)
        wait_until(lambda: client.get(f"/jobs/{sweep['id']}").json()["n_done"] > 0, 60)
        waiting = run(client, SHORT | {"vowel": "U"})
        last = next(iter(events(client, f"/jobs/{sweep['id']}/events"))).id
    with serving(jobs_directory=tmp_path, workers=1) as server, server.client() as client:
        stored = client.get(f"/jobs/{sweep['id']}").json()["n_done"]
        assert stored > 0
        assert finish(client, waiting)["status"] == "successful"
        first = next(iter(events(client, f"/jobs/{sweep['id']}/events", last_id=last)))
        assert first.name == "progress" and first.data["n_done"] >= stored, "the present state, not a gap"
        wait_until(lambda: client.get(f"/jobs/{sweep['id']}").json()["n_done"] > stored, 60)
        client.delete(f"/jobs/{sweep['id']}")
        assert server.services.storage.points.recomputed() == 0


def test_a_second_server_on_the_same_folder_keeps_jobs_of_its_own_and_says_so(tmp_path, monkeypatch):
    monkeypatch.setenv("VOCALIS_JOBS_DIRECTORY", str(tmp_path / "jobs"))
    with started() as (_, first), started() as (_, second):
        wait_until(lambda: len(second) == 2)
        assert str(tmp_path / "jobs-2") in second[1] and len(first) == 1
        with httpx.Client(base_url=f"{address(first)}/api/v1", timeout=60) as one:
            job = run(one, LONG)
            with httpx.Client(base_url=f"{address(second)}/api/v1", timeout=60) as other:
                assert other.get(f"/jobs/{job['id']}").status_code == 404
                assert other.get("/jobs").json()["jobs"] == []


def test_a_folder_that_cannot_be_used_is_one_clear_line(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "jobs").mkdir()
    (tmp_path / "jobs" / "jobs.sqlite").write_text("something else, and long enough for a header" * 100)
    for folder in (tmp_path / "file" / "jobs", tmp_path / "jobs"):
        command = [sys.executable, "-m", "vocalis.server", "--port", "0"]
        environment = os.environ | {"VOCALIS_JOBS_DIRECTORY": str(folder)}
        ended = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment)
        assert ended.returncode != 0
        assert ended.stderr.startswith("vocalis: the folder of jobs cannot be used"), ended.stderr
        assert ended.stderr.count("\n") == 1


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 4 MB."""
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "vocalis", tmp_path], capture_output=True).returncode:
        pytest.skip("mounting a small file system takes root")
    yield tmp_path
    subprocess.run(["umount", "--lazy", tmp_path], check=True)


def fill(path) -> None:
    """A file that takes all the room there is."""
    with open(path, "wb", buffering=0) as file, suppress(OSError):
        while True:
            file.write(bytes(4096))


def test_a_full_disk_is_a_clear_problem_and_damages_nothing(small_disk):
    with serving(jobs_directory=small_disk / "jobs") as server, server.client() as client:
        kept = finish(client, run(client, SHORT))
        before = client.get(f"/jobs/{kept['id']}/result").json()
        filler = small_disk / "filler"
        fill(filler)
        refused = None
        for vowel in "iIeEVOoUu":  # the first ones may still find room in a page that is there
            answer = client.post("/jobs", json=SHORT | {"vowel": vowel})
            if answer.status_code == 507:
                refused = answer
                break
            failed = finish(client, answer.json())
            assert failed["status"] == "failed" and failed["problem"]["type"] == "urn:vocalis:problem:storage-full"
        assert refused is not None
        assert "no room left" in problem(refused, 507)["detail"]
        assert client.get(f"/jobs/{kept['id']}/result").json() == before
        assert client.post("/simulate", json=SHORT | {"vowel": "i"}).status_code == 200, "what needs no disk goes on"
        filler.unlink()
        again = finish(client, run(client, SHORT | {"vowel": "i"}))
        assert again["status"] == "successful"
        sweep = finish(client, run(client, MAP))
        assert sweep["status"] == "successful"
    with serving(jobs_directory=small_disk / "jobs") as server, server.client() as client:
        assert client.get(f"/jobs/{kept['id']}/result").json() == before


def test_a_sweep_that_fills_the_disk_fails_and_goes_on_when_there_is_room(small_disk):
    with serving(jobs_directory=small_disk / "jobs") as server, server.client() as client:
        filler = small_disk / "filler"
        job = run(client, LONG_SWEEP)
        wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["n_done"] > 0, 60)
        fill(filler)
        failed = finish(client, job, 60)
        assert failed["status"] == "failed" and "no room left" in failed["problem"]["detail"]
        filler.unlink()
        again = run(client, LONG_SWEEP)
        wait_until(lambda: client.get(f"/jobs/{again['id']}").json()["n_done"] > failed["n_done"], 30)
        client.delete(f"/jobs/{again['id']}")
        assert server.services.storage.points.recomputed() == 0


def simulation(**changes) -> dict:
    return document_of(resolve({"run": {"duration_s": 0.02}} | changes))


def test_old_jobs_and_large_results_go_and_work_under_way_stays(tmp_path):
    result = vfcore.simulate(resolve(simulation()))
    size = save_result(result, tmp_path / "probe.npz")
    system = JobSystem(tmp_path / "jobs", limits=Limits(jobs=2, days=90, result_bytes=2 * size, points=1000))
    ended = []
    for vowel in "aiueo":
        job = system.jobs.submit("A", simulation(vowel=vowel))
        system.finish(job, replace(result, request=resolve(job.request)))
        ended.append(job)
        time.sleep(0.01)
    active = system.jobs.submit("A", simulation(vowel="a"), fresh=True)
    system.storage.retention.tidy()
    assert {job.id for job in system.jobs.jobs("A", None, None, 100, None)[0]} == {ended[3].id, ended[4].id, active.id}
    assert system.storage.results.total_bytes() <= 2 * size + size, "the result of a job under way is kept"
    assert system.storage.results.is_stored(ended[4].content) and not system.storage.results.is_stored(ended[1].content)
    system.storage.retention._limits = Limits(jobs=100, days=1e-9, result_bytes=2**30, points=1000)
    system.storage.retention.tidy()
    assert [job.id for job in system.jobs.jobs("A", None, None, 100, None)[0]] == [active.id]
    system.close()


def test_a_result_file_reads_back_bit_for_bit_and_damage_is_noticed(tmp_path):
    result = vfcore.simulate(resolve({"run": {"duration_s": 0.2}, "posture": {"strain": 0.1}}))
    path = tmp_path / "result.npz"
    assert save_result(result, path) == path.stat().st_size
    again = load_result(path)
    assert json.dumps(result_document(again)) == json.dumps(result_document(result))
    assert again.request == result.request and again.report == result.report
    for name, array in result.arrays.items():
        np.testing.assert_array_equal(again.arrays[name], array)
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 255
    path.write_bytes(content)
    with pytest.raises(DamagedFile):
        load_result(path)


def test_a_damaged_result_is_made_again_rather_than_given(tmp_path):
    result = vfcore.simulate(resolve(simulation()))
    system = JobSystem(tmp_path / "jobs")
    job = system.jobs.submit("A", simulation())
    system.finish(job, result)
    system.close()
    path = tmp_path / "jobs" / "results" / f"{job.content}.npz"
    path.write_bytes(path.read_bytes()[:-1000])
    system = JobSystem(tmp_path / "jobs")
    again = system.jobs.submit("B", simulation())
    assert again.status is Status.ACCEPTED and again.work_id in system.scheduler.work
    system.close()


def test_what_a_server_only_began_to_write_is_cleared_away(tmp_path):
    system = JobSystem(tmp_path / "jobs")
    system.close()
    draft = tmp_path / "jobs" / "results" / ".x.npz.abc"
    draft.mkdir()
    (draft / "x.npz").write_bytes(b"half")
    JobSystem(tmp_path / "jobs").close()
    assert not draft.exists()


def test_nothing_that_an_earlier_version_stored_is_served_or_gone_on_with(tmp_path, monkeypatch):
    """Rows and results of a version with other addresses: a finished job says so, an unfinished one begins again."""
    import vfcore.spec.address as content

    sweep = sweep_to_dict(
        sweep_from_dict({"points": [{}, {"activation.ct": 0.5}], "base": {"run": {"duration_s": 0.02}}})
    )
    monkeypatch.setattr(content, "ADDRESS_VERSION", "1")
    content._digest.cache_clear()
    system = JobSystem(tmp_path / "jobs")
    result = vfcore.simulate(resolve(simulation()))
    done = system.jobs.submit("A", simulation(), key="mine")
    system.finish(done, result)
    tables = [system.jobs.submit(client, sweep) for client in "AB"]
    work = system.scheduler.work[tables[0].work_id]
    task = work.next_task()
    work.computed(task, [failed_row("of an old version", len(columns(work.sweep))) for _ in task.positions])
    assert system.jobs.job(tables[0].id).n_done == 2
    system.close()
    monkeypatch.undo()
    content._digest.cache_clear()

    system = JobSystem(tmp_path / "jobs")
    with pytest.raises(ResultGone, match="earlier version"):
        system.result(system.jobs.job(done.id))
    assert system.storage.results.get(done.content) is None, "nor by its old address"
    again = [system.jobs.job(job.id) for job in tables]
    assert {job.work_id for job in again} != {job.work_id for job in tables}
    assert [job.n_done for job in again] == [0, 0] and len(system.scheduler.work) == 1
    fresh = next(iter(system.scheduler.work.values()))
    assert fresh.next_task().positions == [0, 1]
    with pytest.raises(ParameterError, match="another request"):
        system.jobs.submit("A", simulation(vowel="i"), key="mine")
    made_again = system.jobs.submit("A", simulation(), key="mine")
    assert made_again.id != done.id and made_again.status is Status.ACCEPTED
    assert system.jobs.submit("A", simulation(), key="mine").id == made_again.id
    system.close()
