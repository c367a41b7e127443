"""Every bound of every field of the OpenAPI document, one request each, with ``-m slow``: some minutes.

Schemathesis writes them down when the file is collected, 20 s, so a run without slow tests leaves it out (conftest.py).
"""

import pytest
from hypothesis import Phase, settings

from tests.server.generated_requests import QUIET, api, check, served

target = pytest.fixture(served, scope="module")


@pytest.mark.slow
@api.parametrize()
@settings(phases=[Phase.explicit], **QUIET)
def test_no_bound_of_any_field_finds_an_undeclared_answer(case, target):
    check(case, target, ask_for_the_job=True)
