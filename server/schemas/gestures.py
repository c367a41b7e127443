"""Answers of gestures at the wire. Names carry the units."""

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from vocalis.server.schemas.answers import MeasuredValue


class Contour(BaseModel):
    unit: str
    label: str
    values: list[float | None] = Field(description="one per 10 ms; null where there is none")


class GestureSegment(BaseModel):
    start_s: float
    end_s: float
    phonation_state: Literal["none", "periodic", "subharmonic", "irregular"]
    explanation: str
    measures: dict[str, MeasuredValue]


class GestureAnswer(BaseModel):
    """A rendered gesture: contours every 10 ms, and measures of each stretch between breakpoints."""

    model_config = ConfigDict(extra="allow")
    id: str
    kind: Literal["gesture"]
    duration_s: float
    contours: dict[str, Contour]
    segments: list[GestureSegment]
    provenance: dict[str, Any]
    links: dict[str, str]
