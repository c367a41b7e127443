"""A played voice over the web socket: sound without gaps that follows the hand, polite refusals, exact replay."""

import json
import secrets
import socket
import struct
import time
from urllib.parse import urlsplit

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from tests.server.live_server import serving, wait_until
from vfcore.audio import FULL_SCALE_PA
from vfcore.gesture.gesture import gesture_from_dict
from vfcore.gesture.render import render
from vocalis_server.live import handover


@pytest.fixture(scope="module")
def stage():
    with serving(live_voices=2) as server:
        with voice(server) as warm:  # the process of the voices starts with the first one
            Heard(warm).listen(0.1)
        yield server


def voice(server, **more):
    return connect(f"{server.url.replace('http', 'ws')}/api/v1/live", open_timeout=60, max_size=None, **more)


class Heard:
    """What a client has received."""

    def __init__(self, socket):
        self.socket = socket
        self.sequence: list[int] = []
        self.blocks: list[np.ndarray] = []
        self.said: list[dict] = []

    def listen(self, seconds: float, until: str | None = None) -> "Heard":
        """Take frames for a while after the first sound, or until a text frame of a type has come."""
        begin = None
        while begin is None or time.monotonic() < begin + seconds:
            frame = self.socket.recv(timeout=60)
            if isinstance(frame, bytes):
                begin = begin or time.monotonic()
                self.sequence.append(struct.unpack("<I", frame[:4])[0])
                self.blocks.append(np.frombuffer(frame, "<f4", offset=4))
            else:
                self.said.append(json.loads(frame))
                if self.said[-1]["type"] == until:
                    break
        return self

    def send(self, **message) -> None:
        self.socket.send(json.dumps(message))

    @property
    def states(self) -> list[dict]:
        return [frame for frame in self.said if frame["type"] == "state"]

    @property
    def problems(self) -> list[dict]:
        return [frame["problem"] for frame in self.said if frame["type"] == "problem"]


def test_blocks_come_in_order_in_real_time_and_sound(stage):
    with voice(stage) as socket:
        heard = Heard(socket).listen(1.5)
    assert heard.sequence == list(range(len(heard.sequence)))
    assert len(heard.sequence) == pytest.approx(150, abs=12)
    assert all(len(block) == 480 for block in heard.blocks)
    sound = np.concatenate(heard.blocks)
    assert 0.01 < np.abs(sound).max() < 0.5
    assert heard.said[0] | {"model_version": ""} == {
        "type": "ready", "rate_hz": 48000, "block": 480, "full_scale_pa": FULL_SCALE_PA, "model_version": "",
    }  # fmt: skip
    assert heard.states[-1]["fo_hz"] == pytest.approx(149.6, abs=0.5)


def test_the_voice_follows_the_hand(stage):
    with voice(stage) as socket:
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


def test_one_voice_too_many_is_refused_politely_and_a_vanished_client_makes_room(stage):
    with voice(stage), voice(stage) as second:
        with voice(stage) as third:
            refusal = json.loads(third.recv(timeout=10))
            with pytest.raises(ConnectionClosed) as closed:
                third.recv(timeout=10)
        assert refusal["problem"]["status"] == 429
        assert "VOCALIS_LIVE_VOICES" in refusal["problem"]["detail"]
        assert closed.value.rcvd.code == 1013
        second.socket.close()  # gone without a word
        wait_until(lambda: stage.services.voices.playing < 2)
        with voice(stage) as fourth:
            assert Heard(fourth).listen(0.1).blocks


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
def test_what_cannot_be_understood_is_said_and_the_voice_goes_on(stage, message, path):
    with voice(stage) as socket:
        heard = Heard(socket).listen(0.05)
        socket.send(message)
        heard.listen(10, until="problem")
        assert heard.problems[-1]["errors"][0]["path"] == path
        assert Heard(socket).listen(0.1).blocks


def test_a_flood_ends_the_connection_and_nothing_else(stage):
    with voice(stage) as calm, voice(stage) as flooding:
        Heard(flooding).listen(0.05)
        with pytest.raises(ConnectionClosed) as closed:
            for _ in range(2000):
                flooding.send('{"activation": {"ct": 0.5}}')
            while True:
                flooding.recv(timeout=10)
        assert closed.value.rcvd.code == 1008
        assert Heard(calm).listen(0.2).blocks


def test_one_who_does_not_listen_is_sent_away(stage):
    connection = socket.create_connection(urlsplit(stage.url).netloc.split(":"))
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    key = "dGhlIHNhbXBsZSBub25jZQ=="
    connection.sendall(
        f"GET /api/v1/live HTTP/1.1\r\nHost: {urlsplit(stage.url).netloc}\r\nUpgrade: websocket\r\n"
        f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    assert connection.recv(12) == b"HTTP/1.1 101"
    wait_until(lambda: stage.services.voices.playing == 1)
    wait_until(lambda: stage.services.voices.playing == 0)
    connection.close()


def test_a_large_message_in_pieces_is_one_message(stage):
    with voice(stage) as talking:
        heard = Heard(talking).listen(0.05)
        talking.send(iter(['{"activation": ', '{"ct": 0.9}, ', '"stamp": 7}']))
        heard.listen(5, until="heard")
        assert heard.said[-1]["stamp"] == 7
        talking.ping().wait(5)


def test_a_voice_whose_process_dies_ends_and_the_next_one_has_another(stage):
    with voice(stage) as playing:
        heard = Heard(playing).listen(0.1)
        stage.services.voices._process.kill()
        with pytest.raises(ConnectionClosed):
            heard.listen(20)
    wait_until(lambda: stage.services.voices.playing == 0)
    with voice(stage) as playing:
        assert Heard(playing).listen(0.1).blocks


def test_when_the_server_stops_it_says_so():
    with serving() as server:
        playing = voice(server).__enter__()
        heard = Heard(playing).listen(0.1)
    with pytest.raises(ConnectionClosed) as closed:
        heard.listen(10)
    assert closed.value.rcvd.code == 1012


def test_where_sockets_cannot_be_handed_on_sound_and_words_are_carried(stage, monkeypatch):
    """So it is with an encrypted connection, whose octets only the server can read."""
    monkeypatch.setattr(handover, "can_go", lambda transport: False)
    with voice(stage) as playing:
        heard = Heard(playing)
        heard.send(activation={"ct": 0.9})
        state = heard.listen(0.6).states[-1]
    assert state["fo_hz"] == pytest.approx(177.7, abs=1)
    assert heard.sequence == list(range(len(heard.sequence)))
    wait_until(lambda: stage.services.voices.playing == 0)


def test_a_page_of_another_site_hears_nothing(stage):
    with pytest.raises(InvalidStatus) as refused:
        voice(stage, origin="https://elsewhere.example").__enter__()
    assert refused.value.response.status_code == 403


def test_a_server_with_a_token_plays_for_those_who_show_it():
    token = secrets.token_hex(8)
    with serving(token=token) as server:
        with pytest.raises(InvalidStatus):
            voice(server).__enter__()
        with voice(server, additional_headers={"Authorization": f"Bearer {token}"}) as socket:
            assert Heard(socket).listen(0.05).blocks


def test_the_block_that_first_follows_a_stamped_movement_is_named(stage):
    with voice(stage) as socket:
        heard = Heard(socket).listen(0.3)
        heard.send(subglottal_pressure_pa=0, stamp=3)
        heard.send(subglottal_pressure_pa=1, stamp=4)
        heard.listen(5, until="heard")
        answer = heard.said[-1]
        assert (answer["stamp"], answer["sequence"]) == (4, heard.sequence[-1] + 1), "the newest, before its block"
        heard.listen(1.0)
    loud = [float(np.abs(block).max()) for block in heard.blocks]
    follows = heard.sequence.index(answer["sequence"])
    assert max(loud[follows + 40 :]) < 0.05 * loud[follows - 1], "and what follows it dies away"


def test_a_recorded_gesture_renders_to_the_same_samples(stage):
    """Tolerance: none. Live and offline are one engine, so CT from 0.1 to 0.9 is the same sound bit for bit."""
    with voice(stage) as socket:
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
