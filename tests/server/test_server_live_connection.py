"""The connection of a played voice: who is let in, who is sent away, and what happens when either end goes."""

import json
import secrets
import socket
from contextlib import ExitStack
from urllib.parse import urlsplit

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from tests.server.live_client import Received, voice
from tests.server.live_server import serving, wait_until
from vocalis.server.live import handover


def test_one_voice_too_many_is_refused_politely_and_a_vanished_client_makes_room(voice_server):
    with voice(voice_server), voice(voice_server) as second:
        with voice(voice_server) as third:
            refusal = json.loads(third.recv(timeout=10))
            with pytest.raises(ConnectionClosed) as closed:
                third.recv(timeout=10)
        assert refusal["problem"]["status"] == 429
        assert "VOCALIS_LIVE_VOICES" in refusal["problem"]["detail"]
        assert closed.value.rcvd.code == 1013
        second.socket.close()  # gone without a close frame
        wait_until(lambda: voice_server.services.voices.playing < 2)
        with voice(voice_server) as fourth:
            assert Received(fourth).listen(0.1).blocks


def test_a_flood_ends_the_connection_and_nothing_else(voice_server):
    with voice(voice_server) as calm, voice(voice_server) as flooding:
        Received(flooding).listen(0.05)
        with pytest.raises(ConnectionClosed) as closed:
            for _ in range(2000):
                flooding.send('{"activation": {"ct": 0.5}}')
            while True:
                flooding.recv(timeout=10)
        assert closed.value.rcvd.code == 1008
        assert Received(calm).listen(0.2).blocks


def test_a_client_that_does_not_read_is_disconnected(voice_server):
    connection = socket.create_connection(urlsplit(voice_server.url).netloc.split(":"))
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    key = "dGhlIHNhbXBsZSBub25jZQ=="
    connection.sendall(
        f"GET /api/v1/live HTTP/1.1\r\nHost: {urlsplit(voice_server.url).netloc}\r\nUpgrade: websocket\r\n"
        f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    assert connection.recv(12) == b"HTTP/1.1 101"
    wait_until(lambda: voice_server.services.voices.playing == 1)
    wait_until(lambda: voice_server.services.voices.playing == 0)
    connection.close()


def test_a_large_message_in_fragments_is_one_message(voice_server):
    with voice(voice_server) as talking:
        received = Received(talking).listen(0.05)
        talking.send(iter(['{"activation": ', '{"ct": 0.9}, ', '"stamp": 7}']))
        received.listen(5, until="heard")
        assert received.texts[-1]["stamp"] == 7
        talking.ping().wait(5)


def test_a_voice_whose_process_dies_ends_and_the_next_one_has_another(voice_server):
    with voice(voice_server) as playing:
        received = Received(playing).listen(0.1)
        voice_server.services.voices._current.process.kill()
        with pytest.raises(ConnectionClosed):
            received.listen(20)
    wait_until(lambda: voice_server.services.voices.playing == 0)
    with voice(voice_server) as playing:
        assert Received(playing).listen(0.1).blocks


def test_a_voice_that_meets_a_process_not_yet_known_to_be_dead_gets_the_next_one(voice_server, monkeypatch):
    with voice(voice_server) as playing:
        Received(playing).listen(0.1)
    voices = voice_server.services.voices._current
    voices.process.kill()
    wait_until(voices.gone.is_set)
    monkeypatch.setattr(voices.process, "is_alive", lambda: True)
    voices.gone.clear()
    with voice(voice_server) as playing:
        assert Received(playing).listen(0.1).blocks


def test_when_the_server_stops_it_says_so():
    with ExitStack() as here:
        with serving() as server:
            received = Received(here.enter_context(voice(server))).listen(0.1)
        with pytest.raises(ConnectionClosed) as closed:
            received.listen(10)
    assert closed.value.rcvd.code == 1012


def test_where_sockets_cannot_be_passed_on_the_server_copies_the_bytes(voice_server, monkeypatch):
    """As for an encrypted connection, whose bytes only the server can read."""
    monkeypatch.setattr(handover, "can_pass_on", lambda transport: False)
    with voice(voice_server) as playing:
        received = Received(playing)
        received.send(activation={"ct": 0.9})
        state = received.listen(0.6).states[-1]
    assert state["fo_hz"] == pytest.approx(177.7, abs=1)
    assert received.sequence == list(range(len(received.sequence)))
    wait_until(lambda: voice_server.services.voices.playing == 0)


def test_a_page_of_another_site_hears_nothing(voice_server):
    with pytest.raises(InvalidStatus) as refused:
        voice(voice_server, origin="https://elsewhere.example").__enter__()
    assert refused.value.response.status_code == 403


def test_a_server_with_a_token_plays_for_those_who_show_it():
    token = secrets.token_hex(8)
    with serving(token=token) as server:
        with pytest.raises(InvalidStatus):
            voice(server).__enter__()
        with voice(server, additional_headers={"Authorization": f"Bearer {token}"}) as socket:
            assert Received(socket).listen(0.05).blocks
