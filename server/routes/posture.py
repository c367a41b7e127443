"""POST /posture and /postures: from muscles to posture, coefficients and static shape, while a slider moves."""

from typing import Any

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse

from vfcore.io.result_document import posture_document
from vfcore.runs.many import static_shapes
from vfcore.runs.setup import GlottisSetup, prepare
from vocalis.server.http.openapi import ok, problems
from vocalis.server.schemas import answers
from vocalis.server.schemas.neighbours import NeighboursBody, requests_of
from vocalis.server.schemas.requests import PostureBody, simulation_of
from vocalis.server.services import Shared

router = APIRouter(tags=["posture"])


@router.post("/posture", responses=ok(model=answers.PostureAnswer) | problems(415, 422, 429, 503))
async def posture(body: PostureBody, request: Request, shared: Shared) -> JSONResponse:
    """Posture, prestrained coefficients and static shape; takes a request without its ``run``."""
    wanted = simulation_of(body)

    def solve() -> dict[str, Any]:
        return posture_document(prepare(wanted))

    await shared.kernels.for_postures()
    return JSONResponse(await shared.postures.run(solve, request.is_disconnected))


@router.post("/postures", responses=ok(model=answers.NeighboursAnswer) | problems(415, 422, 429, 503))
async def postures(body: NeighboursBody, request: Request, shared: Shared) -> JSONResponse:
    """The answers of /posture for several values of one number, in their order.

    An answer is null where the model has none; /posture says why. A value that makes the request invalid refuses the
    whole call, at ``values.k``. The page fetches the neighbours of a value before the slider reaches them.
    """
    wanted = requests_of(body)

    def solve() -> dict[str, Any]:
        shapes = static_shapes(wanted)
        return {"answers": [posture_document(shape) if isinstance(shape, GlottisSetup) else None for shape in shapes]}

    await shared.kernels.for_postures()
    return JSONResponse(await shared.postures.run(solve, request.is_disconnected))
