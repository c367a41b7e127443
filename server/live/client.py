"""The client of a played voice, in the process of the voices: a web socket that never waits."""

import socket
import time
from collections import deque
from contextlib import suppress

from websockets.frames import Frame, Opcode
from websockets.protocol import Protocol, Side, State

#: What the system may hold of what is not yet read; half a second of sound, so that one who does not listen is noticed.
SYSTEM_BYTES = 65_536
#: Frames that wait beyond it: half a second of sound with its state frames.
MOST_WAITING = 70
READ_BYTES = 65_536  # at a time: nobody keeps the other voices waiting
LARGEST_FRAME = 65_536
MESSAGES_PER_S = 200  # a hand makes 60; twice as many may come at once
FAREWELL_S = 1.0  # for the client's own last word
POLICY, GOING_AWAY = 1008, 1012
_HEADERS: dict[int, bytes] = {}


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
        self._waiting: deque[memoryview] = deque([memoryview(greeting)])
        self._parts: list[Frame] = []
        self._meter = Meter(MESSAGES_PER_S)
        self._until_s = 0.0

    def wait(self, seconds: float) -> None:
        """Until the client has said something, for so long at most."""
        self._flush()
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
        self._protocol.receive_data(data)
        self._post()
        if self._protocol.state is not State.OPEN:
            raise Left
        said = [message for frame in self._protocol.events_received() if (message := self._whole(frame)) is not None]
        for _ in said:
            if not self._meter.count():
                self.dismiss(POLICY, f"more than {MESSAGES_PER_S} messages a second")
                raise Left
        return said

    def send(self, text: str) -> None:
        """A frame of text; what the system does not take at once goes with the next one."""
        self._protocol.send_text(text.encode())
        self._post()

    def send_sound(self, octets: bytearray) -> None:
        """A binary frame, as ``Protocol.send_binary`` makes it: the header depends on nothing but the length."""
        if len(octets) not in _HEADERS:
            _HEADERS[len(octets)] = Frame(Opcode.BINARY, octets).serialize(mask=False)[: -len(octets)]
        self._waiting.append(memoryview(_HEADERS[len(octets)] + octets))
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
        self._waiting.extend(memoryview(data) for data in self._protocol.data_to_send() if data)
        self._flush()

    def _flush(self) -> None:
        try:
            while self._waiting:
                data = self._waiting.popleft()
                sent = 0
                try:
                    sent = self._socket.send(data)
                finally:
                    if sent < len(data):
                        self._waiting.appendleft(data[sent:])
                if sent < len(data):
                    return
        except BlockingIOError:
            return
        except OSError as error:
            raise Left from error


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
