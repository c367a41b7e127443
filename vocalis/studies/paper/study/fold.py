"""Alternative folds, for the study only."""

from dataclasses import replace

from vfcore.fold.constants import FoldConstants
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.runs.setup import GlottisSetup, prepare
from vfcore.spec.simulation import Simulation


def with_reported_alpha(request: Simulation) -> GlottisSetup:
    """The fold of a request with the bending stiffness that the authors' program reportedly uses."""
    return prepare(request, lambda c: replace(c, bending_stiffness_n_m2=reported_stiffness(c, request.constants)))


def reported_stiffness(c: Coefficients, k: FoldConstants) -> float:
    """μ̃_c, N m², with α_ta = ½(d_ta + d_lig)·2/(2ρ + 1), ρ = E_ta A_ta/(E_lig A_lig), in place of the text's
    ½(d_ta + d_lig)/(1 + ρ).

    Second-hand and not checked against that program. The form of α_lig does not matter: the reference axis is that of
    the ligament, whose lever is 0.
    """
    lam, depth = c.stretch_ratio, (k.A_lig_0_m2 + k.A_ta_0_m2) / k.b_0_m / c.stretch_ratio**0.5
    A_ta = k.A_ta_0_m2 / lam
    ratio = c.E_ta_pa * k.A_ta_0_m2 / (c.E_lig_pa * k.A_lig_0_m2)
    lever = depth / 2  # r_lig − r_ta
    more_alpha = depth * (1 / (2 * ratio + 1) - 1 / (2 * (1 + ratio)))
    return c.bending_stiffness_n_m2 + lam**3.5 * c.E_ta_pa * lever * A_ta * more_alpha
