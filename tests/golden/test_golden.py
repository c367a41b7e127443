"""Results do not change by more than a part in a million unless MODEL_VERSION changes."""

import json

import pytest

from tests.golden.cases import CASES, STORED, differences, read_stored, results_of
from tests.golden.regenerate import regenerate
from vfcore.version import MODEL_VERSION

GOLDEN = read_stored()
REMEDY = 'raise MODEL_VERSION in vfcore/version.py, then: python -m tests.golden.regenerate --reason "..."'


def test_the_file_has_this_model_version_and_these_cases():
    assert GOLDEN["model_version"] == MODEL_VERSION, REMEDY
    assert GOLDEN["reason"]
    assert {name: case["request"] for name, case in GOLDEN["cases"].items()} == CASES, REMEDY


@pytest.mark.parametrize("name", CASES)
def test_results_have_not_changed(name):
    lines = differences(GOLDEN["cases"][name]["results"], results_of(CASES[name]))
    assert not lines, "\n".join([*lines, REMEDY])


def test_the_cases_cover_every_kind_of_result():
    states = {case["results"]["state"] for case in GOLDEN["cases"].values()}
    assert {"periodic", "none"} <= states
    patterns = {case["results"]["closure"] for case in GOLDEN["cases"].values()}
    assert {"complete", "open"} <= patterns


@pytest.fixture
def altered(tmp_path):
    """A copy of the golden file in which one number is off by ten parts in a million."""
    document = json.loads(STORED.read_text(encoding="utf-8"))
    document["cases"]["modal"]["results"]["numbers"]["fo_hz"] *= 1 + 1e-5
    path = tmp_path / "results.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def test_changed_results_are_not_written_under_the_same_version(altered):
    before = altered.read_bytes()
    with pytest.raises(SystemExit, match=r"(?s)MODEL_VERSION is still .*modal: fo_hz was 149\.62.*, is 149\.62"):
        regenerate("a reason", altered)
    assert altered.read_bytes() == before


def test_changed_results_are_written_under_a_new_version_with_the_reason(altered):
    assert regenerate("another scheme", altered, version="other")
    document = read_stored(altered)
    assert (document["model_version"], document["reason"]) == ("other", "another scheme")
    assert not differences(document["cases"]["modal"]["results"], GOLDEN["cases"]["modal"]["results"])


@pytest.mark.parametrize("reason", ["", "  "])
def test_nothing_is_written_without_a_reason(reason, altered):
    before = altered.read_bytes()
    with pytest.raises(SystemExit, match="say why"):
        regenerate(reason, altered, version="other")
    assert altered.read_bytes() == before
