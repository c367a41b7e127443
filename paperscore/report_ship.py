"""The shipped results and the tables of docs/scoreboard.md, in a source tree (an installed package has no docs/).

`python -m vocalis_paper.report_ship` runs everything and writes both; with `--text` the tables alone, from the shipped
results.
"""

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from vfcore.document import json_text
from vfcore.files.atomic import write_bytes
from vocalis_paper.report_text import filled, tables
from vocalis_paper.run import workers
from vocalis_paper.run_document import READINGS, score_variant, scoreboard
from vocalis_paper.study import study_document

RESULTS = Path(__file__).parent / "results"
SCOREBOARD, STUDY = RESULTS / "scoreboard.json", RESULTS / "study.json"
PAGE = Path(__file__).parents[1] / "docs" / "scoreboard.md"


def shipped(path: Path) -> dict[str, Any]:
    """A shipped document."""
    return json.loads(path.read_text(encoding="utf-8"))


def run_and_write() -> None:
    """Everything anew; some minutes."""
    with workers(os.cpu_count() or 1) as pool:
        scored = {variant: score_variant(variant, pool) for variant in READINGS}
        study = study_document(pool)
    _write(SCOREBOARD, scoreboard(scored))
    _write(STUDY, study)


def write_page() -> None:
    """The tables of docs/scoreboard.md from the shipped documents."""
    page = PAGE.read_text(encoding="utf-8")
    write_bytes(PAGE, filled(page, tables(shipped(SCOREBOARD), shipped(STUDY))).encode())


def _write(path: Path, document: Mapping[str, Any]) -> None:
    write_bytes(path, (json_text(document) + "\n").encode())


if __name__ == "__main__":
    if "--text" not in sys.argv[1:]:
        run_and_write()
    write_page()
