"""A sweep, expanded lazily: from a position to a request and to the address of its result."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from vfcore.measures.catalogue import CATALOGUE
from vfcore.spec.address import Computation, computation, content_hash
from vfcore.spec.paths import known_declaration, one_form
from vfcore.spec.request import patched
from vfcore.spec.simulation import Simulation


@dataclass(frozen=True, slots=True)
class Axis:
    """``parameters``: dotted paths that share the same ``values``."""

    parameters: tuple[str, ...]
    values: tuple[float, ...]

    @property
    def name(self) -> str:
        """The name of the dimension: the first path with underscores, ``activation_ct``."""
        return self.parameters[0].replace(".", "_")

    @property
    def unit(self) -> str:
        return known_declaration(self.parameters[0]).metadata["unit"]

    @property
    def label(self) -> str:
        return " and ".join(known_declaration(path).metadata["label"] for path in self.parameters)


@dataclass(frozen=True)
class Sweep:
    """A base request and the numbers of every point: the product of ``axes`` in C order, or ``points`` in order.

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
        values = zip(self.axes, places, strict=True)
        # Tied paths may be of different types: each has its own form.
        return {
            path: one_form(known_declaration(path), a.values[place]) for a, place in values for path in a.parameters
        }

    def request(self, position: int) -> Simulation:
        """The request of one point; ParameterError where its numbers are inconsistent."""
        return patched(self.base, self.numbers(position))

    def part(self, positions: Iterable[int]) -> "Sweep":
        """A sweep of the points at these positions, as a list: the work of one task."""
        return replace(self, axes=(), points=tuple(self.numbers(position) for position in positions))

    def requests(self) -> Iterator[Simulation]:
        """The requests of all points, one at a time."""
        return (self.request(position) for position in range(len(self)))

    def computation(self, position: int) -> Computation:
        """The computation of one point, without building its request."""
        return self._base_computation.with_numbers(self.numbers(position))

    def address(self, position: int) -> str:
        """The address of the scalars of one point; sweeps that ask for the same scalars share it."""
        return self.computation(position).address(self.precision, self._columns)

    @property
    def content(self) -> str:
        """The address of the whole sweep."""
        asked = {
            "kind": "sweep",
            "base": self._base_computation.address(),
            "axes": [[axis.parameters, axis.values] for axis in self.axes],
            "points": self.points,
            "columns": self._columns,
            "precision": self.precision,
            "keep_waveforms": self.keep_waveforms,
        }
        return content_hash(asked)

    @cached_property
    def _base_computation(self) -> Computation:
        return computation(self.base)

    @cached_property
    def _columns(self) -> list[tuple[str, str]]:
        """The measures by key and version, so that rows of another catalogue have other addresses."""
        keys = CATALOGUE.keys() if self.measures is None else self.measures
        return [(key, CATALOGUE[key].version) for key in keys]
