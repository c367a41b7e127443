"""The study as Markdown."""

from collections.abc import Mapping
from typing import Any

from vocalis.studies.paper.study.designed import changes


def study_markdown(document: Mapping[str, Any]) -> str:
    """One row per choice: its score, and every claim whose verdict it changes."""
    default, *others = document["rows"]
    lines = ["| choice | pass | deviation | fail | better | worse |", "|---|---|---|---|---|---|"]
    lines.append(f"| default | {_score(default)} | | |")
    for row in others:
        lines.append(f"| {row['choice']} | {_score(row)} | {_listed(row, default, +1)} | {_listed(row, default, -1)} |")
    return "\n".join(lines)


_RANK = {"fail": 0, "deviation": 1, "pass": 2}


def _score(row: Mapping[str, Any]) -> str:
    return " | ".join(str(row["score"][verdict]) for verdict in ("pass", "deviation", "fail"))


def _listed(row: Mapping[str, Any], default: Mapping[str, Any], sign: int) -> str:
    """The claims with a better (sign 1) or worse (−1) verdict, each with that verdict."""
    moved = [(key, now) for key, was, now in changes(row, default) if sign * (_RANK[now] - _RANK[was]) > 0]
    return ", ".join(f"{key} {now}" for key, now in moved)
