"""Gestures, voices whose parameters move, rendered in one reply: contours, measures per segment, sound."""

from dataclasses import replace

from fastapi import APIRouter, Request, Response
from fastapi.responses import JSONResponse

from vfcore.errors import ParameterError
from vfcore.io.audio import to_wav_bytes
from vfcore.runs.gesture.document import contour_csv, gesture_document, gesture_netcdf_bytes
from vfcore.runs.gesture.gesture import gesture_address
from vfcore.runs.gesture.render import RenderedGesture, render
from vocalis.server.addresses import gesture_links
from vocalis.server.exceptions import ResultGone
from vocalis.server.http.openapi import ok, ok_bytes, problems
from vocalis.server.jobs.kinds.base import CSV, NETCDF, WAV
from vocalis.server.schemas.gestures import GestureAnswer
from vocalis.server.schemas.requests import GestureBody, gesture_of
from vocalis.server.services import Services, Shared

router = APIRouter(prefix="/gestures", tags=["gestures"])
_PROBLEMS = problems(410, 422)


@router.post("", responses=ok(model=GestureAnswer) | problems(415, 422, 429, 503))
async def gesture(body: GestureBody, request: Request, shared: Shared) -> Response:
    """Render a gesture; ``links`` has the addresses of its sound and tables."""
    wanted = gesture_of(body)
    limit = shared.settings.gesture_duration_s
    if wanted.start.run.duration_s > limit:
        raise ParameterError("run.duration_s", f"{wanted.start.run.duration_s:g} s is too long", f"up to {limit:g} s")
    content = gesture_address(wanted)

    def work() -> Response:
        rendered = shared.gestures.get(content) or render(wanted, stop=lambda: shared.events.closed)
        rendered = replace(rendered, gesture=wanted)  # this request's own words; the computation is the same
        shared.gestures.put(content, rendered)
        return JSONResponse({"id": content} | gesture_document(rendered) | {"links": gesture_links(content)})

    await shared.kernels.for_runs()
    return await shared.runs.run(work, request.is_disconnected)


@router.get(
    "/{gesture_id}/audio.wav",
    response_class=Response,
    responses=ok_bytes("48 kHz, 16 bit, mono.", WAV) | _PROBLEMS,
)
def audio(gesture_id: str, shared: Shared) -> Response:
    """The radiated pressure as sound, peaking at −3 dBFS."""
    return Response(
        to_wav_bytes(_kept(shared, gesture_id).audio_pa)[0], headers=_attachment(gesture_id, "wav"), media_type=WAV
    )


@router.get(
    "/{gesture_id}/contours.csv",
    response_class=Response,
    responses=ok_bytes("One row per 10 ms.", CSV) | _PROBLEMS,
)
def contours(gesture_id: str, shared: Shared) -> Response:
    """f_o, level, posture and what moved, every 10 ms."""
    return Response(contour_csv(_kept(shared, gesture_id)), headers=_attachment(gesture_id, "csv"), media_type=CSV)


@router.get(
    "/{gesture_id}/result.nc",
    response_class=Response,
    responses=ok_bytes("netCDF-4 with units.", NETCDF) | _PROBLEMS,
)
def netcdf(gesture_id: str, shared: Shared) -> Response:
    """Waveforms and contours in one netCDF-4 file."""
    return Response(
        gesture_netcdf_bytes(_kept(shared, gesture_id)), headers=_attachment(gesture_id, "nc"), media_type=NETCDF
    )


def _kept(shared: Services, gesture_id: str) -> RenderedGesture:
    if (found := shared.gestures.get(gesture_id)) is None:
        raise ResultGone("This gesture is not kept here; POST /gestures makes it again.")
    return found


def _attachment(gesture_id: str, ending: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="vocalis-gesture-{gesture_id[:8]}.{ending}"'}
