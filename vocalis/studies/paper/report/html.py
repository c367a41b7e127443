"""The scoreboard as one self-contained HTML file with SVG pictures."""

from collections.abc import Mapping
from html import escape
from typing import Any

from vocalis.studies.paper.cases import CASES
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.pictures.by_claim import figure
from vocalis.studies.paper.pictures.plot import WIDTH
from vocalis.studies.paper.report.style import STYLE
from vocalis.studies.paper.run.document import Scored

VERDICTS = ("pass", "deviation", "fail")
MARKS = {"pass": "✓ pass", "deviation": "≈ deviation", "fail": "✗ fail"}


def html_report(document: Mapping[str, Any], scored: Mapping[str, Scored]) -> str:
    """The report of a ``scoreboard`` document, with pictures drawn from the evidence it came from."""
    variants = document["variants"]
    drawn: set[str] = set()
    sections = [_claim(claim, variants, scored, drawn) for claim in document["claims"]]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        '<meta name="color-scheme" content="light dark">'
        f"<title>Scoreboard of the paper</title><style>{STYLE}</style></head><body><main>"
        "<h1>Scoreboard: the claims of the paper and the results of the model</h1>"
        "<p>Serry, Zañartu &amp; Peterson (2026). Each claim was fixed as a numeric test before the first "
        "run. <b>Pass</b>: as the paper says. <b>Deviation</b>: its sense holds, with the stated difference. "
        "<b>Fail</b>: neither.</p>"
        f"{_scores(variants)}{_summary(document)}{''.join(sections)}"
        f"{_failed_runs(variants)}{_provenance(document)}</main></body></html>\n"
    )


def _scores(variants: Mapping[str, Any]) -> str:
    head = "".join(f'<th scope="col">{MARKS[v]}</th>' for v in VERDICTS)
    rows = "".join(
        f'<tr><th scope="row">{escape(name)}</th>'
        + "".join(f"<td>{one['score'][v]}</td>" for v in VERDICTS)
        + f"<td>{len(one['failed_runs'])}</td><td>{one['seconds']:g} s</td></tr>"
        for name, one in variants.items()
    )
    return (
        '<h2>Score</h2><table><thead><tr><th scope="col">variant</th>'
        f'{head}<th scope="col">runs without an answer</th><th scope="col">run time</th></tr></thead>'
        f"<tbody>{rows}</tbody></table>"
    )


def _summary(document: Mapping[str, Any]) -> str:
    variants = document["variants"]
    head = "".join(f'<th scope="col">{escape(name)}</th>' for name in variants)
    rows = "".join(
        f'<tr><th scope="row"><a href="#{c["key"]}">{c["key"]}</a></th><td>{escape(c["title"])}</td>'
        + "".join(f"<td>{_mark(one['outcomes'][c['key']]['verdict'])}</td>" for one in variants.values())
        + "</tr>"
        for c in document["claims"]
    )
    return (
        '<h2>Claims</h2><table><thead><tr><th scope="col"></th><th scope="col">claim</th>'
        f"{head}</tr></thead><tbody>{rows}</tbody></table>"
    )


def _mark(verdict: str) -> str:
    return f'<span class="{verdict}">{MARKS[verdict]}</span>'


def _failed_runs(variants: Mapping[str, Any]) -> str:
    """Every run without an answer; the advice at the end of a reason is left out."""
    rows = "".join(
        f"<tr><td>{escape(name)}</td><td>{escape(CASES[run['case']].title)}</td><td>{escape(run['activation'])}</td>"
        f"<td>{escape(run['reason'].split('. ')[0])}</td></tr>"
        for name, one in variants.items()
        for run in one["failed_runs"]
    )
    table = f"<table class='measured'><tbody>{rows}</tbody></table>" if rows else "<p>None.</p>"
    return f"<section><h2>Runs without an answer</h2>{table}</section>"


def _claim(claim: Mapping[str, Any], variants: Mapping[str, Any], scored: Mapping[str, Scored], drawn: set) -> str:
    found = "".join(
        f'<div class="variant"><h3>{escape(name)}: {_mark(one["outcomes"][claim["key"]]["verdict"])}</h3>'
        f"{_outcome(one['outcomes'][claim['key']])}{_picture(claim['key'], name, scored[name], drawn)}</div>"
        for name, one in variants.items()
    )
    return (
        f'<section id="{claim["key"]}"><h2>{claim["key"]} {escape(claim["title"])}</h2>'
        f"<p><b>The paper.</b> {escape(claim['paper_says'])}</p>"
        f"<p><b>The test.</b> {escape(claim['definition'])}</p>"
        f'<div class="variants">{found}</div></section>'
    )


def _outcome(outcome: Mapping[str, Any]) -> str:
    rows = "".join(
        f'<tr><th scope="row">{escape(m["name"])}</th><td>{_number(m["value"])}</td>'
        f"<td>{'' if m['unit'] == '1' else escape(m['unit'])}</td></tr>"
        for m in outcome["measured"]
    )
    return f"<p>{escape(outcome['sentence'])}</p><table class='measured'><tbody>{rows}</tbody></table>"


def _number(value: float | str | None) -> str:
    if value is None:
        return "no value"
    return escape(value) if isinstance(value, str) else f"{value:.4g}".replace("-", "−")


def _picture(key: str, variant: str, scored: Scored, drawn: set[str]) -> str:
    """The picture of a claim; a shared picture is drawn once and reused."""
    shown = figure(CLAIMS[key], scored.gathered.evidence)
    if shown is None:
        return ""
    name = f"{variant}-{shown.key}"
    body = f'<use href="#{name}"/>' if name in drawn else f'<g id="{name}">{shown.plot.svg()}</g>'
    drawn.add(name)
    size = f"0 0 {WIDTH} {shown.plot.height()}"
    return f'<svg viewBox="{size}" role="img" aria-label="{escape(CLAIMS[key].title)}, {variant}">{body}</svg>'


def _provenance(document: Mapping[str, Any]) -> str:
    rows = "".join(
        f'<tr><th scope="row">{escape(name.replace("_", " "))}</th><td>{escape(str(value))}</td></tr>'
        for name, value in document["provenance"].items()
    )
    return f"<h2>Provenance</h2><table class='measured'><tbody>{rows}</tbody></table>"
