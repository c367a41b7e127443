"""A gesture: a request in which some numbers are functions of time, given by breakpoints.

In a request document, a list of ``[time in s, value]`` pairs may replace any number, also of one side or of a lesion,
except those of the run (duration, grid, step), which are fixed before the run starts. The vowel may be a list of
``[time in s, vowel]``: it changes at those times.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from vfcore.errors import ParameterError
from vfcore.runs.gesture.track import Track, track_from_pairs
from vfcore.spec.address import computation
from vfcore.spec.paths import LISTS, NUMBERS, NUMBERS_BEYOND, known_declaration, part_of
from vfcore.spec.request import KIND as SIMULATION
from vfcore.spec.request import document_of, flat, merged, nested, patched, resolve
from vfcore.spec.simulation import VOWELS, Simulation

KIND = "gesture"
#: Numbers that may move in time: all but those of the run, which are fixed before it starts.
MOVABLE = (*(path for path in NUMBERS if not path.startswith("run.")), *NUMBERS_BEYOND)
_MOVABLE = frozenset(MOVABLE)


@dataclass(frozen=True, slots=True)
class Gesture:
    """``start``: the request at time 0, whose run sets duration and grid; ``tracks``: the numbers that move;
    ``vowels``: (time, vowel) pairs, each valid from its time on; empty: the vowel is constant.

    Raises ParameterError for a path that cannot move, a path given twice, or a value that the request refuses.
    """

    start: Simulation
    tracks: tuple[Track, ...]
    vowels: tuple[tuple[float, str], ...] = ()

    def __post_init__(self):
        seen = set()
        for track in self.tracks:
            if track.path not in _MOVABLE:
                raise ParameterError(track.path, "cannot move in time", "numbers of activation, breath and constants")
            if track.path in seen:
                raise ParameterError(track.path, "moves twice", "one list of breakpoints")
            seen.add(track.path)
            for k, value in enumerate(track.values):
                try:
                    moved(self.start, {track.path: value})
                except ParameterError as error:
                    raise ParameterError(f"{track.path}.{k}.1", error.message, error.allowed) from error

    def at(self, time_s: float) -> Simulation:
        """The request at a time."""
        now = moved(self.start, {track.path: track.at(time_s) for track in self.tracks})
        vowel = next((vowel for begin, vowel in reversed(self.vowels) if begin <= time_s), now.vowel)
        return now if vowel == now.vowel else replace(now, vowel=vowel)

    def corners_s(self) -> tuple[float, ...]:
        """Times at which a number starts or stops moving, within the run, plus 0 and the end of the run."""
        end = self.start.run.duration_s
        inside = {time for track in self.tracks for time in track.times_s if 0.0 < time < end}
        inside |= {time for time, _ in self.vowels if 0.0 < time < end}
        return (0.0, *sorted(inside), end)


def gesture_patch(document: Any) -> dict[str, Any]:
    """The patch of a gesture document, whose ``kind`` may be gesture or simulation; ParameterError as of ``flat``."""
    if isinstance(document, Mapping) and "kind" in document:
        if document["kind"] not in (KIND, SIMULATION):
            raise ParameterError("kind", f"{document['kind']!r} is not a gesture", f"{KIND} | {SIMULATION}")
        document = {key: value for key, value in document.items() if key != "kind"}
    return flat(document)


def gesture_from_dict(document: Mapping[str, Any]) -> Gesture:
    """A request document with breakpoint lists; ParameterError for the first field that cannot be used."""
    patch = gesture_patch(document)
    tracks = []
    for path, value in patch.items():
        if path in LISTS or not isinstance(value, list) or not known_declaration(path).is_number:
            continue
        if path not in _MOVABLE:
            raise ParameterError(path, "cannot move in time", "one number: it is fixed before the run starts")
        track = track_from_pairs(path, value)
        patch[path] = track.at(0.0)
        tracks.append(track)
    vowels = _vowels(patch.get("vowel"))
    if isinstance(patch.get("vowel"), list):
        patch["vowel"] = patch["vowel"][0][1]
    return Gesture(resolve(patch), tuple(tracks), vowels)


def _vowels(value: Any) -> tuple[tuple[float, str], ...]:
    if not isinstance(value, list):
        return ()
    times = track_from_pairs("vowel", [[pair[0], 0.0] if _is_pair(pair) else pair for pair in value]).times_s
    for k, (_, vowel) in enumerate(value):
        if vowel not in VOWELS:
            raise ParameterError(f"vowel.{k}.1", f"{vowel!r} is not known", " | ".join(VOWELS))
    changes = tuple((time, vowel) for time, (_, vowel) in zip(times, value, strict=True))
    return changes if len(changes) > 1 else ()  # one vowel does not change


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2


def gesture_to_dict(gesture: Gesture) -> dict[str, Any]:
    """The complete request document, with breakpoints in place of the numbers that move."""
    moving: dict[str, Any] = {track.path: track.pairs() for track in gesture.tracks}
    if gesture.vowels:
        moving["vowel"] = [[time, vowel] for time, vowel in gesture.vowels]
    document = document_of(gesture.start)
    return document | nested(merged(flat(document), moving))


def gesture_address(gesture: Gesture) -> str:
    """The address of a rendered gesture: a hash of what it computes, as for a simulation."""
    return computation(gesture.start).address({track.path: track.pairs() for track in gesture.tracks}, gesture.vowels)


def moved(request: Simulation, values: Mapping[str, float]) -> Simulation:
    """The request with the numbers at paths of MOVABLE replaced; ParameterError where one is out of range, or belongs
    to a part that is not given.
    """
    for path in values:
        row = known_declaration(path)
        for part in (*row.optional, *((row.part,) if row.part.partition(".")[0] in LISTS else ())):
            if part_of(request, part) is None:
                raise ParameterError(path, f"moves a {part} that is not given", f"a request with a {part} of its own")
    return patched(request, values)
