"""`vocalis bench`: the cost of the modal voice on this machine."""

from typing import Annotated, Any

import typer
from rich.console import Console

from vfcore.io.result_document import json_text
from vocalis.bench import history
from vocalis.bench.suite import Row, machine_description, run
from vocalis.bench.work import costs
from vocalis.cli.tables import frameless_table

HELP = """
{summary}

Times are medians over interleaved rounds after a warm-up round, and the quickest round, which is the time without
contention. Timed are posture, static shape, the compiled loop at its own and at the paper's step, a plain loop for
comparison, request to stored file, answers over HTTP and maps from request to table. The forms of the step (finite
stretch, two different folds, batches) and a map of the variant human are ratios to the linear step and to the paper's
map, measured in turns; a played voice is a share of a core. Memory and compilation time are measured as well.
Operations and bytes per step are counted by running the source of the loop on counting numbers; two small loops
measure the peak rates of this core.

- `vocalis bench` — the whole table and cost against work; about five minutes
- `vocalis bench --check` — compare the ratios with earlier runs on this processor; exit code 1 for a loss over 15 %
- `vocalis bench --quick --json` — one round, no fresh processes, no history; for a script
"""


def bench(
    rounds: Annotated[int, typer.Option("--rounds", min=1, max=1000, help="interleaved rounds")] = 7,
    quick: Annotated[bool, typer.Option("--quick", help="one round, no fresh processes")] = False,
    check: Annotated[bool, typer.Option("--check", help="exit 1 if a ratio fell by over 15 %")] = False,
    json: Annotated[bool, typer.Option("--json", help="print JSON instead of a table")] = False,
) -> None:
    """Run the benchmarks and print one table."""
    watcher = Console(stderr=True)
    machine: dict[str, Any] = machine_description()
    with watcher.status("starting") as status:
        rows = run(1 if quick else rounds, fresh_processes=not quick, progress=status.update)
        work = []
        if not quick:
            status.update("cost against work")
            work = list(costs(machine["cores"] or 1))
    values = {row.key: row.value if row.quickest is None else row.quickest for row in rows}
    file = history.history_file()
    lost = history.regressions(values, history.earlier(file, machine["processor"])) if check else []
    if not quick:
        history.keep(file, machine["processor"], values)
    if json:
        lines = [row._asdict() for row in rows]
        print(json_text({"machine": machine, "rows": lines, "work": [cost._asdict() for cost in work]}, indent=2))
    else:
        _print(rows, work, machine)
    for sentence in lost:
        watcher.print(f"slower than before: {sentence}", style="red")
    if lost:
        raise typer.Exit(1)


def _print(rows: list, work: list, machine: dict) -> None:
    table = frameless_table("modal voice, 20×10 nodes", "median>", "quickest>", "", "target>")
    for row in rows:
        quickest = "" if row.quickest is None else f"{row.quickest:,.4g}"
        table.add_row(row.label, f"{row.value:,.4g}", quickest, row.unit, _target(row))
    console = Console()
    console.print(table)
    if work:
        console.print()
        table = frameless_table("cost against", "work", "ms>", "each>", "")
        for cost in work:
            table.add_row(cost.table, cost.work, f"{1e3 * cost.seconds:,.4g}", f"{cost.each:,.4g}", cost.unit)
        console.print(table)
    console.print(", ".join(f"{value}" for value in machine.values()), style="dim", highlight=False)


def _target(row: Row) -> str:
    if row.at_least is not None:
        return f"≥ {row.at_least:g}"
    return "" if row.target is None else f"≤ {row.target:g}"


def register(app: typer.Typer, summary: str) -> None:
    app.command("bench", help=HELP.format(summary=summary))(bench)
