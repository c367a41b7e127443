"""The pages on the model match the code: tables, names, numbers, cited works."""

import dataclasses
import re

import pytest

from tests.support.model_runs import RUNS, differences
from tests.support.model_tables import DOCS, PAGES, TABLES, block, page_of
from vfcore.fold.constants import FoldConstants
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.result import ARRAYS
from vfcore.spec.posture_sets import constant_names
from vfcore.spec.simulation import Activation, Model, PostureOverride, Run, Simulation
from vocalis.studies.paper.report.ship import pages as pages_of_the_paper_study

TEXT = {path.relative_to(DOCS).as_posix(): path.read_text(encoding="utf-8") for path in DOCS.rglob("*.md")}
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


def printed(name):
    return block(page_of(name).read_text(encoding="utf-8"), name)


@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_the_one_the_code_writes(name):
    assert printed(name) == TABLES[name](), REWRITE


@pytest.mark.parametrize("name", [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in RUNS])
def test_a_table_of_runs_has_the_numbers_of_the_runs(name):
    assert differences(printed(name), RUNS[name]()) == [], REWRITE


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_marked_table_of_a_page_has_a_generator(page):
    of_the_study = {path.resolve(): names for path, names in pages_of_the_paper_study().items()}
    generated = {*PAGES[page], *of_the_study.get(page, {})}
    assert set(re.findall(r"<!-- table: (.+) -->", page.read_text(encoding="utf-8"))) == generated


def test_every_generator_has_a_page():
    assert {*TABLES, *RUNS} == {name for names in PAGES.values() for name in names}


def test_every_name_of_the_glossary_exists():
    glossary = TEXT["reference/symbols.md"]
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
                assert f"`{prefix}{field.name}`" in TEXT["reference/symbols.md"], field.name


def test_every_choice_named_in_the_text_exists():
    choices = TEXT["model/choices.md"]
    for group, field in re.findall(r"`(constants|posture|model|run)\.(\w+)`", choices):
        assert field in KNOWN[group], field
    numbers = printed("numbers")
    for name in re.findall(r"`([A-Z_]{6,}\w*)`", choices):
        assert f"`{name}`" in numbers, name


def test_every_work_cited_by_the_catalogue_is_in_the_references():
    references = TEXT["reference/literature.md"].splitlines()
    sources = [spec.source for spec in CATALOGUE] + [s.normal_range.source for s in CATALOGUE if s.normal_range]
    parts = [part for source in sources for part in re.split("[;:] ", source)]
    cited = {match.groups() for part in parts if (match := re.match(r"(\w+).*\((\d{4})\)", part))}
    assert len(cited) > 10
    for author, year in cited:
        assert any(line.startswith(f"- {author}") and f"({year})" in line for line in references), (author, year)
