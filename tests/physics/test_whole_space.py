"""Every valid request gives a finite, bounded result or an error with a reason."""

import dataclasses
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import vfcore
from vfcore.errors import VocalisError
from vfcore.fold.constants import FoldConstants
from vfcore.fold.step import LARGEST_DISPLACEMENT_M
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.posture_sets import POSTURE_SETS
from vfcore.spec.simulation import (
    COUPLING_GRADIENTS,
    COUPLINGS,
    SHEAR_FORMS,
    VARIANTS,
    VOWELS,
    Activation,
    Model,
    PostureOverride,
    Run,
    Simulation,
)

GRIDS = [(20, 10), (12, 6), (6, 3)]
MAY_BE_NAN = {"contact_location"}


def within(low, high, default=None):
    """The closed range, its ends more often than by chance; large ranges on a logarithmic scale."""
    ends = [low, high] if default is None else [low, high, default]
    if low > 0 and high / low > 100:
        inside = st.floats(math.log(low), math.log(high)).map(lambda power: min(max(math.exp(power), low), high))
    else:
        inside = st.floats(low, high)
    return st.one_of(st.sampled_from(ends), inside)


def box(kind):
    """A dataclass of declared quantities, each drawn from its declared range."""
    ranges = {
        field.name: within(field.metadata["low"], field.metadata["high"])
        for field in dataclasses.fields(kind)
        if "low" in field.metadata
    }
    return st.builds(kind, **ranges)


def constants():
    """The paper's constants with up to three of them moved anywhere in their range."""
    fields = dataclasses.fields(FoldConstants)
    one = st.sampled_from(fields).flatmap(
        lambda field: st.tuples(
            st.just(field.name), within(field.metadata["low"], field.metadata["high"], field.default)
        )
    )
    return st.lists(one, max_size=3).map(lambda changes: FoldConstants(**dict(changes)))


MODELS = st.builds(
    Model,
    variant=st.sampled_from(sorted(VARIANTS)),
    posture_set=st.sampled_from([None, *POSTURE_SETS]),
    coupling_gradient=st.sampled_from([None, *COUPLING_GRADIENTS]),
    shear=st.sampled_from([None, *SHEAR_FORMS]),
    coupling=st.sampled_from([None, *COUPLINGS]),
)
RUNS = st.builds(
    lambda grid, duration, start, rise: Run(duration, *grid, start=start, pressure_rise_s=rise),
    st.sampled_from(GRIDS),
    st.floats(0.02, 0.03),
    st.sampled_from(["flat", "static"]),
    st.sampled_from([0.0, 0.01]),
)


def check(request):
    """Run a request; True if it ran, False if it was refused with a reason."""
    try:
        result = vfcore.simulate(request)
    except VocalisError as refusal:
        assert len(str(refusal)) > 20
        return False
    arrays = result.arrays
    for name, values in arrays.items():
        assert name in MAY_BE_NAN or np.isfinite(values).all(), name
    assert np.abs(arrays["cycle_w_m"]).max() < 2 * LARGEST_DISPLACEMENT_M  # checked every 5 ms only
    assert (arrays["glottal_area_m2"] >= 0).all()
    if request.model.coupling == "one_way":  # the waves of coupled airways can draw air back through the glottis
        assert (arrays["glottal_flow_m3_s"] >= 0).all()
    assert (arrays["contact_pressure_max_pa"] >= 0).all()
    whole = result.coefficients.length_m * result.coefficients.thickness_m
    assert ((arrays["contact_area_m2"] >= 0) & (arrays["contact_area_m2"] <= whole * (1 + 1e-9))).all()
    if request.subglottal_pressure_pa == 0:
        assert not arrays["glottal_flow_m3_s"].any()
    for key, measure in result.report.measures.items():
        assert (measure.value is None) != (measure.reason is None), key
        assert measure.value is None or math.isfinite(measure.value), key
    return True


@given(
    activation=box(Activation),
    pressure=within(0, 5000, 1000),
    convergence=within(-0.02, 0.3, 0.02),
    vowel=st.sampled_from(VOWELS),
    model=MODELS,
    run=RUNS,
)
@example(Activation(ta=1, ct=0, lca=0, ia=0, pca=0), 5000.0, 0.02, "a", Model(), Run(0.03))
@example(Activation(ta=0, ct=1, lca=1, ia=1, pca=1), 5000.0, 0.3, "i", Model("text_literal"), Run(0.03, 6, 3))
@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_every_muscle_setting_pressure_and_variant(activation, pressure, convergence, vowel, model, run):
    request = Simulation(activation, pressure, convergence, vowel, model, run=run)
    check(request)


@given(posture=box(PostureOverride), ta=st.floats(0, 1), pressure=within(0, 5000, 1000), model=MODELS, run=RUNS)
@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_every_posture_given_directly(posture, ta, pressure, model, run):
    check(Simulation(Activation(ta=ta), pressure, model=model, posture=posture, run=run))


@given(
    constants=constants(),
    activation=box(Activation),
    pressure=within(0, 5000, 1000),
    shear=st.sampled_from(SHEAR_FORMS),
    run=RUNS,
)
@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_every_constant_in_its_range(constants, activation, pressure, shear, run):
    larynx = replace(PAPER_LARYNX, fold=constants)
    check(Simulation(activation, pressure, model=Model(shear=shear), larynx=larynx, run=run))


@pytest.mark.parametrize("pressure", [0.0, 2000.0])
@pytest.mark.parametrize("shear", SHEAR_FORMS)
def test_the_corners_of_the_muscle_cube_all_run(shear, pressure):
    """All 32 corners, none refused."""
    for corner in range(32):
        values = {name: float(corner >> k & 1) for k, name in enumerate(("ta", "ct", "lca", "ia", "pca"))}
        assert check(Simulation(Activation(**values), pressure, model=Model(shear=shear), run=Run(0.02, 12, 6)))
