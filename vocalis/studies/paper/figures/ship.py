"""Writes the figures that the page ships: `python -m vocalis.studies.paper.figures.ship`.

With `--claims` only the verdicts are updated, from the shipped scoreboard.
"""

import json
import os
import sys
from pathlib import Path
from typing import Any

from vfcore.io.atomic import write_bytes
from vfcore.spec.simulation import Simulation
from vocalis.studies.paper.figures.document import answer, figure, figure_cases
from vocalis.studies.paper.report.ship import SCOREBOARD, shipped
from vocalis.studies.paper.run.document import provenance
from vocalis.studies.paper.run.gather import warm_up, workers

FIGURES = Path(__file__).parents[4] / "frontend" / "features" / "paper" / "paper.json"


def claims(scoreboard: dict[str, Any]) -> list[dict[str, Any]]:
    """The claims and the outcomes of each variant, as the page shows them."""
    return [
        {key: claim[key] for key in ("key", "title", "paper_says", "definition")}
        | {
            "outcomes": {
                name: {key: one["outcomes"][claim["key"]][key] for key in ("verdict", "sentence")}
                for name, one in scoreboard["variants"].items()
            }
        }
        for claim in scoreboard["claims"]
    ]


def run() -> dict[str, Any]:
    """Compute everything; half a minute to two minutes."""
    warm_up(Simulation())
    cases = figure_cases()
    with workers(os.cpu_count() or 1) as pool:
        begun = {key: [pool.submit(answer, case.kind, r) for r in case.requests()] for key, case in cases.items()}
        figures = {key: figure(cases[key], [f.result() for f in futures]) for key, futures in begun.items()}
    return {"kind": "paper_figures", "provenance": provenance() | {"variant": "paper"}, "figures": figures}


def write(document: dict[str, Any]) -> None:
    """Write the file with the claims of the shipped scoreboard."""
    FIGURES.parent.mkdir(exist_ok=True)
    whole = document | {"claims": claims(shipped(SCOREBOARD))}
    text = json.dumps(whole, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    write_bytes(FIGURES, (text + "\n").encode())


if __name__ == "__main__":
    write(json.loads(FIGURES.read_text(encoding="utf-8")) if "--claims" in sys.argv[1:] else run())
