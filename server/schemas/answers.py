"""Answers at the wire, as the OpenAPI document describes them. Names carry the units."""

from typing import TYPE_CHECKING, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from vfcore.fold.closure import PATTERNS
from vfcore.runs.result import ARRAYS

if TYPE_CHECKING:
    ClosurePattern = str
    ArrayName = str
else:
    ClosurePattern = Literal[PATTERNS]
    ArrayName = Literal[tuple(ARRAYS)]


class FieldError(BaseModel):
    """One field that cannot be used."""

    path: str = Field(description="dotted path of the field")
    message: str = Field(description="what is wrong with its value")
    allowed: str = Field(description="what would be accepted")


class Problem(BaseModel):
    """RFC 9457 problem details."""

    type: str
    title: str
    status: int
    detail: str
    errors: list[FieldError] | None = None


class EngineState(BaseModel):
    name: str
    workers: int


class Health(BaseModel):
    status: Literal["ok"]
    version: str
    model_version: str
    engine: EngineState
    ready: bool = Field(description="whether the kernels are compiled")
    message: str = Field(description="the same in words")


class Parameters(BaseModel):
    """Every parameter as a row; presets, vowels, variants, the sides, and the lists of objects with their rows."""

    parameters: list[dict[str, Any]]
    groups: list[str]
    presets: list[dict[str, Any]]
    vowels: list[dict[str, Any]]
    sides: list[str] = Field(description="before the path of a row with per_side, the path of one fold's value")
    lists: list[dict[str, Any]]
    lesion_kinds: list[dict[str, Any]] = Field(description="the numbers that each kind of lesion brings, and why")
    variants: list[dict[str, Any]]


class ResolvedRequest(BaseModel):
    """A request with nothing left to a default."""

    values: dict[str, Any] = Field(
        description="every value in force by path; null for an optional part or a side not given; of a given side the "
        "values that it gives; an empty list at the path of each list"
    )
    patch: dict[str, Any] = Field(description="the shortest patch by path that resolves to the same request")
    request: dict[str, Any] = Field(description="the complete request document")
    id: str = Field(description="the address of its result")


class Measures(BaseModel):
    measures: list[dict[str, Any]]


class Resonance(BaseModel):
    frequency_hz: float
    bandwidth_hz: float = Field(description="between the points 3 dB below the peak")


class TractAnswer(BaseModel):
    """A vocal tract in equal sections, glottis first, and what it does to the voice."""

    vowel: str
    ipa: str
    source: str
    section_length_m: float
    areas_m2: list[float]
    formants: list[Resonance] = Field(description="with the glottis closed, lowest first")
    frequency_hz: list[float]
    lip_pressure_per_flow_pa_s_m3: list[float] = Field(description="at frequency_hz: |pressure at lips / glottal flow|")


class Posture(BaseModel):
    strain: float
    glottal_half_angle_rad: float
    raw_glottal_half_angle_rad: float
    length_m: float
    residual: float | None
    converged: bool


class Coefficients(BaseModel):
    """The tilde quantities of the paper."""

    membrane_tension_n_m: float
    beam_tension_n: float
    bending_stiffness_n_m2: float
    prestress_moment_n_m: float
    membrane_density_kg_m2: float
    beam_density_kg_m: float


class StaticShape(BaseModel):
    """Along x, anterior first: displacements, and the medial plane at the same edges, in the fold frame."""

    x_m: list[float]
    superior_m: list[float]
    inferior_m: list[float]
    beam_m: list[float]
    medial_superior_m: list[float]
    medial_inferior_m: list[float]
    closed_fraction: float
    closure_pattern: ClosurePattern


class FoldAnswer(BaseModel):
    """One fold: its posture, coefficients and static shape."""

    posture: Posture
    coefficients: Coefficients
    static_shape: StaticShape


class Sides(BaseModel):
    """Two different folds, each from its own side of the midline."""

    left: FoldAnswer
    right: FoldAnswer


_OF_FOLDS = "of two different folds {}"
_SIDES: Any = Field(None, description="each fold where the two differ; left out where one is the other's mirror image")


class PostureAnswer(BaseModel):
    posture: Posture = Field(description=_OF_FOLDS.format("the mean of every number"))
    coefficients: Coefficients = Field(description=_OF_FOLDS.format("those of the left one"))
    static_shape: StaticShape = Field(description=_OF_FOLDS.format("that of the left one"))
    sides: Sides | None = _SIDES


class NeighboursAnswer(BaseModel):
    answers: list[PostureAnswer | None] = Field(description="in the order of the values; null where there is none")


class MeasuredValue(BaseModel):
    value: float | None
    unit: str
    reason: str | None = Field(description="why there is no value")


class ArrayInfo(BaseModel):
    shape: list[int]
    dtype: Literal["float32"]
    unit: str
    dims: list[str] = Field(
        description="names of the axes; where the folds differ, `side` (left, right) first for what belongs to one"
    )


class ErrorLevel(BaseModel):
    """One of the runs compared; the requested one comes first."""

    nx: int
    ny: int
    time_step_s: float
    phonation_state: str


class ErrorBarAnswer(BaseModel):
    """Of one measure, in its unit: the limit of a fine grid is expected within ``half_width`` of the value."""

    half_width: float | None
    limit: float | None = Field(description="what a fine grid would give")
    order: float | None = Field(description="order of convergence used")
    observed: bool = Field(description="whether that order was found in the runs or is that of the scheme")
    unit: str
    reason: str | None = Field(description="why there is no bar")


class ErrorEstimateAnswer(BaseModel):
    """Discretisation error of the measures, by runs on finer grids; on request (`run.error_estimate`)."""

    method: str
    levels: list[ErrorLevel]
    measures: dict[str, ErrorBarAnswer]


class Result(BaseModel):
    """A finished simulation, without the arrays themselves."""

    model_config = ConfigDict(extra="allow")
    phonation_state: Literal["none", "periodic", "subharmonic", "irregular"]
    periodicity: float | None
    measures: dict[str, MeasuredValue]
    error_estimate: ErrorEstimateAnswer | None = Field(description="null unless the request has `run.error_estimate`")
    posture: Posture = Field(description=_OF_FOLDS.format("the mean of every number"))
    coefficients: Coefficients = Field(description=_OF_FOLDS.format("those of the left one"))
    static_shape: StaticShape = Field(description=_OF_FOLDS.format("that of the left one"))
    sides: Sides | None = _SIDES
    arrays: dict[ArrayName, ArrayInfo]
    provenance: dict[str, Any]


class SweepAxis(BaseModel):
    name: str
    parameters: list[str]
    label: str
    unit: str
    values: list[float]


class MissingReason(BaseModel):
    reason: str
    points: list[int] = Field(description="positions in C order of the shape")


class MeasureTable(BaseModel):
    unit: str
    symbol: str
    label: str
    values: list[float | None] = Field(description="in C order of the shape")
    reasons: list[MissingReason] = Field(description="why points have no value")


class PointProblem(BaseModel):
    index: int
    detail: str


class SweepResult(BaseModel):
    """Scalars of every point of a sweep; lists run in C order of ``shape``."""

    kind: Literal["sweep"]
    shape: list[int]
    n_total: int
    n_done: int
    n_failed: int
    axes: list[SweepAxis]
    points: list[dict[str, float]] | None = Field(description="numbers of each point, where there are no axes")
    phonation_state: list[Literal["none", "periodic", "subharmonic", "irregular"] | None]
    measures: dict[str, MeasureTable]
    problems: list[PointProblem] = Field(description="points without an answer, and why")
    pending: list[int] = Field(description="points not computed yet")


class SimulateAnswer(Result):
    id: str = Field(description="address of the result, as for a job")
    links: dict[str, str]
