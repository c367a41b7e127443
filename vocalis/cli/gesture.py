"""`vocalis gesture`: a voice whose parameters move, as contours, measures per segment, and files."""

from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from vfcore.io.atomic import write_bytes
from vfcore.io.audio import to_wav_bytes
from vfcore.io.result_document import json_text
from vfcore.runs.gesture.document import contour_csv, gesture_document, write_gesture_netcdf
from vfcore.runs.gesture.gesture import Gesture, gesture_from_dict, gesture_patch
from vfcore.runs.gesture.render import RenderedGesture, render
from vocalis.cli.options import SIMULATE_OPTIONS, takes_request
from vocalis.cli.outputs import check_writable, save
from vocalis.cli.progress import watched

HELP = """
{summary}

Any option that takes a number also takes breakpoints `time:value,time:value` (seconds), with straight lines between.
Each segment between two breakpoints is measured on its last half.

- `vocalis gesture --ct 0.2:0.1,1.2:0.9 --duration 1.5 --wav glide.wav` — a pitch glide
- `vocalis gesture --pca 0.5:0,0.7:0.8 --csv contours.csv` — abduction, f_o and level every 10 ms
- `vocalis gesture --pressure 0:200,0.5:1500` — onset with rising pressure
- `vocalis gesture --request recorded.json --wav again.wav` — a gesture recorded in the browser
"""
_OUTPUT = "Output"
_SHOWN = ("fo_hz", "spl_30cm_db", "closed_quotient", "mean_flow_ml_s", "contact_pressure_max_pa")


def gesture(
    request: Gesture,
    json: Annotated[bool, typer.Option("--json", help="print the result as JSON", rich_help_panel=_OUTPUT)] = False,
    wav: Annotated[
        str | None,
        typer.Option("--wav", metavar="FILE", help="the radiated sound: 48 kHz, 16 bit, mono", rich_help_panel=_OUTPUT),
    ] = None,
    netcdf: Annotated[
        str | None,
        typer.Option("--netcdf", metavar="FILE", help="waveforms and contours: netCDF-4", rich_help_panel=_OUTPUT),
    ] = None,
    csv: Annotated[
        str | None, typer.Option("--csv", metavar="FILE", help="the contours as a table", rich_help_panel=_OUTPUT)
    ] = None,
) -> None:
    """Render a gesture, print its measures and write the files."""
    for option, path in (("--wav", wav), ("--netcdf", netcdf), ("--csv", csv)):
        check_writable(option, path)
    rendered = watched(request.start.run.duration_s, lambda progress: render(request, progress=progress))
    console = Console(stderr=json)
    if json:
        print(json_text(gesture_document(rendered), indent=2))
    else:
        _print(console, rendered)
    save("--netcdf", netcdf, lambda path: write_gesture_netcdf(rendered, path))
    save("--csv", csv, lambda path: write_bytes(path, contour_csv(rendered).encode()))
    save("--wav", wav, lambda path: write_bytes(path, to_wav_bytes(rendered.audio_pa)[0]))
    for path in filter(None, (netcdf, csv, wav)):
        console.print(f"wrote {path}", highlight=False, markup=False)


def _print(console: Console, rendered: RenderedGesture) -> None:
    table = Table(box=None, pad_edge=False)
    for header in ("from s", "to s", "f_o Hz", "SPL 30 cm dB", "CQ", "flow mL/s", "contact Pa"):
        table.add_column(header, justify="right")
    table.add_column("state")
    for segment in rendered.segments:
        values = (segment.report.measures[key].value for key in _SHOWN)
        cells = ("–" if v is None else f"{v:.{d}f}" for v, d in zip(values, (1, 1, 2, 0, 0), strict=True))
        table.add_row(f"{segment.start_s:.2f}", f"{segment.end_s:.2f}", *cells, segment.report.state)
    console.print(table)


def register(app: typer.Typer, summary: str) -> None:
    app.command("gesture", help=HELP.format(summary=summary))(
        takes_request(SIMULATE_OPTIONS, gesture_from_dict, gesture_patch)(gesture)
    )
