"""What a sweep asks, expanded lazily: from a position in it to a request, and to the address of its result."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from vfcore.content import canonical, content_hash
from vfcore.params import Simulation
from vfcore.request import with_numbers
from vfcore.sweep.paths import Defaults, document_with_numbers, numbers


@dataclass(frozen=True, slots=True)
class Axis:
    """``parameters``: dotted paths that take the same ``values`` together."""

    parameters: tuple[str, ...]
    values: tuple[float, ...]

    @property
    def name(self) -> str:
        """The name of the dimension: the first path with underscores, ``activation_ct``."""
        return self.parameters[0].replace(".", "_")

    @property
    def unit(self) -> str:
        return numbers()[self.parameters[0]]["unit"]

    @property
    def label(self) -> str:
        return " and ".join(numbers()[path]["label"] for path in self.parameters)


@dataclass(frozen=True)
class Sweep:
    """``base`` with the numbers of every point: the product of ``axes`` in C order, or ``points`` one after the other.

    ``measures``: keys of the catalogue to keep, None for all. Positions count from 0 to len(sweep) − 1.
    """

    base: Simulation
    axes: tuple[Axis, ...] = ()
    points: tuple[dict[str, float], ...] = ()
    measures: tuple[str, ...] | None = None
    precision: str = "float64"
    keep_waveforms: bool = False
    shape: tuple[int, ...] = field(init=False)

    def __post_init__(self) -> None:
        lengths = tuple(len(axis.values) for axis in self.axes) or (len(self.points),)
        object.__setattr__(self, "shape", lengths)

    def __len__(self) -> int:
        return math.prod(self.shape)

    def numbers(self, position: int) -> dict[str, float]:
        """The numbers of one point by dotted path."""
        if not self.axes:
            return self.points[position]
        places = np.unravel_index(position, self.shape)
        return {
            path: axis.values[place]
            for axis, place in zip(self.axes, places, strict=True)
            for path in axis.parameters
        }  # fmt: skip

    def request(self, position: int) -> Simulation:
        """The simulation of one point; ParameterError where its numbers do not go together."""
        return with_numbers(self.base, self.numbers(position))

    def part(self, positions: Iterable[int]) -> "Sweep":
        """The points at these positions alone, as a list: what a worker is sent."""
        return replace(self, axes=(), points=tuple(self.numbers(position) for position in positions))

    def requests(self) -> Iterator[Simulation]:
        """All of them, one at a time."""
        return (self.request(position) for position in range(len(self)))

    def document(self, position: int) -> dict[str, Any]:
        """The canonical request document of one point, without building the request."""
        return document_with_numbers(self._document, self.numbers(position), self._defaults)

    def address(self, position: int) -> str:
        """Where the scalars of one point are stored: shared by every sweep that asks for the same ones."""
        return content_hash([self.document(position), self.precision, self.measures])

    @cached_property
    def _document(self) -> dict[str, Any]:
        return canonical(self.base)

    @cached_property
    def _defaults(self) -> Defaults:
        return Defaults(self.base)
