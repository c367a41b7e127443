"""The framing of a played voice's web socket: words cut anywhere, pieces and pings between them, faults."""

import socket

import pytest
from websockets.frames import Close, Frame, Opcode
from websockets.protocol import Protocol, Side

from vocalis.server.live.client import LARGEST_FRAME, Client, Left


@pytest.fixture
def pair():
    ours, theirs = socket.socketpair()
    theirs.settimeout(5)
    client = Client(ours, b"")
    yield client, theirs
    client.close()
    theirs.close()


def text(words: str, fin: bool = True, opcode: Opcode = Opcode.TEXT, mask: bool = True) -> bytes:
    return Frame(opcode, words.encode(), fin).serialize(mask=mask)


WORDS = ["", "a", "é" * 40, "x" * 125, "y" * 126, "z" * 3000]
SAID = b"".join(map(text, WORDS)) + (
    text("one ", fin=False) + text("", opcode=Opcode.PING) + text("piece", opcode=Opcode.CONT) + text("last")
)
HEARD = [*WORDS, "one piece", "last"]


@pytest.mark.parametrize("step", [1, 2, 3, 7, 100, len(SAID)])
def test_words_are_whole_wherever_they_are_cut(pair, step):
    client, theirs = pair
    heard = []
    for at in range(0, len(SAID), step):
        theirs.send(SAID[at : at + step])
        heard += client.messages()
    assert heard == HEARD
    assert client.messages() == []
    assert theirs.recv(100) == Frame(Opcode.PONG, b"").serialize(mask=False)


@pytest.mark.parametrize(
    "said, code",
    [
        (text("not masked", mask=False), 1002),
        (text("x" * (LARGEST_FRAME + 100)), 1009),
        (text("x" * (LARGEST_FRAME + 100))[:20], 1009),
        (text("one ", fin=False) + text("two"), 1002),
        (b"\xc1" + text("compressed")[1:], 1002),
        (Frame(Opcode.CLOSE, Close(1000, "").serialize()).serialize(mask=True), 1000),
    ],
    ids=["not masked", "too large", "said to be too large", "a word within another", "compressed", "farewell"],
)
def test_what_is_no_web_socket_ends_it_and_says_why(pair, said, code):
    client, theirs = pair
    theirs.sendall(said)
    with pytest.raises(Left):
        for _ in range(50):
            client.messages()
    answer = Protocol(Side.CLIENT)
    answer.receive_data(theirs.recv(1000))
    assert answer.close_rcvd.code == code


def test_frames_go_out_together_and_read_back(pair):
    client, theirs = pair
    client.send("heard")
    client.send("w" * 70_000)
    client.send_sound(bytearray(1924))
    client.flush()
    reader, frames = Protocol(Side.CLIENT, max_size=None), []
    while len(frames) < 3:
        reader.receive_data(theirs.recv(10_000))
        client.flush()
        frames += reader.events_received()
    assert [(frame.opcode, len(frame.data)) for frame in frames] == [
        (Opcode.TEXT, 5), (Opcode.TEXT, 70_000), (Opcode.BINARY, 1924),
    ]  # fmt: skip
