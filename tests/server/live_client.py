"""A client of the played voice, for tests."""

import json
import struct
import time

import numpy as np
from websockets.sync.client import connect


def voice(server, **more):
    return connect(f"{server.url.replace('http', 'ws')}/api/v1/live", open_timeout=60, max_size=None, **more)


class Received:
    """What a client has received."""

    def __init__(self, socket):
        self.socket = socket
        self.sequence: list[int] = []
        self.blocks: list[np.ndarray] = []
        self.texts: list[dict] = []

    def listen(self, seconds: float, until: str | None = None) -> "Received":
        """Take frames for a while after the first sound, or until a text frame of a type has come."""
        begin = None
        while begin is None or time.monotonic() < begin + seconds:
            frame = self.socket.recv(timeout=60)
            if isinstance(frame, bytes):
                begin = begin or time.monotonic()
                self.sequence.append(struct.unpack("<I", frame[:4])[0])
                self.blocks.append(np.frombuffer(frame, "<f4", offset=4))
            else:
                self.texts.append(json.loads(frame))
                if self.texts[-1]["type"] == until:
                    break
        return self

    def send(self, **message) -> None:
        self.socket.send(json.dumps(message))

    @property
    def states(self) -> list[dict]:
        return [frame for frame in self.texts if frame["type"] == "state"]

    @property
    def problems(self) -> list[dict]:
        return [frame["problem"] for frame in self.texts if frame["type"] == "problem"]
