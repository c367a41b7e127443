"""M1–M4: the modal case as a whole (the paper's "Exemplar case of sustained modal phonation")."""

from collections.abc import Callable
from functools import wraps

import numpy as np

from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS, Part, at_least, at_most, between, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.evidence import VoiceCycle
from vocalis.studies.paper.geometry import CLOSED_M, slice_gap, weights

PLACE = "Exemplar case of sustained modal phonation"
SQ_PAPER, SQ_GOOD, SQ_NORMAL = 1.52, 0.1, (1.3, 2.8)
CQ_PAPER, CQ_GOOD, CQ_FAIR = 0.49, 0.03, 0.1
#: "Nearly flat": displacement of the static shape over the length.
FLAT_GOOD, FLAT_FAIR = 0.02, 0.04
#: "Substantially greater" when vibrating than at rest.
DYNAMIC_GOOD, DYNAMIC_FAIR = 2.0, 1.0
_STATES = {"periodic": PASS, "subharmonic": DEVIATION}


def on_cycle(check: Callable[[VoiceCycle], ClaimOutcome]) -> Callable[[VoiceCycle], ClaimOutcome]:
    """Decorator of checks on one cycle: a run without a cycle fails with the reason."""

    @wraps(check)
    def checked(voice: VoiceCycle) -> ClaimOutcome:
        if not voice.repeats:
            why = f"no cycle can be followed: {voice.explanation.rstrip('.')}"
            return conclude(Part("cycle", "none", "", why, FAIL))
        return check(voice)

    return checked


def periodic_part(voice: VoiceCycle) -> Part:
    """Sustained, periodic phonation; a repeating subharmonic pattern is a deviation."""
    explanation = voice.explanation.rstrip(".")
    return Part("phonation state", voice.state, "", explanation, _STATES.get(voice.state, FAIL))


def modal_is_periodic(voice: VoiceCycle) -> ClaimOutcome:
    return conclude(periodic_part(voice))


def speed_quotient(voice: VoiceCycle) -> ClaimOutcome:
    sq = voice.measures["speed_quotient"]
    good = (SQ_PAPER - SQ_GOOD, SQ_PAPER + SQ_GOOD)
    return conclude(Part("SQ", sq, "1", f"SQ is {sq:.2f} (paper {SQ_PAPER})", between(sq, good, SQ_NORMAL)))


def closed_quotient(voice: VoiceCycle) -> ClaimOutcome:
    cq = voice.measures["closed_quotient"]
    verdict = at_most(abs(cq - CQ_PAPER), CQ_GOOD, CQ_FAIR)
    return conclude(Part("CQ", cq, "1", f"CQ is {cq:.3f} (paper {CQ_PAPER})", verdict))


@on_cycle
def static_is_flat_and_closed(voice: VoiceCycle) -> ClaimOutcome:
    length = voice.x_m[-1]
    gap = slice_gap(voice.static_w_m, voice.medial_m)
    closed = float((weights(voice.x_m) * (gap <= CLOSED_M)).sum() / length)
    static, moving = float(np.abs(voice.static_w_m).max()), float(np.abs(voice.w_m).max())
    bow, ratio = static / length, moving / max(static, 1e-12)
    return conclude(
        Part("closed length", closed, "1", f"the static shape is closed along {closed:.0%} of the length",
             at_least(closed, 1.0, 0.9)),
        Part("static displacement", bow, "1", f"its displacement is {bow:.1%} of the length",
             at_most(bow, FLAT_GOOD, FLAT_FAIR)),
        Part("displacement in the cycle over static", ratio, "1", f"in the cycle it is {ratio:.1f} times as large",
             at_least(ratio, DYNAMIC_GOOD, DYNAMIC_FAIR)),
    )  # fmt: skip


CLAIMS = (
    Claim(
        key="M1",
        title="Modal phonation is sustained and periodic",
        needs=("modal",),
        picture="waveforms",
        check=modal_is_periodic,
        paper_says=f"The area waveform opens and closes periodically, as sustained phonation does ({PLACE}).",
        definition="Phonation state of the last half of the run (vfcore.measures). Pass: periodic. Deviation: "
        "subharmonic. Fail: irregular or none.",
    ),
    Claim(
        key="M2",
        title="Speed quotient 1.52",
        needs=("modal",),
        picture="waveforms",
        check=speed_quotient,
        paper_says=f"SQ = {SQ_PAPER}; healthy modal voices range from about 1.3 to 2.8 ({PLACE}).",
        definition=f"Catalogue measure speed_quotient. Pass: within ±{SQ_GOOD:g} of {SQ_PAPER}. SQ depends on where a "
        "flat area peak and two shallow closures are read: the paper states neither its closed threshold nor its "
        "peak rule, and in prototypes of these equations the threshold moved SQ by 0.03 and refining y by 0.1. "
        f"Deviation: beyond, but within the paper's normal range {SQ_NORMAL[0]:g}–{SQ_NORMAL[1]:g}. Fail: outside "
        "both.",
    ),
    Claim(
        key="M3",
        title="Closed quotient 0.49",
        needs=("modal",),
        picture="waveforms",
        check=closed_quotient,
        paper_says=f"CQ = {CQ_PAPER}: closed for about half of the period, as healthy adults are on average ({PLACE}).",
        definition=f"Catalogue measure closed_quotient. Pass: within ±{CQ_GOOD:g} of {CQ_PAPER}; the paper states no "
        "closed threshold, and in prototypes of these equations thresholds from 0 to 2% of the peak moved CQ by "
        f"0.024, the grid by 0.01. Deviation: within ±{CQ_FAIR:g}, still about half of the period. Fail: beyond.",
    ),
    Claim(
        key="M4",
        title="The modal folds rest nearly flat and closed",
        needs=("modal",),
        picture="static_shapes",
        check=static_is_flat_and_closed,
        paper_says="The static shape is nearly flat and completely closed; vibrating shapes are much more convex or "
        f"concave ({PLACE}, top-right panel).",
        definition="Pass: static gap at most 0.05 mm along the whole length; largest static |w_m| at most "
        f"{FLAT_GOOD:.0%} of L; largest |w_m| in the cycle at least {DYNAMIC_GOOD:g} times that. Deviation: closed "
        f"along 90%; at most {FLAT_FAIR:.0%} of L; as large in the cycle as at rest. Fail: otherwise.",
    ),
)
