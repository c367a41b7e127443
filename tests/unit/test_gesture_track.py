"""Breakpoints: linear interpolation, refusals with a path, and a document round trip."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

import vfcore
from vfcore.errors import ParameterError
from vfcore.runs.gesture.gesture import Gesture, gesture_from_dict, gesture_patch, gesture_to_dict
from vfcore.runs.gesture.track import Track
from vocalis.cli.requests import request_patch


def test_straight_lines_between_and_constant_outside():
    track = Track("activation.ct", (0.5, 1.5), (0.2, 0.8))
    assert [track.at(t) for t in (0.0, 0.5, 1.0, 1.5, 9.0)] == pytest.approx([0.2, 0.2, 0.5, 0.8, 0.8], rel=1e-12)


@given(st.lists(st.floats(0, 1), min_size=2, max_size=6), st.floats(0, 6))
def test_never_beyond_its_own_values(values, time):
    track = Track("activation.ct", tuple(float(k) for k in range(len(values))), tuple(values))
    assert min(values) - 1e-12 <= track.at(time) <= max(values) + 1e-12


@pytest.mark.parametrize(
    "document, path, message",
    [
        ({"activation": {"ct": [[0, 0.1], [0, 0.2]]}}, "activation.ct.1.0", "is not after"),
        ({"activation": {"ct": [[0, 0.1], [1, 1.2]]}}, "activation.ct.1.1", "out of range"),
        ({"activation": {"ct": [[0, 0.1], [1]]}}, "activation.ct.1", "is not a breakpoint"),
        ({"activation": {"ct": [[0, True]]}}, "activation.ct.0.1", "is not a number"),
        ({"activation": {"ct": []}}, "activation.ct", "has no breakpoints"),
        ({"run": {"duration_s": [[0, 1]]}}, "run.duration_s", "cannot move"),
        ({"constants": {"K_col_pa_m": [[0, 1.0]]}}, "constants.K_col_pa_m", "out of range"),
        ({"constants": {"K_col_pa_m": [[0, 1e6], [1, 1.0]]}}, "constants.K_col_pa_m.1.1", "out of range"),
    ],
)
def test_a_bad_breakpoint_is_refused_by_its_path(document, path, message):
    with pytest.raises(ParameterError) as caught:
        gesture_from_dict(document)
    assert caught.value.path == path
    assert message in caught.value.message


def test_a_posture_moves_only_where_there_is_one():
    with pytest.raises(ParameterError, match="a posture that is not given"):
        Gesture(vfcore.Simulation(), (Track("posture.strain", (0.0,), (0.1,)),))


@pytest.mark.parametrize("kind", [{}, {"kind": "gesture"}, {"kind": "simulation"}])
def test_a_gesture_document_may_name_its_kind(tmp_path, kind):
    document = {"activation": {"ct": [[0.0, 0.1], [1.0, 0.9]]}}
    wanted = gesture_from_dict(document)
    assert gesture_from_dict(document | kind) == wanted
    file = tmp_path / "gesture.json"
    file.write_text(json.dumps(document | kind))
    assert gesture_from_dict(request_patch(None, str(file), {}, [], gesture_patch)) == wanted


@pytest.mark.parametrize("kind", ["sweep", None, []])
def test_a_document_of_another_kind_is_no_gesture(kind):
    with pytest.raises(ParameterError, match=r"^kind: .*gesture \| simulation"):
        gesture_from_dict({"kind": kind})


def test_a_document_comes_back_as_it_was():
    document = {
        "activation": {"ct": [[0.0, 0.1], [1.0, 0.9]]},
        "subglottal_pressure_pa": [[0.2, 300.0], [0.4, 900.0]],
        "constants": {"L_0_posture_m": [[0.0, 0.0173], [1.0, 0.016]]},
    }
    gesture = gesture_from_dict(document)
    again = gesture_to_dict(gesture)
    assert again["activation"]["ct"] == document["activation"]["ct"]
    assert again["subglottal_pressure_pa"] == document["subglottal_pressure_pa"]
    assert again["constants"] == document["constants"]
    assert gesture_from_dict(again) == gesture
    assert gesture.at(0.3).subglottal_pressure_pa == pytest.approx(600.0)
    assert gesture.at(1.0).posturing.value("L_0_posture_m") == 0.016
