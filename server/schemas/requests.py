"""The request body at the wire: pydantic models made from the rows of ``vfcore.spec.schema``.

Unit, range, label and help are declared once, in the core; here they become JSON Schema. vfcore.spec.request
checks the rest, which a schema cannot express (for example a step that is too long for the grid).
"""

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, create_model, model_validator
from pydantic_core import PydanticCustomError

from vfcore.runs.gesture.gesture import MOVABLE, Gesture, gesture_from_dict
from vfcore.runs.gesture.track import LATEST_S, MOST_BREAKPOINTS
from vfcore.spec.paths import LARYNX, NAMES_IN, OPTIONAL_PARTS, PARTS
from vfcore.spec.request import resolve
from vfcore.spec.schema import parameter_schema
from vfcore.spec.simulation import Simulation

STRICT = ConfigDict(extra="forbid", strict=True)
OFFERED_KINDS = ("simulation",)
#: Every parameter by its dotted path: the ranges that refusals name.
ROWS: dict[str, dict[str, Any]] = {row["key"]: row for row in parameter_schema()}


def _field(row: dict[str, Any], moving: bool = False) -> tuple[Any, Any]:
    """The (type, default) pair of ``create_model`` for one parameter; ``moving``: it may be a list of breakpoints."""
    by_larynx = row["key"].startswith(f"{LARYNX}.")

    def extra(schema: dict[str, Any]) -> None:
        if row["unit"] is not None:
            schema["unit"] = row["unit"]
        if by_larynx:  # not given: the value of the variant and posture set in force, so no one default can be shown
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
    if moving and (row["key"] in MOVABLE or row["key"] == "vowel"):
        about = [Field(title=row["label"], description=f"{text} — or [[time in s, value], …]", json_schema_extra=extra)]
        kind = Annotated[Any, WithJsonSchema({"anyOf": [_one(row), _breakpoints(row)]})]  # the core validates it
    if row["nullable"]:
        kind = kind | None
    return Annotated[kind, *about], None if by_larynx else row["default"]


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


def _parts(suffix: str = "Body", moving: bool = False) -> tuple[dict[str, Any], dict[str, type[BaseModel]]]:
    """Fields at the top of a request, and one model per object in it."""
    objects: dict[str, type[BaseModel]] = {}
    for part in reversed((*PARTS, LARYNX)):  # inner objects first
        fields: dict[str, Any] = {name: _field(ROWS[f"{part}.{name}"], moving) for name in NAMES_IN[part]}
        fields |= _part_fields(objects, part)
        name = "".join(word.capitalize() for word in part.split("."))
        objects[part] = create_model(f"{name}{suffix}", __config__=STRICT, **fields)
    top = {name: _field(ROWS[name], moving) for name in NAMES_IN[""]}
    return top, {part: objects[part] for part in (*PARTS, LARYNX)}


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


_TOP, _OBJECTS = _parts()


_OBJECT_FIELDS = _part_fields(_OBJECTS)
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
        **(_MOVING_TOP | _part_fields(_MOVING_OBJECTS)),
    )


def gesture_of(body: BaseModel) -> Gesture:
    """The validated gesture; ParameterError for what the schema cannot express."""
    return gesture_from_dict(body.model_dump(exclude_unset=True, exclude={"kind"}))


def simulation_of(body: BaseModel) -> Simulation:
    """The validated request; ParameterError for what the schema cannot express."""
    return resolve(body.model_dump(exclude_unset=True, exclude={"fresh"}))


def allowed_at(path: str) -> str | None:
    """The values that a field of a body takes, in words; None when there is no such field."""
    path = path.removeprefix("base.")
    if path in _OBJECTS:
        return f"an object with {', '.join(sorted(_OBJECTS[path].model_fields))}"
    if (row := ROWS.get(path)) is None:
        return None
    if row["options"]:
        return " | ".join(row["options"])
    if row["type"] == "boolean":
        return "true | false"
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{row['min']:g} to {row['max']:g}{unit}" + (", or null" if row["nullable"] else "")


def known_names(path: str) -> str:
    """The known names in the object that has an unknown one."""
    parent, _, _ = path.removeprefix("base.").rpartition(".")
    if parent == "constants":
        return "the constants listed by GET /api/v1/parameters"
    names = _OBJECTS[parent].model_fields if parent in _OBJECTS else SimulationBody.model_fields
    return ", ".join(sorted(names))
