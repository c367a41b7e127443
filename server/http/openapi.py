"""The OpenAPI document: every status of every operation, with problems under their own media type."""

from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from vocalis.server.problems import MEDIA_TYPE
from vocalis.server.schemas.answers import Problem

_PROBLEM = {"schema": {"$ref": "#/components/schemas/Problem"}}
#: Possible for every call: unreadable body, no token, foreign origin, body too large, wrong host.
EVERYWHERE = (400, 401, 403, 413, 421)


Responses = dict[int | str, dict[str, Any]]


def ok(**fields: Any) -> Responses:
    """``responses`` of a route for its answer with status 200."""
    return {200: fields}


def problems(*statuses: int) -> Responses:
    """``responses`` of a route for the problems that it may answer with, and those of every route."""
    return {
        status: {"description": HTTPStatus(status).phrase, "content": {MEDIA_TYPE: _PROBLEM}}
        for status in (*EVERYWHERE, *statuses)
    }


def ok_bytes(description: str, media_type: str, headers: dict[str, str] | None = None) -> Responses:
    """``responses`` of a route for an answer with status 200 that is not JSON."""
    return ok(
        description=description,
        headers={name: {"description": text, "schema": {"type": "string"}} for name, text in (headers or {}).items()},
        content={media_type: {"schema": {"type": "string", "format": "binary"}}},
    )


def install(app: FastAPI) -> None:
    """Make ``app.openapi()`` answer with the complete document."""

    def document() -> dict[str, Any]:
        if app.openapi_schema is None:
            schema = get_openapi(title=app.title, version=app.version, summary=app.summary, routes=app.routes)
            definition = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
            schemas = schema.setdefault("components", {}).setdefault("schemas", {})
            schemas |= definition.pop("$defs", {}) | {"Problem": definition}
            app.openapi_schema = schema
        return app.openapi_schema

    app.openapi = document  # type: ignore[method-assign]  # FastAPI documents this way of extending it
