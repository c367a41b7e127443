"""`vocalis posture`: from muscles to strain, glottal angle and the coefficients of the fold."""

from typing import Annotated

import typer
from rich.console import Console

from vfcore.io.result_document import json_text, posture_document
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Simulation
from vocalis.cli.options import POSTURE_OPTIONS, takes_request
from vocalis.cli.tables import print_constants, print_posture

HELP = """
{summary}

The statics of the larynx are solved for the five activations: cricoarytenoid and cricothyroid joints in equilibrium
with seven tissues. LCA and IA close the glottis, PCA opens it, CT lengthens the folds, TA shortens them.

- `vocalis posture` — the modal voice
- `vocalis posture --pca 0.5` — the vocal processes drawn apart
- `vocalis posture --set posture.strain=0.2` — a posture given directly
- `vocalis posture --constants` — every constant that --set can change
"""


def posture(
    request: Simulation,
    json: Annotated[
        bool, typer.Option("--json", help="print JSON instead of a table", rich_help_panel="Output")
    ] = False,
    constants: Annotated[
        bool,
        typer.Option("--constants", help="list every constant with range and unit, and stop", rich_help_panel="Output"),
    ] = False,
) -> None:
    """Print the posture of a request."""
    if constants:
        print_constants(Console())
        return
    document = posture_document(prepare(request))
    if json:
        print(json_text(document, indent=2))
    else:
        print_posture(Console(), document)


def register(app: typer.Typer, summary: str) -> None:
    app.command("posture", help=HELP.format(summary=summary))(takes_request(POSTURE_OPTIONS)(posture))
