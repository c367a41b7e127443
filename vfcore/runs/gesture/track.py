"""Breakpoints: how one number moves in time."""

import sys
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from vfcore.errors import ParameterError
from vfcore.spec.fields import check_number, is_number

MOST_BREAKPOINTS = 1000
LATEST_S = 3600.0
_FORM = "a list of [time in s, value] pairs with rising times"


@dataclass(frozen=True, slots=True)
class Track:
    """Linear interpolation between breakpoints; constant before the first and after the last.

    ``path`` is the dotted name of a number of the request. Raises ParameterError with the path of the breakpoint.
    """

    path: str
    times_s: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self):
        check_number(f"{self.path} (breakpoints)", len(self.times_s), 1, MOST_BREAKPOINTS)
        for k, time in enumerate(self.times_s):
            check_number(f"{self.path}.{k}.0", time, 0.0, LATEST_S, "s")
            if k and time <= self.times_s[k - 1]:
                raise ParameterError(
                    f"{self.path}.{k}.0", f"{time:g} s is not after {self.times_s[k - 1]:g} s", "rising times"
                )

    def at(self, time_s: float) -> float:
        """The value at a time."""
        k = bisect_right(self.times_s, time_s)
        if k == 0:
            return self.values[0]
        if k == len(self.times_s):
            return self.values[-1]
        t0, t1 = self.times_s[k - 1], self.times_s[k]
        v0, v1 = self.values[k - 1], self.values[k]
        return v0 + (v1 - v0) * (time_s - t0) / (t1 - t0)

    def pairs(self) -> list[list[float]]:
        """The breakpoints as a request document has them."""
        return [[t, v] for t, v in zip(self.times_s, self.values, strict=True)]


def track_from_pairs(path: str, pairs: Sequence) -> Track:
    """A track from the ``[[time, value], …]`` of a request document."""
    for k, pair in enumerate(pairs):
        if not isinstance(pair, Sequence) or isinstance(pair, str) or len(pair) != 2:
            raise ParameterError(f"{path}.{k}", f"{pair!r} is not a breakpoint", _FORM)
        for j, number in enumerate(pair):
            if not is_number(number):
                raise ParameterError(f"{path}.{k}.{j}", f"{number!r} is not a number", _FORM)
            if not abs(number) <= sys.float_info.max:  # an integer may be larger than any float
                raise ParameterError(f"{path}.{k}.{j}", "is not a finite number", _FORM)
    # Adding 0.0 makes a negative zero positive.
    return Track(path, tuple(float(time) + 0.0 for time, _ in pairs), tuple(float(value) + 0.0 for _, value in pairs))
