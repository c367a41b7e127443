"""The WebSocket frames of a live voice: messages cut anywhere, fragments and pings in between, faults."""

import socket

import pytest
from websockets.frames import Close, Frame, Opcode
from websockets.protocol import Protocol, Side

from vocalis.server.live.client import LARGEST_FRAME, Client, ClientGone


@pytest.fixture
def pair():
    own_end, other_end = socket.socketpair()
    other_end.settimeout(5)
    client = Client(own_end, b"")
    yield client, other_end
    client.close()
    other_end.close()


def text(message: str, fin: bool = True, opcode: Opcode = Opcode.TEXT, mask: bool = True) -> bytes:
    return Frame(opcode, message.encode(), fin).serialize(mask=mask)


MESSAGES = ["", "a", "é" * 40, "x" * 125, "y" * 126, "z" * 3000]
SENT = b"".join(map(text, MESSAGES)) + (
    text("one ", fin=False) + text("", opcode=Opcode.PING) + text("piece", opcode=Opcode.CONT) + text("last")
)
EXPECTED = [*MESSAGES, "one piece", "last"]


@pytest.mark.parametrize("step", [1, 2, 3, 7, 100, len(SENT)])
def test_messages_are_whole_wherever_they_are_cut(pair, step):
    client, other_end = pair
    received = []
    for at in range(0, len(SENT), step):
        other_end.send(SENT[at : at + step])
        received += client.messages()
    assert received == EXPECTED
    assert client.messages() == []
    assert other_end.recv(100) == Frame(Opcode.PONG, b"").serialize(mask=False)


@pytest.mark.parametrize(
    "sent, code",
    [
        (text("not masked", mask=False), 1002),
        (text("x" * (LARGEST_FRAME + 100)), 1009),
        (text("x" * (LARGEST_FRAME + 100))[:20], 1009),
        (text("one ", fin=False) + text("two"), 1002),
        (b"\xc1" + text("compressed")[1:], 1002),
        (Frame(Opcode.CLOSE, Close(1000, "").serialize()).serialize(mask=True), 1000),
    ],
    ids=["not masked", "too large", "announced as too large", "a message within another", "compressed", "close"],
)
def test_protocol_errors_close_the_connection_with_their_code(pair, sent, code):
    client, other_end = pair
    other_end.sendall(sent)
    with pytest.raises(ClientGone):
        for _ in range(50):
            client.messages()
    answer = Protocol(Side.CLIENT)
    answer.receive_data(other_end.recv(1000))
    assert answer.close_rcvd.code == code


def test_frames_are_sent_together_and_read_back(pair):
    client, other_end = pair
    client.send("heard")
    client.send("w" * 70_000)
    client.send_sound(bytearray(1924))
    client.flush()
    reader, frames = Protocol(Side.CLIENT, max_size=None), []
    while len(frames) < 3:
        reader.receive_data(other_end.recv(10_000))
        client.flush()
        frames += reader.events_received()
    assert [(frame.opcode, len(frame.data)) for frame in frames] == [
        (Opcode.TEXT, 5), (Opcode.TEXT, 70_000), (Opcode.BINARY, 1924),
    ]  # fmt: skip
