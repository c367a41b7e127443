"""What a finished job gives: document, arrays, sound, files."""

from typing import Annotated, Literal

import orjson
from fastapi import APIRouter, Query, Response
from fastapi.responses import JSONResponse, StreamingResponse

from vfcore.errors import ParameterError
from vfcore.io.audio import render, to_wav_bytes
from vfcore.io.csv import csv_text
from vfcore.io.result_document import result_document
from vfcore.runs.result import ARRAYS, SimulationResult
from vocalis.server.http.encoding import octets as as_octets
from vocalis.server.http.openapi import octets, problems
from vocalis.server.schemas import answers
from vocalis.server.services import Services, Shared

router = APIRouter(prefix="/jobs/{job_id}", tags=["results"])
OCTETS, WAV, NETCDF, CSV = "application/octet-stream", "audio/wav", "application/x-netcdf", "text/csv"
Keys = Annotated[str | None, Query(description="of a sweep: keys of measures, comma between; all when left out")]
Partial = Annotated[bool, Query(description="of a sweep that is not finished: what there is")]
_PROBLEMS = problems(404, 409, 410, 422)
_ARRAY_HEADERS = {
    "X-Shape": "lengths of the axes, comma between",
    "X-Dims": "names of the axes",
    "X-Unit": "unit of the values",
    "X-Sample-Rate-Hz": "of waveforms: values per second",
}


@router.get("/result", responses={200: {"model": answers.Result | answers.SweepResult}} | _PROBLEMS)
def result(job_id: str, shared: Shared, measures: Keys = None, partial: Partial = False) -> Response:
    """Of a simulation: state of phonation, measures, posture, coefficients, and what arrays there are.

    Of a sweep: axes, one table per measure and one state per point, in C order of ``shape``.
    """
    job = shared.desk.job(job_id)
    if job.kind == "sweep":
        table = shared.desk.table(job, partial)
        document = table.document(None if measures is None else _names(measures))
        # Thousands of numbers, none of them NaN, which the standard library would write one by one.
        return Response(orjson.dumps(document), media_type="application/json")
    return JSONResponse(result_document(shared.desk.result(job)))


@router.get(
    "/arrays/{name}",
    response_class=Response,
    responses={200: octets("Little-endian float32, C order.", OCTETS, _ARRAY_HEADERS)} | _PROBLEMS,
)
def array(
    job_id: str,
    name: Literal[tuple(ARRAYS)],
    shared: Shared,
    start: Annotated[int, Query(ge=0, description="first index on the first axis")] = 0,
    stop: Annotated[int | None, Query(ge=0, description="index after the last")] = None,
    stride: Annotated[int, Query(ge=1, le=10**9)] = 1,
) -> Response:
    """One array, or every ``stride``-th entry of a part of it."""
    found = _simulation(shared, job_id)
    length = len(found.arrays[name])
    stop = length if stop is None else stop
    for path, value, most in (("stop", stop, length), ("start", start, stop)):
        if value > most:
            raise ParameterError(path, f"{value} is beyond the end", f"0 to {most}")
    part, spec = found.arrays[name][start:stop:stride], ARRAYS[name]
    headers = {"X-Shape": ",".join(map(str, part.shape)), "X-Dims": ",".join(spec.dims), "X-Unit": spec.unit}
    if spec.dims[0] == "time":
        headers["X-Sample-Rate-Hz"] = repr(found.provenance.sample_rate_hz / stride)
    return Response(as_octets(part), headers=headers, media_type=OCTETS)


@router.get(
    "/audio.wav",
    response_class=Response,
    responses={200: octets("48 kHz, 16 bit, mono.", WAV, {"X-Gain": "full scales per Pa; 0: silence"})} | _PROBLEMS,
)
def audio(job_id: str, shared: Shared, normalize: bool = True) -> Response:
    """The radiated pressure as sound, peaking at −3 dBFS; with ``normalize=false`` at the one gain of all runs."""
    found = _simulation(shared, job_id)
    sound = render(found.arrays["radiated_pressure_pa"], found.provenance.sample_rate_hz)
    content, gain = to_wav_bytes(sound, normalize, phonating=found.report.state != "none")
    return Response(content, headers={"X-Gain": repr(gain)} | _named(job_id, "wav"), media_type=WAV)


@router.get("/result.nc", response_class=Response, responses={200: octets("netCDF-4 with units.", NETCDF)} | _PROBLEMS)
def netcdf(job_id: str, shared: Shared, partial: Partial = False) -> Response:
    """Everything in one netCDF-4 file, with units and provenance; of a sweep one variable per scalar over its axes."""
    from vfcore.io.netcdf import netcdf_bytes  # its library would make every start of the server slower
    from vfcore.runs.sweep.files import netcdf_bytes as sweep_bytes

    job = shared.desk.job(job_id)
    if job.kind == "sweep":
        content = sweep_bytes(shared.desk.table(job, partial))
    else:
        content = netcdf_bytes(shared.desk.result(job))
    return Response(content, headers=_named(job_id, "nc"), media_type=NETCDF)


@router.get(
    "/result.csv",
    response_class=Response,
    responses={200: octets("One row per measure; of a sweep one row per point.", CSV)} | _PROBLEMS,
)
def csv(job_id: str, shared: Shared, partial: Partial = False) -> Response:
    """The measures as a table."""
    from vfcore.runs.sweep.files import csv_lines

    job = shared.desk.job(job_id)
    if job.kind == "sweep":
        return StreamingResponse(
            csv_lines(shared.desk.table(job, partial)), headers=_named(job_id, "csv"), media_type=CSV
        )
    return Response(csv_text(shared.desk.result(job)), headers=_named(job_id, "csv"), media_type=CSV)


def _simulation(shared: Services, job_id: str) -> SimulationResult:
    return shared.desk.result(shared.desk.job(job_id))


def _names(measures: str) -> list[str]:
    return [name.strip() for name in measures.split(",") if name.strip()]


def _named(job_id: str, ending: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="vocalis-{job_id[:8]}.{ending}"'}
