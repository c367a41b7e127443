"""The report holds every claim, its verdicts and pictures, and loads nothing from the network."""

import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from tests.support.synthetic_evidence import activation_map, voice_of, wave
from tests.unit.test_paper_pictures import FOUND
from vfcore.io.result_document import json_text
from vfcore.spec.simulation import Simulation
from vfcore.version import MODEL_VERSION
from vocalis.studies.paper import CASES, CLAIMS
from vocalis.studies.paper.evidence import Timing
from vocalis.studies.paper.report.html import html_report
from vocalis.studies.paper.report.text import filled, tables
from vocalis.studies.paper.run.document import Scored, scoreboard
from vocalis.studies.paper.run.gather import Failure, Gathered
from vocalis.studies.paper.run.score import definitions_hash, judge

EVIDENCE = FOUND | {"timing": Timing(1.0, 0.5, 0.05)}
LOST = EVIDENCE | {"pca_full": Failure("the run diverged at <t = 3 ms>. Try less.")}
RUN = ("pca_full", "TA 0.4, PCA 1", "the run diverged at <t = 3 ms>. Try less.")


class Page(HTMLParser):
    """Ids, references and attribute values of a page."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.uses, self.values, self.tags = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.values += [value for name, value in attrs if name in ("src", "href", "data", "action")]
        for name, value in attrs:
            if name == "id":
                self.ids.append(value)
            if tag == "use":
                self.uses.append(value.removeprefix("#"))


@pytest.fixture(scope="module")
def scored():
    return {
        "paper": Scored(Simulation(), Gathered(EVIDENCE, []), judge(EVIDENCE), 40.0),
        "text_literal": Scored(Simulation(), Gathered(LOST, [RUN]), judge(LOST), 30.0),
    }


@pytest.fixture(scope="module")
def document(scored):
    return scoreboard(scored)


@pytest.fixture(scope="module")
def text(document, scored):
    return html_report(document, scored)


def test_every_claim_appears_once_with_a_verdict_for_each_variant(text, document):
    page = Page(text)
    assert [name for name in page.ids if name in CLAIMS] == list(CLAIMS)
    for key in CLAIMS:
        section = text[text.index(f'<section id="{key}"') :].split("</section>")[0]
        for name, one in document["variants"].items():
            verdict = one["outcomes"][key]["verdict"]
            assert re.search(rf'<h3>{name}: <span class="{verdict}">', section), (key, name)


def test_nothing_is_fetched_from_anywhere(text):
    page = Page(text)
    assert all(value.startswith("#") for value in page.values)
    assert not {"script", "link", "img", "iframe"} & set(page.tags)
    assert not re.search(r"https?:|@import|url\(", text)


def test_a_shared_picture_is_drawn_once_and_referenced(text):
    page = Page(text)
    assert page.uses and set(page.uses) <= set(page.ids)
    assert len(page.ids) == len(set(page.ids))


def test_it_is_readable_in_the_dark_and_on_paper(text):
    assert "prefers-color-scheme:dark" in text and "@media print" in text


def test_a_failed_run_is_counted_and_named_and_cannot_break_the_page(text, document):
    assert document["variants"]["text_literal"]["failed_runs"][0]["case"] == "pca_full"
    assert document["variants"]["text_literal"]["outcomes"]["P4"]["verdict"] == "fail"
    assert "the run diverged at &lt;t = 3 ms&gt;" in text and "<t = 3 ms>" not in text
    assert CASES["pca_full"].title in text


def test_the_document_is_strict_json_with_its_provenance(document):
    again = json.loads(json_text(document))
    assert again["provenance"]["model_version"] == MODEL_VERSION
    assert again["provenance"]["definitions_sha256"] == definitions_hash()
    paper = again["variants"]["paper"]
    assert sum(paper["score"].values()) == len(CLAIMS) == len(paper["outcomes"])
    assert len(paper["tables"]["ct_ta_map"]["fo_hz"]) == 21
    assert paper["states"]["ct_ta_map"] == {"periodic": 441}


def test_missing_values_are_null_and_numbers_keep_six_figures():
    fo = np.full((21, 21), 1000 / 7)
    fo[3, 4] = np.nan
    found = EVIDENCE | {"ct_ta_map": activation_map(fo_hz=fo), "modal": voice_of(wave(), speed_quotient=np.nan)}
    claims = {key: CLAIMS[key] for key in ("A1", "M2")}
    one = scoreboard({"paper": Scored(Simulation(), Gathered(found, []), judge(found, claims), 1.0)}, claims)
    paper = json.loads(json_text(one))["variants"]["paper"]
    assert paper["tables"]["ct_ta_map"]["fo_hz"][3][3:6] == [142.857, None, 142.857]
    assert paper["outcomes"]["M2"]["measured"][0]["value"] is None


def test_tables_of_the_page_come_between_their_marks(document):
    study = {"kind": "study", "seconds": 1.0, "provenance": document["provenance"], "rows": [_row({"M1": "pass"})]}
    page = "Score\n<!-- table: score -->\nold\n<!-- end -->\nwords stay\n"
    table = {"score": tables(document, study)["score"]}
    new = filled(page, table)
    assert "old" not in new and new.endswith("words stay\n") and "| `paper` |" in new
    with pytest.raises(KeyError):
        filled(page.replace("score", "scores"), table)


def _row(verdicts):
    return {"choice": "default", "score": {"pass": 1, "deviation": 0, "fail": 0},
            "outcomes": {key: {"verdict": v} for key, v in verdicts.items()}}  # fmt: skip
