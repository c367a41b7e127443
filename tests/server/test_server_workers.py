"""A worker process that dies is replaced; its job is tried again once."""

import os
import signal
from multiprocessing import active_children
from pathlib import Path

import pytest

from tests.server.live_server import LONG, SHORT, finish, run, serving, wait_until
from vocalis.server.jobs.scheduler import Scheduler

MEDIUM = {"run": {"duration_s": 2, "time_step_s": 1.7857142857142857e-6}}  # some seconds of work where cores are shared


@pytest.fixture(scope="module")
def own():
    with serving(workers=1) as server, server.client() as client:
        yield server, client


def kill_worker(server, client, job) -> None:
    """kill -9 the one worker once the job has progressed in it."""
    scheduler = server.services.jobs.scheduler
    wait_until(lambda: scheduler.worker_pids and client.get(f"/jobs/{job['id']}").json()["progress"] > 0)
    (pid,) = scheduler.worker_pids
    os.kill(pid, signal.SIGKILL)
    wait_until(lambda: pid not in scheduler.worker_pids)


def test_no_worker_is_started_before_there_is_a_job_unless_asked_for(own):
    server, _ = own
    assert server.services.jobs.scheduler.worker_pids == ()


def test_a_warm_worker_waits_with_its_kernels_loaded_and_takes_the_first_job():
    with serving(workers=1, warm_workers=1) as server, server.client() as client:
        scheduler = server.services.jobs.scheduler
        wait_until(lambda: len(scheduler.worker_pids) == 1, seconds=60)
        (pid,) = scheduler.worker_pids
        wait_until(lambda: "pocketfft" in Path(f"/proc/{pid}/maps").read_text())  # voices have been measured in it
        assert finish(client, run(client, SHORT))["status"] == "successful"
        assert scheduler.worker_pids == (pid,)


def test_a_server_that_closes_while_its_workers_warm_up_leaves_none_behind():
    before, scheduler = active_children(), Scheduler(2, listener=None, warm=2)
    scheduler.warm_up()
    scheduler.close()
    wait_until(lambda: not set(active_children()) - set(before))
    assert scheduler.worker_pids == ()


def test_a_job_survives_the_death_of_its_worker(own):
    server, client = own
    job = run(client, MEDIUM)
    kill_worker(server, client, job)
    assert finish(client, job, seconds=60)["status"] == "successful"
    assert client.get(f"/jobs/{job['id']}/result").json()["phonation_state"] == "periodic"


def test_a_job_whose_worker_dies_twice_fails_with_the_exit_code_and_the_next_one_runs(own):
    server, client = own
    job = run(client, LONG)
    kill_worker(server, client, job)
    kill_worker(server, client, job)
    failed = finish(client, job)
    assert failed["status"] == "failed"
    assert "-9" in failed["problem"]["detail"]
    assert finish(client, run(client, SHORT))["status"] == "successful"


def test_workers_give_way_to_what_a_person_waits_for(own):
    server, client = own
    job = run(client, LONG)
    wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["status"] == "running")
    (pid,) = server.services.jobs.scheduler.worker_pids
    wait_until(lambda: os.getpriority(os.PRIO_PROCESS, pid) > os.getpriority(os.PRIO_PROCESS, 0))
    client.delete(f"/jobs/{job['id']}")


def test_no_worker_outlives_the_server():
    with serving(workers=1) as server, server.client() as client:
        job = run(client, LONG)
        wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["progress"] > 0)
        (pid,) = server.services.jobs.scheduler.worker_pids
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
