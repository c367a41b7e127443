"""Two different folds: a side is a patch on the request.

A request describes one fold and its mirror image. ``left`` and ``right`` (the patient's sides) hold the values in which
the fold of that side differs. ``folds_of`` resolves them: each fold is a plain request of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol, Self, TypeVar

from vfcore.errors import ParameterError
from vfcore.spec.declarations import LARYNX, SIDES, declarations_of, lists_of, optional_parts_of, tree_of
from vfcore.spec.fields import check_value
from vfcore.spec.larynx import Larynx

_ONLY_PER_SIDE = "a value of one fold: activation, posture, convergence angle, constants of tissue, muscles and contact"


@dataclass(frozen=True, slots=True)
class Side:
    """The values in which one fold differs from the request: (path, value) pairs in the order of the paths, which are
    those of a request. None in place of an optional part: this fold is without it. ``side_of`` makes it.
    """

    values: tuple[tuple[str, Any], ...]


class _Request(Protocol):
    """What a request (vfcore.spec.simulation.Simulation) offers here."""

    @property
    def left(self) -> Side | None: ...
    @property
    def right(self) -> Side | None: ...
    @property
    def larynx(self) -> Larynx: ...
    @property
    def folds(self) -> tuple[Self, ...] | None: ...
    def copied(self, **fields: Any) -> Self: ...
    def with_values(self, tree: Mapping[str, Any], **fields: Any) -> Self: ...


Request = TypeVar("Request", bound=_Request)


def folds_of(request: Request) -> tuple[Request, ...]:
    """The folds of a request, each a request without sides, whose lesions are those of this fold.

    One fold: both sides are the same, mirrored. Two: the left and the right one. Resolved when the request is created,
    so this costs nothing.
    """
    return (request,) if request.folds is None else request.folds


def fold_on(request: Request, side: str) -> Request:
    """The fold of a side, "left" or "right"."""
    return folds_of(request)[0 if side == SIDES[0] else -1]


def resolved_folds(request: Request) -> tuple[Request, ...] | None:
    """What ``folds_of`` returns, computed; None where it is the request itself.

    Raises ParameterError with the path of the first value of a side that cannot be used.
    """
    lists = lists_of(type(request))
    if request.left is None and request.right is None and not any(getattr(request, name) for name in lists):
        return None
    left, right = (_fold(request, side) for side in SIDES)
    if left != right:
        return left, right
    return None if left == request else (left,)


def _fold(request: Request, name: str) -> Request:
    lists = lists_of(type(request)).values()
    fold = request.copied(
        left=None, right=None, folds=None, **{row.path: row.on_side(getattr(request, row.path), name) for row in lists}
    )
    side = getattr(request, name)
    if side is None:
        return fold
    _check(type(request), name, side)
    tree = tree_of(dict(side.values))
    constants = tuple(tree.pop(LARYNX, {}).items())
    try:
        return fold.with_values(tree, **({"larynx": _overridden(fold.larynx, constants)} if constants else {}))
    except ParameterError as error:  # values that are inconsistent with each other
        raise ParameterError(f"{name}.{error.path}", error.message, error.allowed) from error


@lru_cache(maxsize=32)  # a voice of two folds is resolved a hundred times a second, mostly with the same constants
def _overridden(larynx: Larynx, changes: tuple[tuple[str, float], ...]) -> Larynx:
    return larynx.override(dict(changes))


def _check(kind: type, name: str, side: Side) -> None:
    """Raise ParameterError for a value that a side cannot have."""
    rows, optional = declarations_of(kind), optional_parts_of(kind)
    for path, value in side.values:
        if value is None and path in optional and any(rows[p].per_side for p in rows if p.startswith(f"{path}.")):
            continue
        row = rows.get(path)
        if row is None or not row.per_side:
            raise not_per_side(name, path, row is not None and row.metadata.get("common", ""))
        if value is not None or row.default is not None:
            check_value(f"{name}.{path}", value, row.metadata)


def not_per_side(side: str, path: str, why: Any) -> ParameterError:
    """The error for a path of a request that a side does not have; ``why``: the reason, False for no path at all."""
    if why is False:
        known = f"a field of the request that may differ: {_ONLY_PER_SIDE}"
        return ParameterError(f"{side}.{path}", "is not a known field", known)
    reason = f"is common to both sides: {why}" if why else "is common to both sides"
    where = f"{path}, for both" if path.startswith(f"{LARYNX}.") else _ONLY_PER_SIDE
    return ParameterError(f"{side}.{path}", reason, where)


def side_of(given: Any) -> Side | None:
    """A side as a request holds it: of a mapping by path, or of a side; None where nothing differs."""
    values = given.values if isinstance(given, Side) else tuple(sorted((given or {}).items()))
    return Side(values) if values else None
