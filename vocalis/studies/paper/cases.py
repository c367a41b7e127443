"""The runs behind the claims, by name: what the text of the paper fixes, all else at its default.

The paper's setup is the default request: 1000 Pa, convergence angle 0.02 rad, vowel /a/, 1 s, 20 × 10 nodes.
Static figures and sweeps, for which it prints no levels, cover the whole range of the activation.
"""

from dataclasses import dataclass, field, replace
from itertools import product

from vfcore.spec.simulation import Simulation


def evenly(intervals: int) -> tuple[float, ...]:
    """0 to 1 in equal steps, ends included."""
    return tuple(k / intervals for k in range(intervals + 1))


@dataclass(frozen=True, slots=True)
class MuscleAxis:
    """One or more muscles that share the same ``levels``."""

    muscles: tuple[str, ...]
    levels: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Case:
    """A named run or set of runs; ``fixed``: the constant activations by the short names of the muscles.

    ``kind`` names its evidence: static: StaticSeries, voice: VoiceCycle, map: ActivationMap, sweep: PcaSweep,
    timing: Timing.
    """

    key: str
    title: str
    kind: str
    fixed: dict[str, float]
    axes: tuple[MuscleAxis, ...] = ()
    base: Simulation = field(default_factory=Simulation)

    def requests(self) -> list[Simulation]:
        """The requests, last axis fastest."""
        return [self._request(levels) for levels in product(*(axis.levels for axis in self.axes))]

    def _request(self, levels: tuple[float, ...]) -> Simulation:
        moved = {m: level for axis, level in zip(self.axes, levels, strict=True) for m in axis.muscles}
        return replace(self.base, activation=replace(self.base.activation, **self.fixed, **moved))


MODAL = {"lca": 0.8, "ia": 0.8, "pca": 0.0, "ct": 0.3, "ta": 0.4}
TENTHS = evenly(10)


def _modal_without(muscle: str) -> dict[str, float]:
    return {name: level for name, level in MODAL.items() if name != muscle}


_ROWS = (
    Case("static_adduction", "Static shapes, LCA = IA rising (CT 0.1, TA 0)", "static",
         {"pca": 0.0, "ct": 0.1, "ta": 0.0}, (MuscleAxis(("lca", "ia"), TENTHS),)),
    Case("static_ta", "Static shapes, TA rising (CT 0.1, LCA = IA 0.5)", "static",
         {"pca": 0.0, "ct": 0.1, "lca": 0.5, "ia": 0.5}, (MuscleAxis(("ta",), TENTHS),)),
    Case("static_ct", "Static shapes, CT rising (LCA = IA 0.5, TA 0.2)", "static",
         {"pca": 0.0, "ta": 0.2, "lca": 0.5, "ia": 0.5}, (MuscleAxis(("ct",), TENTHS),)),
    # The paper does not print this panel's CT; 0.3 is that of its modal case.
    Case("static_pca", "Static shapes, PCA rising (LCA = IA 0.8, TA 0.5, CT 0.3)", "static",
         {"ct": 0.3, "ta": 0.5, "lca": 0.8, "ia": 0.8}, (MuscleAxis(("pca",), TENTHS),)),
    Case("modal", "Modal phonation (LCA = IA 0.8, CT 0.3, TA 0.4)", "voice", MODAL),
    Case("ct_ta_map", "CT by TA map (LCA = IA 0.6)", "map",
         {"lca": 0.6, "ia": 0.6, "pca": 0.0}, (MuscleAxis(("ct",), evenly(20)), MuscleAxis(("ta",), evenly(20)))),
    Case("pca_half", "Modal phonation with PCA 0.5", "voice", MODAL | {"pca": 0.5}),
    Case("pca_full", "Modal phonation with PCA 1", "voice", MODAL | {"pca": 1.0}),
    # Steps of 0.025 resolve a cusp between the paper's printed levels.
    Case("pca_sweep", "Modal phonation, PCA rising", "sweep",
         _modal_without("pca"), (MuscleAxis(("pca",), evenly(40)),)),
    Case("timing", "Wall time of 1 s of modal phonation", "timing", MODAL),
)  # fmt: skip
CASES: dict[str, Case] = {case.key: case for case in _ROWS}
