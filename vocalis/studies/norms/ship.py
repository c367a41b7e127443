"""Writes the shipped results and the tables of docs/human.md and of the notebook. Needs a source tree.

`python -m vocalis.studies.norms.ship` runs norms, claims and coupling and writes results and tables (two or three
minutes). With `--study` it also runs the calibration (another half an hour on two cores). With `--text` it writes only
the tables, from the shipped results.
"""

import json
import os
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from vfcore.io.atomic import write_bytes
from vfcore.io.result_document import json_text
from vfcore.spec.request import resolve
from vocalis.studies.norms.calibration import study_document
from vocalis.studies.norms.coupling import effects, fo_over_f1, pairs, robustness
from vocalis.studies.norms.page import calibration_tables, tables
from vocalis.studies.norms.picture import picture
from vocalis.studies.norms.score import norms_document, score_variant
from vocalis.studies.paper.report.text import filled
from vocalis.studies.paper.run.document import plain_outcome, provenance
from vocalis.studies.paper.run.gather import gather, warm_up, workers
from vocalis.studies.paper.run.score import cases_for, judge, score
from vocalis.studies.paper.study.designed import PHYSICS

RESULTS = Path(__file__).parent / "results"
ROOT = Path(__file__).parents[3]
PAGE, PICTURE = ROOT / "docs" / "human.md", ROOT / "docs" / "img" / "coupling.svg"
CALIBRATION = ROOT / "docs" / "notebook" / "2026-11-calibration.md"
COLUMNS = (("human", "two_way"), ("paper", "one_way"), ("paper", "two_way"), ("human_female", "two_way"))
CLAIMED = (("paper", "one_way"), ("paper", "two_way"), ("human", "two_way"))


def norms(pool: ProcessPoolExecutor) -> dict[str, Any]:
    """The document of the norms, all columns."""
    return norms_document({f"{variant}, {way}": score_variant(variant, way, pool) for variant, way in COLUMNS})


def claims(pool: ProcessPoolExecutor) -> dict[str, Any]:
    """The claims of the paper except its cost, on the variants with each coupling."""
    columns = {}
    for variant, way in CLAIMED:
        base = resolve({"model": {"variant": variant, "coupling": way}})
        warm_up(base)
        found = gather(cases_for(base, PHYSICS), pool).evidence
        outcomes = judge(found, PHYSICS)
        columns[f"{variant}, {way}"] = {
            "score": score(outcomes),
            "outcomes": {key: plain_outcome(one) for key, one in outcomes.items()},
            "fo_map": _fo_map(found["ct_ta_map"]),
        }
    return {"kind": "claims", "provenance": provenance(), "columns": columns}


def _fo_map(maps) -> dict[str, Any]:
    """f_o over TA at some CT, Hz, null where the voice is not periodic."""
    rows = {}
    for k in range(0, len(maps.ct), 4):
        line = zip(maps.state[k], maps.fo_hz[k], strict=True)
        rows[f"{maps.ct[k]:g}"] = [round(float(fo), 1) if state == "periodic" else None for state, fo in line]
    return {"ta": [float(v) for v in maps.ta], "rows": rows}


def coupling(pool: ProcessPoolExecutor) -> dict[str, Any]:
    """The document on two-way coupling; writes the picture as well."""
    found = pairs()
    write_bytes(PICTURE, picture([pair for pair in found if pair.variant == "human"]).encode())
    return {
        "kind": "coupling",
        "provenance": provenance(),
        "pairs": [
            {"variant": pair.variant, "vowel": pair.vowel}
            | {way: effects(getattr(pair, way)) for way in ("one_way", "two_way")}
            for pair in found
        ],
        "fo_over_f1": fo_over_f1(),
        "random": {variant: robustness(variant, pool) for variant in ("human", "paper")},
    }


MADE: dict[str, Callable[[ProcessPoolExecutor], dict[str, Any]]] = {
    "norms": norms,
    "claims": claims,
    "coupling": coupling,
    "calibration": study_document,
}


def shipped(name: str) -> dict[str, Any]:
    """A shipped document, one of MADE."""
    return json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8"))


def pages() -> dict[Path, dict[str, str]]:
    """The tables of each page by the names of their marks, from the shipped documents."""
    documents = {name: shipped(name) for name in MADE}
    return {PAGE: tables(documents), CALIBRATION: calibration_tables(documents["calibration"])}


def write_pages() -> None:
    """The tables of both pages, from the shipped documents."""
    for path, by_name in pages().items():
        write_bytes(path, filled(path.read_text(encoding="utf-8"), by_name).encode())


def _write(name: str, document: Mapping[str, Any]) -> None:
    write_bytes(RESULTS / f"{name}.json", (json_text(document) + "\n").encode())


if __name__ == "__main__":
    arguments = set(sys.argv[1:])
    if "--text" not in arguments:
        wanted = [name for name in MADE if name != "calibration" or "--study" in arguments]
        with workers(os.cpu_count() or 1) as workforce:
            for name in wanted:
                _write(name, MADE[name](workforce))
    write_pages()
