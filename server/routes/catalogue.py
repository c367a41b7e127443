"""The state of the server, and its catalogues: parameters and measures."""

from functools import lru_cache
from typing import Any

from fastapi import APIRouter
from fastapi.responses import JSONResponse

import vfcore
from vfcore.spec.schema import parameter_catalogue
from vocalis.server.http.openapi import ok, problems
from vocalis.server.schemas import answers
from vocalis.server.services import Shared

router = APIRouter(tags=["catalogue"], responses=problems())


@router.get("/health")
async def health(shared: Shared) -> answers.Health:
    """Whether the server runs and its kernels are compiled; needs no token."""
    return answers.Health(
        status="ok",
        version=vfcore.CODE_VERSION,
        model_version=vfcore.MODEL_VERSION,
        engine=answers.EngineState(name=shared.jobs.scheduler.name, workers=shared.jobs.scheduler.workers),
        ready=shared.kernels.ready,
        message=shared.kernels.message,
    )


@router.get("/parameters", responses=ok(model=answers.Parameters))
def parameters() -> JSONResponse:
    """Every parameter with unit, range, default and help; presets, vowels, variants."""
    return JSONResponse(_parameters())


@lru_cache(maxsize=1)
def _parameters() -> dict[str, Any]:
    return parameter_catalogue()


@router.get("/measures", responses=ok(model=answers.Measures))
def measures() -> JSONResponse:
    """The catalogue of voice measures: symbol, unit, definition, formula, threshold, source."""
    return JSONResponse({"measures": vfcore.CATALOGUE.as_rows()})
