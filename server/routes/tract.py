"""GET /tract/{vowel}: the vocal tract of a vowel, as shape and as filter."""

from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np
from fastapi import APIRouter, Query
from fastapi.responses import JSONResponse

from vfcore.acoustics.area_functions import area_function
from vfcore.acoustics.resonances import closed_glottis_formants, transfer_function
from vfcore.acoustics.tract import vowel_tract
from vfcore.constants import FoldConstants
from vfcore.params import VOWELS
from vocalis_server import schemas
from vocalis_server.openapi import problems

router = APIRouter(prefix="/tract", tags=["catalogue"])
FORMANTS = 5  # all lie below HIGHEST_HZ for the tracts offered, at the air's usual sound speed
HIGHEST_HZ, STEP_HZ = 6000.0, 20.0
_AIR = FoldConstants()


def _limits(name: str) -> dict[str, float]:
    metadata = FoldConstants.__dataclass_fields__[name].metadata
    return {"ge": metadata["low"], "le": metadata["high"]}


Density = Annotated[float, Query(**_limits("rho_a_kg_m3"), description="density of air, kg/m³")]
Speed = Annotated[float, Query(**_limits("c_a_m_s"), description="speed of sound, m/s")]


@router.get("/{vowel}", responses={200: {"model": schemas.TractAnswer}} | problems(404, 422))
def tract(
    vowel: Literal[tuple(VOWELS)], rho_a_kg_m3: Density = _AIR.rho_a_kg_m3, c_a_m_s: Speed = _AIR.c_a_m_s
) -> JSONResponse:
    """Area function, resonances with the glottis closed, and gain from glottal flow to pressure at the lips."""
    return JSONResponse(_tract(vowel, rho_a_kg_m3, c_a_m_s))


@lru_cache(maxsize=64)
def _tract(vowel: str, rho_a_kg_m3: float, c_a_m_s: float) -> dict[str, Any]:
    published, tubes = area_function(vowel), vowel_tract(vowel, rho_a_kg_m3, c_a_m_s)
    formants = closed_glottis_formants(tubes, FORMANTS)
    frequency_hz = np.arange(STEP_HZ, HIGHEST_HZ + STEP_HZ / 2, STEP_HZ)
    gain = np.abs(transfer_function(tubes, frequency_hz).lip_pressure)
    return {
        "vowel": vowel,
        "ipa": published.ipa,
        "source": published.source,
        "section_length_m": tubes.section_length_m,
        "areas_m2": list(tubes.areas_m2),
        "formants": [
            {"frequency_hz": frequency, "bandwidth_hz": bandwidth}
            for frequency, bandwidth in zip(*(values.tolist() for values in formants), strict=True)
        ],
        "frequency_hz": frequency_hz.tolist(),
        "lip_pressure_per_flow_pa_s_m3": gain.tolist(),
    }
