"""The norms as a Markdown table (for docs) and as one HTML page."""

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from vocalis.studies.norms.norms import NORMS, Norm
from vocalis.studies.paper.claims.claim import Verdict

_MARK = {"pass": "pass", "deviation": "deviation", "fail": "no number"}


def shown(norm: Norm, value: float | None) -> str:
    """A number with the digits of its norm; a dash for None."""
    return "–" if value is None else f"{value:.{norm.decimals}f}"


def limits(norm: Norm) -> str:
    """The range of a norm."""
    return f"{norm.low:g} to {norm.high:g}"


def verdict_text(row: Mapping[str, Any]) -> str:
    """ "pass", or the distance of the number from the range."""
    return _MARK[row["verdict"]] + (f" ({row['beyond']})" if row["verdict"] == "deviation" else "")


def rows(document: Mapping[str, Any]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Header and lines of the table: norm, unit, effort, range, each column's number and verdict, source."""
    names = tuple(document["columns"])
    header = ("norm", "unit", "effort", "range", *(cell for name in names for cell in (name, "verdict")), "source")
    lines = []
    for key, norm in NORMS.items():
        found = (document["columns"][name]["norms"][key] for name in names)
        cells = (cell for row in found for cell in (shown(norm, row["value"]), verdict_text(row)))
        lines.append((f"{norm.symbol}, {norm.name}", norm.unit, norm.effort, limits(norm), *cells, norm.source))
    return header, lines


def summary(document: Mapping[str, Any]) -> list[str]:
    """One sentence per column: how many norms are in range."""
    return [
        f"{name}: {column['in_range']} of {column['of']} norms of normal effort in range"
        for name, column in document["columns"].items()
    ]


def markdown(header: tuple[str, ...], lines: list[tuple[str, ...]]) -> str:
    """A table for docs/human.md."""
    table = [header, ("---",) * len(header), *lines]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in table)


def calibration_rows(document: Mapping[str, Any], which: str = "best") -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Header and lines of the sets of the calibration study, its ``best`` or its ``front``: norms, claims, factors,
    misses.
    """
    names = [*document[which][0]["constants"], "lca_ia", "ct", "ta", "pca"]
    header = ("norms in range", "claims: pass / deviation / fail", "lost", "kept", *names, "norms missed",
              "claims that fail")  # fmt: skip
    return header, [_calibration_row(candidate, names) for candidate in document[which]]


def _calibration_row(candidate: Mapping[str, Any], names: Sequence[str]) -> tuple[str, ...]:
    missed = [
        f"{NORMS[key].symbol} {shown(NORMS[key], value)}"
        for key, value in candidate["norms"].items()
        if value is None or not NORMS[key].low <= value <= NORMS[key].high
    ]
    factors = candidate["constants"] | candidate["activation"] | {"lca_ia": candidate["activation"]["lca"]}
    counts = " / ".join(str(candidate["score"][verdict]) for verdict in Verdict)
    return (
        str(candidate["in_range"]),
        counts,
        ", ".join(candidate["lost"]) or "none",
        str(candidate["kept"]),
        *(f"{factors[name]:.3g}" for name in names),
        ", ".join(missed),
        ", ".join(candidate["failed"]),
    )


_STYLE = """
:root{color-scheme:light dark}body{font:15px/1.5 system-ui;max-width:76rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;width:100%}th,td{padding:.3rem .6rem;text-align:left;border-bottom:1px solid #8884}
.pass{color:light-dark(#0a6b2b,#6fd08c)}.deviation{color:light-dark(#8a5a00,#e6b450)}.none{color:light-dark(#a11,#f77)}
"""


def html(document: Mapping[str, Any]) -> str:
    """One self-contained page."""
    header, lines = rows(document)
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "".join(f"<tr>{''.join(map(_cell, line))}</tr>" for line in lines)
    sentences = "".join(f"<p>{escape(sentence)}.</p>" for sentence in summary(document))
    made = document["provenance"]
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Vocalis: norms</title><style>{_STYLE}</style>'
        f"<h1>The voice compared with norms of men</h1>{sentences}<table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table>"
        f"<p>Model {escape(made['model_version'])}, {escape(made['created'])}.</p></html>\n"
    )


def _cell(text: str) -> str:
    kind = next((name for word, name in (("pass", "pass"), ("deviation", "deviation"), ("no number", "none"))
                 if text.startswith(word)), "")  # fmt: skip
    return f'<td class="{kind}">{escape(text)}</td>' if kind else f"<td>{escape(text)}</td>"
