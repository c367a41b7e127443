"""`vocalis bench`: what the modal voice costs on this machine."""

from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from vfcore.document import json_text
from vocalis_bench.suite import machine_description, run

HELP = """
{summary}

Times are medians over interleaved rounds, after one that does not count: posture, static shape, the compiled loop at
its own and at the paper's step, a plain loop for comparison, request to stored file, memory, compilation. Operations
and bytes a step are counted by running the loop's source on numbers that count; the best that this core can do is
measured by two small loops.

- `vocalis bench` — the whole table, about a minute
- `vocalis bench --quick --json` — one round, no fresh processes, for a script
"""


def bench(
    rounds: Annotated[int, typer.Option("--rounds", min=1, max=1000, help="interleaved rounds")] = 7,
    quick: Annotated[bool, typer.Option("--quick", help="one round, no fresh processes")] = False,
    json: Annotated[bool, typer.Option("--json", help="print JSON instead of a table")] = False,
) -> None:
    """Run the benchmarks and print one table."""
    watcher = Console(stderr=True)
    with watcher.status("starting") as status:
        rows = run(1 if quick else rounds, fresh_processes=not quick, progress=status.update)
    if json:
        print(json_text({"machine": machine_description(), "rows": [row._asdict() for row in rows]}, indent=2))
        return
    table = Table(box=None, pad_edge=False)
    for header, justify in (
        ("modal voice, 20×10 nodes", "left"),
        ("median", "right"),
        ("", "left"),
        ("at most", "right"),
    ):
        table.add_column(header, justify=justify)
    for row in rows:
        table.add_row(row.label, f"{row.value:,.4g}", row.unit, "" if row.target is None else f"{row.target:g}")
    console = Console()
    console.print(table)
    console.print(", ".join(f"{value}" for value in machine_description().values()), style="dim", highlight=False)


def register(app: typer.Typer, summary: str) -> None:
    app.command("bench", help=HELP.format(summary=summary))(bench)
