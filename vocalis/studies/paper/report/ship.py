"""Writes the shipped results and the tables of docs/scoreboard.md and docs/model/. Needs a source tree.

`python -m vocalis.studies.paper.report.ship` runs everything and writes both; with `--text` it writes only the tables,
from the shipped results.
"""

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from vfcore.io.atomic import write_bytes
from vfcore.io.result_document import json_text
from vocalis.studies.paper.convergence.refinement import convergence_document
from vocalis.studies.paper.convergence.text import convergence_tables
from vocalis.studies.paper.report.text import filled, tables
from vocalis.studies.paper.run.document import READINGS, score_variant, scoreboard
from vocalis.studies.paper.run.gather import workers
from vocalis.studies.paper.study.designed import study_document

RESULTS = Path(__file__).parents[1] / "results"
SCOREBOARD, STUDY = RESULTS / "scoreboard.json", RESULTS / "study.json"
CONVERGENCE = RESULTS / "convergence.json"
PAGE = Path(__file__).parents[4] / "docs" / "scoreboard.md"
NUMERICS_PAGE, CHOICES_PAGE = PAGE.parent / "model" / "numerics.md", PAGE.parent / "model" / "choices.md"


def shipped(path: Path) -> dict[str, Any]:
    """A shipped document."""
    return json.loads(path.read_text(encoding="utf-8"))


def run_and_write() -> None:
    """Run everything; a few minutes."""
    with workers(os.cpu_count() or 1) as pool:
        scored = {variant: score_variant(variant, pool) for variant in READINGS}
        study = study_document(pool)
        convergence = convergence_document(pool)
    _write(SCOREBOARD, scoreboard(scored))
    _write(STUDY, study)
    _write(CONVERGENCE, convergence)


def write_pages() -> None:
    """The tables of all pages from the shipped documents."""
    for path, by_name in pages().items():
        write_bytes(path, filled(path.read_text(encoding="utf-8"), by_name).encode())


def pages() -> dict[Path, dict[str, str]]:
    """The tables of each page by the names of their marks."""
    convergence = convergence_tables(shipped(CONVERGENCE))
    return {
        PAGE: tables(shipped(SCOREBOARD), shipped(STUDY)),
        CHOICES_PAGE: {"shear": convergence.pop("shear")},
        NUMERICS_PAGE: convergence,
    }


def _write(path: Path, document: Mapping[str, Any]) -> None:
    write_bytes(path, (json_text(document) + "\n").encode())


if __name__ == "__main__":
    if "--text" not in sys.argv[1:]:
        run_and_write()
    write_pages()
