"""Every refusal is a problem document that says what is wrong and what would be accepted."""

import pytest

from tests.server.live_server import LONG, SHORT, finish, run, serving, wait_until
from vfcore.errors import PostureError
from vfcore.runs.many import static_shapes

JSON = {"Content-Type": "application/json"}


def problem(answer, status: int) -> dict:
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    body = answer.json()
    assert body["status"] == status and body["type"] and body["title"] and body["detail"]
    return body


@pytest.mark.parametrize("path", ["/posture", "/simulate", "/jobs"])
@pytest.mark.parametrize(
    "body, field, allowed",
    [
        ({"activation": {"ta": 1.5}}, "activation.ta", "0 to 1"),
        ({"activation": {"ta": "0.5"}}, "activation.ta", "0 to 1"),
        ({"activation": {"ta": True}}, "activation.ta", "0 to 1"),
        ({"activation": {"tta": 0.5}}, "activation.tta", "ca"),
        ({"volume": 11}, "volume", "subglottal_pressure_pa"),
        ({"constants": {"K_colour": 1}}, "constants.K_colour", "GET /api/v1/parameters"),
        ({"constants": {"K_col_pa_m": 1}}, "constants.K_col_pa_m", "10000 to 1e+09 Pa/m"),
        ({"constants": {"LCA_epsilon_2": -1}}, "constants.LCA_epsilon_2", "to 1"),
        ({"vowel": "x"}, "vowel", "i | I"),
        ({"kind": "song"}, "kind", "simulation"),
        ({"right": {"activation": {"ta": 2}}}, "right.activation.ta", "0 to 1"),
        ({"left": {"constants": {"TA_epsilon_2": -1}}}, "left.constants.TA_epsilon_2", "to 1"),
        ({"left": {"constants": {"rho_a_kg_m3": 1}}}, "left.constants.rho_a_kg_m3", "constants.rho_a_kg_m3, for both"),
        ({"left": {"nerves": 1}}, "left.nerves", "activation, constants"),
        ({"left": {"activation": None}}, "left.activation", "an object with ct, ia"),
        ({"lesions": [{}, {"x": 2}]}, "lesions.1.x", "0 to 1"),
        ({"lesions": [{"kind": "wart"}]}, "lesions.0.kind", "nodule | polyp"),
        ({"lesions": [{"colour": 1}]}, "lesions.0.colour", "height_mm, kind"),
        ({"lesions": [3]}, "lesions.0", "an object with height_mm"),
        ({"lesions": None}, "lesions", "a list of up to 8 objects"),
        ({"lesions": [{}] * 9}, "lesions", "a list of up to 8 objects"),
    ],
)
def test_a_bad_field_is_named_with_what_it_takes(client, path, body, field, allowed):
    errors = problem(client.post(path, json=body), 422)["errors"]
    (found,) = [error for error in errors if error["path"] == field]
    assert found["message"] and allowed in found["allowed"]


@pytest.mark.parametrize("path", ["/posture", "/simulate"])
def test_a_sweep_is_a_job_and_nothing_else(client, path):
    errors = problem(client.post(path, json={"kind": "sweep", "base": {}}), 422)["errors"]
    assert errors == [
        {
            "path": "kind",
            "message": "must be one simulation here; POST /jobs takes other kinds",
            "allowed": "simulation",
        }
    ]


def test_what_both_sides_share_is_refused_on_one_with_the_reason(client):
    body = {"left": {"constants": {"rho_a_kg_m3": 1}}}
    for path, sent, field in (
        ("/posture", body, "left.constants.rho_a_kg_m3"),
        ("/jobs", {"kind": "sweep", "base": body, "points": [{}]}, "base.left.constants.rho_a_kg_m3"),
    ):
        (found,) = problem(client.post(path, json=sent), 422)["errors"]
        assert found["path"] == field
        assert found["message"] == "is common to both sides: one stream of air passes between the folds"


SWEEP = {"kind": "sweep", "axes": [{"parameter": "activation.ct", "values": [0.1]}]}
ROW = {"parameter": "activation.ct", "values": [0.1]}


@pytest.mark.parametrize(
    "path, body, field, has, has_not",
    [
        ("/jobs", {"kind": "gesture"}, "kind", "simulation | sweep", "gesture"),
        ("/jobs", {"kind": None}, "kind", "simulation | sweep", "'"),
        ("/jobs", {"foo": 1}, "foo", "fresh, kind", "axes"),
        ("/jobs", {"sweep": 1}, "sweep", "fresh, kind", "axes"),
        ("/jobs", SWEEP | {"foo": 1}, "foo", "axes, base, fresh", "vowel"),
        ("/jobs", SWEEP | {"axes": [ROW | {"foo": 1}]}, "axes.0.foo", "parameter, values", "vowel"),
        ("/jobs", SWEEP | {"base": {"foo": 1}}, "base.foo", "run, subglottal_pressure_pa, vowel", "axes"),
        ("/jobs", SWEEP | {"base": {"run": {"foo": 1}}}, "base.run.foo", "duration_s", "vowel"),
        ("/postures", ROW | {"foo": 1}, "foo", "base, parameter, values", "vowel"),
        ("/postures", ROW | {"base": {"run": {}}}, "base.run", "posture, right, subglottal_pressure_pa", "run"),
        ("/posture", {"run": {}}, "run", "posture, right, subglottal_pressure_pa", "run"),
        ("/resolve", {"sweep": 1}, "sweep", "run, subglottal_pressure_pa, vowel", "axes"),
        ("/resolve", {"str": 1}, "str", "run, subglottal_pressure_pa, vowel", "axes"),
        ("/resolve", {"posture": {"foo": 1}}, "posture.foo", "strain", "vowel"),
        ("/gestures", {"foo": 1}, "foo", "run, subglottal_pressure_pa, vowel", "fresh"),
        ("/jobs", [], "body", "object", "Input"),
    ],
)
def test_help_names_what_is_known_in_the_object_that_was_read(client, path, body, field, has, has_not):
    (found,) = problem(client.post(path, json=body), 422)["errors"]
    assert found["path"] == field and has in found["allowed"] and has_not not in found["allowed"], found


@pytest.mark.parametrize(
    "body, message",
    [
        ({"vowel": None}, "null cannot be used"),
        ({"activation": None}, "null cannot be used"),
        ({"activation": {"ct": True}}, "true cannot be used"),
        ({"vowel": {"a": [False]}}, '{"a": [false]} cannot be used'),
    ],
)
def test_a_refused_value_is_repeated_in_the_words_of_json(client, body, message):
    assert problem(client.post("/resolve", json=body), 422)["errors"][0]["message"] == message


def test_all_bad_fields_are_told_at_once(client):
    body = {"activation": {"ta": 2, "ct": -1}, "vowel": "x"}
    paths = [error["path"] for error in problem(client.post("/posture", json=body), 422)["errors"]]
    assert sorted(paths) == ["activation.ct", "activation.ta", "vowel"]


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_none_are_refused(client, number):
    answer = client.post("/posture", content=f'{{"subglottal_pressure_pa": {number}}}', headers=JSON)
    assert problem(answer, 422)["errors"][0]["path"] == "subglottal_pressure_pa"


@pytest.mark.parametrize("path", ["/posture", "/jobs", "/gestures"])
@pytest.mark.parametrize(
    "content",
    [
        r'{"\ud800": 1}',
        r'{"vowel": "\ud800"}',
        r'{"kind": "\ud800"}',
        r'{"kind": "sweep", "points": [{"\ud800": 1}]}',
        r'{"kind": "sweep", "axes": [{"parameter": "\ud800", "values": [1]}]}',
    ],
)
def test_a_refusal_can_repeat_half_of_a_surrogate_pair(client, path, content):
    assert problem(client.post(path, content=content, headers=JSON), 422)["errors"]


@pytest.mark.parametrize("content", ["{", "[]", "null", "3", ""])
def test_a_body_that_is_no_object_is_refused(client, content):
    problem(client.post("/posture", content=content, headers=JSON), 422)


def test_a_body_that_cannot_be_read_is_400(client):
    problem(client.post("/posture", content=b"\xff\xfe{", headers=JSON), 400)
    problem(client.post("/posture", content="[" * 50_000, headers=JSON), 400)


def test_a_body_of_another_type_is_415(client):
    body = problem(client.post("/posture", content="{}", headers={"Content-Type": "text/plain"}), 415)
    assert "application/json" in body["detail"] and "text/plain" in body["detail"]


def test_what_is_not_there_and_what_cannot_be_done_are_problems_too(client):
    problem(client.get("/nothing"), 404)
    problem(client.get("/jobs/nothing"), 404)
    problem(client.delete("/jobs/nothing"), 404)
    wrong_method = client.get("/posture")
    problem(wrong_method, 405)
    assert wrong_method.headers["allow"] == "POST"


def test_posture_takes_no_run(client):
    errors = problem(client.post("/posture", json={"run": {"nx": 30}}), 422)["errors"]
    assert errors[0]["path"] == "run"


@pytest.mark.parametrize(
    "body, path",
    [
        ({"parameter": "run.nx", "values": [10]}, "parameter"),
        ({"parameter": "activation.ct", "values": [0.1, 2]}, "values.1"),
        ({"parameter": "activation.ct", "values": [0.1] * 33}, "values"),
        ({"parameter": [], "values": [0.1]}, "parameter"),
        ({"parameter": "activation.ct", "values": [0.1], "base": {"activation": {"ta": 2}}}, "base.activation.ta"),
        ({"parameter": "activation.ct"}, "values"),
        ({"parameter": ["activation.ct", "activation.ta", "activation.ct"], "values": [0.1]}, "parameter"),
        ({"parameter": "constants.vocal_process_x_m", "values": [0.003, 0.015]}, "values.1"),
    ],
)
def test_a_row_of_postures_names_what_it_cannot_use(client, body, path):
    errors = problem(client.post("/postures", json=body), 422)["errors"]
    assert path in [error["path"].removesuffix(".str").removesuffix(".list[str]") for error in errors]


def test_a_larynx_without_posture_leaves_a_gap_in_its_row(client, monkeypatch):
    body = {"parameter": "constants.sigma_1_ta_pa", "values": [1e3, 2e3]}
    good = client.post("/postures", json=body).json()["answers"]
    monkeypatch.setattr(
        "vocalis.server.routes.posture.static_shapes",
        lambda wanted: [PostureError("No posture was found."), *static_shapes(wanted[1:])],
    )
    assert client.post("/postures", json=body).json()["answers"] == [None, good[1]]


def test_a_step_too_long_for_the_grid_is_refused_before_it_runs(client):
    for path in ("/simulate", "/jobs"):
        body = {"run": {"time_step_s": 5e-4, "duration_s": 0.1}}
        errors = problem(client.post(path, json=body), 422)["errors"]
        assert errors[0]["path"] == "run.time_step_s" and "up to" in errors[0]["allowed"]


def test_a_run_that_diverges_says_where_and_what_to_try(client):
    body = {"subglottal_pressure_pa": 5000, "constants": {"K_coup_min_pa_m": 0, "K_coup_max_pa_m": 0}}
    detail = problem(client.post("/simulate", json=body), 422)["detail"]
    assert "diverged at t =" in detail and "Try" in detail


def test_a_run_too_long_to_wait_for_is_refused_with_the_limit(client):
    errors = problem(client.post("/simulate", json={"run": {"duration_s": 2.1}}), 422)["errors"]
    assert errors[0] == {
        "path": "run.duration_s",
        "message": "2.1 s is too long to wait for",
        "allowed": "up to 2 s; POST /jobs takes longer runs",
    }


def test_a_run_of_too_many_nodes_and_steps_is_refused_with_the_limit(client):
    fine = {"run": {"duration_s": 0.2, "nx": 100, "ny": 50}}
    assert "node-steps (VOCALIS_SIMULATE_NODE_STEPS)" in problem(client.post("/simulate", json=fine), 422)["detail"]
    huge = {"run": {"duration_s": 60, "nx": 200, "ny": 100, "time_step_s": 1e-8}}
    assert "node-steps (VOCALIS_JOB_NODE_STEPS)" in problem(client.post("/jobs", json=huge), 422)["detail"]


def test_a_body_too_large_is_413_whether_it_says_so_or_not(client):
    large = b'{"kind": "' + b"x" * 1_100_000 + b'"}'
    assert "1048576 bytes" in problem(client.post("/posture", content=large, headers=JSON), 413)["detail"]
    chunks = iter([large[:400_000], large[400_000:]])
    assert "1048576 bytes" in problem(client.post("/posture", content=chunks, headers=JSON), 413)["detail"]


def test_too_many_jobs_are_429_with_the_limit_and_when_to_come_back():
    with serving(jobs_per_client=3, queue_length=1, workers=1) as server, server.client() as client:
        jobs = [run(client, LONG | {"fresh": True})]
        wait_until(lambda: client.get(f"/jobs/{jobs[0]['id']}").json()["status"] == "running")
        jobs.append(run(client, LONG | {"fresh": True}))
        answer = client.post("/jobs", json=LONG | {"fresh": True})
        assert "1 jobs in the queue" in problem(answer, 429)["detail"] and int(answer.headers["retry-after"]) > 0
        client.delete(f"/jobs/{jobs[1]['id']}")
        jobs.append(run(client, LONG | {"fresh": True}))
        with server.client(Authorization="Bearer other") as other:
            problem(other.post("/jobs", json=SHORT), 429)
        for job in jobs:
            client.delete(f"/jobs/{job['id']}")
    with serving(jobs_per_client=1) as server, server.client() as client:
        job = run(client, LONG)
        answer = client.post("/jobs", json=SHORT)
        assert "1 unfinished jobs of one client" in problem(answer, 429)["detail"]
        assert run(client, LONG)["id"] == job["id"], "a job one has already is not one more"
        client.delete(f"/jobs/{job['id']}")


def test_results_make_room_for_newer_ones_and_say_so():
    with serving(result_bytes=2**20, stored_bytes=2**20) as server, server.client() as client:
        first = finish(client, run(client, SHORT))
        finish(client, run(client, {"run": {"duration_s": 0.5}}))
        server.services.storage.retention.tidy()
        assert "the same request makes it again" in problem(client.get(f"/jobs/{first['id']}/result"), 410)["detail"]
        again = finish(client, run(client, SHORT))
        assert client.get(f"/jobs/{again['id']}/result").status_code == 200


def test_what_nobody_foresaw_is_a_problem_without_its_inside(client, monkeypatch, caplog):
    def broken(*_):
        raise RuntimeError("a secret of the server")

    monkeypatch.setattr("vocalis.server.routes.posture.prepare", broken)
    answer = client.post("/posture", json={})
    assert "secret" not in problem(answer, 500)["detail"]
    assert answer.headers["content-security-policy"], "an error page is protected like any other"
    assert "a secret of the server" in caplog.text


def test_a_larynx_without_posture_is_told_in_the_cores_words(client, monkeypatch):
    def none(*_):
        raise PostureError("no root was reached from rest")

    monkeypatch.setattr("vocalis.server.routes.posture.prepare", none)
    assert problem(client.post("/posture", json={}), 422)["detail"] == "no root was reached from rest"


def test_error_bars_come_with_an_answer_that_asks_for_them_and_count_as_work(client):
    body = {"run": {"duration_s": 0.3, "error_estimate": True}}
    answer = client.post("/simulate", json=body)
    assert answer.status_code == 200, answer.text
    bars = answer.json()["error_estimate"]["measures"]
    assert bars["fo_hz"]["half_width"] > 0 and bars["fo_hz"]["unit"] == "Hz" and bars["jitter_percent"]["reason"]
    assert client.post("/simulate", json={"run": {"duration_s": 0.3}}).json()["error_estimate"] is None
    wrong = problem(client.post("/simulate", json={"run": {"error_estimate": 1}}), 422)["errors"]
    assert [(error["path"], error["allowed"]) for error in wrong] == [("run.error_estimate", "true | false")]
    with serving(simulate_node_steps=2e6) as server:  # 20 × 10 nodes for 0.3 s are 1.7e6, their companions 24e6
        assert server.client().post("/simulate", json={"run": {"duration_s": 0.3}}).status_code == 200
        detail = problem(server.client().post("/simulate", json=body), 422)["detail"]
        assert "finer runs of its error estimate" in detail and "node-steps" in detail
        two = {"right": {"activation": {"ta": 0.1}}, "run": {"duration_s": 0.3}}  # 2.7e6
        assert "on each of two folds" in problem(server.client().post("/simulate", json=two), 422)["detail"]
