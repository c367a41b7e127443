"""The application: made from settings, with all routes and safeguards."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import FastAPI
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

import vfcore
from vocalis.server.addresses import API
from vocalis.server.http import errors, openapi
from vocalis.server.http.guard import Guard
from vocalis.server.routes import (
    catalogue,
    events,
    gestures,
    jobs,
    live,
    page,
    posture,
    resolve,
    results,
    session,
    simulate,
    tract,
)
from vocalis.server.services import Services
from vocalis.server.settings import Settings

#: Binary arrays gain little by compression, and an answer to a moving slider has no time for it.
NOT_COMPRESSED = (*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream", "application/x-netcdf")


def create_app(settings: Settings | None = None) -> FastAPI:
    """The ASGI application of one server process."""
    services = Services.of(settings or Settings())
    app = FastAPI(
        title="Vocalis",
        summary="From five laryngeal muscles to vibrating vocal folds, pressures, measures and sound.",
        version=vfcore.CODE_VERSION,
        lifespan=_lifespan,
        docs_url=None,  # its scripts come from another site
        redoc_url=None,
        openapi_url=f"{API}/openapi.json",
    )
    app.state.services = services
    for module in (catalogue, resolve, tract, posture, simulate, jobs, results, events, session, live, gestures):
        app.include_router(module.router, prefix=API)
    errors.install(app)
    openapi.install(app)
    page.install(app)
    # Level 5 takes twice as long over the table of a map, for 1 % less.
    app.add_middleware(GZipMiddleware, compresslevel=4, exclude_content_types=NOT_COMPRESSED)
    app.add_middleware(Guard, access=services.access, body_bytes=services.settings.body_bytes)
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    services: Services = app.state.services
    services.start()
    yield
    services.close()
