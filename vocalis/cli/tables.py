"""Results as printed tables, with millimetres, degrees and cmH2O where they are usual."""

import math
from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.table import Table

from vfcore.io.result_document import COEFFICIENTS
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.error_estimate import NO_VALUE
from vfcore.spec.schema import FOLD_CONSTANTS, POSTURING_CONSTANTS, parameter_schema

PA_PER_CMH2O = 98.0665

_CLOSURES = {
    "complete": "complete closure",
    "posterior_opening": "closed except for a posterior opening",
    "anterior_opening": "closed except for an anterior opening",
    "hourglass": "hourglass, open anteriorly and posteriorly",
    "spindle": "spindle, open in the middle",
    "open": "open along the whole length",
}


def print_measures(console: Console, document: Mapping[str, Any]) -> None:
    """Print the state and every measure; missing ones with their reason."""
    pressure = document["provenance"]["request"]["subglottal_pressure_pa"]
    console.print(document["explanation"], style="bold", highlight=False)
    console.print(f"Lung pressure {pressure:g} Pa ({pressure / PA_PER_CMH2O:.1f} cmH₂O).", highlight=False)
    console.print(f"Without air pressure: {closure_text(document['static_shape'])}.", highlight=False)
    estimate = document["error_estimate"]
    table = frameless_table("", "measure", "value>", *(("± grid error>",) if estimate else ()), "unit")
    missing: dict[str, list[str]] = {}
    group = None
    for spec in CATALOGUE:
        measure = document["measures"][spec.key]
        if group is not None and spec.group != group:
            table.add_section()
        group = spec.group
        if measure["value"] is None:
            missing.setdefault(measure["reason"], []).append(spec.name)
        text = "–" if measure["value"] is None else f"{measure['value']:.{spec.decimals}f}"
        bar = () if estimate is None else (_bar_text(estimate["measures"][spec.key]["half_width"]),)
        table.add_row(spec.symbol, spec.name, text, *bar, "" if measure["unit"] == "1" else measure["unit"])
    console.print(table)
    if estimate is not None:
        print_error_estimate(console, estimate)
    for reason, names in missing.items():
        console.print(f"– {', '.join(names)}: {reason}", highlight=False, style="dim")


def print_error_estimate(console: Console, estimate: Mapping[str, Any]) -> None:
    """Print the grids of the error bars, and why measures have none."""
    grids = ", ".join(f"{level['nx']} × {level['ny']}" for level in estimate["levels"])
    console.print(f"Grid error from runs on {grids} nodes: {estimate['method']}.", highlight=False, style="dim")
    without: dict[str, list[str]] = {}
    for spec in CATALOGUE:
        bar = estimate["measures"][spec.key]
        if bar["reason"] and bar["reason"] != NO_VALUE:
            without.setdefault(bar["reason"], []).append(spec.name)
    for reason, names in without.items():
        console.print(f"No error bar, {', '.join(names)}: {reason}", highlight=False, style="dim")


def _bar_text(half_width: float | None) -> str:
    return "–" if half_width is None else f"{half_width:.2g}" if half_width < 100 else f"{half_width:.0f}"


def print_posture(console: Console, document: Mapping[str, Any]) -> None:
    """Print posture and coefficients of a posture document."""
    posture = document["posture"]
    table = frameless_table("", "posture", "value>", "unit")
    angle, raw = (math.degrees(posture[key]) for key in ("glottal_half_angle_rad", "raw_glottal_half_angle_rad"))
    table.add_row("ε̄", "nominal fold strain", f"{posture['strain']:+.4f}", "")
    table.add_row("L", "fold length", f"{posture['length_m'] * 1e3:.2f}", "mm")
    table.add_row("θ_g", "glottal half-angle", f"{angle:.2f}", "°")
    if raw != angle:
        table.add_row("", "  before it is clipped at 0", f"{raw:.2f}", "°")
    table.add_section()
    for name, quantity in COEFFICIENTS.items():
        unit = quantity.unit.replace(" m-1", "/m").replace(" m-2", "/m²").replace(" m2", "·m²").replace(" m", "·m")
        table.add_row(quantity.symbol, quantity.label, f"{document['coefficients'][name]:.4g}", unit)
    console.print(table)
    console.print(f"Without air pressure: {closure_text(document['static_shape'])}.", highlight=False)


def print_static_shape(console: Console, shape: Mapping[str, Any]) -> None:
    """Print the static shape along the fold, in mm. At the medial plane the folds would meet."""
    table = frameless_table("x mm>", "superior>", "inferior>", "beam>", "gap superior>", "gap inferior>")
    edges = [("superior_m", "medial_superior_m"), ("inferior_m", "medial_inferior_m")]
    for k, x in enumerate(shape["x_m"]):
        displacements = (shape[name][k] for name in ("superior_m", "inferior_m", "beam_m"))
        gaps = (2 * max(shape[medial][k] - shape[edge][k], 0.0) for edge, medial in edges)
        table.add_row(
            f"{x * 1e3:.2f}", *(f"{value * 1e3:+.3f}" for value in displacements), *(f"{g * 1e3:.3f}" for g in gaps)
        )
    console.print(table)
    console.print("x from the anterior end; displacements towards the midline, full gaps; mm", style="dim")
    console.print(f"Without air pressure: {closure_text(shape)}.", highlight=False)


def print_constants(console: Console) -> None:
    """Print every constant that a request may override."""
    table = frameless_table("constants.…", "", "default>", "range>", "unit", "meaning")
    for row in parameter_schema():
        if row["group"] in (FOLD_CONSTANTS, POSTURING_CONSTANTS):
            name = row["key"].removeprefix("constants.")
            limits = f"{row['min']:g} … {row['max']:g}"
            table.add_row(name, row["symbol"], f"{row['default']:g}", limits, row["unit"], row["label"])
    console.print(table)


def closure_text(shape: Mapping[str, Any]) -> str:
    """The closure of a static shape as text."""
    return f"{_CLOSURES[shape['closure_pattern']]}; {shape['closed_fraction']:.0%} of the length is closed"


def frameless_table(*headers: str, header_style: str | None = None) -> Table:
    """A table without frame; columns whose header ends in > are aligned right."""
    table = Table(box=None, pad_edge=False, header_style=header_style)
    for header in headers:
        table.add_column(header.rstrip(">"), justify="right" if header.endswith(">") else "left")
    return table
