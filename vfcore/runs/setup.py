"""Everything of a request before anything moves: postures, glottis, static shapes."""

from collections.abc import Callable, Sequence
from dataclasses import fields
from typing import NamedTuple

import numpy as np

from vfcore.fold.assemble import Fold, Glottis, assemble
from vfcore.fold.statics import StaticShape, static_shapes_of
from vfcore.larynx.posture.equilibrium import solve_posture, solve_sides
from vfcore.larynx.posture.solution import PostureSolution
from vfcore.larynx.tissue.coefficients import Coefficients, coefficients
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Simulation

Modify = Callable[[Coefficients], Coefficients]


class GlottisSetup(NamedTuple):
    """Posture, glottis and static shape of a request, before anything moves.

    ``postures`` and ``statics``: one of each wall of the glottis, the left fold first.
    """

    postures: tuple[PostureSolution, ...]
    glottis: Glottis
    statics: tuple[StaticShape, ...]

    @property
    def posture(self) -> PostureSolution:
        """The posture; of two different folds the mean of both."""
        return mean_posture(self.postures)

    @property
    def fold(self) -> Fold:
        """The fold; of two different ones the left."""
        return self.glottis.walls[0]

    @property
    def static(self) -> StaticShape:
        """The static shape of ``fold``."""
        return self.statics[0]


def mean_posture(postures: Sequence[PostureSolution]) -> PostureSolution:
    """The mean of every number of the postures of both sides; the half-angle is that of the mean gap and length."""
    if len(postures) == 1:
        return postures[0]
    left, right = postures
    values = {spec.name: (getattr(left, spec.name), getattr(right, spec.name)) for spec in fields(PostureSolution)}
    mean = {
        name: left if left is None or left == right else 0.5 * (left + right) for name, (left, right) in values.items()
    }
    half_gaps = [posture.length_m * np.tan(posture.glottal_half_angle_rad) for posture in postures]
    angle = np.arctan(0.5 * (half_gaps[0] + half_gaps[1]) / mean["length_m"])
    # Processes that touch close the glottis exactly, but for rounding.
    mean["contact_plane_m"] = None  # of a side
    mean["glottal_half_angle_rad"] = float(angle) if abs(angle) > 1e-12 else 0.0
    return PostureSolution(**mean)


def posture_of(request: Simulation) -> PostureSolution:
    """The posture of a request for one fold: solved from the muscles, or given directly."""
    L_0 = request.constants.L_0_m
    given = request.posture
    if given is None:
        return solve_posture(request.activation, request.posturing, L_0)
    half_gap = np.tan(given.glottal_half_angle_rad) * L_0 * (1.0 + given.strain)
    nan = float("nan")
    return PostureSolution(
        given.strain, given.glottal_half_angle_rad, given.glottal_half_angle_rad, L_0 * (1.0 + given.strain),
        float(half_gap), nan, nan, nan, nan, nan, residual=0.0, converged=True,
    )  # fmt: skip


def postures_of(folds: Sequence[Simulation]) -> tuple[PostureSolution, ...]:
    """The posture of each fold of a request. Two sides that both follow their muscles are solved together; a side whose
    posture is given has that posture, and the other is solved as if it had a mirror image.
    """
    if len(folds) == 1 or any(fold.posture is not None for fold in folds):
        return tuple(posture_of(fold) for fold in folds)
    left, right = folds
    if left.activation == right.activation and left.posturing == right.posturing:
        return posture_of(left), posture_of(right)
    return solve_sides(
        left.activation,
        right.activation,
        left.posturing,
        right.posturing,
        left.constants.L_0_m,
        right.constants.L_0_m,
    )


def prepare(request: Simulation, modify: Modify = lambda c: c) -> GlottisSetup:
    """Posture, prestrained coefficients and static shape of a request (milliseconds).

    ``modify`` may change the coefficients before the folds are made of them: for studies of what the paper leaves open.
    Raises PostureError, ParameterError or StaticShapeError.
    """
    folds = folds_of(request)
    postures = postures_of(folds)
    glottis = glottis_of(folds, postures, modify)
    return GlottisSetup(postures, glottis, static_shapes_of(glottis))


def glottis_of(
    folds: Sequence[Simulation], postures: Sequence[PostureSolution], modify: Modify = lambda c: c
) -> Glottis:
    """The glottis of the folds of a request in their postures. ParameterError where one has no stiffness left."""
    return Glottis(tuple(fold_of(fold, posture, modify) for fold, posture in zip(folds, postures, strict=True)))


def fold_of(request: Simulation, posture: PostureSolution, modify: Modify = lambda c: c) -> Fold:
    """The prestrained fold of a request in its posture. Raises ParameterError where it has no stiffness left."""
    rest_angle = request.posture.rest_angle_rad if request.posture else request.constants.rest_angle_rad
    c = modify(coefficients(posture.strain, request.activation.ta, request.constants))
    return assemble(request, posture.strain, c, posture.glottal_half_angle_rad, rest_angle)


def static_shape(request: Simulation) -> StaticShape:
    """The fold at zero lung pressure: a direct solve with contact; of two different folds the left."""
    return prepare(request).static
