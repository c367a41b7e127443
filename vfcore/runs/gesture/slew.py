"""Slew-rate limits of a played voice: its parameters move no faster than muscles do.

A control can jump; a muscle cannot. Within a block of 10 ms each number moves by at most BLOCK_SHARE of its range. A
jump over the whole range therefore takes 50 ms, the twitch time of the fastest laryngeal muscles (LCA and TA reach
their peak tension in about 20–50 ms; Titze 1994, Principles of Voice Production, table 1.2). This is a choice of this
implementation for playing live; breakpoints of a gesture are followed exactly.
"""

from vfcore.runs.gesture.gesture import MOVABLE, moved
from vfcore.spec.declarations import SIDES
from vfcore.spec.paths import (
    LISTS,
    NAMES_IN,
    OPTIONAL_PARTS,
    differing,
    differing_beyond,
    known_declaration,
    part_of,
    value_at,
)
from vfcore.spec.simulation import Simulation

BLOCK_SHARE = 0.2


def _largest_move(path: str) -> float:
    metadata = known_declaration(path).metadata
    return BLOCK_SHARE * (metadata["high"] - metadata["low"])


LARGEST_MOVE = {path: _largest_move(path) for path in MOVABLE}
_MOVABLE_IN = {part: tuple(path for path in MOVABLE if path.rpartition(".")[0] == part) for part in NAMES_IN}

_OPTIONAL = sorted(OPTIONAL_PARTS.difference(SIDES), key=lambda part: (part.count("."), part))


def differences(now: Simulation, wanted: Simulation) -> tuple[str, ...]:
    """The movable numbers in which two requests differ."""
    if now is wanted:
        return ()
    return differing(now, wanted, _MOVABLE_IN) + tuple(
        path for path in differing_beyond(now, wanted) if path in LARGEST_MOVE
    )


def come_or_gone(now: Simulation, wanted: Simulation) -> str | None:
    """The optional part, or the list whose objects differ in number or in a choice: no glide leads from one request to
    the other. None where there is none.
    """
    for part in _OPTIONAL:
        if (part_of(now, part) is None) != (part_of(wanted, part) is None):
            return part
    return next((name for name in LISTS if _choices(now, name) != _choices(wanted, name)), None)


def _choices(request: Simulation, name: str) -> list[list[str]]:
    rows = [row.name for row in LISTS[name].rows.values() if not row.is_number]
    return [[getattr(item, row) for row in rows] for item in getattr(request, name)]


def slew_limited(now: Simulation, wanted: Simulation, paths: tuple[str, ...]) -> Simulation:
    """The request one block later: every number of ``paths`` as close to ``wanted`` as the limit allows."""
    return moved(now, {path: _nearer(path, value_at(now, path), value_at(wanted, path)) for path in paths})


def is_near(now: Simulation, wanted: Simulation, path: str) -> bool:
    """Whether one block is enough to reach the wanted number."""
    return abs(value_at(wanted, path) - value_at(now, path)) <= LARGEST_MOVE[path]


def _nearer(path: str, value: float, goal: float) -> float:
    largest = LARGEST_MOVE[path]
    return goal if abs(goal - value) <= largest else value + max(-largest, min(largest, goal - value))
