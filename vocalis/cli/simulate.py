"""`vocalis simulate`: one run of the vibrating folds, as a table or JSON, and as files."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from vfcore.io.atomic import write_bytes
from vfcore.io.audio import render, to_wav_bytes
from vfcore.io.csv import csv_text
from vfcore.io.netcdf import write_netcdf
from vfcore.io.result_document import json_text, result_document
from vfcore.runs.result import SimulationResult
from vfcore.spec.simulation import Simulation
from vocalis.cli.options import SIMULATE_OPTIONS, takes_request
from vocalis.cli.outputs import check_writable, save
from vocalis.cli.progress import simulate_watched
from vocalis.cli.tables import print_measures

HELP = """
{summary}

Measures are taken from the last half of the run. A measure without a value has a reason.

- `vocalis simulate` — the modal voice of the paper, 1 s in a few hundredths of a second
- `vocalis simulate --ct 1 --ta 0.1 --wav high.wav` — a high pitch, to listen to
- `vocalis simulate --preset breathy --netcdf breathy.nc --csv breathy.csv` — fields and measures as files
- `vocalis simulate --json | jq .measures.fo_hz.value` — one number, for a script
- `vocalis simulate --request run.json --set run.start=static` — a stored request, changed in one place
- `vocalis simulate --error-estimate` — how far each measure is from that of a fine grid
- `vocalis simulate --time-step 1.7857e-6` — the paper's own time step
"""
_OUTPUT = "Output"
_File = str | None


def simulate(
    request: Simulation,
    json: Annotated[bool, typer.Option("--json", help="print the result as JSON", rich_help_panel=_OUTPUT)] = False,
    wav: Annotated[
        _File,
        typer.Option("--wav", metavar="FILE", help="the radiated sound: 48 kHz, 16 bit, mono", rich_help_panel=_OUTPUT),
    ] = None,
    normalize: Annotated[
        bool,
        typer.Option(
            "--normalize/--no-normalize",
            rich_help_panel=_OUTPUT,
            help="peak of the sound at -3 dBFS, or the same scale for every run",
        ),
    ] = True,
    netcdf: Annotated[
        _File,
        typer.Option("--netcdf", metavar="FILE", help="waveforms, fields, measures: netCDF-4", rich_help_panel=_OUTPUT),
    ] = None,
    csv: Annotated[
        _File, typer.Option("--csv", metavar="FILE", help="the measures as a table", rich_help_panel=_OUTPUT)
    ] = None,
) -> None:
    """Run a request, print its measures and write the files."""
    for option, path in (("--wav", wav), ("--netcdf", netcdf), ("--csv", csv)):
        check_writable(option, path)
    result = simulate_watched(request)
    document = result_document(result)
    console = Console(stderr=json)
    if json:
        print(json_text(document, indent=2))
    else:
        print_measures(console, document)
    save("--netcdf", netcdf, lambda path: write_netcdf(result, path))
    save("--csv", csv, lambda path: write_bytes(path, csv_text(result).encode()))
    save("--wav", wav, lambda path: _write_sound(result, path, normalize))
    for path in filter(None, (netcdf, csv, wav)):
        console.print(f"wrote {path}", highlight=False, markup=False)


def _write_sound(result: SimulationResult, path: Path, normalize: bool) -> None:
    """The sound at the lips; silence without phonation."""
    audio = render(result.arrays["radiated_pressure_pa"], result.provenance.sample_rate_hz)
    content, _ = to_wav_bytes(audio, normalize=normalize, phonating=result.report.state != "none")
    write_bytes(path, content)


def register(app: typer.Typer, summary: str) -> None:
    app.command("simulate", help=HELP.format(summary=summary))(takes_request(SIMULATE_OPTIONS)(simulate))
