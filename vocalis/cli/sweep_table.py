"""A sweep as a printed table: points by state, and the range of each measure."""

from collections import Counter

import numpy as np
from rich.console import Console

from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.sweep.row import PERIODICITY
from vfcore.runs.sweep.table import SweepTable
from vocalis.cli.tables import frameless_table

MOST_PROBLEMS = 5


def print_sweep(console: Console, table: SweepTable) -> None:
    """States, then smallest, median and largest value of every measure, then the first problems."""
    sweep = table.sweep
    over = " × ".join(f"{' and '.join(axis.parameters)} ({len(axis.values)})" for axis in sweep.axes) or "a list"
    console.print(f"{len(sweep)} points over {over}", style="bold", highlight=False, markup=False)
    states = Counter(table.states().ravel().tolist())
    console.print(", ".join(f"{count} {state}" for state, count in states.most_common()), highlight=False)
    headers = "", "measure", "smallest>", "median>", "largest>", "unit", "points>"
    lines = frameless_table(*headers, header_style="dim")
    for key, quantity in table.columns.items():
        values = table.measure(key)
        values = values[np.isfinite(values)]
        decimals = 3 if key == PERIODICITY else CATALOGUE[key].decimals
        shown = [f"{value:.{decimals}f}" for value in np.quantile(values, (0, 0.5, 1))] if values.size else ["–"] * 3
        unit = "" if quantity.unit == "1" else quantity.unit
        lines.add_row(quantity.symbol, quantity.label, *shown, unit, str(values.size))
    console.print(lines)
    for position in sorted(table.problems)[:MOST_PROBLEMS]:
        numbers = ", ".join(f"{path} = {value:g}" for path, value in sweep.numbers(position).items())
        console.print(f"{numbers}: {table.problems[position]}", style="dim", highlight=False, markup=False)
    if (more := len(table.problems) - MOST_PROBLEMS) > 0:
        console.print(f"… and {more} more points without an answer", style="dim", highlight=False)
