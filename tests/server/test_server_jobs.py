"""A job from submission to dismissal."""

import time

from tests.server.live_server import LONG, SHORT, finish, run, wait_until

KEYS = {
    "id", "kind", "status", "progress", "n_done", "n_total", "n_failed", "created", "started", "finished", "request",
    "problem", "links",
}  # fmt: skip
DIVERGES = {
    "subglottal_pressure_pa": 5000,
    "constants": {"K_coup_min_pa_m": 0, "K_coup_max_pa_m": 0},
    "run": {"duration_s": 0.1},
}


def test_a_job_is_accepted_runs_and_succeeds(client):
    answer = client.post("/jobs", json=SHORT | {"fresh": True})
    assert answer.status_code == 202
    job = answer.json()
    assert set(job) == KEYS
    assert answer.headers["location"] == f"/api/v1/jobs/{job['id']}" == job["links"]["self"]
    assert job["status"] in ("accepted", "running")
    done = finish(client, job)
    assert done["status"] == "successful"
    assert (done["progress"], done["n_done"], done["n_total"], done["n_failed"]) == (1.0, 1, 1, 0)
    assert done["created"] <= done["started"] <= done["finished"]
    assert done["request"]["run"]["duration_s"] == 0.1
    assert done["problem"] is None
    result = client.get(f"/jobs/{job['id']}/result").json()
    assert result["measures"] == client.post("/simulate", json=SHORT).json()["measures"]


def test_the_same_request_gets_the_same_job_at_once_unless_fresh(client):
    body = SHORT | {"vowel": "i"}
    first = finish(client, run(client, body))
    again = run(client, body)
    assert again["id"] == first["id"] and again["status"] == "successful"
    assert run(client, body | {"fresh": True})["id"] != first["id"]


def test_what_was_simulated_synchronously_is_a_finished_job_at_once(client):
    body = SHORT | {"vowel": "u"}
    client.post("/simulate", json=body)
    assert run(client, body)["status"] == "successful"


def test_an_idempotency_key_makes_one_job_however_often_it_is_sent(client):
    body = SHORT | {"fresh": True}
    first = run(client, body, **{"Idempotency-Key": "abc"})
    assert run(client, body, **{"Idempotency-Key": "abc"})["id"] == first["id"]
    assert run(client, body, **{"Idempotency-Key": "abd"})["id"] != first["id"]
    other = client.post("/jobs", json=SHORT | {"vowel": "o"}, headers={"Idempotency-Key": "abc"})
    assert other.status_code == 422 and other.json()["errors"][0]["path"] == "Idempotency-Key"


def test_a_list_is_newest_first_in_pages_and_filtered(client):
    made = [finish(client, run(client, SHORT | {"fresh": True}))["id"] for _ in range(3)]
    client.delete(f"/jobs/{made[0]}")
    page = client.get("/jobs?limit=2").json()
    assert [job["id"] for job in page["jobs"]] == [made[2], made[1]]
    rest = client.get(f"/jobs?limit=2&cursor={page['next_cursor']}").json()
    assert [job["id"] for job in rest["jobs"]] == [made[0]] and rest["next_cursor"] is None
    dismissed = client.get("/jobs?status=dismissed").json()["jobs"]
    assert [job["id"] for job in dismissed] == [made[0]]
    assert client.get("/jobs?kind=sweep").json()["jobs"] == []
    assert client.get("/jobs?cursor=x").status_code == 422


def test_clients_do_not_see_each_others_jobs(live, client):
    job = run(client, SHORT)
    with live.client(Authorization="Bearer somebody-else") as other:
        assert job["id"] not in [listed["id"] for listed in other.get("/jobs").json()["jobs"]]


def test_progress_is_real_and_dismissal_stops_the_work_within_a_second(live, client):
    job = run(client, LONG)
    wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["progress"] > 0)
    first = client.get(f"/jobs/{job['id']}").json()["progress"]
    wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["progress"] > first)
    asked = time.monotonic()
    answer = client.delete(f"/jobs/{job['id']}")
    assert answer.status_code == 200 and answer.json()["status"] == "dismissed"
    wait_until(lambda: not live.services.jobs.scheduler.busy, seconds=1.0)
    assert time.monotonic() - asked < 1.0
    again = client.delete(f"/jobs/{job['id']}")
    assert again.status_code == 200 and again.json() == answer.json()


def test_shared_work_goes_on_until_the_last_handle_is_dismissed(live, client):
    scheduler = live.services.jobs.scheduler
    with live.client(Authorization="Bearer second") as second:
        mine, theirs = run(client, LONG), run(second, LONG)
        assert mine["id"] != theirs["id"]
        wait_until(lambda: second.get(f"/jobs/{theirs['id']}").json()["status"] == "running")
        assert len(scheduler.busy) == 1 and scheduler.waiting == 0, "two handles, one computation"
        client.delete(f"/jobs/{mine['id']}")
        reached = second.get(f"/jobs/{theirs['id']}").json()["progress"]
        wait_until(lambda: second.get(f"/jobs/{theirs['id']}").json()["progress"] > reached)
        second.delete(f"/jobs/{theirs['id']}")
        wait_until(lambda: not scheduler.busy, seconds=1.0)


def test_a_job_that_waits_leaves_the_queue_when_dismissed(live, client):
    running, waiting = run(client, LONG), run(client, LONG | {"vowel": "i"})
    assert waiting["status"] == "accepted"
    client.delete(f"/jobs/{waiting['id']}")
    assert live.services.jobs.scheduler.waiting == 0
    client.delete(f"/jobs/{running['id']}")


def test_there_is_no_result_before_the_end(client):
    job = run(client, LONG)
    for part in ("result", "arrays/time_s", "audio.wav", "result.nc", "result.csv"):
        answer = client.get(f"/jobs/{job['id']}/{part}")
        assert answer.status_code == 409, part
        assert answer.headers["content-type"] == "application/problem+json"
        assert "accepted" in answer.json()["detail"] or "running" in answer.json()["detail"]
    client.delete(f"/jobs/{job['id']}")
    assert "dismissed" in client.get(f"/jobs/{job['id']}/result").json()["detail"]


def test_a_run_that_diverges_is_a_failed_job_that_says_where_and_what_to_try(client):
    job = finish(client, run(client, DIVERGES))
    assert job["status"] == "failed" and job["n_failed"] == 1
    assert job["problem"]["title"] == "The run diverged"
    assert "ms" in job["problem"]["detail"] and "Try" in job["problem"]["detail"]
    assert client.get(f"/jobs/{job['id']}/result").status_code == 409
    assert run(client, DIVERGES)["id"] != job["id"], "a failed job is no answer to the next request"
