"""POST /resolve: every value of a request. The page shows these values and has no defaults of its own."""

from fastapi import APIRouter
from fastapi.responses import JSONResponse

from vfcore.spec.address import address
from vfcore.spec.request import document_of, patch_of, values_of
from vocalis.server.http.openapi import ok, problems
from vocalis.server.schemas import answers
from vocalis.server.schemas.requests import SimulationBody, simulation_of

router = APIRouter(tags=["catalogue"])


@router.post("/resolve", responses=ok(model=answers.ResolvedRequest) | problems(415, 422))
async def resolve(body: SimulationBody) -> JSONResponse:
    """Every value in force, constants included, the shortest patch that leads to it, and the address of its result.

    With only ``model`` given, these are the defaults of a variant and a posturing set.
    """
    request = simulation_of(body)
    answer = {
        "values": values_of(request),
        "patch": patch_of(request),
        "request": document_of(request),
        "id": address(request),
    }
    return JSONResponse(answer)
