"""Grid and time step refinement: three voices on three grids with three time steps each.

The paper says only that "preliminary" studies were made. Run it with `vocalis paper --convergence`; its tables are in
docs/model/numerics.md.
"""

from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from time import perf_counter
from typing import Any, NamedTuple

from vfcore.errors import VocalisError
from vfcore.fold.stability import time_step_s
from vfcore.measures.catalogue import CATALOGUE, MeasureReport
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Activation, Simulation
from vocalis.studies.paper.cases import MODAL
from vocalis.studies.paper.convergence.shear import shear_rows
from vocalis.studies.paper.run.document import plain_number, provenance
from vocalis.studies.paper.run.gather import Failure

#: The paper's grid, and each spacing halved twice.
GRIDS = ((20, 10), (40, 20), (80, 40))
#: The default step of the grid is divided by these.
DIVISORS = (1, 2, 4)
VOICES = {
    "modal": MODAL,
    "PCA 0.5": MODAL | {"pca": 0.5},
    "high pitch (CT 1, TA 0.1)": MODAL | {"ct": 1.0, "ta": 0.1},
}
#: Largest allowed relative change by the last refinement.
BOUNDS = {"fo_hz": 0.005, "closed_quotient": 0.05, "contact_pressure_max_pa": 0.05}
REPORTED = ("fo_hz", "closed_quotient", "speed_quotient", "mean_flow_ml_s", "contact_pressure_max_pa")


class Cell(NamedTuple):
    """One run of the table."""

    voice: str
    request: Simulation


def cells() -> Iterator[Cell]:
    """All runs, coarse to fine grids, long to short steps within a grid."""
    for voice, activation in VOICES.items():
        for nx, ny in GRIDS:
            base = Simulation(activation=Activation(**activation))
            base = replace(base, run=replace(base.run, nx=nx, ny=ny))
            step = time_step_s(base.run, prepare(base).glottis)
            for divisor in DIVISORS:
                yield Cell(voice, replace(base, run=replace(base.run, time_step_s=step / divisor)))


def convergence_document(
    pool: ProcessPoolExecutor, progress: Callable[[str, int, int], None] = lambda case, done, total: None
) -> dict[str, Any]:
    """Run both studies: grids and steps of three voices, and the two shear forms on more and more rows."""
    began = perf_counter()
    asked = list(cells())
    # The longest first, so that it does not run alone at the end.
    order = sorted(range(len(asked)), key=lambda k: -_work(asked[k].request))
    begun = {k: pool.submit(measured, asked[k].request) for k in order}
    shear = shear_rows(pool)
    rows = []
    for k, cell in enumerate(asked):
        rows.append(_row(cell, begun[k].result()))
        progress(cell.voice, k + 1, len(asked))
    return {
        "kind": "convergence",
        "provenance": provenance(),
        "rows": rows,
        "shear": [row() for row in shear],
        "seconds": round(perf_counter() - began, 1),
    }


def measured(request: Simulation) -> MeasureReport | Failure:
    """One run, in a worker."""
    try:
        return simulate(request).report
    except VocalisError as error:
        return Failure(str(error))


def _work(request: Simulation) -> float:
    return request.run.nx * request.run.ny / request.run.step_s


def _row(cell: Cell, answer: MeasureReport | Failure) -> dict[str, Any]:
    run = cell.request.run
    row = {"voice": cell.voice, "nx": run.nx, "ny": run.ny, "time_step_us": plain_number(run.step_s * 1e6)}
    if isinstance(answer, Failure):
        return row | {"state": "failed", "reason": answer.reason, "measures": dict.fromkeys(REPORTED)}
    values = {key: answer.measures[key].value for key in REPORTED}
    return row | {"state": answer.state, "measures": {key: plain_number(value) for key, value in values.items()}}


def last_changes(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Per voice and measure of BOUNDS, the relative change by the last refinement of the grid and of the step.

    Each is None where a value is missing or 0; ``met`` says whether both are within the bound.
    """
    found = []
    for voice in VOICES:
        own = [row for row in rows if row["voice"] == voice]
        shortest = own[len(DIVISORS) - 1 :: len(DIVISORS)]
        for key, bound in BOUNDS.items():
            coarse, before, after = (row["measures"][key] for row in shortest)
            longer = own[-2]["measures"][key]
            changes = {
                "first_grid": _change(coarse, before),
                "last_grid": _change(before, after),
                "last_step": _change(longer, after),
            }
            checked = [changes["last_grid"], changes["last_step"]]
            met = all(change is not None and abs(change) < bound for change in checked)
            absent = all(row["measures"][key] == 0 for row in own)
            found.append({"voice": voice, "measure": CATALOGUE[key].symbol, "bound": bound, "met": met or absent,
                          "absent": absent} | changes)  # fmt: skip
    return found


def _change(before: float | None, after: float | None) -> float | None:
    return None if not before or after is None else after / before - 1.0
