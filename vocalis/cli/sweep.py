"""`vocalis sweep`: many runs over one to three parameters, on all cores, resumable."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeRemainingColumn

from vfcore.errors import ParameterError
from vfcore.io.result_document import json_text
from vfcore.runs.many import SINGLE_PRECISION
from vfcore.runs.sweep import run as sweep_run
from vfcore.runs.sweep import run_sweep
from vfcore.runs.sweep.cost import point_node_steps
from vfcore.runs.sweep.files import write_csv, write_netcdf
from vfcore.runs.sweep.journal import Journal
from vfcore.runs.sweep.plan import Sweep
from vfcore.spec.simulation import Simulation
from vocalis.cli.axes import sweep_of
from vocalis.cli.options import SIMULATE_OPTIONS, takes_request
from vocalis.cli.outputs import check_writable, save
from vocalis.cli.sweep_table import print_sweep

HELP = """
{summary}

A point that cannot be computed gets a reason and does not stop the others. Computed points are kept in a journal next
to the output until the output is written: after an interruption, the same command continues.

- `vocalis sweep --axis activation.ct=0:1:21 --axis activation.ta=0:1:21 --netcdf map.nc` — a map over two muscles
- `vocalis sweep --axis activation.lca,activation.ia=0:1:11 --csv adduction.csv` — tied parameters
- `vocalis sweep --axis constants.K_col_pa_m=5e5,1e6,2e6 --ct 0.8 --json` — any number of the model, over any base
- `vocalis sweep --sweep points.json --netcdf points.nc` — a sweep document, as for the HTTP API
- `vocalis sweep --axis … --scheduler tcp://head:8786 --netcdf map.nc` — on a Dask cluster
"""
_AXES, _OUTPUT, _HOW = "Parameters and measures", "Output", "Execution"
_File = str | None


def sweep(
    request: Simulation,
    axis: Annotated[
        list[str] | None,
        typer.Option(
            "--axis",
            metavar="PATH=VALUES",
            rich_help_panel=_AXES,
            help="0:1:21 for 21 values, or 0,0.5,1; up to three times; PATH,PATH=… for tied parameters",
        ),
    ] = None,
    sweep_file: Annotated[
        _File,
        typer.Option(
            "--sweep", metavar="FILE|-", help="a sweep document in JSON: axes or points", rich_help_panel=_AXES
        ),
    ] = None,
    measures: Annotated[
        str | None,
        typer.Option(
            "--measures", metavar="KEYS", help="these measures only, separated by commas", rich_help_panel=_AXES
        ),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            "--workers", metavar="NUMBER", help="worker processes; default: one for each core", rich_help_panel=_HOW
        ),
    ] = None,
    precision: Annotated[
        str | None,
        typer.Option(
            "--precision",
            metavar="NAME",
            help=f"float64, or float32: 60 % of the time, {SINGLE_PRECISION}",
            rich_help_panel=_HOW,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="address of a Dask scheduler; the sweep runs on its cluster",
            rich_help_panel=_HOW,
        ),
    ] = None,
    resume: Annotated[
        _File,
        typer.Option(
            "--resume",
            metavar="FILE",
            rich_help_panel=_HOW,
            help="journal file, kept; default: OUTPUT.journal, deleted when the output is written",
        ),
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="print the result as JSON", rich_help_panel=_OUTPUT)] = False,
    netcdf: Annotated[
        _File,
        typer.Option("--netcdf", metavar="FILE", help="netCDF-4, for xarray and others", rich_help_panel=_OUTPUT),
    ] = None,
    csv: Annotated[
        _File, typer.Option("--csv", metavar="FILE", help="one line per point", rich_help_panel=_OUTPUT)
    ] = None,
) -> None:
    """Run a sweep, print its measures and write the files."""
    for option, path in (("--netcdf", netcdf), ("--csv", csv), ("--resume", resume)):
        check_writable(option, path)
    if workers is not None and not 1 <= workers <= 1024:
        raise ParameterError("--workers", f"{workers} is out of range", "1 to 1024")
    wanted = sweep_of(request, sweep_file, axis or [], measures, precision)
    journal_path = resume or next((f"{path}.journal" for path in (netcdf, csv) if path), None)
    journal = Journal(journal_path, wanted) if journal_path else None
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # for the worker processes: see vocalis.server
    try:
        table = _run(wanted, workers, journal, scheduler)
    except OSError as error:
        raise ParameterError("--resume", str(error), "a disk with free space") from error
    console = Console(stderr=json)
    if json:
        print(json_text(table.document(), indent=2))
    else:
        print_sweep(console, table)
    save("--netcdf", netcdf, lambda path: write_netcdf(table, path))
    save("--csv", csv, lambda path: write_csv(table, path))
    for path in filter(None, (netcdf, csv)):
        console.print(f"wrote {path}", highlight=False, markup=False)
    if journal is not None:
        journal.close()
        if resume is None:
            Path(journal.path).unlink()


def _run(wanted: Sweep, workers: int | None, journal: Journal | None, scheduler: str | None):
    with _progress(wanted) as progress:
        if scheduler is None:
            return run_sweep(wanted, workers, journal=journal, progress=progress)
        with _cluster(scheduler) as (executor, threads):
            return run_sweep(wanted, workers or threads, journal=journal, progress=progress, executor=executor)


@contextmanager
def _cluster(address: str) -> Iterator:
    try:
        from distributed import Client
    except ImportError as error:
        raise ParameterError("--scheduler", "needs dask.distributed", "pip install 'vocalis[cluster]'") from error
    try:
        client = Client(address, timeout=5, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ParameterError("--scheduler", f"{address}: {error}", "the address of a running scheduler") from error
    with client:
        yield client.get_executor(pure=False), max(1, sum(client.nthreads().values()))


@contextmanager
def _progress(wanted: Sweep) -> Iterator[sweep_run.Progress]:
    """On a terminal: points done, points without an answer, and the remaining time."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda *_: None
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bars:
        text = f"points of up to {point_node_steps(wanted):.2g} node-steps"
        task = bars.add_task(text, total=len(wanted))

        def show(done: int, failed: int, _: int) -> None:
            bars.update(task, completed=done, description=f"{text}, {failed} without an answer" if failed else text)

        yield show


def register(app: typer.Typer, summary: str) -> None:
    app.command("sweep", help=HELP.format(summary=summary))(takes_request(SIMULATE_OPTIONS)(sweep))
