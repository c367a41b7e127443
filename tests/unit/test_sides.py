"""Two different folds and lesions: what each fold is, what is refused, and how they move in a played voice."""

import dataclasses
import json

import pytest

from vfcore.errors import ParameterError
from vfcore.runs.gesture.gesture import MOVABLE, gesture_from_dict
from vfcore.runs.gesture.slew import come_or_gone, differences, slew_limited
from vfcore.runs.gesture.voice import BLOCK_S
from vfcore.runs.sweep import sweep_from_dict
from vfcore.spec.lesions import KINDS, Lesion
from vfcore.spec.paths import DECLARATIONS, NUMBERS, NUMBERS_BEYOND, value_at
from vfcore.spec.request import document_of, flat, patched, resolve
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Simulation
from vfcore.spec.variants import VARIANTS
from vocalis.cli.requests import request_patch
from vocalis.server.live.recording import Recording

OF_ONE_FOLD = [path for path in NUMBERS if DECLARATIONS[path].per_side]
COMMON = [path for path in DECLARATIONS if not DECLARATIONS[path].per_side]
PALSY = {"activation": {"ta": 0.1}, "constants": {"K_col_pa_m": 2e6}}


def refusal(document) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        resolve(document)
    return caught.value


@pytest.mark.parametrize("variant", VARIANTS)
def test_a_fold_is_the_request_with_the_values_of_its_side(variant):
    base = {"model": {"variant": variant}, "activation": {"ct": 0.6}, "vowel": "i"}
    left, right = folds_of(resolve(base | {"right": PALSY}))
    assert left == resolve(base)
    assert right == resolve(base | {"activation": {"ct": 0.6, "ta": 0.1}, "constants": PALSY["constants"]})


def test_equal_sides_are_one_fold():
    assert folds_of(Simulation()) == (Simulation(),)
    both = folds_of(resolve({"left": PALSY, "right": PALSY}))
    assert both == (resolve(PALSY),)
    assert folds_of(resolve({"left": {}, "right": {"activation": {"ta": 0.4}}})) == (Simulation(),), "0.4 anyway"


def test_folds_are_resolved_once():
    request = resolve({"right": PALSY, "lesions": [{"kind": "polyp", "side": "left"}]})
    assert folds_of(request)[1] is folds_of(request)[1]


def test_a_side_has_its_own_posture_or_none():
    request = resolve({"right": {"posture": {"strain": 0.1}}})
    assert [fold.posture is None for fold in folds_of(request)] == [True, False]
    given = resolve({"posture": {"strain": 0.1, "rest_angle_rad": 0.3}, "left": {"posture": {"strain": 0.2}}})
    assert [fold.posture.strain for fold in folds_of(given)] == [0.2, 0.1]
    assert folds_of(given)[0].posture.rest_angle_rad == 0.3, "the rest is that of the request"
    by_muscles = resolve({"posture": {"strain": 0.1}, "left": {"posture": None}})
    assert [fold.posture is None for fold in folds_of(by_muscles)] == [True, False]
    assert resolve(document_of(by_muscles)) == by_muscles


@pytest.mark.parametrize("path", [path for path in NUMBERS_BEYOND if path.startswith(("right.", "lesions.0."))])
def test_every_number_of_a_side_or_a_lesion_is_refused_out_of_its_range_by_its_own_name(path):
    assert path in MOVABLE
    for value in (1e300, -1e300, "1", True, [1]):
        error = refusal({path: value})
        assert error.path == path and " to " in error.allowed, value


def test_errors_name_side_and_field():
    assert (
        str(refusal({"right": {"activation": {"ta": 2}}})) == "right.activation.ta: 2 is out of range; allowed: 0 to 1"
    )
    assert refusal({"left": {"constants": {"TA_epsilon_2": -0.9}}}).path == "left.constants.TA_epsilon_2"
    assert refusal({"lesions": [{}, {"x": 2}]}).path == "lesions.1.x"
    assert refusal({"lesions": [{}] * 9}).path == "lesions"


@pytest.mark.parametrize("path", [*COMMON, "lesions", "run", "model"])
def test_what_both_sides_share_is_refused_on_one(path):
    error = refusal({f"right.{path}": 1 if path != "run" else {"nx": 20}})
    assert error.path.startswith(f"right.{path}")
    assert "common to both sides" in error.message or path == "lesions"
    with pytest.raises(ParameterError) as swept:
        sweep_from_dict({"axes": [{"parameter": f"right.{path}", "values": [1]}]})
    assert f"right.{path} {error.message}" == swept.value.message


def test_air_airways_and_the_cricothyroid_joint_are_shared_and_the_arytenoids_are_not():
    shared = {path.removeprefix("constants.") for path in COMMON if path.startswith("constants.")}
    joint = {
        name for name in (path.removeprefix("constants.") for path in DECLARATIONS) if name.startswith(("k_t_", "k_r_"))
    }
    arms = {"L_0_posture_m", "cos_phi", "h_TA_m", "w_CT_m"}
    assert shared == {"alpha_s", "rho_a_kg_m3", "mu_a_pa_s", "c_a_m_s", "airway_scale"} | arms | joint


@pytest.mark.parametrize(
    "document",
    [
        {"left": 3}, {"right": []}, {"left": {"tа": 1}}, {"right": {"posture": {"x": 1}}},
        {"left": {"kind": "simulation"}}, {"left": None, "left.activation.ta": 1},
        {"lesions": {"0": {"y": 7}}}, {"lesions": "nodule"}, {"lesions": [3]}, {"lesions.0.colour": 1},
        {"lesions.8.x": 1}, {"lesions.-1.x": 1}, {"lesions.00.x": 1},
    ],
)  # fmt: skip
def test_what_no_side_and_no_lesion_has_is_refused(document):
    assert refusal(document).path.startswith(next(iter(document)).partition(".")[0])


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_brings_the_numbers_that_are_not_given(kind):
    lesion = resolve({"lesions": [{"kind": kind, "x": 0.4}]}).lesions[0]
    own = {field.name for field in dataclasses.fields(Lesion)} - {"side", "kind", "x"}
    assert {name: getattr(lesion, name) for name in own} == {name: getattr(KINDS[kind], name) for name in own}
    assert (lesion.x, lesion.side) == (0.4, "both")
    assert lesion.has_effect == (kind != "custom")


def test_another_kind_brings_other_numbers_and_keeps_those_given():
    request = resolve({"lesions": [{"kind": "nodule", "x": 0.4, "side": "left"}]})
    changed = patched(request, {"lesions.0.kind": "sulcus"}).lesions[0]
    assert changed == Lesion("left", "sulcus", x=0.4) and changed.height_mm < 0


def test_a_fold_has_the_lesions_of_its_side():
    asked = [{"kind": "polyp", "side": "right"}, {"kind": "nodule"}, {"side": "left", "x": 0.1}]
    left, right = folds_of(resolve({"lesions": asked}))
    assert [len(left.lesions), len(right.lesions)] == [1, 2], "a lesion without effect is none"
    assert all((lesion.side, lesion.kind) == ("both", "custom") for lesion in (*left.lesions, *right.lesions))
    assert {lesion.mass_ratio for lesion in right.lesions} == {1.0, KINDS["polyp"].mass_ratio}


def test_a_list_replaces_the_list_before_and_a_path_changes_one_lesion():
    request = resolve({"lesions": [{"kind": "nodule"}, {"kind": "scar"}]})
    assert [one.kind for one in patched(request, flat({"lesions": [{"kind": "polyp"}]})).lesions] == ["polyp"]
    assert patched(request, flat({"lesions": []})).lesions == ()
    raised = patched(request, {"lesions.1.height_mm": 1.0})
    assert [one.height_mm for one in raised.lesions] == [KINDS["nodule"].height_mm, 1.0]
    assert flat({"lesions": {"1": {"height_mm": 1.0}}}) == {"lesions.1.height_mm": 1.0}
    words = ["lesions.0.kind=nodule", "lesions.1.kind=scar", 'lesions=[{"x": 0.2}]', "lesions.0.kind=polyp"]
    assert resolve(request_patch(None, None, {}, words)).lesions == (Lesion(kind="polyp", x=0.2),)


def test_a_change_of_the_request_reaches_both_folds_and_leaves_what_a_side_holds():
    request = resolve({"right": PALSY, "lesions": [{"kind": "nodule"}]})
    for moved in (
        patched(request, {"activation.ta": 0.7, "activation.ct": 0.9}),
        request.with_activation(dataclasses.replace(request.activation, ta=0.7, ct=0.9)),
    ):
        left, right = folds_of(moved)
        assert (left.activation.ta, right.activation.ta) == (0.7, 0.1)
        assert left.activation.ct == right.activation.ct == 0.9
        assert len(left.lesions) == len(right.lesions) == 1 and right.constants.K_col_pa_m == 2e6
    assert len(folds_of(patched(request, {"right": None}))) == 1


def test_numbers_that_are_consistent_only_together_change_together():
    """The base and a side of it: neither change alone is possible."""
    request = resolve({"right": {"constants": {"TA_epsilon_2": -0.4}}})
    changes = {"constants.TA_epsilon_1": -0.3, "right.constants.TA_epsilon_2": -0.2}
    assert folds_of(patched(request, changes))[1].posturing.ta.epsilon_2 == -0.2
    with pytest.raises(ParameterError, match=r"^right\.constants\.TA_epsilon_2"):
        patched(request, {"constants.TA_epsilon_1": -0.3})


def test_a_sweep_ties_a_side_to_the_request_and_names_it():
    axes = [
        {"parameter": ["activation.ta", "right.activation.ta"], "values": [0.2, 0.5]},
        {"parameter": "lesions.0.height_mm", "values": [0, 1]},
    ]
    sweep = sweep_from_dict({"base": {"lesions": [{"side": "left"}]}, "axes": axes})
    assert sweep.axes[0].label == "thyroarytenoid (TA) and thyroarytenoid (TA), right fold"
    assert (sweep.axes[1].name, sweep.axes[1].unit) == ("lesions_0_height_mm", "mm")
    assert [len(folds_of(request)) for request in sweep.requests()] == [1, 2, 1, 2]
    assert len({sweep.address(k) for k in range(4)}) == 4


def test_a_point_of_a_sweep_that_is_impossible_has_an_address_of_its_own():
    points = [{}, {"lesions.2.x": 0.2}, {"right.constants.TA_epsilon_2": -0.9}]
    sweep = sweep_from_dict({"points": points})
    assert len({sweep.address(k) for k in range(3)}) == 3
    for k in (1, 2):
        with pytest.raises(ParameterError):
            sweep.request(k)


def test_sides_and_lesions_move_in_a_gesture():
    document = {
        "activation": {"ta": [[0, 0.2], [1, 0.4]]},
        "right": {"activation": {"ta": [[0, 1.0], [1, 0.0]]}, "posture": None},
        "lesions": [{"kind": "nodule", "side": "left", "height_mm": [[0, 0.0], [1, 1.0]]}],
    }
    left, right = folds_of(gesture_from_dict(document).at(0.5))
    assert (left.activation.ta, right.activation.ta) == pytest.approx((0.3, 0.5))
    assert left.lesions[0].height_mm == 0.5 and not right.lesions
    with pytest.raises(ParameterError) as caught:
        gesture_from_dict(document | {"lesions": [{"x": [[0, 0.5], [1, 2.0]]}]})
    assert caught.value.path == "lesions.0.x.1.1"
    with pytest.raises(ParameterError, match="left.posture that is not given"):
        dataclasses.replace(
            gesture_from_dict({}),
            tracks=gesture_from_dict({"left": {"posture": {"strain": [[0, 0.1], [1, 0]]}}}).tracks,
        )


def test_a_played_voice_moves_to_a_side_of_its_own_and_back():
    plain, palsy = Simulation(), resolve({"right": PALSY})
    paths = differences(plain, palsy)
    assert set(paths) == {"right.activation.ta", "right.constants.K_col_pa_m"} == set(differences(palsy, plain))
    step = slew_limited(plain, palsy, paths)
    assert [fold.activation.ta for fold in folds_of(step)] == pytest.approx([0.4, 0.2]), "a block moves 0.2 at most"
    assert differences(palsy, patched(palsy, {"activation.ta": 0.6})) == ("activation.ta",)


@pytest.mark.parametrize(
    ("patch", "part"),
    [({"activation.ta": 0.9}, None), ({"right.activation.ta": 0.9}, None), ({"posture.strain": 0.1}, "posture"),
     ({"left.posture.strain": 0.1}, "left.posture"), ({"lesions.1.x": 0.1}, "lesions"),
     ({"lesions.0.x": 0.1}, None), ({"lesions.0.side": "left"}, "lesions")],
)  # fmt: skip
def test_what_comes_or_goes_cannot_glide(patch, part):
    request = resolve({"lesions": [{"kind": "nodule"}]})
    assert come_or_gone(request, patched(request, flat(patch))) == part


def test_a_recorded_voice_is_the_one_that_was_played():
    """Also where a side follows the request before it gets values of its own, and after it gives them up."""
    targets = [resolve({"lesions": [{"kind": "nodule"}]})]
    for patch in (
        {"activation.ta": 0.5}, {"activation.ta": 0.6}, {"right.activation.ta": 0.7}, {"activation.ta": 0.65},
        {"lesions.0.height_mm": 0.3, "activation.ta": 0.7}, {"right": None}, {"activation.ta": 0.8},
        {"activation.ta": 0.7},
    ):  # fmt: skip
        targets.append(patched(targets[-1], patch))
    recording = Recording(targets[0])
    for block, target in enumerate(targets[1:], 1):
        recording.take(block, target)
    gesture = gesture_from_dict(json.loads(json.dumps(recording.document())))
    for block, target in enumerate(targets):
        for one, other in zip(folds_of(gesture.at(block * BLOCK_S)), folds_of(target), strict=True):
            assert one.activation == other.activation and one.lesions == other.lesions, block


def test_the_value_at_a_path_of_a_side_is_the_one_in_force():
    request = resolve({"right": PALSY})
    assert [value_at(request, f"{side}.activation.ta") for side in ("left", "right")] == [0.4, 0.1]
    assert value_at(request, "right.posture.strain") is None is value_at(request, "lesions.0.x")
