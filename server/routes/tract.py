"""GET /tract/{vowel}: the vocal tract of a vowel, as shape and as filter."""

from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np
from fastapi import APIRouter, Query
from fastapi.responses import JSONResponse

from vfcore.airways.coupled import tract_of
from vfcore.airways.resonances import closed_glottis_formants, transfer_function
from vfcore.spec.area_functions import area_function
from vfcore.spec.document import simulation_from_dict
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.simulation import VARIANTS, VOWELS, Simulation
from vocalis.server.http.openapi import ok, problems
from vocalis.server.schemas import answers

router = APIRouter(prefix="/tract", tags=["catalogue"])
FORMANTS = 5  # all lie below HIGHEST_HZ for the tracts offered, at the air's usual sound speed
HIGHEST_HZ, STEP_HZ = 6000.0, 20.0


def _limits(name: str) -> dict[str, float]:
    metadata = FoldConstants.__dataclass_fields__[name].metadata
    return {"ge": metadata["low"], "le": metadata["high"]}


Density = Annotated[
    float | None, Query(**_limits("rho_a_kg_m3"), description="density of air, kg/m³; the variant's own when left out")
]
Speed = Annotated[
    float | None, Query(**_limits("c_a_m_s"), description="speed of sound, m/s; the variant's own when left out")
]


@router.get("/{vowel}", responses=ok(model=answers.TractAnswer) | problems(404, 422))
def tract(
    vowel: Literal[tuple(VOWELS)],
    variant: Annotated[Literal[tuple(VARIANTS)], Query(description="model variant, whose airways these are")] = "paper",
    rho_a_kg_m3: Density = None,
    c_a_m_s: Speed = None,
) -> JSONResponse:
    """Area function, resonances with the glottis closed, and gain from glottal flow to pressure at the lips.

    It is the tract that a run of this vowel, variant and air is heard through.
    """
    air = {name: value for name, value in (("rho_a_kg_m3", rho_a_kg_m3), ("c_a_m_s", c_a_m_s)) if value is not None}
    return JSONResponse(_tract(simulation_from_dict({"vowel": vowel, "model": {"variant": variant}, "constants": air})))


@lru_cache(maxsize=64)
def _tract(request: Simulation) -> dict[str, Any]:
    vowel, published, tubes = request.vowel, area_function(request.vowel), tract_of(request)
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
