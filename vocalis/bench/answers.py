"""Waiting time of a client on an idle server: for a second of voice, and for a map from request to table."""

import os
import tempfile
from functools import partial

from vocalis.bench.interactive import milliseconds, run
from vocalis.bench.sweeps import grid, served, start_workers, to_table

POINTS = 21  # of each of the two muscles of a map
VOICES = 40
HUMAN = {"model": {"variant": "human"}}  # finite stretch, and airways that act back
#: Base request and precision of each map.
MAPS: dict[str, tuple[dict, str]] = {
    "map": ({}, "float64"),
    "map_single": ({}, "float32"),
    "map_human": (HUMAN, "float64"),
    "map_human_single": (HUMAN, "float32"),
}


def answers(rounds: int, points: int = POINTS, voices: int = VOICES) -> dict[str, list[float]]:
    """Seconds of each answer, measured at the client, with all workers already running.

    ``http``: of ``voices`` requests for 1 s of voice with all arrays. MAPS: each of ``rounds`` maps, in turns.
    """
    body, workers = grid(points, points), os.cpu_count() or 1
    with tempfile.TemporaryDirectory(prefix="vocalis-answers-") as folder, served(folder, workers) as (client, _):
        for base, precision in MAPS.values():
            start_workers(client, base, precision)
        run(client, 0.0)
        voice = partial(run, duration_s=1.0)
        found = {"http": [1e-3 * took for took in milliseconds(voice, client, 0.001, voices)]}
        found |= {name: [] for name in MAPS}
        for k in range(rounds):
            for name, (base, precision) in MAPS.items():
                found[name].append(to_table(client, body | {"base": base, "precision": precision}, k))
    return found
