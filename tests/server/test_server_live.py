"""A played voice over the web socket: sound without gaps that follows the hand, exact replay."""

import numpy as np
import pytest

from tests.server.live_client import Heard, voice
from vfcore.io.audio import FULL_SCALE_PA
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import render


def test_blocks_come_in_order_in_real_time_and_sound(voice_server):
    with voice(voice_server) as socket:
        heard = Heard(socket).listen(1.5)
    assert heard.sequence == list(range(len(heard.sequence)))
    assert 138 <= len(heard.sequence) <= 180  # 150, and what waited for a client that woke late
    assert all(len(block) == 480 for block in heard.blocks)
    sound = np.concatenate(heard.blocks)
    assert 0.01 < np.abs(sound).max() < 0.5
    assert heard.said[0] | {"model_version": ""} == {
        "type": "ready", "rate_hz": 48000, "block": 480, "full_scale_pa": FULL_SCALE_PA, "model_version": "",
    }  # fmt: skip
    assert heard.states[-1]["fo_hz"] == pytest.approx(149.6, abs=0.5)


def test_the_voice_follows_the_hand(voice_server):
    with voice(voice_server) as socket:
        heard = Heard(socket)
        heard.send(activation={"ct": 0.1})
        low = heard.listen(0.6).states[-1]
        heard.send(activation={"ct": 0.9})
        high = heard.listen(0.6).states[-1]
        heard.send(subglottal_pressure_pa=0)
        silent = heard.listen(1.0).states[-1]
    assert low["fo_hz"] == pytest.approx(125.3, abs=1)
    assert high["fo_hz"] == pytest.approx(177.7, abs=1)
    assert high["length_m"] > low["length_m"]
    assert silent["fo_hz"] is None
    assert np.abs(np.concatenate(heard.blocks[-20:])).max() < 0.02 * np.abs(np.concatenate(heard.blocks[:60])).max()


@pytest.mark.parametrize(
    "message, path",
    [
        ("[1", "message"),
        ("3", "message"),
        ("{" + " " * 20_000 + "}", "message"),
        (b"\x00\x01", "message"),
        ('{"activation": {"ct": 2}}', "activation.ct"),
        ('{"activation": {"xx": 0}}', "activation.xx"),
        ('{"run": {"nx": 30}}', "model"),
        ('{"buffer_ms": -1}', "buffer_ms"),
        ('{"record": 1}', "record"),
        ('{"stamp": 0.5}', "stamp"),
    ],
)
def test_what_cannot_be_understood_is_said_and_the_voice_goes_on(voice_server, message, path):
    with voice(voice_server) as socket:
        heard = Heard(socket).listen(0.05)
        socket.send(message)
        heard.listen(10, until="problem")
        assert heard.problems[-1]["errors"][0]["path"] == path
        assert Heard(socket).listen(0.1).blocks


def test_the_block_that_first_follows_a_stamped_movement_is_named(voice_server):
    with voice(voice_server) as socket:
        heard = Heard(socket).listen(0.3)
        heard.send(subglottal_pressure_pa=0, stamp=3)
        heard.send(subglottal_pressure_pa=1, stamp=4)
        heard.listen(5, until="heard")
        if heard.said[-1]["stamp"] == 3:  # it was heard before the other came
            heard.listen(5, until="heard")
        answer = heard.said[-1]
        assert (answer["stamp"], answer["sequence"]) == (4, heard.sequence[-1] + 1), "the newest, before its block"
        heard.listen(1.0)
    loud = [float(np.abs(block).max()) for block in heard.blocks]
    follows = heard.sequence.index(answer["sequence"])
    assert max(loud[follows + 40 :]) < 0.05 * loud[follows - 1], "and what follows it dies away"


def test_a_recorded_gesture_renders_to_the_same_samples(voice_server):
    """Tolerance: none. Live and offline are one engine, so CT from 0.1 to 0.9 is the same sound bit for bit."""
    with voice(voice_server) as socket:
        heard = Heard(socket).listen(0.1)
        heard.send(record=True)
        for ct, vowel in ((0.1, "a"), (0.9, "a"), (0.9, "i"), (0.2, "i")):
            heard.listen(0.15)
            heard.send(activation={"ct": ct, "pca": ct / 4}, vowel=vowel)
        heard.listen(0.3)
        heard.send(record=False)
        heard.listen(5, until="gesture")
    kept = heard.said[-1]
    first = kept["first_sequence"]
    rendered = render(gesture_from_dict(kept["gesture"]))
    count = len(rendered.audio_pa) // 480
    assert count > 60
    played = np.concatenate(heard.blocks[first : first + count])
    assert np.array_equal(played, (rendered.audio_pa / FULL_SCALE_PA).astype("<f4")[: len(played)])
    assert len(rendered.segments) > 3
    assert {0.1, 0.9, 0.2} <= {value for _, value in kept["gesture"]["activation"]["ct"]}
