"""`vocalis paper`: the paper's claims, run and judged."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from vfcore.errors import ParameterError
from vfcore.io.atomic import write_bytes
from vfcore.io.result_document import json_text
from vfcore.spec.simulation import VARIANTS
from vocalis.cli.outputs import check_writable, save
from vocalis.studies.paper.cases import CASES
from vocalis.studies.paper.claims.registry import CLAIMS
from vocalis.studies.paper.convergence.refinement import convergence_document
from vocalis.studies.paper.convergence.text import convergence_tables
from vocalis.studies.paper.report.html import html_report
from vocalis.studies.paper.run.document import READINGS, score_variant, scoreboard
from vocalis.studies.paper.run.gather import workers
from vocalis.studies.paper.study.designed import study_document
from vocalis.studies.paper.study.text import study_markdown

HELP = """
{summary}

Each claim is a numeric test that was fixed before the first run. pass: as the paper says; deviation: true in
substance, with a stated difference; fail: neither.

- `vocalis paper` — all 29 claims on both readings of the paper; one or two minutes
- `vocalis paper --variant human` — the same claims on a voice of human size, coupled to its airways
- `vocalis paper --variant paper --html report.html` — with a picture for each claim
- `vocalis paper --only M2,M3,S1` — some claims; a few seconds
- `vocalis paper --study` — how the score changes with each free choice; a few minutes
- `vocalis paper --convergence` — three voices on finer grids and shorter steps; both shear forms on more rows
"""
_STYLES = {"pass": "green", "deviation": "yellow", "fail": "red"}
BOTH = "both"


def paper(
    variant: Annotated[str, typer.Option("--variant", metavar="NAME", help=f"{', '.join(VARIANTS)} or {BOTH}")] = BOTH,
    only: Annotated[str | None, typer.Option("--only", metavar="S1,M2", help="these claims only")] = None,
    html: Annotated[str | None, typer.Option("--html", metavar="FILE", help="a report with pictures")] = None,
    json: Annotated[str | None, typer.Option("--json", metavar="FILE", help="every number")] = None,
    count: Annotated[
        int | None, typer.Option("--workers", min=1, max=256, help="worker processes; default: one for each core")
    ] = None,
    study: Annotated[
        bool, typer.Option("--study", help="vary the free choices instead, on coarser maps, for the paper variant")
    ] = False,
    convergence: Annotated[
        bool, typer.Option("--convergence", help="refine grid and time step instead, for the paper variant")
    ] = False,
) -> None:
    """Judge the paper's claims and print one line for each."""
    chosen = _variants(variant)
    claims = CLAIMS if only is None else {key: CLAIMS[key] for key in _keys(only)}
    _refuse_with("--study", study, ("--only", only), ("--html", html), ("--convergence", convergence or None))
    _refuse_with("--convergence", convergence, ("--only", only), ("--html", html))
    for option, path in (("--html", html), ("--json", json)):
        check_writable(option, path)
    with workers(count or os.cpu_count() or 1) as pool, _watch() as watched:
        if study:
            document = study_document(pool, watched)
        elif convergence:
            document = convergence_document(pool, watched("convergence"))
        else:
            scored = {name: score_variant(name, pool, claims, watched(name)) for name in chosen}
            document = scoreboard(scored, claims)
    if study:
        print(study_markdown(document))
    elif convergence:
        print("\n\n".join(convergence_tables(document).values()))
    else:
        _print(document)
        save("--html", html, lambda path: write_bytes(path, html_report(document, scored).encode()))
    save("--json", json, lambda path: _write_json(path, document))


def _variants(name: str) -> tuple[str, ...]:
    if name == BOTH:
        return READINGS
    if name not in VARIANTS:
        raise ParameterError("--variant", f"{name!r} is not known", " | ".join((*VARIANTS, BOTH)))
    return (name,)


def _keys(text: str) -> list[str]:
    keys = [key.strip().upper() for key in text.split(",") if key.strip()]
    unknown = [key for key in keys if key not in CLAIMS]
    if unknown or not keys:
        raise ParameterError(
            "--only", f"{text!r} contains no claim" if not keys else f"{unknown[0]} is not a claim", ", ".join(CLAIMS)
        )
    return [key for key in CLAIMS if key in keys]


def _refuse_with(chosen: str, is_chosen: bool, *others: tuple[str, Any]) -> None:
    for option, value in others:
        if is_chosen and value is not None:
            raise ParameterError(option, f"cannot be combined with {chosen}", "--json, --workers")


@contextmanager
def _watch() -> Iterator[Callable[[str], Callable[[str, int, int], None]]]:
    """A function from a name to a progress callback: bars on a terminal, nothing elsewhere."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda name: lambda case, done, total: None
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bars:

        def named(name: str) -> Callable[[str, int, int], None]:
            bar = bars.add_task(f"{name}: compiling kernels (slow the first time only)", total=None)

            def update(case: str, done: int, total: int) -> None:
                title = CASES[case].title if case in CASES else case
                bars.update(bar, description=f"{name}: {title}", completed=done, total=total)

            return update

        yield named


def _print(document: dict) -> None:
    console = Console()
    table = Table(box=None, pad_edge=False)
    for header in ("", "claim", *document["variants"]):
        table.add_column(header)
    for claim in document["claims"]:
        verdicts = (one["outcomes"][claim["key"]]["verdict"] for one in document["variants"].values())
        table.add_row(claim["key"], claim["title"], *(f"[{_STYLES[v]}]{v}[/]" for v in verdicts))
    console.print(table)
    for name, one in document["variants"].items():
        counts = ", ".join(f"{count} {verdict}" for verdict, count in one["score"].items())
        failed = len(one["failed_runs"])
        console.print(f"{name}: {counts}; {failed} runs without an answer; {one['seconds']:g} s", highlight=False)


def _write_json(path: Path, document: dict) -> None:
    write_bytes(path, (json_text(document, indent=1) + "\n").encode())


def register(app: typer.Typer, summary: str) -> None:
    app.command("paper", help=HELP.format(summary=summary))(paper)
