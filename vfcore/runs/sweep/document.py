"""A sweep document (plain dict, as in JSON) to a ``Sweep`` and back; errors carry the dotted path of their field."""

from collections.abc import Mapping, Sequence
from typing import Any

from vfcore.errors import ParameterError
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.many import PRECISIONS
from vfcore.runs.sweep.plan import Axis, Sweep
from vfcore.spec.paths import number_of, value_for
from vfcore.spec.request import document_of, flat, resolve
from vfcore.spec.simulation import Simulation

MOST_AXES = 3
MOST_POINTS = 10**9  # positions beyond are not exact in every client
MOST_WITH_WAVEFORMS = 500  # about 3 MB each
KEYS = ("kind", "base", "axes", "points", "measures", "precision", "keep_waveforms")


def sweep_from_dict(document: Mapping[str, Any]) -> Sweep:
    """Validate a sweep document; ParameterError for the first field that cannot be used.

    Numbers are checked one by one. Where those of one point are inconsistent (a rise time longer than the run, a step
    too long for the grid), that point gets the reason and the others are computed.
    """
    if not isinstance(document, Mapping):
        raise ParameterError("sweep", f"{type(document).__name__} is not an object", "an object with named fields")
    for key in document:
        if key not in KEYS:
            raise ParameterError(str(key), "is not a known field", ", ".join(sorted(KEYS)))
    if document.get("kind", "sweep") != "sweep":
        raise ParameterError("kind", f"{document['kind']!r} is not a sweep", "sweep")
    axes, points = document.get("axes"), document.get("points")
    if (axes is None) == (points is None):
        both = "cannot be combined with points"
        raise ParameterError("axes", "is missing" if points is None else both, "either axes or points")
    sweep = Sweep(
        base=_base(document.get("base", {})),
        axes=_axes(axes) if axes is not None else (),
        points=_points(points) if points is not None else (),
        measures=_measures(document.get("measures")),
        precision=_precision(document.get("precision", "float64")),
        keep_waveforms=_flag(document.get("keep_waveforms", False)),
    )
    if len(sweep) > MOST_POINTS:
        raise ParameterError("axes", f"{len(sweep)} points are too many", f"up to {MOST_POINTS:g} points")
    if sweep.keep_waveforms and sweep.precision != "float64":
        raise ParameterError(
            "precision", "float32 cannot be combined with keep_waveforms", "float64, or keep_waveforms false"
        )
    if sweep.keep_waveforms and len(sweep) > MOST_WITH_WAVEFORMS:
        raise ParameterError(
            "keep_waveforms",
            f"{len(sweep)} points are too many to keep the waveforms of",
            f"up to {MOST_WITH_WAVEFORMS} points",
        )
    return sweep


def sweep_to_dict(sweep: Sweep) -> dict[str, Any]:
    """The complete, canonical sweep document: equal sweeps are equal documents."""
    document: dict[str, Any] = {"kind": "sweep", "base": document_of(sweep.base)}
    if sweep.axes:
        document["axes"] = [
            {"parameter": _one_or_many(axis.parameters), "values": list(axis.values)} for axis in sweep.axes
        ]
    else:
        document["points"] = [dict(point) for point in sweep.points]
    document["measures"] = None if sweep.measures is None else list(sweep.measures)
    return document | {"precision": sweep.precision, "keep_waveforms": sweep.keep_waveforms}


def _one_or_many(paths: tuple[str, ...]) -> str | list[str]:
    return paths[0] if len(paths) == 1 else list(paths)


def _base(document: Any) -> Simulation:
    try:
        base = resolve(document)
    except ParameterError as error:
        path = "base" if error.path == "request" else f"base.{error.path}"
        raise ParameterError(path, error.message, error.allowed) from error
    if base.run.error_estimate:
        raise ParameterError("base.run.error_estimate", "is not for sweeps", "false; single runs carry error bars")
    return base


def _list(value: Any, at: str, allowed: str) -> Sequence[Any]:
    if not isinstance(value, list | tuple) or not value:
        raise ParameterError(at, "is empty" if value in ([], ()) else f"{type(value).__name__} is not a list", allowed)
    return value


def _axes(entries: Any) -> tuple[Axis, ...]:
    entries = _list(entries, "axes", f"1 to {MOST_AXES} axes")
    if len(entries) > MOST_AXES:
        raise ParameterError("axes", f"{len(entries)} axes are too many", f"1 to {MOST_AXES} axes")
    axes = tuple(_axis(entry, f"axes.{k}") for k, entry in enumerate(entries))
    seen: set[str] = set()
    for k, axis in enumerate(axes):
        for path in axis.parameters:
            if path in seen:
                raise ParameterError(f"axes.{k}.parameter", f"{path} is varied twice", "each number on one axis only")
            seen.add(path)
    return axes


def _axis(entry: Any, at: str) -> Axis:
    if not isinstance(entry, Mapping):
        raise ParameterError(at, f"{type(entry).__name__} is not an object", "an object with parameter and values")
    for key in ("parameter", "values"):
        if key not in entry:
            raise ParameterError(f"{at}.{key}", "is missing", "parameter and values")
    for key in entry:
        if key not in ("parameter", "values"):
            raise ParameterError(f"{at}.{key}", "is not a known field", "parameter, values")
    given = entry["parameter"]
    tied = given if isinstance(given, list | tuple) else [given]
    names = _list(tied, f"{at}.parameter", "a path, or a list of paths that take the same values")
    places = [f"{at}.parameter" + (f".{k}" if tied is given else "") for k in range(len(names))]
    paths = tuple(number_of(name, place) for name, place in zip(names, places, strict=True))
    values = _list(entry["values"], f"{at}.values", "a list of numbers")
    checked = tuple(value_for(paths[0], value, f"{at}.values.{k}") for k, value in enumerate(values))
    for path in paths[1:]:
        for k, value in enumerate(values):
            value_for(path, value, f"{at}.values.{k}")
    return Axis(paths, checked)


def _points(entries: Any) -> tuple[dict[str, float], ...]:
    entries = _list(entries, "points", "a list of objects with numbers by path")
    return tuple(_point(entry, f"points.{k}") for k, entry in enumerate(entries))


def _point(entry: Any, at: str) -> dict[str, float]:
    """``{"activation": {"ct": 1}}`` and ``{"activation.ct": 1}`` mean the same."""
    try:
        patch = flat(entry, at)
    except ParameterError as error:
        path = error.path if error.path == at else f"{at}.{error.path}"
        raise ParameterError(path, error.message, error.allowed) from error
    return {number_of(path, f"{at}.{path}"): value_for(path, value, f"{at}.{path}") for path, value in patch.items()}


def _measures(keys: Any) -> tuple[str, ...] | None:
    if keys is None:
        return None
    for k, key in enumerate(_list(keys, "measures", "keys of the catalogue of measures, or null for all")):
        if key not in CATALOGUE.keys():  # noqa: SIM118 - the catalogue iterates over rows
            raise ParameterError(f"measures.{k}", f"{key!r} is not a measure", ", ".join(CATALOGUE.keys()))
    wanted = set(keys)
    return tuple(key for key in CATALOGUE.keys() if key in wanted)  # noqa: SIM118


def _precision(value: Any) -> str:
    if value not in PRECISIONS:
        raise ParameterError("precision", f"{value!r} is not known", " | ".join(PRECISIONS))
    return value


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ParameterError("keep_waveforms", f"{value!r} is neither true nor false", "true | false")
    return value
