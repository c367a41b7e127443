"""Exceptions to problem+json answers; ``problems.TABLE`` has the statuses."""

import asyncio
import json
import logging
from collections.abc import Sequence
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from vfcore.errors import ParameterError, VocalisError
from vocalis.server.exceptions import NotReady
from vocalis.server.jobs.kinds.registry import KINDS
from vocalis.server.problems import MEDIA_TYPE, TABLE, Kind, document, kind_of, problem_of
from vocalis.server.schemas.requests import OFFERED_KINDS, allowed_at, models_in, refused_name

log = logging.getLogger("vocalis")
LONGEST_ECHO = 60
_NO_OBJECT = ("model_attributes_type", "model_type", "dict_type")
_UNION_MEMBERS = ("function-wrap", "str", "list[str]", "list[constrained-str]")


class StreamOver(Exception):
    """A stream to be resumed has no further events; status 204 tells a browser not to reconnect."""


def problem_response(body: dict[str, Any], headers: dict[str, str] | None = None) -> JSONResponse:
    """A problem document as an answer."""
    return JSONResponse(body, body["status"], headers, MEDIA_TYPE)


def answer(error: Exception) -> JSONResponse:
    """The answer to an exception of the table, with the headers that its status needs."""
    headers = {}
    if (seconds := getattr(error, "retry_after_s", None)) is not None:
        headers["Retry-After"] = str(seconds)
    if kind_of(error).status == HTTPStatus.UNAUTHORIZED:
        headers["WWW-Authenticate"] = "Bearer"
    return problem_response(problem_of(error), headers)


def install(app: FastAPI) -> None:
    """Every error of the application leaves as problem+json."""
    app.add_exception_handler(VocalisError, _known)
    app.add_exception_handler(RequestValidationError, _validation)
    app.add_exception_handler(HTTPException, _http)
    app.add_exception_handler(StreamOver, _over)
    app.add_middleware(UnexpectedErrors)


async def _known(_: Request, error: Exception) -> JSONResponse:
    return answer(error)


async def _over(_: Request, __: Exception) -> Response:
    return Response(status_code=HTTPStatus.NO_CONTENT)


class UnexpectedErrors:
    """Turns unexpected exceptions into problems too; the traceback goes to the log, not to the client.

    A call is cancelled only when the server stops and its grace period is over.
    """

    def __init__(self, app: ASGIApp):
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = scope["type"] != "http"

        async def watched(message: Message) -> None:
            nonlocal started
            started = started or message["type"] == "http.response.start"
            await send(message)

        try:
            await self._app(scope, receive, watched)
        except asyncio.CancelledError:
            if started:
                raise
            await answer(NotReady("The server is stopping."))(scope, receive, send)
        except Exception as error:
            if started:
                raise
            log.exception("%s %s failed", scope["method"], scope["path"])
            await answer(error)(scope, receive, send)


async def _http(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    return problem_response(_by_status(error.status_code, error.detail), dict(error.headers or {}))


async def _validation(request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    items = error.errors()
    if items[0]["loc"] == ("body",) and isinstance(error.body, bytes):
        given = request.headers.get("content-type", "nothing")
        return problem_response(_by_status(415, f"The body must be application/json, not {given}."))
    body = request.scope["endpoint"].__annotations__.get("body")
    fields = [_field(item, body) for item in items]
    detail = "; ".join(f"{field['path']}: {field['message']}" for field in fields[:3])
    return problem_response(document(TABLE[ParameterError], detail, fields))


def _by_status(status: int, detail: str) -> dict[str, Any]:
    phrase = HTTPStatus(status).phrase
    return document(Kind(status, phrase.lower().replace(" ", "-"), phrase), detail)


def _field(item: dict[str, Any], body: Any) -> dict[str, str]:
    """One entry of ``errors`` from one of pydantic's; ``body``: the type of the body of the route, None for none."""
    where, *place = item["loc"]
    kind, limits = item["type"], item.get("ctx", {})
    if kind == "json_invalid":
        return {"path": "body", "message": f"is not JSON: {limits['error']}", "allowed": "a JSON object"}
    models = models_in(body) if where == "body" else []
    kinds: Sequence[str] = OFFERED_KINDS
    if len(models) > 1 and place:  # pydantic names the member of the union first
        if place[1:] in ([], ["kind"]):
            kinds = tuple(KINDS)
        models, place = [KINDS[place[0]].body], place[1:]
    if kind == "extra_forbidden":
        path = _path([*place[:-1]], place[-1]) or "a field without a name"
        message, known = refused_name(models[0], place, path)
        return {"path": path, "message": message, "allowed": known}
    path = _path(place) or str(where)
    if kind == "kind_not_offered":
        path = _path(place, "kind")
        message = item["msg"] if kinds == OFFERED_KINDS else f"{_echo(item['input']['kind'])} is not a kind of job"
        return {"path": path, "message": message, "allowed": " | ".join(kinds)}
    if kinds != OFFERED_KINDS and path == "kind":
        allowed: str | None = " | ".join(kinds)
    elif kind in _NO_OBJECT:
        allowed = allowed_at(path) or "an object"
    else:
        allowed = allowed_at(path) if where == "body" else None
    message = "is missing" if kind == "missing" else f"{_echo(item['input'])} cannot be used"
    return {"path": path, "message": message, "allowed": str(allowed or limits.get("expected") or item["msg"])}


def _path(place: Sequence[int | str], *unknown: int | str) -> str:
    """Dotted, without what pydantic adds to say which member of a union it means; ``unknown`` is a client's word."""
    return ".".join(str(part) for part in (*(part for part in place if part not in _UNION_MEMBERS), *unknown))


def _echo(value: Any) -> str:
    """A value as the client wrote it, in JSON."""
    text = json.dumps(value, ensure_ascii=False, default=repr)
    return text if len(text) <= LONGEST_ECHO else f"{text[:LONGEST_ECHO]}…"
