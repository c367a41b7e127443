"""A row of postures at the wire: one request, and the values that one of its numbers takes."""

from typing import Annotated

from pydantic import BaseModel, Field

from vfcore.errors import ParameterError
from vfcore.spec.paths import value_for
from vfcore.spec.request import patched
from vfcore.spec.simulation import Simulation
from vocalis.server.schemas.requests import NUMBER_PATHS, STRICT, PostureBody, simulation_of

#: A posture and its shape take about 1 ms: this many hold up no other call by more than a frame or two.
MOST_VALUES = 32

PATHS = [path for path in NUMBER_PATHS if not path.startswith("run.")]
Path = Annotated[str, Field(json_schema_extra={"enum": PATHS})]


class NeighboursBody(BaseModel):
    """Values that one number of a posture request takes, or several tied ones together."""

    model_config = STRICT
    base: PostureBody = Field(default_factory=PostureBody, description="what all of them have in common")
    parameter: Path | Annotated[list[Path], Field(min_length=1, max_length=len(PATHS))]
    values: Annotated[list[float], Field(min_length=1, max_length=MOST_VALUES)]


def requests_of(body: NeighboursBody) -> list[Simulation]:
    """One request for each value; ParameterError for what the schema cannot express."""
    base = simulation_of(body.base)
    paths = [body.parameter] if isinstance(body.parameter, str) else body.parameter
    for k, path in enumerate(paths):
        if path not in PATHS:
            raise ParameterError("parameter", f"{path!r} is no number of a posture", "one listed by GET /parameters")
        if path in paths[:k]:
            raise ParameterError("parameter", f"{path} is varied twice", "each number once")
    return [_request(base, paths, value, f"values.{k}") for k, value in enumerate(body.values)]


def _request(base: Simulation, paths: list[str], value: float, at: str) -> Simulation:
    patch = {path: value_for(path, value, at) for path in paths}
    try:
        return patched(base, patch)
    except ParameterError as error:
        raise ParameterError(at, f"{error.path}: {error.message}", error.allowed) from error
