"""The figures that the page ships: current, complete, and equal to the results of the model."""

import json

import pytest

from vfcore.version import MODEL_VERSION
from vocalis.studies.paper import CASES, CLAIMS
from vocalis.studies.paper.figures.document import answer, figure, figure_cases
from vocalis.studies.paper.figures.ship import FIGURES, claims
from vocalis.studies.paper.report.ship import SCOREBOARD, shipped
from vocalis.studies.paper.run.score import definitions_hash

AGAIN = "run `python -m vocalis.studies.paper.figures.ship`"
MOST_BYTES = 1_000_000


@pytest.fixture(scope="module")
def paper():
    return json.loads(FIGURES.read_text(encoding="utf-8"))


def test_they_are_of_this_model_and_these_definitions(paper):
    assert paper["provenance"]["model_version"] == MODEL_VERSION, AGAIN
    assert paper["provenance"]["definitions_sha256"] == definitions_hash(), AGAIN
    assert FIGURES.stat().st_size < MOST_BYTES


def test_they_have_the_verdicts_of_the_shipped_scoreboard(paper):
    assert paper["claims"] == claims(shipped(SCOREBOARD)), "run `python -m vocalis.studies.paper.figures.ship --claims`"
    assert [claim["key"] for claim in paper["claims"]] == list(CLAIMS)


def test_every_case_is_there_with_all_its_points(paper):
    assert list(paper["figures"]) == list(figure_cases())
    for key, shown in paper["figures"].items():
        points = len(CASES[key].requests())
        if shown["kind"] == "static":
            assert len(shown["shapes"]) == points
        elif shown["kind"] == "voice":
            assert points == 1 and shown["result"]["phonation_state"] == "periodic"
        else:
            assert all(len(table) == points for table in shown["measures"].values())
            assert len(shown["states"]) == points
            assert "periodic" in shown["states"]


@pytest.mark.parametrize("key", ["static_ta", "modal"])
def test_the_model_gives_the_shipped_figure_again(paper, key):
    case = CASES[key]
    again = figure(case, [answer(case.kind, request) for request in case.requests()])
    again, there = json.loads(json.dumps(again)), paper["figures"][key]
    if case.kind == "voice":  # waveforms differ in the last digits from processor to processor
        assert again["result"]["measures"]["fo_hz"]["value"] == pytest.approx(
            there["result"]["measures"]["fo_hz"]["value"], rel=1e-3
        )
        assert again["arrays"]["cycle_w_m"]["shape"] == there["arrays"]["cycle_w_m"]["shape"]
    else:
        assert again["shapes"][-1]["superior_m"] == pytest.approx(there["shapes"][-1]["superior_m"], rel=1e-3, abs=1e-9)
