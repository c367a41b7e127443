"""One computation, one address: over every variant, posture set and coupling, with random numbers of a request."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vfcore.errors import ParameterError
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.sweep import sweep_from_dict
from vfcore.runs.sweep.paths import numbers
from vfcore.spec.address import address, computation
from vfcore.spec.document import FOLD_NAMES, numeric_paths, simulation_from_dict
from vfcore.spec.posture_sets import POSTURE_SETS, constant_names
from vfcore.spec.simulation import COUPLING_GRADIENTS, COUPLINGS, SHEAR_FORMS, VARIANTS, Simulation

PAPER = Simulation()
CHOICES = {
    "variant": tuple(VARIANTS),
    "posture_set": (None, *POSTURE_SETS),
    "coupling_gradient": (None, *COUPLING_GRADIENTS),
    "shear": (None, *SHEAR_FORMS),
    "coupling": (None, *COUPLINGS),
}
models = st.fixed_dictionaries({}, optional={name: st.sampled_from(options) for name, options in CHOICES.items()})


def known_values(path: str) -> list[float]:
    """Values that some variant or posture set has at a path: where mix-ups of defaults show."""
    name = path.removeprefix("constants.")
    if path.startswith("constants."):
        requests = [simulation_from_dict({"model": {"variant": v}}) for v in VARIANTS]
        requests += [simulation_from_dict({"model": {"posture_set": s}}) for s in POSTURE_SETS]
        return sorted({constant(request, name) for request in requests})
    default = numbers()[path]["default"]
    return [numbers()[path]["min"] if default is None else default]


def constant(request: Simulation, name: str) -> float:
    return getattr(request.constants, name) if name in FOLD_NAMES else request.posturing.value(name)


def values_at(path: str):
    row = numbers()[path]
    if row["type"] == "integer":
        return st.integers(row["min"], row["max"])
    return st.sampled_from(known_values(path)) | st.floats(row["min"], row["max"])


CHANGED_BY_VARIANTS = [f"constants.{change.name}" for variant in VARIANTS.values() for change in variant.changes]
paths = st.sampled_from(numeric_paths()) | st.sampled_from(CHANGED_BY_VARIANTS)
patches = st.lists(paths, max_size=4, unique=True).flatmap(
    lambda chosen: st.fixed_dictionaries({path: values_at(path) for path in chosen})
)


def nested(patch: dict[str, float], model: dict[str, str | None]) -> dict:
    document: dict = {"model": model} if model else {}
    for path, value in patch.items():
        part, _, name = path.rpartition(".")
        (document.setdefault(part, {}) if part else document)[name] = value
    return document


def resolved(document: dict) -> Simulation | None:
    try:
        return simulation_from_dict(document)
    except ParameterError:
        return None  # numbers that do not go together


def meaning(request: Simulation) -> tuple:
    """What a request resolves to, worked out without the code under test."""
    variant = request.model.resolved()
    return (
        *(getattr(variant, name) for name in ("coupling_gradient", "shear", "coupling", "airway_scale")),
        *(constant(request, name) for name in (*FOLD_NAMES, *constant_names())),
        request.activation, request.posture, request.run, request.vowel,
        request.subglottal_pressure_pa, request.convergence_angle_rad,
    )  # fmt: skip


@given(models, patches, models, patches)
def test_two_requests_have_one_address_exactly_when_they_compute_the_same(model, patch, other_model, other_patch):
    one, other = resolved(nested(patch, model)), resolved(nested(other_patch, other_model))
    if one is not None and other is not None:
        assert (address(one) == address(other)) == (meaning(one) == meaning(other))


@given(models, patches)
def test_naming_a_default_changes_nothing(model, patch):
    """What a request resolves to, spelled out in full, is the same computation."""
    request = resolved(nested(patch, model))
    if request is None:
        return
    spelled = dataclasses.asdict(request.model)
    constants = {name: constant(request, name) for name in (*FOLD_NAMES, *constant_names())}
    full = nested(patch, spelled) | {"constants": constants}
    assert address(simulation_from_dict(full)) == address(request)
    assert simulation_from_dict(full) == request


@pytest.mark.parametrize("variant", VARIANTS)
def test_a_variant_is_the_paper_with_its_choices_and_constants(variant):
    chosen = VARIANTS[variant]
    if chosen.airway_scale != 1.0:
        pytest.skip("its airways are no constant of a request")
    names = ("posture_set", "coupling_gradient", "shear", "coupling")
    spelled = {"model": {name: getattr(chosen, name) for name in names}, "constants": dict(chosen.overrides)}
    assert address(simulation_from_dict(spelled)) == address(simulation_from_dict({"model": {"variant": variant}}))


@given(models, patches, patches)
def test_a_point_of_a_sweep_has_the_computation_and_address_of_its_own_request(model, base, point):
    if resolved(nested(base, model)) is None:
        return
    sweep = sweep_from_dict({"base": nested(base, model), "points": [point]})
    alone = resolved(nested(base | point, model))
    if alone is None:
        return
    assert sweep.request(0) == alone
    assert sweep.computation(0) == computation(alone)
    spelled = sweep_from_dict({"base": nested(base | point, model), "points": [{}]})
    assert sweep.address(0) == spelled.address(0)


def test_all_measures_by_name_are_all_measures():
    asked = {"points": [{}]}
    named = asked | {"measures": list(CATALOGUE.keys())}
    assert sweep_from_dict(asked).address(0) == sweep_from_dict(named).address(0)
    assert sweep_from_dict(asked).content == sweep_from_dict(named).content


def test_a_new_measure_gives_rows_of_all_measures_another_address(monkeypatch):
    before = sweep_from_dict({"points": [{}]})
    row = next(iter(CATALOGUE))
    old = before.address(0), before.content
    monkeypatch.setitem(CATALOGUE._by_key, "one_more", dataclasses.replace(row, key="one_more"))
    after = sweep_from_dict({"points": [{}]})
    assert (after.address(0), after.content) != old and after.address(0) != old[0]


@pytest.mark.parametrize("part", ["activation", "model", "run", "constants"])
def test_a_part_that_is_null_is_refused_by_name(part):
    with pytest.raises(ParameterError) as refusal:
        simulation_from_dict({part: None})
    assert refusal.value.path == part and "null" in refusal.value.message
    assert simulation_from_dict({"posture": None}) == PAPER
