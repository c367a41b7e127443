"""`vocalis static`: the shape of the folds at rest, without air pressure."""

import csv
import io
from typing import Annotated, Any

import typer
from rich.console import Console

from vfcore.io.atomic import write_bytes
from vfcore.io.result_document import json_text, posture_document
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Simulation
from vocalis.cli.options import SHAPE_OPTIONS, takes_request
from vocalis.cli.outputs import check_writable, save
from vocalis.cli.tables import print_static_shape

HELP = """
{summary}

One fold of the pair, from the anterior end (x = 0) to the vocal process; the other is its mirror image. TA bulges the
fold medially, most at its inferior edge; CT straightens it; PCA leaves the back open.

- `vocalis static --lca 0.5 --ia 0.5 --ct 0.1 --ta 0.8` — medial bulging
- `vocalis static --pca 0.5 --csv shape.csv` — the curves, in metres
"""
_COLUMNS = ("x_m", "superior_m", "inferior_m", "beam_m", "medial_superior_m", "medial_inferior_m")


def static(
    request: Simulation,
    json: Annotated[
        bool, typer.Option("--json", help="print JSON instead of a table", rich_help_panel="Output")
    ] = False,
    csv_path: Annotated[
        str | None, typer.Option("--csv", metavar="FILE", help="write the curves", rich_help_panel="Output")
    ] = None,
) -> None:
    """Print the static shape of a request."""
    check_writable("--csv", csv_path)
    document = posture_document(prepare(request))
    shape = document["static_shape"]
    if json:
        print(json_text(document, indent=2))
    else:
        print_static_shape(Console(), shape)
    save("--csv", csv_path, lambda path: write_bytes(path, curves_csv(shape).encode()))


def curves_csv(shape: dict[str, Any]) -> str:
    """The curves of a static shape as CSV, one row per node along the fold, m."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows(zip(*(shape[name] for name in _COLUMNS), strict=True))
    return text.getvalue()


def register(app: typer.Typer, summary: str) -> None:
    app.command("static", help=HELP.format(summary=summary))(takes_request(SHAPE_OPTIONS)(static))
