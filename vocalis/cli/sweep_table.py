"""A sweep as a table for a person: how many points in which state, and between what each measure lies."""

from collections import Counter

import numpy as np
from rich.console import Console
from rich.table import Table

from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.sweep.row import PERIODICITY
from vfcore.runs.sweep.table import SweepTable

MOST_PROBLEMS = 5


def print_sweep(console: Console, table: SweepTable) -> None:
    """States, then smallest, median and largest value of every measure, then the first problems."""
    sweep = table.sweep
    over = " × ".join(f"{' and '.join(axis.parameters)} ({len(axis.values)})" for axis in sweep.axes) or "a list"
    console.print(f"{len(sweep)} points over {over}", style="bold", highlight=False, markup=False)
    states = Counter(table.states().ravel().tolist())
    console.print(", ".join(f"{count} {state}" for state, count in states.most_common()), highlight=False)
    lines = Table(box=None, pad_edge=False, header_style="dim")
    for name, justify in (("", "left"), ("measure", "left"), ("smallest", "right"), ("median", "right"),
                          ("largest", "right"), ("unit", "left"), ("points", "right")):  # fmt: skip
        lines.add_column(name, justify=justify)
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
