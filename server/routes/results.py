"""The answer of a finished job in its forms: document, arrays, sound, files. The kind of the job makes each."""

from typing import Annotated

from fastapi import APIRouter, Query, Response
from fastapi.responses import StreamingResponse

from vocalis.server.http.openapi import ok, ok_bytes, problems
from vocalis.server.jobs.kinds.base import BYTES, CSV, NETCDF, WAV, Answer, Part
from vocalis.server.jobs.kinds.registry import kind_named
from vocalis.server.schemas.answers import ArrayName
from vocalis.server.schemas.jobs import ResultAnswer
from vocalis.server.services import Shared

router = APIRouter(prefix="/jobs/{job_id}", tags=["results"])
Keys = Annotated[str | None, Query(description="of a sweep: keys of measures, comma between; all when left out")]
Partial = Annotated[bool, Query(description="of a sweep that is not finished: the points so far")]
_PROBLEMS = problems(404, 409, 410, 422)
_ARRAY_HEADERS = {
    "X-Shape": "lengths of the axes, comma between",
    "X-Dims": "names of the axes; where the folds differ, `side` (left, right) first for what belongs to one of them",
    "X-Unit": "unit of the values",
    "X-Sample-Rate-Hz": "of waveforms: values per second",
}


@router.get("/result", responses=ok(model=ResultAnswer) | _PROBLEMS)
def result(job_id: str, shared: Shared, measures: Keys = None, partial: Partial = False) -> Response:
    """Of a simulation: state of phonation, measures, posture, coefficients, and the table of its arrays.

    Of a sweep: axes, one table per measure and one state per point, in C order of ``shape``.
    """
    job = shared.jobs.job(job_id)
    keys = None if measures is None else [name.strip() for name in measures.split(",") if name.strip()]
    return _response(kind_named(job.kind).result(job, shared.storage, keys, partial))


@router.get(
    "/arrays/{name}",
    response_class=Response,
    responses=ok_bytes("Little-endian float32, C order.", BYTES, _ARRAY_HEADERS) | _PROBLEMS,
)
def array(
    job_id: str,
    name: ArrayName,
    shared: Shared,
    start: Annotated[int, Query(ge=0, description="first index on the first axis")] = 0,
    stop: Annotated[int | None, Query(ge=0, description="index after the last")] = None,
    stride: Annotated[int, Query(ge=1, le=10**9)] = 1,
) -> Response:
    """One array, or every ``stride``-th entry of a part of its first axis."""
    job = shared.jobs.job(job_id)
    return _response(kind_named(job.kind).array(job, shared.storage, name, Part(start, stop, stride)))


@router.get(
    "/audio.wav",
    response_class=Response,
    responses=ok_bytes("48 kHz, 16 bit, mono.", WAV, {"X-Gain": "full scales per Pa; 0: silence"}) | _PROBLEMS,
)
def audio(job_id: str, shared: Shared, normalize: bool = True) -> Response:
    """The radiated pressure as sound, peaking at −3 dBFS; with ``normalize=false`` at the one gain of all runs."""
    job = shared.jobs.job(job_id)
    return _response(kind_named(job.kind).audio(job, shared.storage, normalize), _file_name(job_id, "wav"))


@router.get("/result.nc", response_class=Response, responses=ok_bytes("netCDF-4 with units.", NETCDF) | _PROBLEMS)
def netcdf(job_id: str, shared: Shared, partial: Partial = False) -> Response:
    """Everything in one netCDF-4 file, with units and provenance; of a sweep one variable per scalar over its axes."""
    job = shared.jobs.job(job_id)
    return _response(kind_named(job.kind).netcdf(job, shared.storage, partial), _file_name(job_id, "nc"))


@router.get(
    "/result.csv",
    response_class=Response,
    responses=ok_bytes("One row per measure; of a sweep one row per point.", CSV) | _PROBLEMS,
)
def csv(job_id: str, shared: Shared, partial: Partial = False) -> Response:
    """The measures as a table."""
    job = shared.jobs.job(job_id)
    return _response(kind_named(job.kind).csv(job, shared.storage, partial), _file_name(job_id, "csv"))


def _response(answer: Answer, file_name: str | None = None) -> Response:
    headers = dict(answer.headers)
    if file_name is not None:
        headers["Content-Disposition"] = f'attachment; filename="{file_name}"'
    if isinstance(answer.content, bytes):
        return Response(answer.content, headers=headers, media_type=answer.media_type)
    return StreamingResponse(answer.content, headers=headers, media_type=answer.media_type)


def _file_name(job_id: str, ending: str) -> str:
    return f"vocalis-{job_id[:8]}.{ending}"
