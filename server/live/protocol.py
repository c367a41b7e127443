"""The messages over the WebSocket of a live voice.

Client → server, JSON text: a partial simulation request (``{"activation": {"ct": 0.4}}``), applied to the request in
force; with it ``"buffer_ms"`` (the least sound that the client had buffered lately) and ``"wanted_buffer_ms"``,
``"stamp"`` (any number of the client, answered by ``heard``), and ``"record"`` true (start again from rest and record
the gesture) or false (send the recorded gesture).

Server → client, binary: uint32 little-endian sequence number, then 480 float32 samples at 48 kHz, in units of
``full_scale_pa``. Text: ``{"type": "ready" | "state" | "gesture" | "problem", …}``, and ``{"type": "heard", "stamp",
"sequence"}``, the acknowledgement of the newest stamp: ``sequence`` is the first frame of sound after that message.
"""

import json
import struct
from typing import Any

import numpy as np

from vfcore.errors import ParameterError
from vfcore.io.audio import AUDIO_RATE_HZ, FULL_SCALE_PA

LONGEST_MESSAGE = 16_384
BLOCK_SAMPLES = AUDIO_RATE_HZ // 100
CONTROLS = ("buffer_ms", "wanted_buffer_ms", "stamp", "record")
LARGEST_STAMP = 2**53 - 1  # the largest whole number that JavaScript keeps exactly


def read_message(text: str | bytes) -> dict[str, Any]:
    """One message of a client; ParameterError when it is not text, not an object or too long."""
    if isinstance(text, bytes):
        raise ParameterError("message", "is binary", "text: an object in JSON")
    if len(text) > LONGEST_MESSAGE:
        raise ParameterError("message", f"{len(text)} characters are too many", f"up to {LONGEST_MESSAGE}")
    try:
        message = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ParameterError("message", "is not JSON", "an object in JSON") from error
    if not isinstance(message, dict):
        raise ParameterError("message", f"{type(message).__name__} is not an object", "an object in JSON")
    for name, low, high in (("buffer_ms", 0, 60_000), ("wanted_buffer_ms", 0, 2_000)):
        if name not in message:
            continue
        value = message[name]
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            raise ParameterError(name, f"{value!r} is not a time", f"{low} to {high} ms")
    stamp = message.get("stamp", 0)
    if isinstance(stamp, bool) or not isinstance(stamp, int) or not 0 <= stamp <= LARGEST_STAMP:
        raise ParameterError("stamp", f"{stamp!r} is not a whole number", f"0 to {LARGEST_STAMP}")
    if not isinstance(message.get("record", False), bool):
        raise ParameterError("record", f"{message['record']!r} is neither on nor off", "true or false")
    return message


class SoundFrame:
    """A binary frame, number and samples; it reuses its memory, because there is one every 10 ms."""

    def __init__(self) -> None:
        self._bytes = bytearray(4 + 4 * BLOCK_SAMPLES)
        self._samples = np.frombuffer(self._bytes, "<f4", offset=4)

    def of(self, sequence: int, audio_pa: np.ndarray) -> bytearray:
        """Block number ``sequence``, good until the next call."""
        struct.pack_into("<I", self._bytes, 0, sequence & 0xFFFFFFFF)
        np.divide(audio_pa, FULL_SCALE_PA, out=self._samples, casting="same_kind")
        return self._bytes
