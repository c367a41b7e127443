"""The client of a live voice, in the voice process: a WebSocket that never waits.

The frequent frames, short texts in and sound out, are read and written here. Everything else of a WebSocket (close,
ping, fragments, faults) is left to the protocol of ``websockets``, which gets whole frames only. On a core that has
just woken, a general parser takes as long for one control message as the vocal tract for a block of sound.
"""

import socket
import time
from contextlib import suppress

from websockets.frames import Frame, Opcode
from websockets.protocol import Event, Protocol, Side, State

#: Send buffer of the system, bytes: half a second of sound, so that a client that does not read is noticed.
SYSTEM_BYTES = 65_536
#: Most bytes that wait for room in it.
MOST_WAITING = 135_000
READ_BYTES = 65_536  # at a time, so that no client delays the other voices
LARGEST_FRAME = 65_536
MESSAGES_PER_S = 200  # a moved slider sends 60; a burst may have twice as many
CLOSE_S = 1.0  # for the client's own close frame
POLICY, GOING_AWAY = 1008, 1012
_TEXT, _BINARY = 0x81, 0x82  # the first byte of a frame that is a whole message
_MASKED = 0x80
_LONGEST_HEADER = 14
_SHORT, _TWO_BYTES = 126, 65_536  # lengths below take no bytes of their own, and two


class ClientGone(Exception):
    """The client has left, or was disconnected."""


class Client:
    """``messages``, ``send`` and ``send_sound`` raise ClientGone when the connection has ended."""

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
        self._rate = RateLimit(MESSAGES_PER_S)
        self._until_s = 0.0

    def fileno(self) -> int:
        return self._socket.fileno()

    def wait(self, seconds: float) -> None:
        """Wait until the client has sent something, for so long at most."""
        self.flush()
        self._socket.settimeout(seconds)
        with suppress(OSError):
            self._socket.recv(1, socket.MSG_PEEK)
        self._socket.setblocking(False)

    def messages(self) -> list[str | bytes]:
        """The messages that have arrived since the last call."""
        try:
            data = self._socket.recv(READ_BYTES)
        except BlockingIOError:
            return []
        except OSError as error:
            raise ClientGone from error
        if not data:
            raise ClientGone
        if self._unread:
            data = self._unread + data
        messages: list[str | bytes] = []
        at = 0
        while at < len(data):
            mask_at, end = _place(data, at)
            too_large = end - at > LARGEST_FRAME + _LONGEST_HEADER
            if end > len(data) and not too_large:
                break
            if mask_at and data[at] == _TEXT and not too_large and not self._parts:
                messages.append(_unmasked(data, mask_at, end).decode(errors="replace"))
            else:
                messages += self._by_library(data[at:end])
            at = end
        self._unread = data[at:]
        for _ in messages:
            if not self._rate.count():
                self.begin_close(POLICY, f"more than {MESSAGES_PER_S} messages a second")
                raise ClientGone
        return messages

    def send(self, text: str) -> None:
        """Queue a text frame for the next ``flush``."""
        payload = text.encode()
        self._waiting += _header(_TEXT, len(payload)) + payload

    def send_sound(self, payload: bytearray) -> None:
        """Queue a binary frame for the next ``flush``."""
        self._waiting += _header(_BINARY, len(payload))
        self._waiting += payload

    def flush(self) -> None:
        """Send what is queued; what the system does not take is sent the next time."""
        self._flush()
        if len(self._waiting) > MOST_WAITING:
            self.begin_close(POLICY, "the sound is not taken as fast as it is made")
            raise ClientGone

    def begin_close(self, code: int = 1000, reason: str = "") -> None:
        """Send a close frame; ``is_closing`` then tells when the socket may be closed."""
        if self._protocol.state is State.OPEN:
            self._protocol.send_close(code, reason)
            with suppress(ClientGone):
                self._flush_protocol()

    def is_closing(self) -> bool:
        """Whether the client has not answered the close frame yet: closing the socket earlier might discard it."""
        now = time.monotonic()
        self._until_s = self._until_s or now + CLOSE_S
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
        except (OSError, ClientGone):
            return False

    def close(self) -> None:
        with suppress(OSError):  # the server holds the same socket: it ends for both
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()

    def _by_library(self, frame: bytes) -> list[str | bytes]:
        """The whole messages that end with a frame, read by the library."""
        self._protocol.receive_data(frame)
        self._flush_protocol()
        if self._protocol.state is not State.OPEN:
            raise ClientGone
        return [message for one in self._protocol.events_received() if (message := self._whole(one)) is not None]

    def _whole(self, frame: Event) -> str | bytes | None:
        if not isinstance(frame, Frame) or frame.opcode not in (Opcode.TEXT, Opcode.BINARY, Opcode.CONT):
            return None
        self._parts.append(frame)
        if not frame.fin:
            return None
        parts, self._parts = self._parts, []
        data = b"".join(bytes(part.data) for part in parts)
        return data.decode(errors="replace") if parts[0].opcode is Opcode.TEXT else data

    def _flush_protocol(self) -> None:
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
            raise ClientGone from error


def _place(data: bytes, at: int) -> tuple[int, int]:
    """The position of the mask (0: none) and the end of the frame that begins at ``at``.

    The end is beyond all data while the header is incomplete.
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
    """The payload that ends at ``end``, after its mask of 4 bytes."""
    payload = data[mask_at + 4 : end]
    count = len(payload)
    key = (data[mask_at : mask_at + 4] * (count // 4 + 1))[:count]
    return (int.from_bytes(payload, "little") ^ int.from_bytes(key, "little")).to_bytes(count, "little")


def _header(first: int, length: int) -> bytes:
    """The header of an unmasked frame."""
    if length < _SHORT:
        return bytes((first, length))
    if length < _TWO_BYTES:
        return bytes((first, _SHORT)) + length.to_bytes(2, "big")
    return bytes((first, _SHORT + 1)) + length.to_bytes(8, "big")


class RateLimit:
    """A token bucket."""

    def __init__(self, per_second: float):
        self._per_second, self._left, self._at = per_second, 2.0 * per_second, time.monotonic()

    def count(self) -> bool:
        """Count one message; False when it is too many."""
        now = time.monotonic()
        self._left = min(2.0 * self._per_second, self._left + (now - self._at) * self._per_second) - 1.0
        self._at = now
        return self._left >= 0
