"""POST /posture: from muscles to posture, coefficients and static shape, while the hand still moves."""

from typing import Any

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse

from vfcore.document import posture_document
from vfcore.simulate import prepare
from vocalis_server import schemas
from vocalis_server.openapi import problems
from vocalis_server.request_schema import PostureBody, simulation_of
from vocalis_server.services import Shared

router = APIRouter(tags=["posture"])


@router.post("/posture", responses={200: {"model": schemas.PostureAnswer}} | problems(415, 422, 429, 503))
async def posture(body: PostureBody, request: Request, shared: Shared) -> JSONResponse:
    """Posture, prestrained coefficients and static shape; takes a request without its ``run``."""
    wanted = simulation_of(body)

    def solve() -> dict[str, Any]:
        return posture_document(prepare(wanted))

    await shared.kernels.for_postures()
    return JSONResponse(await shared.postures.run(solve, request.is_disconnected))
