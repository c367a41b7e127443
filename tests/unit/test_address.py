"""Equal computations have equal addresses: random requests over all variants, posture sets, sides and lesions."""

import dataclasses
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vfcore.errors import ParameterError
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.gesture.gesture import MOVABLE, gesture_address, gesture_from_dict
from vfcore.runs.sweep import sweep_from_dict
from vfcore.spec.address import address, computation
from vfcore.spec.larynx import CONSTANTS
from vfcore.spec.lesions import KINDS
from vfcore.spec.paths import DECLARATIONS, LISTS, NUMBERS, known_declaration, value_at
from vfcore.spec.posture_sets import POSTURE_SETS
from vfcore.spec.request import document_of, flat, merged, nested, patch_of, patched, resolve, values_of
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import COUPLING_GRADIENTS, COUPLINGS, SHEAR_FORMS, STRETCHES, VARIANTS, Simulation
from vocalis.cli.requests import request_patch

PAPER = Simulation()
CHOICES = {
    "variant": tuple(VARIANTS),
    "posture_set": (None, *POSTURE_SETS),
    "coupling_gradient": (None, *COUPLING_GRADIENTS),
    "shear": (None, *SHEAR_FORMS),
    "coupling": (None, *COUPLINGS),
    "stretch": (None, *STRETCHES),
}
models = st.fixed_dictionaries({}, optional={name: st.sampled_from(options) for name, options in CHOICES.items()})


def known_values(path: str) -> list[float]:
    """Values that a variant, posture set or kind of lesion has at a path, which reveal mixed-up defaults."""
    path = path.removeprefix("left.").removeprefix("right.")
    if path.startswith("lesions."):
        return sorted({getattr(kind, path.split(".")[2]) for kind in KINDS.values()})
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
    metadata = known_declaration(path).metadata
    if metadata["type"] == "integer":
        return st.integers(metadata["low"], metadata["high"])
    return st.sampled_from(known_values(path)) | st.floats(metadata["low"], metadata["high"])


CHANGED_BY_VARIANTS = [f"constants.{change.name}" for variant in VARIANTS.values() for change in variant.changes]
OF_ONE_FOLD = [path for path in NUMBERS if DECLARATIONS[path].per_side]
fold_paths = st.sampled_from(OF_ONE_FOLD) | st.sampled_from(
    [path for path in CHANGED_BY_VARIANTS if "airway" not in path]
)
paths = (
    st.sampled_from(NUMBERS)
    | st.sampled_from(CHANGED_BY_VARIANTS)
    | st.builds("{}.{}".format, st.sampled_from(["left", "right"]), fold_paths | st.sampled_from(["activation.ta"]))
    | st.sampled_from(["lesions.0.height_mm", "lesions.0.x", "lesions.0.mass_ratio"])
)
#: Numbers, as a point of a sweep has them.
patches = st.lists(paths, max_size=4, unique=True).flatmap(
    lambda chosen: st.fixed_dictionaries({path: values_at(path) for path in chosen})
)
lesions = st.fixed_dictionaries(
    {},
    optional={"side": st.sampled_from(["left", "right", "both"]), "kind": st.sampled_from(list(KINDS))}
    | {name: values_at(f"lesions.0.{name}") for name, row in LISTS["lesions"].rows.items() if row.is_number},
)
#: Any values that a request may start from.
bases = st.builds(
    lambda numbers, items: flat({"lesions": items}) | numbers if items else numbers,
    patches,
    st.lists(lesions, max_size=2),
)


def asking(patch: dict[str, float], model: dict[str, str | None]) -> dict:
    """The patch and the model as a document, as scripts write it."""
    return nested(patch | {f"model.{name}": choice for name, choice in model.items()})


def resolved(document: dict) -> Simulation | None:
    try:
        return resolve(document)
    except ParameterError:
        return None  # inconsistent numbers


def meant(patch: dict, model: dict[str, str | None]) -> tuple | None:
    """What both folds of a request are computed from, once where they are equal; None for inconsistent numbers."""
    folds = []
    for side in ("left", "right"):
        own = {
            path: value for path, value in patch.items() if path.partition(".")[0] not in ("left", "right", "lesions")
        }
        own |= {path.partition(".")[2]: value for path, value in patch.items() if path.startswith(side)}
        if (request := resolved(asking(own, model))) is None:
            return None
        folds.append((meaning(request), lesions_meant(nested(patch).get("lesions", []), side)))
    return tuple(folds) if folds[0] != folds[1] else (folds[0],)


def lesions_meant(items: list[dict], side: str) -> list[tuple[float, ...]]:
    """Numbers of the lesions of a side that change something, smallest first."""
    found = []
    for item in items:
        kind = KINDS[item.get("kind") or "custom"]
        names = [name for name, row in LISTS["lesions"].rows.items() if row.is_number]
        numbers = {name: getattr(kind, name) if item.get(name) is None else item[name] for name in names}
        neutral = numbers["height_mm"] == 0 and all(numbers[name] == 1 for name in names if "ratio" in name)
        if item.get("side") in (side, "both", None) and not neutral:
            found.append(tuple(numbers.values()))
    return sorted(found)


def meaning(request: Simulation) -> tuple:
    """The values that a request without sides and lesions resolves to, found without the code under test."""
    return (
        *(getattr(request.model, name) for name in ("coupling_gradient", "shear", "coupling", "stretch")),
        *(constant(request, name) for name in CONSTANTS),
        request.activation, request.posture, request.run, request.vowel,
        request.subglottal_pressure_pa, request.convergence_angle_rad,
    )  # fmt: skip


@given(models, bases, models, bases)
def test_two_requests_have_one_address_exactly_when_they_compute_the_same(model, patch, other_model, other_patch):
    one, other = resolved(asking(patch, model)), resolved(asking(other_patch, other_model))
    if one is not None and other is not None:
        assert (address(one) == address(other)) == (meant(patch, model) == meant(other_patch, other_model))


def on(side: str, patch: dict) -> dict:
    return {f"{side}.{path}": value for path, value in patch.items()}


fold_patches = st.lists(fold_paths, min_size=1, max_size=3, unique=True).flatmap(
    lambda chosen: st.fixed_dictionaries({path: values_at(path) for path in chosen})
)


@given(models, bases, fold_patches, fold_patches)
def test_the_address_is_of_two_folds_whatever_the_request_calls_them(model, base, one, other):
    base = {path: value for path, value in base.items() if path.partition(".")[0] not in ("left", "right", "lesions")}
    two, swapped, both, plain = (
        resolved(asking(base | patch, model))
        for patch in (on("left", one) | on("right", other), on("left", other) | on("right", one),
                      on("left", one) | on("right", one), one)
    )  # fmt: skip
    if two is not None and swapped is not None:
        assert (address(two) == address(swapped)) == (len(folds_of(two)) == 1), "sides are not interchangeable"
        assert folds_of(two) == folds_of(swapped)[::-1]
    if both is not None and plain is not None:
        assert address(both) == address(plain), "a fold and its mirror image"
        assert folds_of(both) == folds_of(plain)
    alone = resolved(asking(base, model))
    if alone is not None:
        spelled = {path: value_at(alone, path) for path in one if value_at(alone, path) is not None}
        assert address(patched(alone, on("right", spelled))) == address(alone), "nothing differs"


@given(models, patches, st.lists(lesions, min_size=1, max_size=3), st.randoms())
def test_lesions_have_no_names_no_order_and_no_place_without_an_effect(model, patch, items, rng):
    patch = {path: value for path, value in patch.items() if not path.startswith("lesions")}
    request = resolved(asking(patch | flat({"lesions": items}), model))
    if request is None:
        return
    apart = [
        {name: getattr(lesion, name) for name in LISTS["lesions"].rows} | {"kind": "custom", "side": side}
        for lesion in request.lesions
        for side in (("left", "right") if lesion.side == "both" else (lesion.side,))
    ]
    apart += [{"x": 0.2}, {"side": "left", "length_mm": 9.0}]
    rng.shuffle(apart)
    other = resolve(asking(patch | flat({"lesions": apart}), model))
    assert address(other) == address(request) and folds_of(other) == folds_of(request)


@given(models, bases)
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
    names = ("posture_set", "coupling_gradient", "shear", "coupling", "stretch")
    spelled = {"model": {name: getattr(chosen, name) for name in names}, "constants": dict(chosen.overrides)}
    assert address(resolve(spelled)) == address(resolve({"model": {"variant": variant}}))


@given(models, bases, patches)
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


@given(models, bases, patches)
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


@given(models, bases)
def test_the_shortest_patch_omits_the_choices_of_the_variant(model, patch):
    request = resolved(asking(patch, model))
    if request is None:
        return
    shortest = patch_of(request)
    for path in shortest:
        if path.startswith(("posture.", "left.", "right.", "lesions.")):
            continue  # a given posture is named in full, and what a side gives is kept
        without = {other: value for other, value in shortest.items() if other != path}
        assert resolved(without) != request, f"{path} says nothing"


BASES = {
    "paper": {},
    "human": {"model.variant": "human"},
    "woman with a given posture": {
        "model": {"variant": "human_female", "posture_set": "titze2006", "coupling": "one_way"},
        "posture": {"strain": 0.1}, "constants": {"K_col_pa_m": 2e6}, "vowel": "i",
    },
}  # fmt: skip


def another_value(request: Simulation, path: str):
    """A value near the one in force, and different from it."""
    metadata, now = known_declaration(path).metadata, value_at(request, path)
    if metadata["type"] == "boolean":
        return not now
    if metadata["type"] == "choice":
        return next(option for option in metadata["options"] if option != now)
    if metadata["type"] == "integer":
        return now + 1
    low, high = metadata["low"], metadata["high"]
    if now is None or now == 0:
        return low + 0.001 * (high - low) if low >= 0 else 0.001 * high
    return now * 1.001 if low <= now * 1.001 <= high else now * 0.999


@pytest.mark.parametrize("path", [*DECLARATIONS, *(f"right.{path}" for path in OF_ONE_FOLD)])
@pytest.mark.parametrize("base", BASES.values(), ids=BASES)
def test_every_single_value_is_part_of_the_address(base, path):
    """One value changed: another address exactly when another computation, for a run and for a point of a sweep."""
    request = resolve(base)
    value = another_value(request, path)
    changed = patched(request, {path: value})
    assert changed == resolve(merged(flat(document_of(request)), {path: value})) or path.startswith("model.")
    if path.startswith("right."):
        assert len(folds_of(changed)) == 2
        left = patched(request, {path.replace("right.", "left."): value})
        assert len({address(one) for one in (request, changed, left)}) == 3
    else:
        assert (address(changed) == address(request)) == (meaning(changed) == meaning(request))
    if not path.startswith("model."):
        assert address(changed) != address(request)
    if known_declaration(path).is_number:
        sweep = sweep_from_dict({"base": base, "axes": [{"parameter": path, "values": [value]}]})
        assert sweep.computation(0) == computation(changed)
        plain = sweep_from_dict({"base": base, "points": [{}]})
        assert sweep.address(0) != plain.address(0) and sweep.content != plain.content


@pytest.mark.parametrize("base", BASES.values(), ids=BASES)
@pytest.mark.parametrize("choice", ["variant", "posture_set", "coupling_gradient", "shear", "coupling", "stretch"])
def test_a_choice_of_the_model_keeps_all_else(base, choice):
    """A patch of the model on a request is the request that names both from the start."""
    for option in DECLARATIONS[f"model.{choice}"].metadata["options"]:
        patch = {f"model.{choice}": option}
        assert patched(resolve(base), patch) == resolve(merged(flat(base), patch))


def test_a_posture_given_or_not_is_part_of_the_address():
    given, not_given = resolve({"posture": {}}), resolve({})
    assert address(given) != address(not_given) == address(patched(given, {"posture": None}))


def test_tied_numbers_of_different_types_have_the_address_of_the_single_run():
    for tied in (["subglottal_pressure_pa", "run.nx"], ["run.nx", "subglottal_pressure_pa"]):
        sweep = sweep_from_dict({"axes": [{"parameter": tied, "values": [20]}]})
        assert sweep.computation(0).address() == address(resolve({"subglottal_pressure_pa": 20, "run": {"nx": 20}}))


def test_everything_that_changes_a_sweep_changes_its_address():
    axis = {"parameter": "activation.ct", "values": [0.1, 0.2]}
    documents = [
        {"axes": [axis]},
        {"axes": [axis | {"values": [0.1, 0.3]}]},
        {"axes": [axis | {"parameter": "activation.ta"}]},
        {"axes": [axis | {"parameter": ["activation.ct", "activation.ta"]}]},
        {"axes": [axis, {"parameter": "activation.ta", "values": [0.1]}]},
        {"axes": [axis], "base": {"vowel": "i"}},
        {"axes": [axis], "measures": ["fo_hz"]},
        {"axes": [axis], "precision": "float32"},
        {"axes": [axis], "keep_waveforms": True},
        {"points": [{"activation.ct": 0.1}, {"activation.ct": 0.2}]},
        {"points": [{"activation.ct": 0.1}]},
    ]
    assert len({sweep_from_dict(document).content for document in documents}) == len(documents)
    points = {sweep_from_dict(document).address(0) for document in documents}
    assert len(points) == 6, "points differ by numbers, base, measures and precision only"


@pytest.mark.parametrize("version", ["MODEL_VERSION", "ADDRESS_VERSION"])
def test_versions_are_part_of_every_address(version, monkeypatch):
    request, gesture = resolve({}), gesture_from_dict({"activation": {"ct": [[0, 0.1], [1, 0.2]]}})

    def addresses() -> list[str]:
        sweep = sweep_from_dict({"points": [{}]})
        return [address(request), sweep.address(0), sweep.content, gesture_address(gesture)]

    old = addresses()
    monkeypatch.setattr(f"vfcore.spec.address.{version}", "another")
    new = addresses()
    assert not set(old) & set(new)


def test_a_measure_with_another_formula_gives_rows_another_address(monkeypatch):
    before = sweep_from_dict({"points": [{}]}).address(0)
    row = CATALOGUE["fo_hz"]
    monkeypatch.setitem(CATALOGUE._by_key, "fo_hz", dataclasses.replace(row, version=row.version + "x"))
    assert sweep_from_dict({"points": [{}]}).address(0) != before


def test_everything_that_moves_is_part_of_the_address_of_a_gesture():
    documents = [
        {},
        {"activation": {"ct": [[0, 0.1], [1, 0.2]]}},
        {"activation": {"ct": [[0, 0.1], [1, 0.3]]}},
        {"activation": {"ct": [[0, 0.1], [1.1, 0.2]]}},
        {"activation": {"ta": [[0, 0.1], [1, 0.2]]}},
        {"activation": {"ct": [[0, 0.1], [1, 0.2]]}, "vowel": "i"},
        {"vowel": [[0, "a"], [1, "i"]]},
        {"vowel": [[0, "a"], [1, "u"]]},
    ]
    assert len({gesture_address(gesture_from_dict(document)) for document in documents}) == len(documents)
    same = [{"vowel": [[0, "i"]], "constants": {"epsilon_2_ta": [[0, -0.0], [1, 0.1]]}},
            {"vowel": "i", "constants": {"epsilon_2_ta": [[0, 0.0], [1, 0.1]]}}]  # fmt: skip
    assert len({gesture_address(gesture_from_dict(document)) for document in same}) == 1


def test_a_later_patch_removes_or_restores_an_optional_part():
    given, none = {"posture.strain": 0.1}, {"posture": None}
    assert merged(given, none) == none and merged(none, given) == given
    assert merged(given, {"posture.strain": 0.2, "vowel": "i"}) == {"posture.strain": 0.2, "vowel": "i"}


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


PARTS_NEVER_NULL = [
    "activation",
    "model",
    "run",
    "constants",
    "lesions",
    "left.activation",
    "right.constants",
    "lesions.0",
]


@pytest.mark.parametrize("part", PARTS_NEVER_NULL)
def test_a_part_that_is_null_is_refused_by_name(part):
    for asked in ({part: None}, nested({part: None})):
        with pytest.raises(ParameterError) as refusal:
            resolve(asked)
        assert refusal.value.path == part and "null" in refusal.value.message
    for optional in ("posture", "left", "right", "left.posture", "right.posture"):
        assert address(resolve({optional: None})) == address(resolve(nested({optional: None}))) == address(PAPER)
