"""Server-sent events: of one job, and of all jobs of a client on one stream."""

from collections.abc import AsyncIterator
from typing import Annotated

import orjson
from fastapi import APIRouter, Depends, Header
from fastapi.concurrency import run_in_threadpool
from fastapi.sse import EventSourceResponse, ServerSentEvent

from vocalis.server.exceptions import TooMany
from vocalis.server.http.errors import StreamOver
from vocalis.server.http.openapi import problems
from vocalis.server.jobs.events import Event
from vocalis.server.jobs.model import ACTIVE
from vocalis.server.services import Client, Services, Shared

router = APIRouter(tags=["events"])
_RESPONSES = problems(404, 422, 429) | {204: {"description": "There will be no further events of this job."}}
LastId = Annotated[str | None, Header(alias="Last-Event-ID", description="id of the last event that was read")]


async def job_stream(
    job_id: str, shared: Shared, client: Client, last_id: LastId = None
) -> AsyncIterator[AsyncIterator[Event]]:
    """Dependency: the events of one job. Errors have to come before the stream starts."""
    job = await run_in_threadpool(shared.jobs.job, job_id)
    position = shared.events.position(last_id)
    if job.status not in ACTIVE and position is not None and not shared.events.since(position, "", job_id)[0]:
        raise StreamOver
    async for stream in _open(shared, client, job_id, last_id):
        yield stream


async def client_stream(shared: Shared, client: Client, last_id: LastId = None) -> AsyncIterator[AsyncIterator[Event]]:
    """Dependency: the events of all jobs of a client."""
    async for stream in _open(shared, client, None, last_id):
        yield stream


async def _open(
    shared: Services, client: str, job_id: str | None, last_id: str | None
) -> AsyncIterator[AsyncIterator[Event]]:
    streams, limit = shared.events.streams, shared.settings.streams_per_client
    if streams[client] >= limit:
        raise TooMany(f"A client may have {limit} event streams open (VOCALIS_STREAMS_PER_CLIENT).")
    streams[client] += 1
    try:
        yield shared.events.follow(client, job_id, last_id, lambda: shared.jobs.present(client, job_id))
    finally:
        streams[client] -= 1
        if not streams[client]:
            del streams[client]


def _sent(event: Event) -> ServerSentEvent:
    """The points of a task are a thousand numbers, which FastAPI's own encoder would visit one by one."""
    return ServerSentEvent(raw_data=orjson.dumps(event.data).decode(), event=event.name, id=event.id)


@router.get("/jobs/{job_id}/events", response_class=EventSourceResponse, responses=_RESPONSES)
async def job_events(
    stream: Annotated[AsyncIterator[Event], Depends(job_stream)],
) -> AsyncIterator[ServerSentEvent]:
    """``progress`` until ``done``, each with the job as data; resumes after ``Last-Event-ID``.

    Of sweeps also ``point``: several points at a time, ``index`` into the axes in C order, and along it
    ``phonation_state``, ``measures`` by key, ``problems``; beyond 2500 points ``index`` only.
    """
    async for event in stream:
        yield _sent(event)


@router.get("/events", response_class=EventSourceResponse, responses=_RESPONSES)
async def client_events(
    stream: Annotated[AsyncIterator[Event], Depends(client_stream)],
) -> AsyncIterator[ServerSentEvent]:
    """The same for all of this client's jobs, without end: one stream serves a page."""
    async for event in stream:
        yield _sent(event)
