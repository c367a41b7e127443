"""M5–M9: what happens within one cycle of the modal case.

In an opening phase the minimum glottal area exceeds 0.1% of its peak and rises; in a closing phase it exceeds that and
falls. Means over the surface weight every node by its area.
"""

import numpy as np

from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS, Part, above, at_least, at_most, between, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.claims.modal import on_cycle
from vocalis.studies.paper.evidence import VoiceCycle
from vocalis.studies.paper.geometry import full_gap, opening_and_closing, weights

PLACE = "Exemplar case of sustained modal phonation"
#: "Predominantly": three quarters; deviation: half.
MOST, HALF = 0.75, 0.5
#: M6: the inferior third; deviation: the inferior half; likewise at the superior edge.
THIRD = 1.0 / 3.0
CLIMB_GOOD, CLIMB_FAIR = 0.8, 0.6
MIDDLE = (0.25, 0.75)
#: M7: shares of the largest contact pressure, and of the cycle.
SUCTION, LETTING_GO = 0.01, 0.1
#: M8: "substantially reduced" is half; deviation: any clear reduction.
REDUCED_GOOD, REDUCED_FAIR = 0.5, 0.8
#: M9: "slight" dip before the area peak, and the difference to a scaled copy of the area.
DIP, DIP_MOST = 0.01, 0.3
COPY = 0.05


def convergence_part(voice: VoiceCycle) -> tuple[Part, Part]:
    """The share of opening phases with a convergent channel, and of closing phases with a divergent one."""
    gap = full_gap(voice.w_m, voice.medial_m)
    inlet_wider = (gap[:, :, -1] - gap[:, :, 0]) @ weights(voice.x_m)
    opening, closing = opening_and_closing(voice.area_m2)
    convergent = _share(inlet_wider[opening] > 0.0)
    divergent = _share(inlet_wider[closing] < 0.0)
    return (
        Part("opening phases convergent", convergent, "1", f"{convergent:.0%} of the opening is convergent",
             at_least(convergent, MOST, HALF)),
        Part("closing phases divergent", divergent, "1", f"{divergent:.0%} of the closing is divergent",
             at_least(divergent, MOST, HALF)),
    )  # fmt: skip


@on_cycle
def converges_then_diverges(voice: VoiceCycle) -> ClaimOutcome:
    return conclude(*convergence_part(voice))


@on_cycle
def contact_climbs(voice: VoiceCycle) -> ClaimOutcome:
    x, height = voice.x_m / voice.x_m[-1], voice.y_m / voice.y_m[-1]
    middle = (x >= MIDDLE[0]) & (x <= MIDDLE[1])
    from_peak = np.roll(voice.w_m > voice.medial_m, -int(voice.area_m2.argmax()), axis=0)
    touches = from_peak[:, middle].any(axis=1)  # (p, ny)
    rows = np.flatnonzero(touches.any(axis=0))
    if not len(rows):
        return conclude(Part("rows in contact", 0.0, "", "the folds never touch mid-fold", FAIL))
    onset = touches.argmax(axis=0)[rows[::-1]]  # from the inferior edge up
    first = float(height[rows[::-1]][onset == onset.min()].mean())
    top = float(height[rows[0]])
    order = float((np.diff(onset) >= 0).mean()) if len(onset) > 1 else 0.0
    step_ms = float(voice.time_s[1] - voice.time_s[0]) * 1e3
    lag = float(onset[-1] - onset.min()) * step_ms
    return conclude(
        Part("first contact", first, "y/b", f"contact starts at y/b {first:.2f}", at_least(first, 1 - THIRD, HALF)),
        Part(
            "rows in rising order",
            order,
            "1",
            f"{order:.0%} of the rows touch no earlier than the one below",
            at_least(order, CLIMB_GOOD, CLIMB_FAIR),
        ),
        Part("highest row reached", top, "y/b", f"it reaches y/b {top:.2f}", at_most(top, THIRD, HALF)),
        Part("delay of the highest row", lag, "ms", f"{lag:.2f} ms later", above(lag, 0.0, 0.0)),
    )


@on_cycle
def separation_sucks(voice: VoiceCycle) -> ClaimOutcome:
    p = voice.contact_pa
    phase, i, j = np.unravel_index(int(p.argmin()), p.shape)
    lowest, share = float(p.min()), float(-p.min() / max(p.max(), 1e-9))
    overlap = np.roll((voice.w_m - voice.medial_m)[:, i, j], -int(phase))
    apart = overlap <= 0.0
    left = float(apart.argmax() / len(apart)) if apart.any() else float("nan")
    negative = FAIL if lowest >= 0.0 else PASS if share >= SUCTION else DEVIATION
    return conclude(
        Part("lowest contact pressure", lowest, "Pa", f"the lowest contact pressure is {lowest:.0f} Pa, {share:.1%} of "
             "the highest", negative),
        Part("from there to separation", left, "of the cycle", f"that node separates {left:.0%} of a cycle later",
             PASS if left <= LETTING_GO else DEVIATION),
    )  # fmt: skip


@on_cycle
def pressure_drives_opening(voice: VoiceCycle) -> ClaimOutcome:
    node = np.outer(weights(voice.x_m), weights(voice.y_m))
    node = node / node.sum()
    opening, closing = (voice.aerodynamic_pa[phases] for phases in opening_and_closing(voice.area_m2))
    if not len(opening) or not len(closing):
        return conclude(Part("open phases", 0.0, "", "the area does not both rise and fall", FAIL))
    size_opening, size_closing = np.abs(opening).mean(axis=0), np.abs(closing).mean(axis=0)
    total = float((size_opening * node).sum())
    positive = float((np.maximum(opening, 0.0).mean(axis=0) * node).sum()) / max(total, 1e-9)
    ratio = float((size_closing * node).sum()) / max(total, 1e-9)
    loaded = size_opening > 0.01 * max(size_opening.max(), 1e-9)
    halved = loaded & (size_closing <= REDUCED_GOOD * size_opening)
    surface = float(node[halved].sum() / node[loaded].sum()) if loaded.any() else float("nan")
    return conclude(
        Part("mean |p| while opening", total, "Pa", f"while opening |p| is {total:.0f} Pa", PASS),
        Part("positive share while opening", positive, "1", f"{positive:.0%} of it positive",
             at_least(positive, MOST, HALF)),
        Part("mean |p| closing over opening", ratio, "1", f"while closing {ratio:.2f} times that",
             at_most(ratio, REDUCED_GOOD, REDUCED_FAIR)),
        Part("surface with |p| halved", surface, "1", f"halved over {surface:.0%} of the loaded surface",
             at_least(surface, HALF, 0.0)),
    )  # fmt: skip


@on_cycle
def flow_is_no_copy(voice: VoiceCycle) -> ClaimOutcome:
    peak = int(voice.area_m2.argmax())
    to_peak = np.arange(peak - len(voice.area_m2) // 2, peak + 1)
    opening, _ = opening_and_closing(voice.area_m2)
    rise = [k for k in to_peak if opening[k] or k == peak]
    q = voice.flow_m3_s
    dip = float(1.0 - q[peak] / max(q[rise].max(), 1e-30))
    is_open = voice.area_m2 > 0.0
    difference = (q / max(q.max(), 1e-30) - voice.area_m2 / max(voice.area_m2.max(), 1e-30))[is_open]
    rms = float(np.sqrt(np.mean(difference**2)))
    dips = between(dip, (DIP, DIP_MOST), (-np.inf, np.inf))
    return conclude(
        Part(
            "rms difference to a scaled area",
            rms,
            "1",
            f"flow and area, each over its peak, differ by {rms:.0%} rms",
            at_least(rms, COPY, COPY),
        ),
        Part("dip of the flow by the area peak", dip, "1", f"at the area peak the flow has fallen by {dip:.1%}", dips),
    )


def _share(flags: np.ndarray) -> float:
    return float(flags.mean()) if len(flags) else float("nan")


CLAIMS = (
    Claim(
        key="M5",
        title="Convergent while opening, divergent while closing",
        needs=("modal",),
        picture="cycle",
        check=converges_then_diverges,
        paper_says="During opening the glottis is predominantly convergent, during closing predominantly divergent "
        f"({PLACE}, lower panels).",
        definition="Inlet (y = b) against outlet (y = 0) gap, integrated over x. Pass: the inlet is the wider in at "
        f"least {MOST:.0%} of the opening phases and the narrower in {MOST:.0%} of the closing ones. Deviation: "
        f"{HALF:.0%} of each. Fail: less.",
    ),
    Claim(
        key="M6",
        title="Contact starts inferiorly and travels up",
        needs=("modal",),
        picture="cycle",
        check=contact_climbs,
        paper_says="While closing, contact begins near the inferior edge and then spreads to the superior one "
        f"({PLACE}).",
        definition="Per row of y: first phase after the area peak in which any node in the middle half of the length "
        f"touches (w_m > G). Pass: first contact in the inferior third (y/b ≥ 2/3); {CLIMB_GOOD:.0%} of the rows "
        "touch no earlier than the row below; contact reaches the superior third, and later. Deviation: first "
        f"contact in the inferior half; {CLIMB_FAIR:.0%} of the rows; reaching only the superior half. Fail: "
        "otherwise, or no delay.",
    ),
    Claim(
        key="M7",
        title="Contact pressure turns negative at separation",
        needs=("modal",),
        picture="cycle",
        check=separation_sucks,
        paper_says="As the folds begin to separate the contact pressure becomes negative, from the damping in the "
        f"contact law ({PLACE}).",
        definition=f"Lowest contact pressure over x, y and the cycle. Pass: negative, in size at least {SUCTION:.0%} "
        f"of the highest, at a node that separates within {LETTING_GO:.0%} of a cycle. Deviation: negative, but "
        "smaller, or not followed by separation. Fail: never negative.",
    ),
    Claim(
        key="M8",
        title="Air pressure pushes while opening, hardly while closing",
        needs=("modal",),
        picture="cycle",
        check=pressure_drives_opening,
        paper_says="During opening the aerodynamic pressure on the medial surface is predominantly positive; during "
        f"closing its size is much reduced over much of the surface, except near local obstructions ({PLACE}).",
        definition=f"Means of |p| over the surface and over the opening or the closing phases. Pass: {MOST:.0%} of "
        f"the opening mean is positive pressure; the closing mean is at most {REDUCED_GOOD:g} of the opening mean, "
        "and so node by node over half of the loaded surface (nodes above 1% of the highest mean). Deviation: "
        f"{HALF:.0%} positive; at most {REDUCED_FAIR:g} of the opening mean; over less of the surface. Fail: "
        "otherwise.",
    ),
    Claim(
        key="M9",
        title="Flow is not a scaled copy of area",
        needs=("modal",),
        picture="waveforms",
        check=flow_is_no_copy,
        paper_says="The flow is not simply the area rescaled: it drops slightly near the end of opening and declines "
        f"unevenly during closing ({PLACE}).",
        definition=f"Both waves over their peaks. Pass: they differ by at least {COPY:.0%} rms over the open phase, "
        f"and at the area peak the flow has fallen by {DIP:.0%} to {DIP_MOST:.0%} from its own earlier peak. "
        "Deviation: they differ, without such a dip. Fail: they do not differ.",
    ),
)
