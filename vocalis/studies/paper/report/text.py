"""The tables of docs/scoreboard.md, each between its two marks in the page."""

from collections.abc import Mapping
from typing import Any

from vocalis.studies.paper.study.text import study_markdown

#: Longer sentences, which list every level of a sweep, are cut.
LONGEST = 160


def tables(scoreboard: Mapping[str, Any], study: Mapping[str, Any]) -> dict[str, str]:
    """The generated tables by the name of their marks."""
    return {
        "score": _score(scoreboard["variants"]),
        "claims": _claims(scoreboard),
        "misses": _misses(scoreboard, "paper", "paper_says"),
        "misses of text_literal": _misses(scoreboard, "text_literal", "title"),
        "study": study_markdown(study),
        "versions": _versions(scoreboard, study),
    }


def filled(page: str, by_name: Mapping[str, str]) -> str:
    """``page`` with the text between ``<!-- table: NAME -->`` and ``<!-- end -->`` replaced by the table of that name;
    KeyError for a table without such marks.
    """
    for name, table in by_name.items():
        mark = f"<!-- table: {name} -->\n"
        if mark not in page:
            raise KeyError(name)
        before, _, after = page.partition(mark)
        page = before + mark + table + after[after.index("\n<!-- end -->") :]
    return page


def _score(variants: Mapping[str, Any]) -> str:
    lines = ["| variant | pass | deviation | fail | runs without an answer |", "|---|---|---|---|---|"]
    for name, one in variants.items():
        counts = " | ".join(str(one["score"][v]) for v in ("pass", "deviation", "fail"))
        lines.append(f"| `{name}` | {counts} | {len(one['failed_runs'])} |")
    return "\n".join(lines)


def _claims(scoreboard: Mapping[str, Any]) -> str:
    variants = scoreboard["variants"]
    names = [f"`{name}`" for name in variants]
    lines = [f"| | claim | {' | '.join(names)} |", "|---" * (2 + len(names)) + "|"]
    for claim in scoreboard["claims"]:
        verdicts = " | ".join(one["outcomes"][claim["key"]]["verdict"] for one in variants.values())
        lines.append(f"| {claim['key']} | {claim['title']} | {verdicts} |")
    return "\n".join(lines)


def _misses(scoreboard: Mapping[str, Any], variant: str, field: str) -> str:
    lines = ["| | verdict | the paper | here |", "|---|---|---|---|"]
    for claim in scoreboard["claims"]:
        outcome = scoreboard["variants"][variant]["outcomes"][claim["key"]]
        if outcome["verdict"] != "pass":
            text = _cell(claim[field])
            lines.append(f"| {claim['key']} | {outcome['verdict']} | {text} | {_short(_cell(outcome['sentence']))} |")
    return "\n".join(lines)


def _versions(*documents: Mapping[str, Any]) -> str:
    lines = ["| | model version | definitions | made | run time |", "|---|---|---|---|---|"]
    for document in documents:
        made = document["provenance"]
        seconds = document.get("seconds") or sum(one["seconds"] for one in document["variants"].values())
        lines.append(
            f"| {document['kind']} | {made['model_version']} | `{made['definitions_sha256'][:12]}` "
            f"| {made['created'][:10]} | {seconds:.0f} s |"
        )
    return "\n".join(lines)


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else text[:LONGEST].rsplit(" ", 1)[0] + " …"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
