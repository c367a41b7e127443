"""A live voice over the WebSocket: sound without gaps that follows the parameters, exact replay."""

import json

import numpy as np
import pytest

from tests.server.live_client import Received, voice
from vfcore.io.audio import FULL_SCALE_PA
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import render
from vocalis.server.live.player import Player


def test_blocks_come_in_order_in_real_time_and_sound(voice_server):
    with voice(voice_server) as socket:
        received = Received(socket).listen(1.5)
    assert received.sequence == list(range(len(received.sequence)))
    assert 138 <= len(received.sequence) <= 180  # 150, and those that were due before the client read
    assert all(len(block) == 480 for block in received.blocks)
    sound = np.concatenate(received.blocks)
    assert 0.01 < np.abs(sound).max() < 0.5
    assert received.texts[0] | {"model_version": ""} == {
        "type": "ready", "rate_hz": 48000, "block": 480, "full_scale_pa": FULL_SCALE_PA, "model_version": "",
    }  # fmt: skip
    assert received.states[-1]["fo_hz"] == pytest.approx(149.6, abs=0.5)


def test_the_voice_follows_the_parameters(voice_server):
    with voice(voice_server) as socket:
        received = Received(socket)
        received.send(activation={"ct": 0.1})
        low = received.listen(0.6).states[-1]
        received.send(activation={"ct": 0.9})
        high = received.listen(0.6).states[-1]
        received.send(subglottal_pressure_pa=0)
        silent = received.listen(1.0).states[-1]
    assert low["fo_hz"] == pytest.approx(125.3, abs=1)
    assert high["fo_hz"] == pytest.approx(177.7, abs=1)
    assert high["length_m"] > low["length_m"]
    assert silent["fo_hz"] is None
    assert (
        np.abs(np.concatenate(received.blocks[-20:])).max() < 0.02 * np.abs(np.concatenate(received.blocks[:60])).max()
    )


@pytest.mark.parametrize(
    "message, path",
    [
        ("[1", "message"),
        ("3", "message"),
        ("{" + " " * 20_000 + "}", "message"),
        (b"\x00\x01", "message"),
        ('{"activation": {"ct": 2}}', "activation.ct"),
        ('{"activation": {"xx": 0}}', "activation.xx"),
        (r'{"\ud800": 1}', r"\ud800"),
        ('{"run": {"nx": 30}}', "run"),
        ('{"model": {"shear": "rotation"}}', "model"),
        ('{"posture": {"strain": 0.1}}', "posture"),
        ('{"buffer_ms": -1}', "buffer_ms"),
        ('{"record": 1}', "record"),
        ('{"stamp": 0.5}', "stamp"),
    ],
)
def test_a_bad_message_is_reported_and_the_voice_continues(voice_server, message, path):
    with voice(voice_server) as socket:
        received = Received(socket).listen(0.05)
        socket.send(message)
        received.listen(10, until="problem")
        assert received.problems[-1]["errors"][0]["path"] == path
        assert Received(socket).listen(0.1).blocks


class Sender:
    """A client whose messages all come at once."""

    def __init__(self, *messages):
        self.texts = [json.dumps(message) for message in messages]
        self.problems = []

    def wait(self, seconds):
        pass

    def messages(self):
        return self.texts

    def send(self, text):
        frame = json.loads(text)
        if frame["type"] == "problem":
            self.problems.append(frame["problem"]["errors"][0]["path"])

    def flush(self):
        pass


def played(*messages):
    """The request of a voice that begins with these messages, and the paths that were refused."""
    client = Sender(*messages)
    player = Player(client)
    assert player.prepare()
    return player._voice.request, client.problems


def test_of_messages_that_come_at_once_only_the_bad_ones_are_dropped():
    good, bad = {"activation": {"ct": 0.9}}, {"activation": {"ct": 2}}
    request, problems = played(good, bad, {"vowel": "x"}, {"colour": 1}, {"subglottal_pressure_pa": 900})
    assert problems == ["activation.ct", "vowel", "colour"]
    assert (request.activation.ct, request.vowel, request.subglottal_pressure_pa) == (0.9, "a", 900.0)


def test_of_messages_that_come_at_once_the_newest_wins_where_a_part_comes_and_goes():
    given = {"posture": {"strain": 0.1, "glottal_half_angle_rad": 0.01}}
    request, problems = played(given, {"posture": None})
    assert (request.posture, problems) == (None, [])
    request, problems = played({"posture": None}, given)
    assert (request.posture.strain, problems) == (0.1, [])


def test_the_block_that_first_follows_a_stamped_movement_is_named(voice_server):
    with voice(voice_server) as socket:
        received = Received(socket).listen(0.3)
        received.send(subglottal_pressure_pa=0, stamp=3)
        received.send(subglottal_pressure_pa=1, stamp=4)
        received.listen(5, until="heard")
        if received.texts[-1]["stamp"] == 3:  # it was received before the other came
            received.listen(5, until="heard")
        answer = received.texts[-1]
        assert (answer["stamp"], answer["sequence"]) == (4, received.sequence[-1] + 1), "the newest, before its block"
        received.listen(1.0)
    loud = [float(np.abs(block).max()) for block in received.blocks]
    follows = received.sequence.index(answer["sequence"])
    assert max(loud[follows + 40 :]) < 0.05 * loud[follows - 1], "and what follows it dies away"


def test_a_recorded_gesture_renders_to_the_same_samples(voice_server):
    """Tolerance: none. Live and offline are one engine, so CT from 0.1 to 0.9 is the same sound bit for bit."""
    with voice(voice_server) as socket:
        received = Received(socket).listen(0.1)
        received.send(record=True)
        for ct, vowel in ((0.1, "a"), (0.9, "a"), (0.9, "i"), (0.2, "i")):
            received.listen(0.15)
            received.send(activation={"ct": ct, "pca": ct / 4}, vowel=vowel)
        received.listen(0.3)
        received.send(record=False)
        received.listen(5, until="gesture")
    kept = received.texts[-1]
    first = kept["first_sequence"]
    rendered = render(gesture_from_dict(kept["gesture"]))
    count = len(rendered.audio_pa) // 480
    assert count > 60
    played = np.concatenate(received.blocks[first : first + count])
    assert np.array_equal(played, (rendered.audio_pa / FULL_SCALE_PA).astype("<f4")[: len(played)])
    assert len(rendered.segments) > 3
    assert {0.1, 0.9, 0.2} <= {value for _, value in kept["gesture"]["activation"]["ct"]}
