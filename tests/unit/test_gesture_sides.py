"""Voices whose folds come to differ: form of the step, no click, exact replay."""

import numpy as np
import pytest

import vfcore
from vfcore.airways.coupled import airways_of
from vfcore.runs.gesture.forms import form_of, is_compiled, is_loaded, load
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import RATE_HZ, render
from vfcore.runs.gesture.voice import BLOCK_S, BLOCK_STEPS, Voice
from vfcore.runs.setup import prepare
from vfcore.spec.request import patched, resolve
from vfcore.spec.simulation import DEFAULT_STEP_S, Run, Simulation
from vocalis.server.live.recording import Recording

MODAL = Simulation()
NODULES = {"lesions": [{"kind": "nodule", "side": "both"}]}


@pytest.mark.parametrize(
    "document",
    [
        {},
        {"model": {"variant": "human"}},
        {"model": {"variant": "text_literal"}},
        {"right": {"activation": {"ta": 0.1}}, "run": {"nx": 24}},
        NODULES,
        {"lesions": [{"kind": "polyp", "side": "left"}], "model": {"coupling": "two_way"}},
    ],
)
def test_the_form_of_a_request_is_known_before_its_posture(document):
    request = resolve(document)
    coupled = airways_of(request, DEFAULT_STEP_S) is not None
    assert form_of(request) == prepare(request).glottis.form(coupled=coupled)


def test_a_loaded_form_marches_at_once_and_is_known_to_be_compiled(monkeypatch, tmp_path):
    monkeypatch.setattr("vfcore.runs.gesture.forms.kernel_directory", lambda: tmp_path)
    form = form_of(Simulation(run=Run(nx=9, ny=5)))
    assert not is_loaded(form) and not is_compiled(form)
    load(form)
    assert is_loaded(form) and is_compiled(form)
    assert not is_loaded(form_of(Simulation(run=Run(nx=9, ny=6))))
    assert not is_compiled(form_of(Simulation(run=Run(nx=9, ny=6))))


@pytest.mark.parametrize(
    "change, walls",
    [
        ({"activation.ct": 0.9}, 1),
        ({"right.activation.ta": 0.1}, 2),
        ({"right.activation.ta": 0.4}, 2),  # the same as the left one, but not on the way there
        ({"lesions": [], "lesions.0.kind": "nodule", "lesions.0.side": "left"}, 2),
    ],
)
def test_a_voice_knows_the_form_that_a_target_needs(change, walls):
    voice = Voice(MODAL)
    form = voice.form_for(patched(MODAL, change))
    assert (form.walls, form.patched) == (walls, "lesions" in change)
    assert (form == voice.form) == (walls == 1)


def area(voice: Voice, targets) -> np.ndarray:
    return np.concatenate([voice.advance(target).record[:, 0] for target in targets])


def test_a_fold_that_begins_to_differ_makes_no_click():
    """Up to the change nothing is different, bit for bit; the change itself glides like that of both folds."""
    at = 20
    one_sided = [patched(MODAL, {"right.activation.ta": 0.4 - 0.04 * k}) for k in range(6)]
    voice = Voice(MODAL)
    changed = area(voice, [MODAL] * at + one_sided + [one_sided[-1]] * 10)
    steady = area(Voice(MODAL), [MODAL] * (at + 16))
    begin = at * BLOCK_STEPS
    assert voice.form.walls == 2
    assert np.array_equal(changed[:begin], steady[:begin])
    assert np.abs(changed - steady)[begin : begin + 20].max() < 1e-3 * steady.max(), "it departs from there"
    assert np.abs(changed - steady)[begin + 8 * BLOCK_STEPS :].max() > 0.05 * steady.max(), "to another voice"


def test_equal_folds_as_two_walls_are_the_same_voice():
    """The state is carried over exactly: what remains is the rounding of another order of sums."""
    voice = Voice(MODAL)
    apart = [patched(MODAL, {"right.activation.ta": value}) for value in (0.4 + 1e-12, 0.4)]
    sound = area(voice, [MODAL] * 10 + apart + [MODAL] * 10)
    expected = area(Voice(MODAL), [MODAL] * 22)
    assert voice.form.walls == 2
    assert np.abs(sound - expected).max() < 1e-7 * expected.max()


def test_a_gesture_of_one_side_ends_at_the_voice_of_that_side():
    ta = {"activation": {"ta": [[0.1, 0.4], [0.3, 0.25]]}}
    rendered = render(gesture_from_dict({"right": ta, "run": {"duration_s": 0.8}}))
    alone = vfcore.simulate(resolve({"right": {"activation": {"ta": 0.25}}, "run": {"duration_s": 0.8}}))
    assert rendered.contours["right.activation.ta"][[0, -1]] == pytest.approx([0.4, 0.25])
    assert rendered.contours["fo_hz"][-5] == pytest.approx(alone.report.measures["fo_hz"].value, rel=5e-3)
    assert rendered.segments[-1].report.measures["gap_mm"].value == alone.report.measures["gap_mm"].value


def test_a_lesion_may_grow():
    growing = {"lesions": [{"kind": "polyp", "side": "left", "height_mm": [[0.1, 0.0], [0.3, 0.5]]}]}
    rendered = render(gesture_from_dict(growing | {"run": {"duration_s": 0.4}}))
    grown = resolve({"lesions": [{"kind": "polyp", "side": "left", "height_mm": 0.5}]})
    assert rendered.contours["lesions.0.height_mm"][-1] == 0.5
    before, after = (rendered.waves["glottal_area_m2"][part] for part in (slice(0, 2800), slice(-2800, None)))
    assert np.abs(before - after).max() > 0.05 * before.max()
    voice = Voice(patched(grown, {"lesions.0.height_mm": 0.0}))
    voice.advance(grown)
    assert [np.abs(medial).max() for medial in voice.outline[2] - Voice(grown).outline[2]] == [0.0, 0.0]


def test_a_recorded_voice_whose_folds_came_to_differ_renders_to_the_same_samples():
    """Tolerance: none."""
    voice, recording = Voice(MODAL), Recording(MODAL)
    played, target = [], MODAL
    for k in range(30):
        if k >= 12:
            target = patched(MODAL, {"right.activation.ta": max(0.1, 0.4 - 0.05 * (k - 11))})
        played.append(voice.advance(target).audio_pa)
        recording.take(voice.blocks, target)
    rendered = render(gesture_from_dict(recording.document()))
    assert len(rendered.waves["time_s"]) == round(30 * BLOCK_S * RATE_HZ)
    assert np.array_equal(rendered.audio_pa, np.concatenate(played))
