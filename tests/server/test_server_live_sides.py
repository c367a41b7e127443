"""A played voice whose folds come to differ: it sounds on while another form of the step is made, then follows."""

import json
import threading
from dataclasses import replace

import numpy as np
import pytest

from tests.server.live_client import Received, voice
from vfcore.io.audio import FULL_SCALE_PA
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import render
from vfcore.spec.paths import value_at
from vocalis.server.live import forms
from vocalis.server.live.player import Player
from vocalis.server.live.state_frame import EDGES


class Connected:
    """A client that sends what it is given, and keeps the texts that come."""

    def __init__(self):
        self.texts, self.waiting = [], []
        self.sounds = 0

    def say(self, **message):
        self.waiting.append(json.dumps(message))

    def wait(self, seconds):
        pass

    def messages(self):
        told, self.waiting = self.waiting, []
        return told

    def send(self, text):
        self.texts.append(json.loads(text))

    def send_sound(self, payload):
        self.sounds += 1

    def flush(self):
        pass


@pytest.fixture
def compiler(monkeypatch):
    """No form of two walls is loaded, and a load waits for ``set``."""
    free, loaded = threading.Event(), set()

    def load(form):
        if form.walls == 2:
            assert free.wait(30)
        loaded.add(form)

    monkeypatch.setattr(forms, "load", load)
    monkeypatch.setattr("vocalis.server.live.player.is_loaded", lambda form: form.walls == 1 or form in loaded)
    return free


def blocks(player, count):
    for _ in range(count):
        player._block()


def until_loaded(player):
    player._loading.thread.join(30)


def test_a_voice_sounds_on_while_its_form_is_made_and_then_follows(compiler):
    client = Connected()
    player = Player(client)
    assert player.prepare()
    client.say(right={"activation": {"ta": 0.1}})
    assert player.receive()
    blocks(player, 10)
    assert client.sounds == 10
    assert value_at(player._voice.request, "right.activation.ta") == 0.4
    client.say(activation={"ct": 0.5})
    client.say(right={"activation": {"ta": 0.2}})
    player.receive()
    blocks(player, 10)
    assert value_at(player._voice.request, "activation.ct") == 0.5, "what needs no other form is followed at once"
    assert player._voice.form.walls == 1
    compiler.set()
    until_loaded(player)
    blocks(player, 10)
    assert player._voice.form.walls == 2
    assert value_at(player._voice.request, "right.activation.ta") == 0.2, "the newest wins"
    assert not [text for text in client.texts if text["type"] == "problem"]


def test_a_change_taken_back_needs_no_other_form(compiler):
    client = Connected()
    player = Player(client)
    player.prepare()
    client.say(right={"activation": {"ta": 0.1}})
    player.receive()
    client.say(right=None, activation={"ct": 0.6})
    player.receive()
    blocks(player, 10)
    assert (player._voice.request.activation.ct, player._voice.form.walls) == (0.6, 1)
    compiler.set()
    until_loaded(player)
    blocks(player, 5)
    assert player._voice.form.walls == 1


def test_a_recording_of_a_form_that_is_not_loaded_begins_when_it_is(monkeypatch, compiler):
    client = Connected()
    player = Player(client)
    player.prepare()
    two_walls = replace(player._voice.form, walls=2)
    monkeypatch.setattr("vocalis.server.live.player.form_of", lambda request: two_walls)
    client.say(record=True)
    player.receive()
    blocks(player, 5)
    assert player._recording is None
    compiler.set()
    until_loaded(player)
    blocks(player, 5)
    client.say(record=False)
    player.receive()
    assert client.texts[-1]["gesture"]["run"]["duration_s"] == pytest.approx(0.05)


def test_a_voice_of_two_folds_is_heard_and_seen_and_replayed(voice_server):
    with voice(voice_server) as socket:
        received = Received(socket).listen(0.1)
        received.send(record=True)
        received.listen(0.3)
        received.send(right={"activation": {"ta": 0.1}})
        for _ in range(60):  # until the form is there, which may have to be compiled
            if "right" in received.listen(1.0).states[-1]:
                break
        state = received.listen(0.3).states[-1]
        received.send(record=False)
        received.listen(5, until="gesture")
    assert received.sequence == list(range(len(received.sequence)))
    assert set(state["right"]) == set(EDGES)
    assert state["right"]["x_m"][-1] != state["x_m"][-1]
    kept = received.texts[-1]
    first = kept["first_sequence"]
    rendered = render(gesture_from_dict(kept["gesture"]))
    count = len(rendered.audio_pa) // 480
    played = np.concatenate(received.blocks[first : first + count])
    assert np.array_equal(played, (rendered.audio_pa / FULL_SCALE_PA).astype("<f4")[: len(played)])
