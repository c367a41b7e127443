"""From where a voice is to where the hand wants it, no faster than muscles go.

A hand on a slider jumps; a muscle does not. Within a block of 10 ms each number moves by at most BLOCK_SHARE of its
range, so a jump over the whole range takes 50 ms, the twitch time of the fastest laryngeal muscles (LCA and TA reach
their peak tension in about 20–50 ms; Titze 1994, Principles of Voice Production, table 1.2). A choice of this
implementation for playing live; breakpoints of a gesture are followed as they stand.
"""

from vfcore.runs.gesture.gesture import MOVABLE, with_numbers
from vfcore.spec.schema import parameter_schema
from vfcore.spec.simulation import Simulation

BLOCK_SHARE = 0.2


def _limits() -> dict[str, float]:
    return {row["key"]: BLOCK_SHARE * (row["max"] - row["min"]) for row in parameter_schema() if row["key"] in MOVABLE}


LARGEST_MOVE = _limits()


_GROUP_AND_NAME = {path: (path.rpartition(".")[0], path.rpartition(".")[2]) for path in MOVABLE}


def number_at(request: Simulation, path: str) -> float | None:
    """The number at a dotted path of a request; None for a posture that is not given."""
    group, name = _GROUP_AND_NAME[path]
    if not group:
        return getattr(request, name)
    if group == "constants" and not hasattr(request.constants, name):
        return request.posturing.value(name)
    part = getattr(request, group)
    return None if part is None else getattr(part, name)


def differences(now: Simulation, wanted: Simulation) -> tuple[str, ...]:
    """The numbers in which two requests differ."""
    if now is wanted:
        return ()
    return tuple(
        path
        for part, paths in _PATHS_OF.items()
        if not _same(now, wanted, part)
        for path in paths
        if number_at(now, path) != number_at(wanted, path)
    )


#: The movable numbers by the part of a request they belong to: most of the time all but one or two parts are the same.
_PATHS_OF = {
    part: tuple(path for path in MOVABLE if path.rpartition(".")[0] == part)
    for part in dict.fromkeys(path.rpartition(".")[0] for path in MOVABLE)
}


def _same(now: Simulation, wanted: Simulation, part: str) -> bool:
    if not part:
        return False
    if part == "constants" and now.posturing is not wanted.posturing and now.posturing != wanted.posturing:
        return False
    one, other = getattr(now, part), getattr(wanted, part)
    return one is other or one == other


def approach(now: Simulation, wanted: Simulation, paths: tuple[str, ...]) -> Simulation:
    """The request one block later: every number of ``paths`` as near to ``wanted`` as a block allows."""
    return with_numbers(now, {path: _nearer(path, number_at(now, path), number_at(wanted, path)) for path in paths})


def is_near(now: Simulation, wanted: Simulation, path: str) -> bool:
    """Whether one block brings the number all the way."""
    return abs(number_at(wanted, path) - number_at(now, path)) <= LARGEST_MOVE[path]


def _nearer(path: str, value: float, goal: float) -> float:
    largest = LARGEST_MOVE[path]
    return goal if abs(goal - value) <= largest else value + max(-largest, min(largest, goal - value))
