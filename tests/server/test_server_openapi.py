"""The OpenAPI document is true: a thousand generated requests find no 5xx and no answer it does not declare.

``VOCALIS_SCHEMA_CASES=170`` makes it five thousand.
"""

import os
from collections import Counter
from contextlib import suppress

import httpx
import pytest
from hypothesis import Phase, given, settings
from hypothesis.errors import Unsatisfiable
from schemathesis import GenerationMode

from tests.server.generated_requests import DOCUMENT, QUIET, api, check, served

CASES_PER_CALL = int(os.environ.get("VOCALIS_SCHEMA_CASES", 33))  # of each kind, right and wrong
target = pytest.fixture(served, scope="module")


@pytest.mark.first
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
