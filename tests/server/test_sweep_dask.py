"""Sweeps on a real Dask cluster: the numbers of local workers, bit for bit, whatever happens to a worker."""

import pytest

from tests.server.dask_cluster import scheduler, workers
from tests.server.live_server import finish, run, serving, wait_until
from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vocalis.server.jobs.cluster import CONNECT_S

SWEEP = {
    "kind": "sweep",
    "base": {"run": {"duration_s": 0.2}},
    "axes": [
        {"parameter": "activation.ct", "values": [k / 19 for k in range(20)]},
        {"parameter": "activation.ta", "values": [k / 9 for k in range(10)]},
    ],
}
pytestmark = pytest.mark.timeout(300)


@pytest.fixture(scope="module")
def cluster():
    with scheduler() as address:
        yield address


def result(client, job: dict) -> dict:
    return client.get(f"/jobs/{job['id']}/result").json()


def test_a_sweep_on_a_cluster_that_loses_a_worker_is_the_local_one_bit_for_bit(cluster, tmp_path):
    run_sweep(sweep_from_dict(SWEEP | {"axes": SWEEP["axes"][:1]}), workers=1)  # all below load what this compiles
    with serving() as server, server.client() as client:
        local = result(client, finish(client, run(client, SWEEP), 120))
    with (
        workers(cluster, tmp_path, 2) as processes,
        serving(dask_scheduler_address=cluster) as server,
        server.client() as client,
    ):
        wait_until(lambda: client.get("/health").json()["engine"] == {"name": "dask", "workers": 4})
        job = run(client, SWEEP)
        wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["n_done"] >= 60, 60)
        processes[0].kill()
        assert client.get(f"/jobs/{job['id']}").json()["status"] == "running"
        done = finish(client, job, 120)
        assert (done["status"], done["n_done"], done["n_failed"]) == ("successful", 200, 0)
        assert result(client, done) == local
        assert not server.services.jobs.scheduler.worker_pids, "nothing was computed on this machine's own processes"


def test_a_worker_of_another_model_is_refused_in_words(cluster, tmp_path):
    other = "import vfcore.runs.sweep.task as task; task.MODEL_VERSION = 'other'"
    with (
        workers(cluster, tmp_path, 1, before=other),
        serving(dask_scheduler_address=cluster) as server,
        server.client() as client,
    ):
        job = finish(client, run(client, SWEEP), 60)
        assert job["status"] == "failed"
        assert job["problem"]["type"] == "urn:vocalis:problem:wrong-model"
        assert "model other" in job["problem"]["detail"] and "install the same version" in job["problem"]["detail"]
        assert job["n_done"] == 0


def test_a_sweep_waits_for_a_scheduler_that_is_not_there_and_can_be_dismissed():
    with serving(dask_scheduler_address="tcp://127.0.0.1:9", workers=1) as server, server.client() as client:
        job = run(client, SWEEP)
        wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["status"] == "running")
        assert client.get("/health").json()["ready"], "what is not a sweep goes on"
        client.delete(f"/jobs/{job['id']}")
        assert client.get(f"/jobs/{job['id']}").json()["status"] == "dismissed"
        # Two attempts to connect may be under way, one after the other.
        wait_until(lambda: not server.services.jobs.scheduler.busy, 3 * CONNECT_S)
