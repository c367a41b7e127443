"""What a client waits for, on a server with nothing else to do: a second of voice, and a map from request to table."""

import os
import tempfile
import time

import httpx

from vocalis_bench.interactive import run
from vocalis_bench.sweeps import grid, served, start_workers, to_table

POINTS = 21  # of each of the two muscles of a map
VOICES = 40
PRECISIONS = {"map": "float64", "map_single": "float32"}


def answers(rounds: int, points: int = POINTS, voices: int = VOICES) -> dict[str, list[float]]:
    """Seconds of each answer, client to client, all workers started before: ``http``, of ``voices`` requests for 1 s of
    voice with all arrays; ``map`` and ``map_single``, of ``rounds`` maps in double and in single precision.
    """
    body = grid(points, points)
    with tempfile.TemporaryDirectory(prefix="vocalis-answers-") as folder, served(folder, os.cpu_count() or 1) as pair:
        client = pair[0]
        start_workers(client)
        _voice(client, 0.0)
        found = {"http": [_voice(client, (1 + k) / (1 + voices)) for k in range(voices)]}
        for name, precision in PRECISIONS.items():
            found[name] = [to_table(client, body | {"precision": precision}, k) for k in range(rounds)]
    return found


def _voice(client: httpx.Client, ct: float) -> float:
    began = time.perf_counter()
    run(client, ct, duration_s=1.0).raise_for_status()
    return time.perf_counter() - began
