"""The client of a played voice, in the process of the voices: a web socket that never waits.

What passes a hundred times a second, short texts in and frames out, is read and written here; everything else of a
web socket (closing, pings, pieces, faults) is left to the protocol of ``websockets``, which gets whole frames only. A
general parser that was just woken takes as long over one word of the hand as the tract over its sound.
"""

import socket
import time
from contextlib import suppress

from websockets.frames import Frame, Opcode
from websockets.protocol import Protocol, Side, State

#: What the system may hold of what is not yet read; half a second of sound, so that one who does not listen is noticed.
SYSTEM_BYTES = 65_536
#: What waits beyond it, octets: some more.
MOST_WAITING = 135_000
READ_BYTES = 65_536  # at a time: nobody keeps the other voices waiting
LARGEST_FRAME = 65_536
MESSAGES_PER_S = 200  # a hand makes 60; twice as many may come at once
FAREWELL_S = 1.0  # for the client's own last word
POLICY, GOING_AWAY = 1008, 1012
_TEXT, _BINARY = 0x81, 0x82  # the first octet of a frame that is a whole message
_MASKED = 0x80
_LONGEST_HEADER = 14
_SHORT, _TWO_OCTETS = 126, 65_536  # lengths that take no octets of their own, and two


class Left(Exception):
    """The client has gone, or has been sent away."""


class Client:
    """``messages``, ``send`` and ``send_sound`` raise Left when there is nobody any more."""

    def __init__(self, connection: socket.socket, greeting: bytes):
        self._socket = connection
        self._socket.setblocking(False)
        with suppress(OSError):
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SYSTEM_BYTES)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._protocol = Protocol(Side.SERVER, max_size=LARGEST_FRAME)
        self._waiting = bytearray(greeting)
        self._unread = b""  # the beginning of a frame
        self._parts: list[Frame] = []
        self._meter = Meter(MESSAGES_PER_S)
        self._until_s = 0.0

    def fileno(self) -> int:
        return self._socket.fileno()

    def wait(self, seconds: float) -> None:
        """Until the client has said something, for so long at most."""
        self.flush()
        self._socket.settimeout(seconds)
        with suppress(OSError):
            self._socket.recv(1, socket.MSG_PEEK)
        self._socket.setblocking(False)

    def messages(self) -> list[str | bytes]:
        """What the client has said since the last call."""
        try:
            data = self._socket.recv(READ_BYTES)
        except BlockingIOError:
            return []
        except OSError as error:
            raise Left from error
        if not data:
            raise Left
        if self._unread:
            data = self._unread + data
        said: list[str | bytes] = []
        at = 0
        while at < len(data):
            mask_at, end = _place(data, at)
            too_large = end - at > LARGEST_FRAME + _LONGEST_HEADER
            if end > len(data) and not too_large:
                break
            if mask_at and data[at] == _TEXT and not too_large and not self._parts:
                said.append(_unmasked(data, mask_at, end).decode(errors="replace"))
            else:
                said += self._by_the_book(data[at:end])
            at = end
        self._unread = data[at:]
        for _ in said:
            if not self._meter.count():
                self.dismiss(POLICY, f"more than {MESSAGES_PER_S} messages a second")
                raise Left
        return said

    def send(self, text: str) -> None:
        """A frame of text, which goes with the next ``flush``."""
        octets = text.encode()
        self._waiting += _header(_TEXT, len(octets)) + octets

    def send_sound(self, octets: bytearray) -> None:
        """A binary frame, which goes with the next ``flush``."""
        self._waiting += _header(_BINARY, len(octets))
        self._waiting += octets

    def flush(self) -> None:
        """Hand the system what waits; what it does not take at once goes the next time."""
        self._flush()
        if len(self._waiting) > MOST_WAITING:
            self.dismiss(POLICY, "the sound is not taken as fast as it is made")
            raise Left

    def dismiss(self, code: int = 1000, reason: str = "") -> None:
        """Say farewell; ``lingers`` then tells when the socket may be closed."""
        if self._protocol.state is State.OPEN:
            self._protocol.send_close(code, reason)
            with suppress(Left):
                self._post()

    def lingers(self) -> bool:
        """Whether the client has not yet heard the farewell: a socket closed earlier would take the word back."""
        now = time.monotonic()
        self._until_s = self._until_s or now + FAREWELL_S
        try:
            self._flush()
            while self._protocol.close_rcvd is None:
                data = self._socket.recv(READ_BYTES)
                if not data:
                    return False
                self._protocol.receive_data(data)
                self._protocol.events_received()
            return bool(self._waiting) and now < self._until_s
        except BlockingIOError:
            return now < self._until_s
        except (OSError, Left):
            return False

    def close(self) -> None:
        with suppress(OSError):  # the server holds the same socket: it ends for both
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()

    def _by_the_book(self, frame: bytes) -> list[str | bytes]:
        """The whole messages that end with a frame."""
        self._protocol.receive_data(frame)
        self._post()
        if self._protocol.state is not State.OPEN:
            raise Left
        return [message for one in self._protocol.events_received() if (message := self._whole(one)) is not None]

    def _whole(self, frame: Frame) -> str | bytes | None:
        if frame.opcode not in (Opcode.TEXT, Opcode.BINARY, Opcode.CONT):
            return None
        self._parts.append(frame)
        if not frame.fin:
            return None
        parts, self._parts = self._parts, []
        data = b"".join(bytes(part.data) for part in parts)
        return data.decode(errors="replace") if parts[0].opcode is Opcode.TEXT else data

    def _post(self) -> None:
        for data in self._protocol.data_to_send():
            self._waiting += data
        self._flush()

    def _flush(self) -> None:
        try:
            while self._waiting:
                del self._waiting[: self._socket.send(self._waiting)]
        except BlockingIOError:
            return
        except OSError as error:
            raise Left from error


def _place(data: bytes, at: int) -> tuple[int, int]:
    """Of the frame that begins at ``at``: where its mask stands, 0 when it has none, and where it ends.

    The end is beyond all data while its header has not come.
    """
    unknown = (0, len(data) + 1)
    if len(data) < at + 2:
        return unknown
    length, begin = data[at + 1] & ~_MASKED, at + 2
    if length >= _SHORT:
        begin += 2 if length == _SHORT else 8
        if len(data) < begin:
            return unknown
        length = int.from_bytes(data[at + 2 : begin], "big")
    return (begin, begin + 4 + length) if data[at + 1] & _MASKED else (0, begin + length)


def _unmasked(data: bytes, mask_at: int, end: int) -> bytes:
    """The payload that ends at ``end``, after its mask of 4 octets."""
    payload = data[mask_at + 4 : end]
    count = len(payload)
    key = (data[mask_at : mask_at + 4] * (count // 4 + 1))[:count]
    return (int.from_bytes(payload, "little") ^ int.from_bytes(key, "little")).to_bytes(count, "little")


def _header(first: int, length: int) -> bytes:
    """Of an unmasked frame."""
    if length < _SHORT:
        return bytes((first, length))
    if length < _TWO_OCTETS:
        return bytes((first, _SHORT)) + length.to_bytes(2, "big")
    return bytes((first, _SHORT + 1)) + length.to_bytes(8, "big")


class Meter:
    """A token bucket."""

    def __init__(self, per_second: float):
        self._per_second, self._left, self._at = per_second, 2.0 * per_second, time.monotonic()

    def count(self) -> bool:
        """One message more; False when it is one too many."""
        now = time.monotonic()
        self._left = min(2.0 * self._per_second, self._left + (now - self._at) * self._per_second) - 1.0
        self._at = now
        return self._left >= 0
