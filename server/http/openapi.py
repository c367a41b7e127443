"""The OpenAPI document: every status an operation can answer with, problems under their own media type."""

from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from vocalis.server.http.problems import MEDIA_TYPE
from vocalis.server.schemas.answers import Problem

_PROBLEM = {"schema": {"$ref": "#/components/schemas/Problem"}}
#: Any call may meet these: a body that cannot be read, no token, a foreign origin, a body too large, a wrong host.
EVERYWHERE = (400, 401, 403, 413, 421)


def problems(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """``responses`` of a route for the problems it may answer with, beside those of every route."""
    return {
        status: {"description": HTTPStatus(status).phrase, "content": {MEDIA_TYPE: _PROBLEM}}
        for status in (*EVERYWHERE, *statuses)
    }


def octets(description: str, media_type: str, headers: dict[str, str] | None = None) -> dict[str, Any]:
    """A 200 answer that is not JSON."""
    return {
        "description": description,
        "headers": {
            name: {"description": text, "schema": {"type": "string"}} for name, text in (headers or {}).items()
        },
        "content": {media_type: {"schema": {"type": "string", "format": "binary"}}},
    }


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

    app.openapi = document
