"""The request body at the wire: pydantic models made from the rows of ``vfcore.spec.schema``.

Unit, range, label and help are declared once, in the core; here they become JSON Schema. vfcore.spec.request
checks the rest, which a schema cannot express (for example a step that is too long for the grid).
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, create_model, model_validator
from pydantic_core import PydanticCustomError

from vfcore.runs.gesture.gesture import MOVABLE, Gesture, gesture_from_dict
from vfcore.runs.gesture.track import LATEST_S, MOST_BREAKPOINTS
from vfcore.spec.declarations import LARYNX, SIDES
from vfcore.spec.paths import (
    LISTS,
    NAMES_IN,
    NUMBERS,
    NUMBERS_BEYOND,
    OPTIONAL_PARTS,
    PARTS,
    common_to_both_sides,
    item_of,
    names_known_in,
)
from vfcore.spec.request import resolve
from vfcore.spec.schema import parameter_catalogue
from vfcore.spec.simulation import Simulation

STRICT = ConfigDict(extra="forbid", strict=True)
OFFERED_KINDS = ("simulation",)
#: Every parameter by its dotted path: the ranges that refusals name.
_CATALOGUE = parameter_catalogue()
ROWS: dict[str, dict[str, Any]] = {row["key"]: row for row in _CATALOGUE["parameters"]}
#: The values of an object of each list by name.
ITEM_ROWS = {of["key"]: {row["key"]: row for row in of["parameters"]} for of in _CATALOGUE["lists"]}
#: Every path of a number of a request.
NUMBER_PATHS = (*NUMBERS, *NUMBERS_BEYOND)


def _field(row: dict[str, Any], moving: bool = False, on_side: bool = False) -> tuple[Any, Any]:
    """The (type, default) pair of ``create_model`` for one parameter; ``moving``: it may be a list of breakpoints;
    ``on_side``: it is that of one fold.
    """
    # Not given: the value of the variant and posture set in force, or of the request, so no one default can be shown.
    has_no_default = on_side or row["key"].startswith(f"{LARYNX}.")

    def extra(schema: dict[str, Any]) -> None:
        if row["unit"] is not None:
            schema["unit"] = row["unit"]
        if has_no_default:
            schema.pop("default", None)

    text = " — ".join(text for text in (row["help"], row["source"]) if text)
    about: list[Any] = [Field(title=row["label"], description=text, json_schema_extra=extra)]
    kind: Any
    if row["type"] == "choice":
        kind = Literal[tuple(row["options"])]
    elif row["type"] == "boolean":
        kind = bool
    elif row["type"] == "integer":
        kind = int
        about += [Field(ge=row["min"], le=row["max"]), BeforeValidator(_whole)]
    else:
        kind = float
        about.append(Field(ge=row["min"], le=row["max"], allow_inf_nan=False))
    if moving:
        about = [Field(title=row["label"], description=f"{text} — or [[time in s, value], …]", json_schema_extra=extra)]
        kind = Annotated[Any, WithJsonSchema({"anyOf": [_one(row), _breakpoints(row)]})]  # the core validates it
    if row["nullable"]:
        kind = kind | None
    return Annotated[kind, *about], None if has_no_default else row["default"]


def _one(row: dict[str, Any]) -> dict[str, Any]:
    if row["type"] == "choice":
        return {"enum": row["options"]}
    return {"type": "number", "minimum": row["min"], "maximum": row["max"]}


def _breakpoints(row: dict[str, Any]) -> dict[str, Any]:
    time = {"type": "number", "minimum": 0, "maximum": LATEST_S}
    pair = {"type": "array", "prefixItems": [time, _one(row)], "minItems": 2, "maxItems": 2}
    return {"type": "array", "items": pair, "minItems": 1, "maxItems": MOST_BREAKPOINTS}


def _whole(value: Any) -> Any:
    """20.0 is a whole number in JSON."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _parts(suffix: str, moving: bool, on_side: bool = False) -> tuple[dict[str, Any], dict[str, type[BaseModel]]]:
    """Fields at the top of a request, and one model per object in it; ``on_side``: those that a side has."""

    def fields_of(part: str) -> dict[str, Any]:
        rows = {name: ROWS[f"{part}.{name}" if part else name] for name in NAMES_IN[part]}
        return {
            name: _field(row, moving and (row["key"] in MOVABLE or row["key"] == "vowel"), on_side)
            for name, row in rows.items()
            if row["per_side"] or not on_side
        }

    objects: dict[str, type[BaseModel]] = {}
    for part in reversed((*PARTS, LARYNX)):  # inner objects first
        fields = fields_of(part) | _part_fields(objects, part)
        if fields:
            objects[part] = create_model(f"{_camel(part)}{suffix}", __config__=STRICT, **fields)
    return fields_of(""), {part: objects[part] for part in (*PARTS, LARYNX) if part in objects}


def _camel(part: str) -> str:
    return "".join(word.capitalize() for word in part.split("."))


def _beyond(suffix: str = "Body", moving: bool = False) -> dict[str, tuple[Any, Any]]:
    """Fields of the sides and of the lists of a request."""
    top, objects = _parts(f"Side{suffix}", moving, on_side=True)
    of_side: dict[str, Any] = top | _part_fields(objects)
    text = "The values in which the fold of one side differs; all others are those of the request."
    side = create_model(f"Side{suffix}", __config__=STRICT, __doc__=text, **of_side)
    text = "the fold of the patient's {} side; null: as the request says"
    fields: dict[str, tuple[Any, Any]] = {
        name: (Annotated[side | None, Field(description=text.format(name))], None) for name in SIDES
    }
    for name, of in LISTS.items():
        values: dict[str, Any] = {
            key: _field(row, moving and row["type"] == "number") for key, row in ITEM_ROWS[name].items()
        }
        item = create_model(f"{of.kind.__name__}{suffix}", __config__=STRICT, **values)
        about: Any = Field(default_factory=list, max_length=of.at_most, title=of.label, description=of.help)
        fields[name] = (Annotated[list[item], BeforeValidator(_in_order)], about)  # type: ignore[valid-type]
    return fields


def _in_order(value: Any) -> Any:
    """Objects by position, {"0": {…}, "1": {…}}, as a list: so the page has them, whose entries are paths."""
    if not isinstance(value, dict) or value.keys() != {str(k) for k in range(len(value))}:
        return value
    return [value[str(k)] for k in range(len(value))]


def _part_fields(objects: dict[str, type[BaseModel]], inside: str = "") -> dict[str, tuple[Any, Any]]:
    """The objects directly in a part as fields; "" for those of a request."""
    return {
        part.rpartition(".")[2]: (model | None, None)
        if part in OPTIONAL_PARTS
        else (model, Field(default_factory=model))
        for part, model in objects.items()
        if part.rpartition(".")[0] == inside
    }


class _Kind(BaseModel):
    model_config = STRICT
    kind: Literal["simulation"] = "simulation"

    @model_validator(mode="before")
    @classmethod
    def _offered(cls, document: Any) -> Any:
        """A kind that is not possible here gets a message of its own, and no list of unknown keys."""
        kind = document.get("kind", "simulation") if isinstance(document, dict) else "simulation"
        if isinstance(kind, str) and kind not in OFFERED_KINDS:
            raise PydanticCustomError("kind_not_offered", "must be one simulation here; POST /jobs takes other kinds")
        return document


_TOP, _OBJECTS = _parts("Body", moving=False)
_OBJECT_FIELDS = _part_fields(_OBJECTS) | _beyond()
if TYPE_CHECKING:  # a type checker cannot follow models that are made from rows

    class PostureBody(_Kind): ...

    class SimulationBody(_Kind): ...

    class JobBody(SimulationBody):
        fresh: bool

    class GestureBody(BaseModel): ...

else:
    PostureBody = create_model(
        "PostureBody",
        __base__=_Kind,
        __doc__="A request without its run: what the posture and the shape at rest depend on.",
        **(_TOP | {name: field for name, field in _OBJECT_FIELDS.items() if name != "run"}),
    )
    SimulationBody = create_model(
        "SimulationBody", __base__=_Kind, __doc__=Simulation.__doc__, **(_TOP | _OBJECT_FIELDS)
    )
    JobBody = create_model(
        "JobBody",
        __base__=SimulationBody,
        __doc__="A simulation to be run as a job.",
        fresh=(Annotated[bool, Field(description="run again even when the same request has a finished job")], False),
    )
    _MOVING_TOP, _MOVING_OBJECTS = _parts("GestureBody", moving=True)
    GestureBody = create_model(
        "GestureBody",
        __config__=STRICT,
        __doc__="A simulation in which numbers may be breakpoints over time, [[time in s, value], …].",
        kind=(Literal["simulation", "gesture"], "gesture"),
        **(_MOVING_TOP | _part_fields(_MOVING_OBJECTS) | _beyond("GestureBody", moving=True)),
    )


def gesture_of(body: BaseModel) -> Gesture:
    """The validated gesture; ParameterError for what the schema cannot express."""
    return gesture_from_dict(body.model_dump(exclude_unset=True))


def simulation_of(body: BaseModel) -> Simulation:
    """The validated request; ParameterError for what the schema cannot express."""
    return resolve(body.model_dump(exclude_unset=True, exclude={"fresh"}))


def allowed_at(path: str) -> str | None:
    """The values that a field of a body takes, in words; None when there is no such field."""
    path = path.removeprefix("base.")
    if path and names_known_in(path):
        return f"an object with {', '.join(sorted(names_known_in(path)))}"
    if path in LISTS:
        return f"a list of up to {LISTS[path].at_most} objects"
    first, _, rest = path.partition(".")
    item = item_of(path)
    row = ITEM_ROWS[item[0]].get(item[2]) if item else ROWS.get(rest if first in SIDES else path)
    if row is None:
        return None
    if row["options"]:
        return " | ".join(row["options"])
    if row["type"] == "boolean":
        return "true | false"
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{row['min']:g} to {row['max']:g}{unit}" + (", or null" if row["nullable"] else "")


def models_in(annotation: Any) -> list[type[BaseModel]]:
    """The models that a type is made of: itself, or the members of a union, or the entries of a list."""
    if isinstance(annotation, type) and get_origin(annotation) is None:
        return [annotation] if issubclass(annotation, BaseModel) else []
    return [model for inner in get_args(annotation) for model in models_in(inner)]


def refused_name(body: type[BaseModel], place: Sequence[int | str], path: str) -> tuple[str, str]:
    """Why the object of ``body`` has no field at ``place``, of the dotted ``path``, and which it has."""
    common = common_to_both_sides(path.removeprefix("base."))
    return ("is not a known field", known_names(body, place)) if common is None else (common.message, common.allowed)


def known_names(body: type[BaseModel], place: Sequence[int | str]) -> str:
    """The known names in the object of ``body`` that has an unknown one at ``place``."""
    if place[-2:-1] == [LARYNX]:
        return "the constants listed by GET /api/v1/parameters"
    for part in place[:-1]:
        if part in body.model_fields:
            body = models_in(body.model_fields[str(part)].annotation)[0]
    return ", ".join(sorted(body.model_fields))
