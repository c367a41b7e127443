"""Handing in jobs, asking about them, dismissing them."""

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import JSONResponse

from vfcore.errors import ParameterError
from vfcore.runs.sweep.cost import check_cost as check_sweep_cost
from vfcore.runs.sweep.document import sweep_to_dict
from vfcore.spec.request import document_of
from vocalis.server.http.openapi import problems
from vocalis.server.jobs.cost import check_cost
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.model import Status
from vocalis.server.schemas import answers
from vocalis.server.schemas.requests import JobBody, simulation_of
from vocalis.server.schemas.sweeps import AnyJobBody, SweepBody, sweep_of
from vocalis.server.services import Client, Services, Shared

router = APIRouter(prefix="/jobs", tags=["jobs"])
_LOCATION = {"Location": {"description": "address of the job", "schema": {"type": "string"}}}
Key = Annotated[
    str | None,
    Header(alias="Idempotency-Key", max_length=200, description="the same key again: the same job, never a second one"),
]


@router.post(
    "",
    status_code=202,
    responses={202: {"model": answers.JobAnswer, "headers": _LOCATION}} | problems(415, 422, 429, 503, 507),
)
async def submit(body: AnyJobBody, request: Request, shared: Shared, client: Client, key: Key = None) -> Response:
    """Hand in a simulation or a sweep. What has a job already gets that job, finished if it is, unless ``fresh``."""
    work = _sweep if isinstance(body, SweepBody) else _simulation
    wanted, n_total = await work(body, request, shared)
    job = await run_in_threadpool(shared.desk.submit, client, wanted, body.fresh, key, n_total)
    document = job_document(job)
    return JSONResponse(document, 202, {"Location": document["links"]["self"]})


async def _sweep(body: SweepBody, _: Request, shared: Services) -> tuple[dict[str, Any], int]:
    """A canonical sweep that may be run here, and its number of points."""

    def checked() -> tuple[dict[str, Any], int]:
        sweep, limits = sweep_of(body), shared.settings
        check_sweep_cost(
            sweep, limits.sweep_points, limits.sweep_node_steps, "VOCALIS_SWEEP_POINTS", "VOCALIS_SWEEP_NODE_STEPS"
        )
        return sweep_to_dict(sweep), len(sweep)

    return await run_in_threadpool(checked)


async def _simulation(body: JobBody, request: Request, shared: Services) -> tuple[dict[str, Any], int]:
    """A canonical simulation that may be run here."""
    wanted = simulation_of(body)
    limit = shared.settings.job_node_steps
    await shared.kernels.for_postures()
    await shared.runs.run(lambda: check_cost(wanted, limit, "VOCALIS_JOB_NODE_STEPS"), request.is_disconnected)
    return document_of(wanted), 1


@router.get("", responses={200: {"model": answers.JobList}} | problems(422))
def jobs(
    shared: Shared,
    client: Client,
    status: Status | None = None,
    kind: Literal["simulation", "sweep"] | None = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 50,
    cursor: Annotated[str | None, Query(description="next_cursor of the page before")] = None,
) -> JSONResponse:
    """This client's jobs, newest first."""
    found, more = shared.desk.jobs(client, status, kind, limit, _position(cursor))
    listed = [job_document(job, brief=True) for job in found]
    return JSONResponse({"jobs": listed, "next_cursor": str(found[-1].sequence) if more else None})


@router.get("/{job_id}", responses={200: {"model": answers.JobAnswer}} | problems(404, 422))
def job(job_id: str, shared: Shared) -> JSONResponse:
    """The state of a job."""
    return JSONResponse(job_document(shared.desk.job(job_id)))


@router.delete("/{job_id}", responses={200: {"model": answers.JobAnswer}} | problems(404, 422, 507))
def dismiss(job_id: str, shared: Shared) -> JSONResponse:
    """Let go of a job; running work that nobody else waits for stops within a second."""
    return JSONResponse(job_document(shared.desk.dismiss(job_id)))


def _position(cursor: str | None) -> int | None:
    if cursor is None:
        return None
    if not (cursor.isascii() and cursor.isdecimal() and len(cursor) < 19):
        raise ParameterError("cursor", f"{cursor[:40]!r} is not a cursor", "the next_cursor of a page")
    return int(cursor)
