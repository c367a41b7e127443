"""GET /tract/{vowel}: the vocal tract of a vowel, as shape and as filter."""

from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from fastapi import APIRouter, Query
from fastapi.responses import JSONResponse

from vfcore.airways.coupled import tract_of
from vfcore.airways.resonances import closed_glottis_formants, transfer_function
from vfcore.spec.area_functions import area_function
from vfcore.spec.paths import DECLARATIONS, LARYNX
from vfcore.spec.request import resolve
from vfcore.spec.simulation import VARIANTS, VOWELS, Simulation
from vocalis.server.http.openapi import ok, problems
from vocalis.server.schemas import answers

router = APIRouter(prefix="/tract", tags=["catalogue"])
FORMANTS = 5  # all lie below HIGHEST_HZ for the tracts offered, at the air's usual sound speed
HIGHEST_HZ, STEP_HZ = 6000.0, 20.0


def _constant(name: str) -> Any:
    """The type of a query that sets one constant of the larynx."""
    row = DECLARATIONS[f"{LARYNX}.{name}"].metadata
    unit = "" if row["unit"] == "1" else f", {row['unit']}"
    about = Query(ge=row["low"], le=row["high"], description=f"{row['label']}{unit}; the variant's own when left out")
    return Annotated[float | None, about]


if TYPE_CHECKING:
    Vowel = str
    Variant = str
    Density = float | None
    Speed = float | None
    Scale = float | None
else:
    Vowel, Variant = Literal[tuple(VOWELS)], Literal[tuple(VARIANTS)]
    Density, Speed, Scale = (_constant(name) for name in ("rho_a_kg_m3", "c_a_m_s", "airway_scale"))


@router.get("/{vowel}", responses=ok(model=answers.TractAnswer) | problems(404, 422))
def tract(
    vowel: Vowel,
    variant: Annotated[Variant, Query(description="model variant, whose airways these are")] = "paper",
    rho_a_kg_m3: Density = None,
    c_a_m_s: Speed = None,
    airway_scale: Scale = None,
) -> JSONResponse:
    """Area function, resonances with the glottis closed, and gain from glottal flow to pressure at the lips.

    It is the tract of a run with this vowel, variant and air.
    """
    given = {"rho_a_kg_m3": rho_a_kg_m3, "c_a_m_s": c_a_m_s, "airway_scale": airway_scale}
    constants = {name: value for name, value in given.items() if value is not None}
    return JSONResponse(_tract(resolve({"vowel": vowel, "model": {"variant": variant}, "constants": constants})))


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
