"""`vocalis paper` as a command."""

import json

import pytest

from vocalis.cli import paper
from vocalis.cli.main import main
from vocalis.studies.paper import CLAIMS
from vocalis.studies.paper.report.ship import CONVERGENCE, shipped

REFUSED = [
    ("--variant mine", "--variant", "paper | text_literal | human | human_female | both"),
    ("--only X9", "X9 is not a claim", "S1, S2"),
    ("--only ,", "contains no claim", "S1, S2"),
    ("--html /no/such/folder/r.html", "--html", "existing folder"),
    ("--study --only S1", "--only", "--study"),
    ("--study --convergence", "--convergence", "--study"),
    ("--convergence --html r.html", "--html", "--convergence"),
]


@pytest.mark.parametrize(("arguments", "named", "allowed"), REFUSED, ids=[row[0] for row in REFUSED])
def test_invalid_input_ends_with_one_line_before_any_run(arguments, named, allowed, capsys, monkeypatch):
    monkeypatch.setattr(paper, "score_variant", lambda *_: pytest.fail("a run was started"))
    assert main(["paper", *arguments.split()]) == 2
    line = capsys.readouterr().err
    assert named in line and allowed in line and line.count("\n") == 1


def test_convergence_prints_its_tables_and_writes_every_number(tmp_path, capsys, monkeypatch):
    document = shipped(CONVERGENCE)
    monkeypatch.setattr(paper, "convergence_document", lambda pool, progress: document)
    written = tmp_path / "c.json"
    assert main(["paper", "--convergence", "--workers", "1", "--json", str(written)]) == 0
    assert json.loads(written.read_text()) == document
    printed = capsys.readouterr().out
    assert "| modal | 80 × 40 |" in printed and "| `rotation` | 40 | 40 |" in printed


def test_chosen_claims_are_judged_on_the_chosen_variant_and_written(tmp_path, capsys):
    html, written = tmp_path / "r.html", tmp_path / "r.json"
    assert main(["paper", "--variant", "paper", "--only", "s5,S1", "--workers", "1",
                 "--html", str(html), "--json", str(written)]) == 0  # fmt: skip
    document = json.loads(written.read_text())
    assert [claim["key"] for claim in document["claims"]] == ["S1", "S5"]
    assert list(document["variants"]) == ["paper"]
    table = capsys.readouterr().out
    assert CLAIMS["S5"].title in table and CLAIMS["M1"].title not in table
    assert "2 pass, 0 deviation, 0 fail; 0 runs without an answer" in table
    assert html.read_text().count("<svg") == 2
