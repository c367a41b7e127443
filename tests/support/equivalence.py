"""Measures at the default step against those of the plain loop at the paper's step, over random postures.

``python -m tests.support.equivalence 300`` prints the report (one to two seconds per posture). The plain loop is
``vocalis.bench.reference``, equal to the twin (tests/cli/test_bench.py): semi-implicit Euler, explicit beam, 1.79 µs.
The same code measures both waves. ``python -m tests.support.equivalence 300 float32`` compares batches in single
precision with batches in double precision.
"""

import sys
from typing import NamedTuple
from unittest import mock

import numpy as np

import vfcore
from vfcore.errors import VocalisError
from vfcore.fold.march import TimeMarch
from vfcore.measures.catalogue import MeasureReport
from vfcore.runs.many import Point, run_points
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S, Activation, Simulation
from vocalis.bench.reference import plain_run

#: Largest deviation allowed where both are periodic: (measure, bound, relative).
BOUNDS = (
    ("fo_hz", 2e-4, True),
    ("closed_quotient", 3e-3, False),
    ("contact_pressure_max_pa", 8e-3, True),
    ("mean_flow_ml_s", 1.5e-3, True),
)
SAME_STATE = 0.98


class PlainMarch(TimeMarch):
    """The plain loop at the paper's step, every twentieth step recorded, with the interface of TimeMarch."""

    def run(self, samples, progress=None, stop=None):
        every = round(DEFAULT_STEP_S / PAPER_STEP_S)
        [fold] = self.glottis.walls
        plain = plain_run(fold, self.pressure_pa, samples * every * PAPER_STEP_S, PAPER_STEP_S)[::every]
        area, flow, largest = plain.T
        nowhere, none = np.full(samples, np.nan), np.zeros(samples)
        return np.column_stack([area, flow, largest, nowhere, none, np.full(samples, self.pressure_pa), none])

    def cycle(self, first_sample, last_sample, phases):
        """Flat folds: no measure needs them."""
        nx, ny = self.form.nx, self.form.ny
        return {"cycle_w_m": np.zeros((1, phases, nx, ny)), "cycle_wb_m": np.zeros((1, phases, nx))}

    oldest_sample = 0


class Comparison(NamedTuple):
    """One posture: both states, and the deviation of each measure of BOUNDS (NaN if one of the two is missing)."""

    states: tuple[str, str]
    deviations: tuple[float, ...]


def random_request(rng) -> Simulation:
    ta, ct, lca, ia = rng.random(4)
    return Simulation(
        activation=Activation(ta=ta, ct=ct, lca=lca, ia=ia, pca=0.0), subglottal_pressure_pa=rng.uniform(500.0, 2000.0)
    )


def compare(request: Simulation) -> Comparison:
    fast = vfcore.simulate(request)
    with mock.patch.object(sys.modules["vfcore.runs.one"], "TimeMarch", PlainMarch):
        slow = vfcore.simulate(request)
    return deviations(fast.report, slow.report)


def deviations(one: MeasureReport, other: MeasureReport) -> Comparison:
    found = []
    for key, _, relative in BOUNDS:
        a, b = (report.measures[key].value for report in (one, other))
        missing = a is None or b is None
        found.append(np.nan if missing else abs(a - b) / (abs(b) if relative and b else 1.0))
    return Comparison((one.state, other.state), tuple(found))


def survey(count: int, seed: int = 1) -> list[Comparison]:
    """``count`` random postures for which both runs succeed."""
    rng, found = np.random.default_rng(seed), []
    while len(found) < count:
        request = random_request(rng)
        try:
            found.append(compare(request))
        except VocalisError:
            continue
    return found


def survey_precisions(count: int, seed: int = 1) -> list[Comparison]:
    """The first ``count`` postures of ``survey``, without those that fail."""
    rng = np.random.default_rng(seed)
    requests = [random_request(rng) for _ in range(count)]
    single, double = (list(run_points(requests, precision=precision)) for precision in ("float32", "float64"))
    return [
        deviations(a.report, b.report)
        for a, b in zip(single, double, strict=True)
        if isinstance(a, Point) and isinstance(b, Point)
    ]


def report(found: list[Comparison]) -> str:
    same = [one for one in found if one.states[0] == one.states[1]]
    periodic = np.array([one.deviations for one in same if one.states[0] == "periodic"]).reshape(-1, len(BOUNDS))
    lines = [f"{len(found)} postures, same state in {len(same)}, periodic in both {len(periodic)}"]
    lines += [" / ".join(one.states) for one in found if one not in same]
    for k, (key, bound, _) in enumerate(BOUNDS):
        values = periodic[:, k][np.isfinite(periodic[:, k])]
        if values.size:
            median, ninety, most = np.percentile(values, [50, 90, 100])
            over = int((values > bound).sum())
            lines.append(
                f"{key:26s} median {median:.2e}  90 % {ninety:.2e}  max {most:.2e}  allowed {bound:.1e}  over it {over}"
            )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report((survey_precisions if "float32" in sys.argv else survey)(int(sys.argv[1]))))
