"""Requests that schemathesis makes from the OpenAPI document, and what must hold of every answer."""

from itertools import cycle

import httpx
import schemathesis
from hypothesis import HealthCheck
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from tests.server.live_server import SHORT, finish, run, serving
from vocalis.server.app import create_app
from vocalis.server.settings import Settings

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
]
SWEEP = {"kind": "sweep", "base": SHORT, "axes": [{"parameter": "activation.ct", "values": [0.2, 0.4]}]}
RUNS = ("/api/v1/simulate", "/api/v1/jobs", "/api/v1/gestures")
SHORTEST_S = 0.02
ANSWER_WITHIN_S = 60  # the first error estimate compiles its two grids, while other tests want the cores as well
QUIET = {"deadline": None, "derandomize": True, "database": None, "suppress_health_check": list(HealthCheck)}
DOCUMENT = create_app(Settings(_env_file=None)).openapi()
# /events has no end; the events of a job are requested.
api = schemathesis.openapi.from_dict(DOCUMENT).exclude(path="/api/v1/events")


def served():
    """A server for cheap runs only, and without end the ids of a finished simulation and a finished sweep on it."""
    limits = {"simulate_node_steps": 3e6, "job_node_steps": 3e6, "sweep_node_steps": 3e6}
    with serving(**limits, jobs_per_client=10_000, queue_length=10_000) as server:
        with server.client() as client:
            jobs = [finish(client, run(client, body)) for body in (SHORT, SWEEP)]
        yield server, cycle([job["id"] for job in jobs])


def check(case, target, ask_for_the_job: bool) -> int:
    """Make one request; the status of its answer."""
    server, job_ids = target
    if case.operation.path in RUNS and isinstance(case.body, dict):
        cheap(case.body)
    if ask_for_the_job and "job_id" in (case.path_parameters or {}) and case.method == "GET":
        case.path_parameters["job_id"] = next(job_ids)
    if ask_for_the_job and "gesture_id" in (case.path_parameters or {}):
        case.path_parameters["gesture_id"] = httpx.post(f"{server.url}/api/v1/gestures", json=SHORT).json()["id"]
    return case.call_and_validate(base_url=server.url, checks=CHECKS, timeout=ANSWER_WITHIN_S).status_code


def cheap(body: dict) -> None:
    """Make runs that would be taken short, and keep them to few compiled forms of the step: one grid, the equations of
    a model only without sides and lesions, finer grids only for the default model; what is wrong stays wrong.
    """
    if body.get("kind") == "sweep":
        body["base"] = body.get("base") or {}
        if "run." in str(body.get("axes")) + str(body.get("points")):
            del body["kind"]
        body = body["base"]
    if not isinstance(body, dict):
        return
    if any(body.get(name) for name in ("left", "right", "lesions")):
        body.pop("model", None)
    run = body.setdefault("run", {})
    if isinstance(run, dict) and any(body.get(name) for name in ("model", "left", "right", "lesions")):
        run.pop("error_estimate", None)
    if isinstance(run, dict) and isinstance(run.setdefault("duration_s", SHORTEST_S), int | float):
        run["duration_s"] = min(run["duration_s"], SHORTEST_S)
        for name in ("nx", "ny", "time_step_s", "pressure_rise_s"):
            if isinstance(run.get(name), int | float):
                run.pop(name)
