"""Two different folds over the whole space of requests: a run that diverges also does so at half the step."""

import random
from dataclasses import replace

import pytest

from vfcore.errors import DivergenceError, VocalisError
from vfcore.fold.stability import time_step_s
from vfcore.runs.many import run_points
from vfcore.runs.setup import prepare
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Simulation

VARIANTS = ("paper", "paper", "human", "human_female", "text_literal")
DURATION_S = 0.15


def two_sided(draw: random.Random, every_form: bool = True) -> Simulation:
    """A request with two different folds; with ``every_form`` one in four has a lesion, one in four finite stretch
    whatever its variant.
    """

    def muscles() -> dict[str, float]:
        closing = {name: draw.uniform(0.3, 1.0) for name in ("lca", "ia")}
        return closing | {"ta": draw.random(), "ct": draw.random(), "pca": draw.choice((0.0, 0.0, draw.random()))}

    constants = {name: draw.uniform(0.5, 2.0) for name in ("sigma_2_muc_pa", "K_coup_max_pa_m", "C_coup_pa_s_m")}
    base = resolve({"model": {"variant": draw.choice(VARIANTS)}})
    scaled = {name: factor * getattr(base.constants, name) for name, factor in constants.items()}
    document = {
        "model": {"variant": base.model.variant}
        | ({"stretch": "finite"} if every_form and draw.random() < 0.25 else {}),
        "subglottal_pressure_pa": draw.uniform(300, 2500),
        "left": {"activation": muscles()},
        "right": {"activation": muscles(), "constants": scaled},
        "run": {"duration_s": DURATION_S},
    }
    if every_form and draw.random() < 0.25:
        kind = draw.choice(("nodule", "polyp", "oedema", "scar", "sulcus", "bowing"))
        document["lesions"] = [{"kind": kind, "side": draw.choice(("left", "right", "both"))}]
    return resolve(document)


def at_half_the_step(request: Simulation) -> Simulation:
    step_s = time_step_s(request.run, prepare(request).glottis)
    return replace(request, run=replace(request.run, time_step_s=step_s / 2, pressure_rise_s=0.0))


@pytest.mark.parametrize(
    ("count", "every_form"), [(40, False), pytest.param(500, True, marks=pytest.mark.slow)]
)  # every form of the step compiles for some seconds
def test_no_random_pair_of_folds_diverges_that_does_not_at_half_the_step(count, every_form):
    draw = random.Random(count)
    requests = [two_sided(draw, every_form) for _ in range(count)]
    assert all(len(request.folds) == 2 for request in requests)
    points = list(run_points(requests, measures=["fo_hz"]))
    ill = {k: point for k, point in enumerate(points) if isinstance(point, VocalisError)}
    assert all(isinstance(error, DivergenceError) for error in ill.values()), ill
    finer = run_points([at_half_the_step(requests[k]) for k in ill], measures=["fo_hz"])
    assert not [requests[k] for k, point in zip(ill, finer, strict=True) if not isinstance(point, DivergenceError)]
    assert len(ill) < 0.5 * count  # otherwise nothing was tried
