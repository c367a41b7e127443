"""`vocalis norms`: the voice against published norms, and the study that calibrates the human variant."""

import os
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from vfcore.errors import ParameterError
from vfcore.io.atomic import write_bytes
from vfcore.io.result_document import json_text
from vfcore.spec.simulation import COUPLINGS, Model
from vfcore.spec.variants import VARIANTS
from vocalis.cli.outputs import check_writable, save
from vocalis.studies.norms.calibration import study_document
from vocalis.studies.norms.report import calibration_rows, html, rows, summary
from vocalis.studies.norms.score import norms_document, score_variant
from vocalis.studies.paper.run.gather import workers

HELP = """
{summary}

Each norm is a published range of adult men, with its source and the definition of the model's number. pass: within
the range; otherwise the distance from it. Efforts are lung pressures of soft, normal and loud voice.

- `vocalis norms` — the human variant with two-way coupling and the paper's variant; about ten seconds
- `vocalis norms --variant paper --coupling two_way` — one variant, one coupling
- `vocalis norms --html norms.html --json norms.json` — the table with sources, every number
- `vocalis norms --study` — the search for the constants of the human variant; half an hour on two cores. The first
  line is the set that the variant uses
"""
_STYLES = {"pass": "green", "deviation": "yellow", "no number": "red"}
#: Columns without --variant.
SHOWN = (("human", "two_way"), ("paper", "one_way"))


def norms(
    variant: Annotated[str | None, typer.Option("--variant", metavar="NAME", help=", ".join(VARIANTS))] = None,
    coupling: Annotated[
        str | None, typer.Option("--coupling", metavar="NAME", help=f"{', '.join(COUPLINGS)}; default: the variant's")
    ] = None,
    html_path: Annotated[str | None, typer.Option("--html", metavar="FILE", help="a page with sources")] = None,
    json: Annotated[str | None, typer.Option("--json", metavar="FILE", help="every number")] = None,
    count: Annotated[
        int | None, typer.Option("--workers", min=1, max=256, help="worker processes; default: one for each core")
    ] = None,
    study: Annotated[bool, typer.Option("--study", help="run the calibration study instead")] = False,
) -> None:
    """Score the voice against the norms and print one line for each."""
    _refuse(variant, coupling, html_path, study)
    for option, path in (("--html", html_path), ("--json", json)):
        check_writable(option, path)
    with workers(count or os.cpu_count() or 1) as pool, _bars() as bars:
        if study:
            document = study_document(pool, _update(bars, "study"))
        else:
            columns = [(variant, Model(variant, coupling=coupling).coupling)] if variant else SHOWN
            scored = {}
            for name, way in columns:
                column = f"{name}, {way}"
                scored[column] = score_variant(name, way, pool, _update(bars, column))
            document = norms_document(scored)
    _print(*(calibration_rows(document) if study else rows(document)))
    for sentence in [] if study else summary(document):
        print(sentence)
    if not study:
        save("--html", html_path, lambda path: write_bytes(path, html(document).encode()))
    save("--json", json, lambda path: _write_json(path, document))


def _refuse(variant: str | None, coupling: str | None, html_path: str | None, study: bool) -> None:
    if variant is not None and variant not in VARIANTS:
        raise ParameterError("--variant", f"{variant!r} is not known", " | ".join(VARIANTS))
    if coupling is not None and coupling not in COUPLINGS:
        raise ParameterError("--coupling", f"{coupling!r} is not known", " | ".join(COUPLINGS))
    if coupling is not None and variant is None:
        raise ParameterError("--coupling", "needs --variant", "together with --variant")
    for option, value in (("--variant", variant), ("--html", html_path)):
        if study and value is not None:
            raise ParameterError(option, "cannot be combined with --study", "--json, --workers")


def _bars() -> Progress:
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    console = Console(stderr=True)
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


def _update(bars: Progress, name: str):
    bar = bars.add_task(f"{name}: compiling kernels (slow the first time only)", total=None)
    return lambda done, total: bars.update(bar, description=name, completed=done, total=total)


def _print(header: tuple[str, ...], lines: list[tuple[str, ...]]) -> None:
    table = Table(box=None, pad_edge=False)
    keep = [k for k, cell in enumerate(header) if cell != "source"]
    for k in keep:
        table.add_column(header[k])
    for line in lines:
        cells = [line[0].split(", ")[0], *line[1:]]  # the symbol without the name
        table.add_row(*(_coloured(cells[k]) for k in keep))
    Console().print(table)


def _coloured(text: str) -> str:
    style = next((style for word, style in _STYLES.items() if text.startswith(word)), None)
    return f"[{style}]{text}[/]" if style else text


def _write_json(path: Path, document: dict) -> None:
    write_bytes(path, (json_text(document, indent=1) + "\n").encode())


def register(app: typer.Typer, summary: str) -> None:
    app.command("norms", help=HELP.format(summary=summary))(norms)
