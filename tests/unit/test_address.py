"""Equal computations have equal addresses: random requests over all variants, posture sets and couplings."""

import dataclasses
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vfcore.errors import ParameterError
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.gesture.gesture import MOVABLE, gesture_from_dict
from vfcore.runs.sweep import sweep_from_dict
from vfcore.spec.address import address, computation
from vfcore.spec.larynx import CONSTANTS
from vfcore.spec.paths import DECLARATIONS, NUMBERS
from vfcore.spec.posture_sets import POSTURE_SETS
from vfcore.spec.request import document_of, flat, nested, patch_of, patched, resolve, values_of
from vfcore.spec.simulation import COUPLING_GRADIENTS, COUPLINGS, SHEAR_FORMS, VARIANTS, Simulation
from vocalis.cli.requests import request_patch

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
    """Values that a variant or posture set has at a path, which reveal mixed-up defaults."""
    name = path.removeprefix("constants.")
    if path.startswith("constants."):
        requests = [resolve({"model": {"variant": v}}) for v in VARIANTS]
        requests += [resolve({"model": {"posture_set": s}}) for s in POSTURE_SETS]
        return sorted({constant(request, name) for request in requests})
    default = DECLARATIONS[path].default
    return [DECLARATIONS[path].metadata["low"] if default is None else default]


def constant(request: Simulation, name: str) -> float:
    """One constant, found without the code under test."""
    for table in (request.larynx.fold, request.larynx.airways):
        if hasattr(table, name):
            return getattr(table, name)
    return request.larynx.posturing.value(name)


def values_at(path: str):
    metadata = DECLARATIONS[path].metadata
    if metadata["type"] == "integer":
        return st.integers(metadata["low"], metadata["high"])
    return st.sampled_from(known_values(path)) | st.floats(metadata["low"], metadata["high"])


CHANGED_BY_VARIANTS = [f"constants.{change.name}" for variant in VARIANTS.values() for change in variant.changes]
paths = st.sampled_from(NUMBERS) | st.sampled_from(CHANGED_BY_VARIANTS)
patches = st.lists(paths, max_size=4, unique=True).flatmap(
    lambda chosen: st.fixed_dictionaries({path: values_at(path) for path in chosen})
)


def asking(patch: dict[str, float], model: dict[str, str | None]) -> dict:
    """The patch and the model as a document, as scripts write it."""
    return nested(patch | {f"model.{name}": choice for name, choice in model.items()})


def resolved(document: dict) -> Simulation | None:
    try:
        return resolve(document)
    except ParameterError:
        return None  # inconsistent numbers


def meaning(request: Simulation) -> tuple:
    """The values that a request resolves to, found without the code under test."""
    return (
        *(getattr(request.model, name) for name in ("coupling_gradient", "shear", "coupling")),
        *(constant(request, name) for name in CONSTANTS),
        request.activation, request.posture, request.run, request.vowel,
        request.subglottal_pressure_pa, request.convergence_angle_rad,
    )  # fmt: skip


@given(models, patches, models, patches)
def test_two_requests_have_one_address_exactly_when_they_compute_the_same(model, patch, other_model, other_patch):
    one, other = resolved(asking(patch, model)), resolved(asking(other_patch, other_model))
    if one is not None and other is not None:
        assert (address(one) == address(other)) == (meaning(one) == meaning(other))


@given(models, patches)
def test_naming_a_default_changes_nothing(model, patch):
    """A request with all its resolved values is the same computation."""
    request = resolved(asking(patch, model))
    if request is None:
        return
    spelled = dataclasses.asdict(request.model)
    constants = {name: constant(request, name) for name in CONSTANTS}
    full = asking(patch, spelled) | {"constants": constants}
    assert address(resolve(full)) == address(request)
    assert resolve(full) == request


@pytest.mark.parametrize("variant", VARIANTS)
def test_a_variant_is_the_paper_with_its_choices_and_constants(variant):
    chosen = VARIANTS[variant]
    names = ("posture_set", "coupling_gradient", "shear", "coupling")
    spelled = {"model": {name: getattr(chosen, name) for name in names}, "constants": dict(chosen.overrides)}
    assert address(resolve(spelled)) == address(resolve({"model": {"variant": variant}}))


@given(models, patches, patches)
def test_a_point_of_a_sweep_has_the_computation_and_address_of_its_own_request(model, base, point):
    if resolved(asking(base, model)) is None:
        return
    sweep = sweep_from_dict({"base": asking(base, model), "points": [point]})
    alone = resolved(asking(base | point, model))
    if alone is None:
        return
    assert sweep.request(0) == alone
    assert sweep.computation(0) == computation(alone)
    spelled = sweep_from_dict({"base": asking(base | point, model), "points": [{}]})
    assert sweep.address(0) == spelled.address(0)


@given(models, patches, patches)
def test_every_form_of_a_request_gives_the_same_request(model, base, patch):
    """Document, patch, patch on a request, shortest patch, complete document: one request."""
    asked = asking(base | patch, model)
    request, start = resolved(asked), resolved(asking(base, model))
    if request is None or start is None:
        return
    assert resolve(flat(asked)) == request
    assert patched(start, patch) == request
    assert patched(resolve(), flat(asked)) == request
    assert resolve(patch_of(request)) == request
    assert resolve(document_of(request)) == request
    assert document_of(resolve(document_of(request))) == document_of(request)
    assert resolve(values_of(request)) == request
    words = [f"{path}={json.dumps(value)}" for path, value in flat(asked).items()]
    assert resolve(request_patch(None, None, {}, words)) == request, "the command line"
    moving = {p: [[0.0, v], [9.0, v]] if p in MOVABLE and v is not None else v for p, v in flat(asked).items()}
    still = gesture_from_dict(nested(moving))
    assert still.at(0.0) == request == still.start, "a gesture in which nothing moves"


@given(models, patches)
def test_the_shortest_patch_omits_the_choices_of_the_variant(model, patch):
    request = resolved(asking(patch, model))
    if request is None:
        return
    shortest = patch_of(request)
    for path in shortest:
        if path.startswith("posture."):
            continue  # a given posture is named in full
        without = {other: value for other, value in shortest.items() if other != path}
        assert resolved(without) != request, f"{path} says nothing"


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
        resolve({part: None})
    assert refusal.value.path == part and "null" in refusal.value.message
    assert resolve({"posture": None}) == PAPER
