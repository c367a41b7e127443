"""A gesture: a simulation in which some numbers are breakpoints over time.

In a request document a list of ``[time in s, value]`` pairs may stand wherever a number does, but for the numbers of
the run itself (duration, grid, step), which the march fixes before it starts. The vowel may be a list of
``[time in s, vowel]``: it changes at those times.
"""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from typing import Any

from vfcore.errors import ParameterError
from vfcore.runs.gesture.track import Track, track_from_pairs
from vfcore.spec.address import computation, content_hash
from vfcore.spec.document import numeric_paths, simulation_from_dict, simulation_to_dict
from vfcore.spec.document import with_numbers as changed
from vfcore.spec.simulation import VOWELS, Simulation

MOVABLE = tuple(path for path in numeric_paths() if not path.startswith("run."))


@dataclass(frozen=True, slots=True)
class Gesture:
    """``start``: the simulation at time 0, whose run sets duration and grid; ``tracks``: the numbers that move;
    ``vowels``: (time, vowel) from which each holds, empty where it stays.

    Raises ParameterError for a path that cannot move, a path given twice, or a value that the request refuses.
    """

    start: Simulation
    tracks: tuple[Track, ...]
    vowels: tuple[tuple[float, str], ...] = ()

    def __post_init__(self):
        seen = set()
        for track in self.tracks:
            if track.path not in MOVABLE:
                raise ParameterError(track.path, "cannot move in time", "numbers of activation, breath and constants")
            if track.path in seen:
                raise ParameterError(track.path, "moves twice", "one list of breakpoints")
            seen.add(track.path)
            for k, value in enumerate(track.values):
                try:
                    with_number(self.start, track.path, value)
                except ParameterError as error:
                    raise ParameterError(f"{track.path}.{k}.1", error.message, error.allowed) from error

    def at(self, time_s: float) -> Simulation:
        """The request as it stands at a time."""
        now = with_numbers(self.start, {track.path: track.at(time_s) for track in self.tracks})
        vowel = next((vowel for begin, vowel in reversed(self.vowels) if begin <= time_s), now.vowel)
        return now if vowel == now.vowel else replace(now, vowel=vowel)

    def corners_s(self) -> tuple[float, ...]:
        """Times at which some number begins or ends to move, inside the run, with 0 and its end."""
        end = self.start.run.duration_s
        inside = {time for track in self.tracks for time in track.times_s if 0.0 < time < end}
        inside |= {time for time, _ in self.vowels if 0.0 < time < end}
        return (0.0, *sorted(inside), end)


def gesture_from_dict(document: Mapping[str, Any]) -> Gesture:
    """A request document with breakpoint lists; ParameterError for the first field that cannot be used."""
    plain = deepcopy(dict(document))
    tracks = []
    for path in numeric_paths():
        *parents, key = path.split(".")
        place = plain
        for parent in parents:
            place = place.get(parent) if isinstance(place, dict) else None
        if not isinstance(place, dict) or not isinstance(place.get(key), list):
            continue
        if path not in MOVABLE:
            raise ParameterError(path, "cannot move in time", "one number: the march fixes it before it starts")
        track = track_from_pairs(path, place[key])
        place[key] = track.at(0.0)
        tracks.append(track)
    vowels = _vowels(plain.get("vowel"))
    if vowels:
        plain["vowel"] = vowels[0][1]
    return Gesture(simulation_from_dict(plain), tuple(tracks), vowels)


def _vowels(value: Any) -> tuple[tuple[float, str], ...]:
    if not isinstance(value, list):
        return ()
    times = track_from_pairs("vowel", [[pair[0], 0.0] if _is_pair(pair) else pair for pair in value]).times_s
    for k, (_, vowel) in enumerate(value):
        if vowel not in VOWELS:
            raise ParameterError(f"vowel.{k}.1", f"{vowel!r} is not known", " | ".join(VOWELS))
    return tuple((time, vowel) for time, (_, vowel) in zip(times, value, strict=True))


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2


def gesture_to_dict(gesture: Gesture) -> dict[str, Any]:
    """The complete request document, breakpoints in the place of the numbers that move."""
    document = simulation_to_dict(gesture.start)
    for track in gesture.tracks:
        *parents, key = track.path.split(".")
        place = document
        for parent in parents:
            place = place[parent]
        place[key] = track.pairs()
    if gesture.vowels:
        document["vowel"] = [[time, vowel] for time, vowel in gesture.vowels]
    return document


def gesture_address(gesture: Gesture) -> str:
    """Where a rendered gesture is kept: of what it computes, as for a simulation."""
    return content_hash(
        {
            "kind": "gesture",
            "start": computation(gesture.start),
            "tracks": {track.path: track.pairs() for track in gesture.tracks},
            "vowels": gesture.vowels,
        }
    )


def with_number(request: Simulation, path: str, value: float) -> Simulation:
    """The request with one number (a path of MOVABLE) replaced; ParameterError when it is out of range."""
    return with_numbers(request, {path: value})


def with_numbers(request: Simulation, values: Mapping[str, float]) -> Simulation:
    """The same with several numbers at once; a posture that is not given does not move."""
    for path in values:
        if path.startswith("posture.") and request.posture is None:
            raise ParameterError(path, "moves a posture that is not given", "a request with a posture of its own")
    return changed(request, values)
