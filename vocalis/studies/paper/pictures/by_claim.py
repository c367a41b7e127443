"""Which picture shows a claim."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from vocalis.studies.paper.cases import CASES
from vocalis.studies.paper.claims.claim import Claim
from vocalis.studies.paper.pictures import muscle_maps, shape, voice
from vocalis.studies.paper.pictures.plot import Plot
from vocalis.studies.paper.run.gather import Failure


class Figure(NamedTuple):
    """A picture; ``key`` is the same for claims that share it."""

    key: str
    plot: Plot


def _map(name: str, label: str, *states: str) -> Callable:
    return lambda maps: muscle_maps.measure(maps, name, label, *([states] if states else []))


def _shapes(case: str) -> Callable:
    muscles = " = ".join(m.upper() for m in CASES[case].axes[0].muscles)
    return lambda series: shape.series(series, muscles)


_FO = ("fo", _map("fo_hz", "f_o, Hz", "periodic"))
_WAVES = ("waves", voice.waves)
#: By claim: name of the picture within its case, and the function that draws it from the evidence of that case.
_DRAWN: dict[str, tuple[str, Callable[[Any], Plot]]] = {
    "S1": ("shapes", _shapes("static_adduction")), "S2": ("shapes", _shapes("static_adduction")),
    "S3": ("shapes", _shapes("static_ta")), "S4": ("shapes", _shapes("static_ta")),
    "S5": ("shapes", _shapes("static_ct")), "S6": ("shapes", _shapes("static_pca")),
    "M1": _WAVES, "M2": _WAVES, "M3": _WAVES, "M9": _WAVES,
    "M4": ("rest", shape.rest_and_motion),
    "M5": ("channel", voice.channel), "M6": ("height", voice.contact_over_height),
    "M7": ("range", voice.contact_range), "M8": ("air", voice.air_pressure),
    "A1": _FO, "A2": _FO, "A3": _FO, "A4": _FO, "A5": ("blanks", muscle_maps.blanks),
    "A6": ("flow", _map("mean_flow_ml_s", "mean flow, mL/s")),
    "A7": ("spl", _map("spl_lips_db", "SPL at the lips, dB")),
    "A8": ("sq", _map("speed_quotient", "SQ")), "A9": ("cq", _map("closed_quotient", "CQ")),
    "P1": ("gap", voice.lasting_gap), "P4": ("length", voice.contact_over_length),
    "P2": ("pressure", lambda s: muscle_maps.sweep(s, "contact_pressure_max_pa", "max. contact pressure, kPa", 1e-3)),
    "P3": ("place", lambda s: muscle_maps.sweep(s, "contact_location", "place of max. contact, x/L")),
}  # fmt: skip


def figure(claim: Claim, found: Mapping[str, Any]) -> Figure | None:
    """The picture of a claim; None if it is only a number or its run has no answer."""
    if claim.key not in _DRAWN or isinstance(found[claim.needs[0]], Failure):
        return None
    name, draw = _DRAWN[claim.key]
    return Figure(f"{claim.needs[0]}-{name}", draw(found[claim.needs[0]]))
