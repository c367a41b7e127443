"""Published norms of adult men, one row each; "approximate": figures not checked against the source, or widened.

Ranges are mean ± 2 standard deviations where the source gives both, otherwise the range it reports.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import log2

from vocalis.studies.norms.efforts import EFFORTS_PA, LEVEL_PA, THRESHOLD_PA
from vocalis.studies.norms.reading import NO_VOICE, NormReading

HOLMBERG = "Holmberg, Hillman & Perkell (1988), mean ± 2 SD, approximate"
BJORKLUND = "Björklund & Sundberg (2016)"
NORMAL = "normal"
Runs = Mapping[str, NormReading]
Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Norm:
    """One norm: ``low`` to ``high`` in ``unit`` at an ``effort`` (soft, normal, loud, or across efforts).

    ``measured``: definition of the model's number in words; ``read``: the same as a function of the runs.
    """

    key: str
    symbol: str
    name: str
    unit: str
    effort: str
    low: float
    high: float
    decimals: int
    source: str
    measured: str
    read: Callable[[Runs], float]


def _catalogue(key: str, effort: str, factor: float = 1.0) -> Callable[[Runs], float]:
    return lambda runs: runs[effort].measures[key] * factor


def _flow(key: str, effort: str) -> Callable[[Runs], float]:
    return lambda runs: getattr(runs[effort].flow, key)


def _naq(runs: Runs) -> float:
    flow = runs[NORMAL].flow
    return flow.ac_ml_s * 1e-3 / flow.mfdr_l_s2 * runs[NORMAL].measures["fo_hz"]


def _level_rise(runs: Runs) -> float:
    low, high = (runs[name].measures["spl_30cm_db"] for name in ("half", "level"))
    return (high - low) / log2(LEVEL_PA["level"] / LEVEL_PA["half"])


def _fo_per_kpa(runs: Runs) -> float:
    low, high = (runs[effort].measures["fo_hz"] for effort in ("soft", "loud"))
    return (high - low) / (EFFORTS_PA["loud"] - EFFORTS_PA["soft"]) * 1e3


def _threshold_kpa(runs: Runs) -> float:
    voiced = [pressure for pressure in THRESHOLD_PA if runs[f"threshold {pressure}"].state != NO_VOICE]
    return min(voiced) / 1e3 if voiced else float("nan")


MASK = "flow low-passed at 1 kHz, as a mask sees it"


def _flow_rows(effort: str, ac: Range, mfdr: Range, low: Range, open_quotient: Range) -> tuple[Norm, ...]:
    """AC flow, MFDR, minimum flow and open quotient of one effort, each (low, high)."""
    suffix = "" if effort == NORMAL else f"_{effort}"
    return (
        Norm(f"ac{suffix}", "AC", "AC flow", "mL/s", effort, *ac, 0, HOLMBERG, MASK, _flow("ac_ml_s", effort)),
        Norm(f"mfdr{suffix}", "MFDR", "maximum flow declination rate", "L/s²", effort, *mfdr, 0, HOLMBERG, MASK,
             _flow("mfdr_l_s2", effort)),
        Norm(f"min{suffix}", "DC", "minimum flow", "mL/s", effort, *low, 0, HOLMBERG, MASK, _flow("min_ml_s", effort)),
        Norm(f"oq{suffix}", "OQ", "open quotient of the flow", "1", effort, *open_quotient, 2, HOLMBERG,
             f"{MASK}; open: above 20 % of the AC flow", _flow("open_quotient", effort)),
    )  # fmt: skip


_ROWS = (
    Norm("fo", "f_o", "fundamental frequency", "Hz", NORMAL, 85, 155, 0,
         "Baken & Orlikoff (2000), habitual pitch of men, approximate", "catalogue", _catalogue("fo_hz", NORMAL)),
    Norm("sq", "SQ", "speed quotient of the flow", "1", NORMAL, 0.9, 2.8, 2, HOLMBERG,
         f"{MASK}; rising over falling time above 20 % of the AC flow", _flow("speed_quotient", NORMAL)),
    Norm("cq", "CQ", "closed quotient of the area", "1", NORMAL, 0.3, 0.6, 2,
         "Mehta et al. (2010): half of the cycle in healthy adults; range approximate", "catalogue",
         _catalogue("closed_quotient", NORMAL)),
    Norm("mean", "Q̄", "mean flow", "mL/s", NORMAL, 80, 300, 0, HOLMBERG, "catalogue",
         _catalogue("mean_flow_ml_s", NORMAL)),
    *_flow_rows(NORMAL, (120, 400), (100, 460), (20, 220), (0.44, 0.76)),
    Norm("naq", "NAQ", "normalised amplitude quotient", "1", NORMAL, 0.08, 0.22, 3,
         "Alku, Bäckström & Vilkman (2002), normal phonation of men, approximate", MASK, _naq),
    Norm("spl", "SPL₃₀", "sound pressure level at 30 cm, 10 cmH₂O, /æ/", "dB", NORMAL, 74, 86, 1,
         f"{BJORKLUND}: 80.0 dB; ± 6 dB for speakers, approximate", "catalogue", _catalogue("spl_30cm_db", "level")),
    Norm("rise", "ΔSPL", "rise of the level per doubling of pressure, /æ/", "dB", "soft to loud", 6, 12.6, 1,
         f"{BJORKLUND}: 9.3 dB; ± 3.3 dB for speakers, approximate", "5 to 10 cmH₂O", _level_rise),
    Norm("fo_slope", "df_o/dP", "rise of f_o with pressure", "Hz/kPa", "soft to loud", 10, 60, 0,
         "Titze (1989): 1 to 6 Hz per cmH₂O, rounded", "soft to loud", _fo_per_kpa),
    Norm("threshold", "PTP", "phonation threshold pressure", "kPa", "threshold", 0.09, 0.64, 2,
         "Rieves, Regner & Jiang (2009): 3.68 ± 1.41 cmH₂O, mean ± 2 SD",
         "lowest pressure, in steps of 100 Pa, that starts a voice from rest", _threshold_kpa),
    Norm("contact", "p_col,max", "peak contact pressure", "kPa", NORMAL, 0.4, 5, 2,
         "Jiang & Titze (1994), canine hemilarynx: 0.5 to 5; Gunter et al. (2005), men: 0.4 to 3.2, approximate",
         "catalogue", _catalogue("contact_pressure_max_pa", NORMAL, 1e-3)),
    Norm("area", "A_max", "peak glottal area", "mm²", NORMAL, 5, 25, 1,
         "Hertegård & Gauffin (1995), men, approximate", "catalogue", _catalogue("peak_area_mm2", NORMAL)),
    *_flow_rows("soft", (90, 300), (50, 280), (20, 260), (0.5, 0.95)),
    *_flow_rows("loud", (200, 560), (150, 810), (20, 220), (0.4, 0.7)),
)  # fmt: skip
NORMS: dict[str, Norm] = {norm.key: norm for norm in _ROWS}
#: The fifteen norms of normal effort; the others describe changes with effort.
FIFTEEN = tuple(norm.key for norm in _ROWS if norm.effort not in ("soft", "loud"))
