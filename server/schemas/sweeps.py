"""The schema of a sweep at the wire. vfcore.runs.sweep checks its values, and names the place of each bad one."""

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, Field

from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.many import PRECISIONS, SINGLE_PRECISION
from vfcore.runs.sweep.document import MOST_AXES, sweep_from_dict
from vfcore.runs.sweep.plan import Sweep
from vocalis.server.schemas.requests import NUMBER_PATHS, STRICT, SimulationBody

if TYPE_CHECKING:
    MeasureKey = str
    Precision = str
else:
    MeasureKey = Literal[tuple(CATALOGUE.keys())]
    Precision = Literal[PRECISIONS]
Path = Annotated[str, Field(json_schema_extra={"enum": list(NUMBER_PATHS)})]


class AxisBody(BaseModel):
    """Values that one number takes, or several tied ones together."""

    model_config = STRICT
    parameter: Path | Annotated[list[Path], Field(min_length=1)]
    values: Annotated[list[float], Field(min_length=1)]


class SweepBody(BaseModel):
    """A simulation over one to three axes, or at a list of points; exactly one of the two is given."""

    model_config = STRICT
    kind: Literal["sweep"]
    base: SimulationBody = Field(default_factory=SimulationBody, description="what all points have in common")
    axes: Annotated[list[AxisBody], Field(min_length=1, max_length=MOST_AXES)] | None = None
    points: Annotated[list[dict[str, Any]], Field(min_length=1)] | None = Field(
        None, description="numbers by dotted path, or nested as in a simulation"
    )
    measures: Annotated[list[MeasureKey], Field(min_length=1)] | None = Field(
        None, description="keys of GET /measures to compute; all when left out"
    )
    precision: Precision = Field(
        "float64",
        description=f"of march and transforms; float32 computes a map in three fifths of the time, {SINGLE_PRECISION}",
    )
    keep_waveforms: bool = Field(False, description="keep every point as a whole run as well; up to 500 points")
    fresh: bool = Field(False, description="compute again what is stored already")


def sweep_of(body: SweepBody) -> Sweep:
    """The validated sweep; ParameterError for what the schema cannot express."""
    return sweep_from_dict(body.model_dump(exclude_unset=True, exclude={"fresh"}))
