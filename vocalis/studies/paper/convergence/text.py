"""The convergence tables as Markdown."""

from collections.abc import Mapping
from typing import Any

from vocalis.studies.paper.convergence.refinement import last_changes

_COLUMNS = {
    "fo_hz": ("f_o, Hz", "{:.2f}"),
    "closed_quotient": ("CQ", "{:.4f}"),
    "speed_quotient": ("SQ", "{:.3f}"),
    "mean_flow_ml_s": ("mean flow, mL/s", "{:.0f}"),
    "contact_pressure_max_pa": ("largest contact pressure, Pa", "{:.0f}"),
}


def convergence_tables(document: Mapping[str, Any]) -> dict[str, str]:
    """The tables of docs/model/numerics.md and, of the shear, docs/model/choices.md by the names of their marks."""
    return {
        "convergence": _table(
            ("voice", "grid, $N_x × N_y$", "step, µs", "state", *(head for head, _ in _COLUMNS.values())),
            (_run(row) for row in document["rows"]),
        ),
        "convergence criteria": _table(
            ("voice", "measure", "20 × 10 to 40 × 20", "40 × 20 to 80 × 40", "step halved, 80 × 40", "bound", "met"),
            map(_change, last_changes(document["rows"])),
        ),
        "shear": _table(
            ("shear", "$N_y$", "modes below 500 Hz", "slowest decay, 1/s", "state", "f_o, Hz",
             "neighbouring rows differ by, of the motion"),
            map(_shear, document["shear"]),
        ),
        "convergence versions": _table(
            ("model version", "made", "run time"),
            [(document["provenance"]["model_version"], document["provenance"]["created"][:10],
              f"{document['seconds']:.0f} s")],
        ),
    }  # fmt: skip


def _run(row: Mapping[str, Any]):
    grid, step = f"{row['nx']} × {row['ny']}", f"{row['time_step_us']:.3f}"
    values = (_number(row["measures"][key], form) for key, (_, form) in _COLUMNS.items())
    return (row["voice"], grid, step, row["state"], *values)


def _change(row: Mapping[str, Any]):
    changes = (_percent(row[key]) for key in ("first_grid", "last_grid", "last_step"))
    met = "never closed" if row["absent"] else "yes" if row["met"] else "no"
    return row["voice"], row["measure"], *changes, f"{100 * row['bound']:g} %", met


def _shear(row: Mapping[str, Any]):
    decay, jump = _number(row["least_decay_per_s"], "{:.1f}"), row["jump"]
    return (f"`{row['shear']}`", row["ny"], row["modes"], decay, row["state"], _number(row["fo_hz"], "{:.2f}"),
            "–" if jump is None else f"{100 * jump:.1f} %")  # fmt: skip


def _percent(value: float | None) -> str:
    return "–" if value is None else f"{100 * value:+.2f} %".replace("-", "−")


def _number(value: float | None, form: str) -> str:
    return "–" if value is None else form.format(value)


def _table(header, rows) -> str:
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)
