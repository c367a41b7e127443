"""Values of a request: defaults are the paper's modal case, ranges are enforced, refusals are sentences."""

import dataclasses
import math

import pytest

from vfcore.errors import ParameterError, VocalisError
from vfcore.fold.constants import FoldConstants
from vfcore.spec.fields import check_number
from vfcore.spec.posture_sets import POSTURE_SETS
from vfcore.spec.simulation import (
    COUPLING_GRADIENTS,
    DEFAULT_STEP_S,
    GRID_LIMITS,
    PAPER_STEP_S,
    SECTION_TRAVEL_S,
    SHEAR_FORMS,
    VARIANTS,
    VOWELS,
    Activation,
    Model,
    PostureOverride,
    Run,
    Simulation,
)

BOXES = [(Activation, "activation."), (PostureOverride, "posture."), (FoldConstants, "constants.")]
NUMBERS = [
    (box, prefix, field.name) for box, prefix in BOXES for field in dataclasses.fields(box) if "low" in field.metadata
]
NUMBERS += [(Run, "run.", "duration_s"), (Run, "run.", "pressure_rise_s")]
NUMBERS += [(Simulation, "", "subglottal_pressure_pa"), (Simulation, "", "convergence_angle_rad")]


def meta(box, name):
    return next(field for field in dataclasses.fields(box) if field.name == name).metadata


def test_the_default_is_the_papers_modal_case():
    asked = Simulation()
    assert dataclasses.asdict(asked.activation) == {"ta": 0.4, "ct": 0.3, "lca": 0.8, "ia": 0.8, "pca": 0.0}
    assert (asked.subglottal_pressure_pa, asked.convergence_angle_rad, asked.vowel) == (1000.0, 0.02, "a")
    assert (asked.run.nx, asked.run.ny, asked.run.duration_s, asked.run.start) == (20, 10, 1.0, "flat")
    assert asked.posture is None and asked.run.time_step_s is None
    assert asked.posturing.set_name == "serry2026"


@pytest.mark.parametrize(("box", "prefix", "name"), NUMBERS, ids=lambda value: getattr(value, "__name__", value))
@pytest.mark.parametrize("side", ["below", "above"])
def test_every_number_is_refused_just_outside_its_range_and_taken_at_its_end(box, prefix, name, side):
    end = meta(box, name)["low" if side == "below" else "high"]
    outside = math.nextafter(end, -math.inf if side == "below" else math.inf)
    with pytest.raises(ParameterError, match="is out of range; allowed:") as refusal:
        box(**{name: outside})
    assert refusal.value.path == prefix + name
    assert f"{meta(box, name)['low']:g} to {meta(box, name)['high']:g}" in refusal.value.allowed
    if name != "pressure_rise_s":
        assert getattr(box(**{name: end}), name) == end


@pytest.mark.parametrize(("box", "prefix", "name"), NUMBERS, ids=lambda value: getattr(value, "__name__", value))
def test_every_number_is_described(box, prefix, name):
    says = meta(box, name)
    assert says["label"] and says["unit"] and says["source"]
    assert says["low"] < says["high"]
    assert says["low"] <= getattr(box(), name) <= says["high"]


@pytest.mark.parametrize("value", [math.nan, math.inf, "0.4", None, True, [0.4], 1 + 0j])
def test_values_that_are_not_numbers_are_refused(value):
    with pytest.raises(ParameterError) as refusal:
        Activation(ta=value)
    assert refusal.value.path == "activation.ta"
    assert isinstance(refusal.value, VocalisError) and isinstance(refusal.value, ValueError)


def test_an_integer_may_be_required():
    check_number("n", 3.0, 1, 5, integer=True)
    with pytest.raises(ParameterError, match="n: 3.5 is not a whole number; allowed: 1 to 5 nodes"):
        check_number("n", 3.5, 1, 5, "nodes", integer=True)


@pytest.mark.parametrize("axis", ["nx", "ny"])
def test_the_grid_has_limits(axis):
    low, high = GRID_LIMITS[axis]
    for bad in (low - 1, high + 1, low + 0.5, None, "10"):
        with pytest.raises(ParameterError) as refusal:
            Run(**{axis: bad})
        assert refusal.value.path == f"run.{axis}"
    assert getattr(Run(**{axis: low}), axis) == low and getattr(Run(**{axis: high}), axis) == high


@pytest.mark.parametrize("bad", [0.0, -1e-6, 2e-3, math.nan])
def test_a_time_step_is_positive_and_short(bad):
    with pytest.raises(ParameterError) as refusal:
        Run(time_step_s=bad)
    assert refusal.value.path == "run.time_step_s"


def test_the_steps_are_whole_travels_through_a_tract_section():
    assert SECTION_TRAVEL_S == 0.0025 / 350
    assert abs(PAPER_STEP_S - 1.7857142857142857e-6) < 1e-20
    assert DEFAULT_STEP_S == 5 * SECTION_TRAVEL_S
    assert Run().step_s == DEFAULT_STEP_S and Run(time_step_s=PAPER_STEP_S).step_s == PAPER_STEP_S


@pytest.mark.parametrize(
    ("make", "path", "options"),
    [
        (lambda: Model(variant="best"), "variant", VARIANTS),
        (lambda: Model(shear="none"), "shear", SHEAR_FORMS),
        (lambda: Model(coupling_gradient="flat"), "coupling_gradient", COUPLING_GRADIENTS),
        (lambda: Model(posture_set="mine"), "posture_set", POSTURE_SETS),
        (lambda: Model(coupling="three_way"), "coupling", ("one_way", "two_way")),
        (lambda: Run(start="warm"), "start", ("flat", "static")),
        (lambda: Simulation(vowel="y"), "vowel", VOWELS),
    ],
)
def test_an_unknown_choice_is_refused_with_the_known_ones(make, path, options):
    with pytest.raises(ParameterError, match="is not known") as refusal:
        make()
    assert refusal.value.path.endswith(path)
    assert refusal.value.allowed == " | ".join(options)


def test_none_is_refused_where_a_choice_is_required():
    with pytest.raises(ParameterError):
        Run(start=None)


def test_a_variant_sets_the_others_and_each_may_be_given_to_override():
    paper, literal = Model(), Model(variant="text_literal")
    assert (paper.posture_set, paper.coupling_gradient, paper.shear) == ("serry2026", "inferior_stiff", "kelvin_voigt")
    assert (literal.coupling_gradient, literal.shear) == ("superior_stiff", "rotation")
    mixed = Model(variant="text_literal", shear="kelvin_voigt")
    assert (mixed.coupling_gradient, mixed.shear) == ("superior_stiff", "kelvin_voigt")
    assert Simulation(model=Model(posture_set="alzamendi2020")).posturing.set_name == "alzamendi2020"


def test_a_pressure_that_rises_longer_than_the_run_is_refused():
    with pytest.raises(ParameterError, match="longer than the run") as refusal:
        Simulation(run=Run(duration_s=0.5, pressure_rise_s=0.6))
    assert refusal.value.path == "run.pressure_rise_s"
    assert "0.5" in refusal.value.allowed


def test_a_request_cannot_be_changed_once_made():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Simulation().subglottal_pressure_pa = 2.0
