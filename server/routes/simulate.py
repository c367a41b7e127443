"""POST /simulate: a short run, answered in one reply."""

from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import JSONResponse

from vfcore.errors import ParameterError
from vfcore.io.result_document import result_document
from vfcore.runs.one import simulate as run_simulation
from vfcore.runs.result import SimulationResult
from vfcore.spec.address import address
from vfcore.spec.simulation import Simulation
from vocalis.server.addresses import answer_links
from vocalis.server.encoding import bundle, chosen_names
from vocalis.server.http.openapi import ok, problems
from vocalis.server.jobs.cost import check_cost
from vocalis.server.jobs.kinds.base import BYTES
from vocalis.server.jobs.kinds.simulation import SIMULATION
from vocalis.server.schemas import answers
from vocalis.server.schemas.requests import SimulationBody, simulation_of
from vocalis.server.services import Services, Shared

router = APIRouter(tags=["simulate"])
_OK = {
    "model": answers.SimulateAnswer,
    "description": "The result. As bytes: uint32 little-endian header length, JSON header (this document, each of "
    "the chosen arrays with its `offset` from the start of the data), then the arrays, little-endian float32.",
    "content": {BYTES: {"schema": {"type": "string", "format": "binary"}}},
}


@router.post("/simulate", responses=ok(**_OK) | problems(415, 422, 429, 503))
async def simulate(
    body: SimulationBody,
    request: Request,
    shared: Shared,
    arrays: Annotated[str | None, Query(description="names of arrays, comma between; all when left out")] = None,
) -> Response:
    """Run at most 2 simulated seconds; arrays and audio can then be had under ``id`` as for a job."""
    wanted = simulation_of(body)
    names = chosen_names(arrays)
    as_bytes = BYTES in request.headers.get("accept", "")

    def work() -> Response:
        content, result = _result(shared, wanted)
        document: dict[str, Any] = (
            {"id": content} | result_document(result) | {"links": answer_links(content, SIMULATION.forms)}
        )
        return Response(bundle(document, result, names), media_type=BYTES) if as_bytes else JSONResponse(document)

    await shared.kernels.for_runs()
    return await shared.runs.run(work, request.is_disconnected)


def _result(shared: Services, request: Simulation) -> tuple[str, SimulationResult]:
    """The kept result of a request, or a new one."""
    content = address(request)
    result = shared.storage.results.get(content)
    if result is None:
        limit = shared.settings.simulate_duration_s
        if request.run.duration_s > limit:
            raise ParameterError(
                "run.duration_s", f"{request.run.duration_s:g} s is too long to wait for",
                f"up to {limit:g} s; POST /jobs takes longer runs",
            )  # fmt: skip
        check_cost(request, shared.settings.simulate_node_steps, "VOCALIS_SIMULATE_NODE_STEPS")
        result = run_simulation(request, stop=lambda: shared.events.closed)
        shared.storage.results.cache(content, result)
    return content, replace(result, request=request)  # this request's own words; the computation is the same
