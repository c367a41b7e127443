"""docs/model.md says what the code does: its tables, its names, its paths, its numbers."""

import dataclasses
import re
from pathlib import Path

import pytest

from tests.support.model_runs import RUNS, differences
from tests.support.model_tables import DOCUMENT, TABLES, block
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.result import ARRAYS
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.posture_sets import constant_names
from vfcore.spec.simulation import Activation, Model, PostureOverride, Run, Simulation
from vocalis.studies.paper.convergence.text import convergence_tables
from vocalis.studies.paper.report.ship import CONVERGENCE, shipped

TEXT = DOCUMENT.read_text(encoding="utf-8")
ROOT = Path(DOCUMENT).parents[1]
REWRITE = "run `python -m tests.support.model_tables --write --runs` and read what changed"
QUICK = ("modal", "shapes", "closed")  # one grid, a second; the others take half a minute


def fields(kind):
    return {field.name for field in dataclasses.fields(kind)}


KNOWN = {
    "activation": fields(Activation),
    "posture": fields(PostureOverride),
    "model": fields(Model),
    "run": fields(Run),
    "constants": fields(FoldConstants) | set(constant_names()),
    "coefficients": fields(Coefficients),
    "PostureSolution": fields(PostureSolution),
    "measures": set(CATALOGUE.keys()),
}
BARE = set(ARRAYS) | fields(Simulation)


@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_the_one_the_code_writes(name):
    assert block(TEXT, name) == TABLES[name](), REWRITE


@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in RUNS])
def test_a_table_of_runs_has_the_numbers_of_the_runs(name):
    assert differences(block(TEXT, name), RUNS[name]()) == [], REWRITE


def test_no_table_stands_without_its_maker():
    made = set(TABLES) | set(RUNS) | set(convergence_tables(shipped(CONVERGENCE)))
    assert set(re.findall(r"<!-- table: (.+) -->", TEXT)) == made


def test_every_name_of_the_glossary_exists():
    glossary = TEXT.split("## 8. Symbols")[1].split("## 9. Constants")[0]
    last_cells = [line.rsplit("|", 2)[1] for line in glossary.splitlines() if line.startswith("| ")]
    names = [name for cell in last_cells for name in re.findall(r"`([^`]+)`", cell)]
    assert len(names) > 80
    for name in names:
        group, _, field = name.partition(".")
        assert field in KNOWN[group] if field else name in BARE, name


def test_every_symbol_of_a_request_is_in_the_glossary_or_in_a_table_of_constants():
    for kind, prefix in ((Activation, "activation."), (PostureOverride, "posture."), (Simulation, "")):
        for field in dataclasses.fields(kind):
            if field.metadata.get("symbol"):
                assert f"`{prefix}{field.name}`" in TEXT, field.name


def test_every_choice_named_in_the_text_exists():
    choices = TEXT.split("## 7. ")[1].split("## 8. ")[0]
    for group, field in re.findall(r"`(constants|posture|model|run)\.(\w+)`", choices):
        assert field in KNOWN[group], field
    numbers = block(TEXT, "numbers")
    for name in re.findall(r"`([A-Z_]{6,}\w*)`", choices):
        assert f"`{name}`" in numbers, name


def test_every_file_named_exists():
    paths = set(re.findall(r"`((?:vfcore|tests|docs)/[\w/.]+)`", TEXT))
    assert len(paths) > 30
    assert [path for path in sorted(paths) if not (ROOT / path).exists()] == []


def test_every_work_cited_by_the_catalogue_is_in_the_references():
    references = TEXT.split("## 11. References")[1].splitlines()
    sources = [spec.source for spec in CATALOGUE] + [s.normal_range.source for s in CATALOGUE if s.normal_range]
    parts = [part for source in sources for part in re.split("[;:] ", source)]
    cited = {match.groups() for part in parts if (match := re.match(r"(\w+).*\((\d{4})\)", part))}
    assert len(cited) > 10
    for author, year in cited:
        assert any(line.startswith(f"- {author}") and f"({year})" in line for line in references), (author, year)
