"""The factors of the calibration study: constants in ranges that have been measured or used, and a posture.

All sets are rounded, constants to two digits and activations to hundredths, so that a set can be adopted as it is. None
of these constants enters the posturing, which has its own tissues (vfcore.spec.posture_sets), so a posture is the same
with all sets.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np
from scipy.stats import qmc

from vfcore.fold.constants import FoldConstants
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Simulation

_PAPER = FoldConstants()
DIGITS, HUNDREDTHS = 2, 2
Values = dict[str, float]


@dataclass(frozen=True, slots=True)
class Factor:
    """One factor, varied between ``low`` and ``high``: on a logarithmic scale, or ``even``."""

    name: str
    unit: str
    low: float
    high: float
    even: bool = False

    def at(self, share: float) -> float:
        """The value at a share of the range."""
        if self.even:
            return self.low + (self.high - self.low) * share
        return self.low * (self.high / self.low) ** share


#: K_coup_level multiplies both ends of the coupling stiffness, K_coup_contrast the ratio of the two; contact_time is
#: C_col/K_col, 0.1 ms in the paper.
CONSTANTS = (
    Factor("C_coup_pa_s_m", "Pa·s/m", 10, 120),
    Factor("A_muc_0_m2", "m²", 5e-6, 9e-6),
    Factor("K_coup_level", "1", 1.0, 3.0),
    Factor("K_coup_contrast", "1", 0.3, 1.2),
    Factor("K_col_pa_m", "Pa/m", 8e5, 2.5e6),
    Factor("contact_time_s", "s", 7e-5, 1.5e-4),
    Factor("eta_m_pa_s", "Pa·s", 0.3, 0.9),
    Factor("G_m_pa", "Pa", 16, 120),
    Factor("sigma_2_muc_pa", "Pa", 1000, 2200),
    Factor("K_r_a_n_m", "N·m", 0.02, 0.06),
)
POSTURE = (
    Factor("lca_ia", "1", 0.5, 0.8, even=True),
    Factor("ct", "1", 0.05, 0.3, even=True),
    Factor("ta", "1", 0.2, 0.6, even=True),
    Factor("pca", "1", 0.05, 0.25, even=True),
)
FACTORS = (*CONSTANTS, *POSTURE)


def values_at(point: Iterable[float]) -> Values:
    """The factors at a point of the unit cube, one coordinate for each of FACTORS."""
    return {f.name: f.at(float(share)) for f, share in zip(FACTORS, point, strict=True)}


def constants_of(values: Mapping[str, float]) -> dict[str, float]:
    """The constants that differ from the paper's, rounded."""
    own = {f.name: values[f.name] for f in CONSTANTS if f.name in FoldConstants.__dataclass_fields__}
    spread = sqrt(values["K_coup_contrast"])
    own["K_coup_min_pa_m"] = _PAPER.K_coup_min_pa_m * values["K_coup_level"] / spread
    own["K_coup_max_pa_m"] = _PAPER.K_coup_max_pa_m * values["K_coup_level"] * spread
    own["C_col_pa_s_m"] = values["K_col_pa_m"] * values["contact_time_s"]
    return {name: float(f"{value:.{DIGITS}g}") for name, value in own.items()}


def activation_of(values: Mapping[str, float]) -> dict[str, float]:
    """The activation at which the norms are read, rounded."""
    found = {name: round(float(values[name]), HUNDREDTHS) for name in ("ct", "ta", "pca")}
    return dict.fromkeys(("lca", "ia"), round(float(values["lca_ia"]), HUNDREDTHS)) | found


def base_of(values: Mapping[str, float]) -> Simulation:
    """The request of a set."""
    return request_of(constants_of(values), activation_of(values))


def request_of(constants: Mapping[str, float], activation: Mapping[str, float]) -> Simulation:
    """A request with these, two-way coupled, with constant tension, all other constants the paper's."""
    document: dict[str, Any] = {
        "model": {"coupling": "two_way"},
        "activation": dict(activation),
        "constants": dict(constants),
    }
    return resolve(document)


def sample(count: int, seed: int) -> np.ndarray:
    """``count`` points of the unit cube on a Latin hypercube, (count, factors)."""
    return qmc.LatinHypercube(len(FACTORS), seed=seed).random(count)
