"""Submitting jobs, finding them, dismissing them."""

from typing import Annotated

from fastapi import APIRouter, Header, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import JSONResponse

from vfcore.errors import ParameterError
from vocalis.server.addresses import job_address
from vocalis.server.http.openapi import ok, problems
from vocalis.server.jobs.document import job_document
from vocalis.server.jobs.kinds.registry import kind_named
from vocalis.server.jobs.model import Status
from vocalis.server.schemas.jobs import AnyJobBody, JobAnswer, JobList, KindName
from vocalis.server.services import Client, Shared

router = APIRouter(prefix="/jobs", tags=["jobs"])
_LOCATION = {"Location": {"description": "address of the job", "schema": {"type": "string"}}}
Key = Annotated[
    str | None,
    Header(alias="Idempotency-Key", max_length=200, description="the same key again: the same job, never a second one"),
]


@router.post(
    "",
    status_code=202,
    responses=problems(415, 422, 429, 503, 507) | {202: {"model": JobAnswer, "headers": _LOCATION}},
)
async def submit(body: AnyJobBody, request: Request, shared: Shared, client: Client, key: Key = None) -> Response:
    """Submit a job. A request that has a job already gets that job, finished if it is, unless ``fresh``."""
    kind = kind_named(body.kind)
    wanted = await run_in_threadpool(kind.read, body)
    if kind.check_needs_kernels:
        await shared.kernels.for_postures()
        await shared.runs.run(lambda: kind.check_cost(wanted, shared.settings), request.is_disconnected)
    else:
        await run_in_threadpool(kind.check_cost, wanted, shared.settings)
    job = await run_in_threadpool(lambda: shared.jobs.submit(client, kind.canonical(wanted), body.fresh, key))
    return JSONResponse(job_document(job), 202, {"Location": job_address(job.id)})


@router.get("", responses=ok(model=JobList) | problems(422))
def jobs(
    shared: Shared,
    client: Client,
    status: Status | None = None,
    kind: KindName | None = None,
    limit: Annotated[int, Query(ge=1, le=200)] = 50,
    cursor: Annotated[str | None, Query(description="next_cursor of the page before")] = None,
) -> JSONResponse:
    """This client's jobs, newest first."""
    found, more = shared.jobs.jobs(client, status, kind, limit, _position(cursor))
    listed = [job_document(job, brief=True) for job in found]
    return JSONResponse({"jobs": listed, "next_cursor": str(found[-1].sequence) if more else None})


@router.get("/{job_id}", responses=ok(model=JobAnswer) | problems(404, 422))
def job(job_id: str, shared: Shared) -> JSONResponse:
    """The state of a job."""
    return JSONResponse(job_document(shared.jobs.job(job_id)))


@router.delete("/{job_id}", responses=ok(model=JobAnswer) | problems(404, 422, 507))
def dismiss(job_id: str, shared: Shared) -> JSONResponse:
    """Dismiss a job; running work that no other job waits for stops within a second."""
    return JSONResponse(job_document(shared.jobs.dismiss(job_id)))


def _position(cursor: str | None) -> int | None:
    if cursor is None:
        return None
    if not (cursor.isascii() and cursor.isdecimal() and len(cursor) < 19):
        raise ParameterError("cursor", f"{cursor[:40]!r} is not a cursor", "the next_cursor of a page")
    return int(cursor)
