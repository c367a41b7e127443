"""Handing in jobs, asking about them, dismissing them."""

from typing import Annotated, Literal

from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.responses import JSONResponse

from vfcore.errors import ParameterError
from vocalis_server import schemas
from vocalis_server.cost import check_cost
from vocalis_server.jobs.content import canonical
from vocalis_server.jobs.document import job_document
from vocalis_server.jobs.model import Status
from vocalis_server.openapi import problems
from vocalis_server.request_schema import JobBody, simulation_of
from vocalis_server.services import Client, Shared

router = APIRouter(prefix="/jobs", tags=["jobs"])
_LOCATION = {"Location": {"description": "address of the job", "schema": {"type": "string"}}}
Key = Annotated[
    str | None,
    Header(alias="Idempotency-Key", max_length=200, description="the same key again: the same job, never a second one"),
]


@router.post(
    "",
    status_code=202,
    responses={202: {"model": schemas.JobAnswer, "headers": _LOCATION}} | problems(415, 422, 429, 503),
)
async def submit(body: JobBody, request: Request, shared: Shared, client: Client, key: Key = None) -> Response:
    """Hand in a simulation. A request that has a job already gets that job, finished if it is, unless ``fresh``."""
    wanted = simulation_of(body)
    limit = shared.settings.job_node_steps
    await shared.kernels.for_postures()
    await shared.runs.run(lambda: check_cost(wanted, limit, "VOCALIS_JOB_NODE_STEPS"), request.is_disconnected)
    document = job_document(shared.desk.submit(client, canonical(wanted), body.fresh, key))
    return JSONResponse(document, 202, {"Location": document["links"]["self"]})


@router.get("", responses={200: {"model": schemas.JobList}} | problems(422))
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
    return JSONResponse(
        {"jobs": [job_document(job) for job in found], "next_cursor": str(found[-1].sequence) if more else None}
    )


@router.get("/{job_id}", responses={200: {"model": schemas.JobAnswer}} | problems(404, 422))
def job(job_id: str, shared: Shared) -> JSONResponse:
    """The state of a job."""
    return JSONResponse(job_document(shared.desk.job(job_id)))


@router.delete("/{job_id}", responses={200: {"model": schemas.JobAnswer}} | problems(404, 422))
def dismiss(job_id: str, shared: Shared) -> JSONResponse:
    """Let go of a job; running work that nobody else waits for stops within a second."""
    return JSONResponse(job_document(shared.desk.dismiss(job_id)))


def _position(cursor: str | None) -> int | None:
    if cursor is None:
        return None
    if not (cursor.isascii() and cursor.isdecimal() and len(cursor) < 19):
        raise ParameterError("cursor", f"{cursor[:40]!r} is not a cursor", "the next_cursor of a page")
    return int(cursor)
