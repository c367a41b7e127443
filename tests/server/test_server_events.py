"""Server-sent events: order, resumption, one stream for all jobs."""

from itertools import islice

from tests.server.live_server import LONG, SHORT, events, finish, run, serving, wait_until

SECONDS = {"run": {"duration_s": 10}}


def test_a_jobs_stream_tells_progress_and_ends_with_done(client):
    job = run(client, SECONDS | {"fresh": True})
    seen = list(events(client, f"/jobs/{job['id']}/events"))
    assert [event.name for event in seen[-2:]] == ["progress", "done"]
    progress = [event.data["progress"] for event in seen]
    assert progress == sorted(progress) and any(0 < part < 1 for part in progress)
    assert seen[-1].data["status"] == "successful"
    assert len({event.id for event in seen}) == len(seen)


def test_a_stream_resumes_after_the_last_event_that_was_read(client):
    first, second = run(client, LONG), run(client, LONG | {"vowel": "i"})
    stream = events(client, "/events")
    next(stream)
    client.delete(f"/jobs/{first['id']}")
    read = next(event for event in stream if event.name == "done")
    stream.close()
    client.delete(f"/jobs/{second['id']}")
    missed = events(client, "/events", last_id=read.id)
    seen = []
    while not seen or seen[-1].name != "done":
        seen.append(next(missed))
    assert {event.data["id"] for event in seen} == {second["id"]}, "what was read is not sent again, the rest is"


def test_a_finished_stream_is_sent_once_and_not_again(client):
    job = finish(client, run(client, SHORT | {"fresh": True}))
    (done,) = events(client, f"/jobs/{job['id']}/events")
    assert done.name == "done" and done.data["status"] == "successful"
    again = client.get(f"/jobs/{job['id']}/events", headers={"Last-Event-ID": done.id})
    assert again.status_code == 204, "204 keeps a browser from reconnecting for ever"


def test_an_id_from_before_a_restart_gets_the_present_state(client):
    job = finish(client, run(client, SHORT | {"fresh": True}))
    (done,) = events(client, f"/jobs/{job['id']}/events", last_id="00000000-5")
    assert done.data["status"] == "successful"


def test_one_stream_serves_all_jobs_of_a_client_and_of_nobody_else(live, client):
    stream = events(client, "/events")
    long = run(client, LONG)
    assert next(stream).data["id"] == long["id"]
    with live.client(Authorization="Bearer a-third") as other:
        run(other, SHORT | {"fresh": True})
    short = run(client, SHORT | {"fresh": True})
    client.delete(f"/jobs/{long['id']}")
    seen = []
    for event in stream:
        seen.append(event)
        if {long["id"], short["id"]} <= {event.data["id"] for event in seen if event.name == "done"}:
            break
    assert {event.data["id"] for event in seen} == {long["id"], short["id"]}
    dismissed = next(event for event in seen if event.name == "done" and event.data["id"] == long["id"])
    assert dismissed.data["status"] == "dismissed"


def test_a_stream_that_begins_late_starts_with_what_is_going_on(client):
    job = run(client, LONG)
    (first,) = islice(events(client, "/events"), 1)
    assert first.data["id"] == job["id"] and first.name == "progress"
    client.delete(f"/jobs/{job['id']}")


def test_a_client_has_a_limited_number_of_streams_and_gets_places_back():
    with serving(streams_per_client=2) as server, server.client() as client:
        job = run(client, LONG)
        open_streams = [events(client, "/events"), events(client, f"/jobs/{job['id']}/events")]
        for stream in open_streams:
            next(stream)
        refused = client.get("/events")
        assert refused.status_code == 429
        assert "2 event streams" in refused.json()["detail"] and refused.headers["retry-after"]
        open_streams.pop().close()

        def has_a_place() -> bool:  # once the server has seen the other one end
            with client.stream("GET", "/events") as answer:
                return answer.status_code == 200

        wait_until(has_a_place)
        client.delete(f"/jobs/{job['id']}")
