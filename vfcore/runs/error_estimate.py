"""How far the measures of a run are from the limit of a fine grid: Richardson error bars from two finer runs.

The run itself has spacing h = √(dx·dy) and two companions with h/1.5 and h/2, time step divided by a whole number
at least as large (more where stability asks for it). Finer and not coarser grids, because on 10 × 5 nodes the measures
are not yet on their way to the limit (docs/model/numerics.md).

With f₁ on the finest grid, f₂, f₃ on that of the run, a measure that changes one way has the observed order p of

    (h₃ᵖ − h₂ᵖ)/(h₂ᵖ − h₁ᵖ) = (f₃ − f₂)/(f₂ − f₁)

and, with R = h₃/h₁, its limit is f₃ + (f₁ − f₃) Rᵖ/(Rᵖ − 1) (Celik et al. 2008). The half width of the bar about f₃ is
that distance times a safety factor (Roache 1997): 1.25 for an observed order; 3 where the order found is below 0.5, and
the first order of the scheme is taken instead. Orders above 2 count as 2, the highest of the scheme.

Not covered: the error of the model, which is far larger, and that of the tract, which is exact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from scipy.optimize import brentq

from vfcore.errors import ParameterError
from vfcore.measures.catalogue import CATALOGUE, MeasureReport
from vfcore.spec.simulation import GRID_LIMITS, Run, Simulation

#: Refinements of the companions.
REFINEMENTS = (1.5, 2.0)
#: The orders that are accepted: contact, and the separation point on a node, are of first order, all else of second.
LOWEST_ORDER, SCHEME_ORDER, HIGHEST_ORDER = 0.5, 1.0, 2.0
SAFETY_OBSERVED, SAFETY_ASSUMED = 1.25, 3.0
#: A change below this share of the value is rounding.
ROUNDING = 1e-9
NO_VALUE = "The measure has no value here."
METHOD = "Richardson extrapolation over three grids, Roache's safety factors; docs/model/numerics.md"


class Level(NamedTuple):
    """One of the runs compared, the requested one first."""

    nx: int
    ny: int
    time_step_s: float
    phonation_state: str


@dataclass(frozen=True, slots=True)
class ErrorBar:
    """``half_width`` and ``limit`` (what a fine grid would give) in the unit of the measure, or None with ``reason``.

    ``order``: the order of convergence used; ``observed`` whether it was found in the runs or assumed.
    """

    half_width: float | None
    limit: float | None
    order: float | None
    observed: bool
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class ErrorEstimate:
    """``bars`` by key of the catalogue; ``levels``: the runs behind them."""

    levels: tuple[Level, ...]
    bars: dict[str, ErrorBar]


def companions(request: Simulation) -> tuple[Simulation, ...]:
    """The two finer requests, their time step left open.

    Raises ParameterError where a companion would exceed the limits of the grid.
    """
    return tuple(replace(request, run=_finer(request.run, by)) for by in REFINEMENTS)


def companion_step_s(step_s: float, refinement: float, longest_s: float) -> float:
    """The step of a companion: that of the run over a whole number, ``refinement`` or more, up to ``longest_s``."""
    return step_s / max(math.ceil(refinement), math.ceil(step_s / longest_s))


def _finer(run: Run, by: float) -> Run:
    nodes = {name: round((getattr(run, name) - 1) * by) + 1 for name in ("nx", "ny")}
    for name, count in nodes.items():
        if count > GRID_LIMITS[name][1]:
            most = (GRID_LIMITS[name][1] - 1) // 2 + 1
            raise ParameterError("run.error_estimate", f"would need run.{name} = {count} in its finest companion",
                                 f"run.{name} up to {most} with an error estimate")  # fmt: skip
    return replace(run, **nodes, time_step_s=None, error_estimate=False)


def without_bars(levels: Sequence[Level], reason: str) -> ErrorEstimate:
    """No measure has a bar, for one ``reason``."""
    return ErrorEstimate(tuple(levels), {spec.key: _none(reason) for spec in CATALOGUE})


def richardson(levels: Sequence[Level], reports: Sequence[MeasureReport]) -> ErrorEstimate:
    """Error bars of the first of three runs, given on three ``levels``, each finer than the one before."""
    h = [1.0 / math.sqrt((level.nx - 1) * (level.ny - 1)) for level in levels]
    bars = {s.key: _bar(h, [one.measures[s.key].value for one in reports], reports) for s in CATALOGUE}
    return ErrorEstimate(tuple(levels), bars)


def _bar(h: Sequence[float], values: Sequence[float | None], reports: Sequence[MeasureReport]) -> ErrorBar:
    if values[0] is None:
        return _none(NO_VALUE)
    states = [report.state for report in reports]
    if len(set(states)) > 1:
        return _none(f"The phonation state changes with the grid: {', '.join(states)}.")
    if states[0] == "irregular":
        return _none("Irregular phonation does not repeat: its numbers have no limit to converge to.")
    f = [value for value in values if value is not None and math.isfinite(value)]
    if len(f) < len(values):
        return _none("A finer grid gives no value.")
    first, second = f[1] - f[0], f[2] - f[1]
    small = ROUNDING * max(abs(value) for value in f)
    if abs(first) <= small and abs(second) <= small:
        return ErrorBar(0.0, f[2], None, False)
    if first * second <= 0.0:
        return _none("The measure does not change one way as the grid is refined.")
    order = _order(h, first / second)
    p, safety = (SCHEME_ORDER, SAFETY_ASSUMED) if order is None else (order, SAFETY_OBSERVED)
    gain = (h[0] / h[2]) ** p
    to_limit = (f[2] - f[0]) * gain / (gain - 1.0)
    return ErrorBar(safety * abs(to_limit), f[0] + to_limit, p, order is not None)


def _order(h: Sequence[float], ratio: float) -> float | None:
    """The order at which the changes have this ``ratio``, at most HIGHEST_ORDER; None below LOWEST_ORDER."""

    def excess(p: float) -> float:
        return (h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p) - ratio

    if excess(LOWEST_ORDER) > 0.0:
        return None
    return HIGHEST_ORDER if excess(HIGHEST_ORDER) <= 0.0 else float(brentq(excess, LOWEST_ORDER, HIGHEST_ORDER))


def _none(reason: str) -> ErrorBar:
    return ErrorBar(None, None, None, False, reason)
