"""The OpenAPI document is true: a thousand generated requests find no 5xx and no answer it does not declare.

``VOCALIS_SCHEMA_CASES=170`` makes it five thousand.
"""

import os
from collections import Counter
from contextlib import suppress
from itertools import cycle

import httpx
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis.errors import Unsatisfiable
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from tests.server.live_server import SHORT, finish, run, serving
from vocalis_server.app import create_app
from vocalis_server.settings import Settings

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
]
CASES_PER_CALL = int(os.environ.get("VOCALIS_SCHEMA_CASES", 55))  # of each kind, right and wrong
SWEEP = {"kind": "sweep", "base": SHORT, "axes": [{"parameter": "activation.ct", "values": [0.2, 0.4]}]}
RUNS = ("/api/v1/simulate", "/api/v1/jobs", "/api/v1/gestures")
SHORTEST_S = 0.02
QUIET = {"deadline": None, "derandomize": True, "database": None, "suppress_health_check": list(HealthCheck)}


@pytest.fixture(scope="module")
def target():
    """A server for cheap runs only, with a finished simulation and a finished sweep to ask about."""
    limits = {"simulate_node_steps": 3e6, "job_node_steps": 3e6, "sweep_node_steps": 3e6}
    with serving(**limits, jobs_per_client=10_000, queue_length=10_000) as server:
        with server.client() as client:
            jobs = [finish(client, run(client, body)) for body in (SHORT, SWEEP)]
        yield server, cycle([job["id"] for job in jobs])


DOCUMENT = create_app(Settings(_env_file=None)).openapi()
# /events has no end; a job's events are asked for.
api = schemathesis.openapi.from_dict(DOCUMENT).exclude(path="/api/v1/events")


def test_a_thousand_generated_requests_find_no_undeclared_answer(target):
    seen: Counter[tuple[str, int]] = Counter()
    for operation in (found.ok() for found in api.get_all_operations()):
        for mode in GenerationMode:

            @settings(phases=[Phase.generate], max_examples=CASES_PER_CALL, **QUIET)
            @given(case=operation.as_strategy(generation_mode=mode))
            def ask(case):
                asked = sum(number for (label, _), number in seen.items() if label == case.operation.label)
                seen[case.operation.label, check(case, target, ask_for_the_job=asked % 2 == 0)] += 1

            with suppress(Unsatisfiable):  # a call without parameters cannot be made wrong
                ask()
    assert seen.total() >= 1000
    labels = {label for label, _ in seen}
    assert labels == {operation.ok().label for operation in api.get_all_operations()}
    # A job that was only made up cannot be dismissed; everything else also succeeded.
    assert {label for label, status in seen if status < 300} == labels - {"DELETE /api/v1/jobs/{job_id}"}


@pytest.mark.slow
@api.parametrize()
@settings(phases=[Phase.explicit], **QUIET)
def test_no_bound_of_any_field_finds_an_undeclared_answer(case, target):
    check(case, target, ask_for_the_job=True)


def check(case, target, ask_for_the_job: bool) -> int:
    """Make one request; the status of its answer."""
    server, job_ids = target
    if case.operation.path in RUNS and isinstance(case.body, dict):
        cheap(case.body)
    if ask_for_the_job and "job_id" in (case.path_parameters or {}) and case.method == "GET":
        case.path_parameters["job_id"] = next(job_ids)
    if ask_for_the_job and "gesture_id" in (case.path_parameters or {}):
        case.path_parameters["gesture_id"] = httpx.post(f"{server.url}/api/v1/gestures", json=SHORT).json()["id"]
    return case.call_and_validate(base_url=server.url, checks=CHECKS).status_code


def cheap(body: dict) -> None:
    """Make runs that would be taken short, and keep them on the one compiled grid; what is wrong stays wrong."""
    if body.get("kind") == "sweep":
        body["base"] = body.get("base") or {}
        if "run." in str(body.get("axes")) + str(body.get("points")):
            del body["kind"]
        body = body["base"]
    if not isinstance(body, dict):
        return
    run = body.setdefault("run", {})
    if isinstance(run, dict) and isinstance(run.setdefault("duration_s", SHORTEST_S), int | float):
        run["duration_s"] = min(run["duration_s"], SHORTEST_S)
        for name in ("nx", "ny", "time_step_s", "pressure_rise_s"):
            if isinstance(run.get(name), int | float):
                run.pop(name)


def test_the_document_is_served(target):
    assert httpx.get(f"{target[0].url}/api/v1/openapi.json").json() == DOCUMENT


def test_every_call_of_the_contract_is_in_the_document():
    calls = {f"{method.upper()} {path}" for path, methods in DOCUMENT["paths"].items() for method in methods}
    job = "/api/v1/jobs/{job_id}"
    assert calls >= {
        "GET /api/v1/health", "GET /api/v1/parameters", "GET /api/v1/measures", "POST /api/v1/posture",
        "POST /api/v1/simulate", "POST /api/v1/jobs", "GET /api/v1/jobs", f"GET {job}", f"DELETE {job}",
        f"GET {job}/events", "GET /api/v1/events", f"GET {job}/result", f"GET {job}/arrays/{{name}}",
        f"GET {job}/audio.wav", f"GET {job}/result.nc", f"GET {job}/result.csv",
    }  # fmt: skip


def test_the_document_shows_ranges_units_and_every_constant():
    schemas = DOCUMENT["components"]["schemas"]
    ta = schemas["ActivationBody"]["properties"]["ta"]
    assert (ta["minimum"], ta["maximum"], ta["default"], ta["unit"]) == (0, 1, 0.4, "1")
    assert schemas["SimulationBody"]["additionalProperties"] is False
    assert {"K_col_pa_m", "rest_angle_rad", "L_0_posture_m"} <= set(schemas["ConstantsBody"]["properties"])
