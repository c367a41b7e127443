"""S1–S6: static shapes at zero lung pressure.

"Gap" is the full distance between the folds, the smallest over y in each slice; a slice is closed up to 0.05 mm. A step
is the change from one level of the activation to the next, 0.1 higher.
"""

import numpy as np

from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS, ROUNDING, Part, above, at_least, at_most, below, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.evidence import StaticSeries
from vocalis.studies.paper.geometry import CLOSED_M, at_place, posterior_share, slice_gap, weights

MM = 1e3
CLOSED_MM = CLOSED_M * MM
PLACE = "Static vocal fold configurations"
#: "Progressively": this share of the steps has the sign that the paper gives.
STEPS_GOOD, STEPS_FAIR = 0.9, 0.7
#: Share of the gap by which a deviation may miss closure or monotonicity.
REST_FAIR = 0.1
#: Shortest anterior opening, as a share of the length; the limit of the closure patterns of vfcore.
OPENING_LENGTH = 0.15
#: TA from which "increasing TA" is judged, and the two places near the ends.
STRONG_TA = 0.5
ENDS = (0.1, 0.9)
#: "Largely absent": below half of the mid-fold value.
ENDS_GOOD, ENDS_FAIR = 0.5, 1.0
#: "Progressively straighter": the bow loses at least this share.
STRAIGHTER = 0.2


def _gaps(series: StaticSeries) -> np.ndarray:
    return slice_gap(series.w_m, series.medial_m)


def adduction_closes(series: StaticSeries) -> ClaimOutcome:
    gap = _gaps(series)[:, -1] * MM
    rise = float(max(np.diff(gap).max(), 0.0))
    allowed = max(REST_FAIR * gap[0], CLOSED_MM)
    start = above(gap[0], CLOSED_MM, CLOSED_MM)
    return conclude(
        Part("gap at LCA = IA 0", gap[0], "mm", f"the posterior gap starts at {gap[0]:.2f} mm", start),
        Part("largest rise", rise, "mm", f"no step widens it by over {rise:.2f} mm", at_most(rise, CLOSED_MM, allowed)),
        Part("gap at LCA = IA 1", gap[-1], "mm", f"{gap[-1]:.2f} mm are left", at_most(gap[-1], CLOSED_MM, allowed)),
    )


def adducted_shapes_open_anteriorly(series: StaticSeries) -> ClaimOutcome:
    closed = np.flatnonzero(_gaps(series)[:, -1] <= CLOSED_M)
    if not len(closed):
        return conclude(Part("posteriorly closed shapes", 0.0, "", "no level closes the glottis posteriorly", FAIL))
    open_levels, front_levels = [], []
    for gap, x in zip(_gaps(series)[closed], series.x_m[closed], strict=True):
        anterior = (x <= 0.5 * x[-1]) & (gap > CLOSED_M)
        open_levels.append(weights(x)[anterior].sum() >= OPENING_LENGTH * x[-1])
        front_levels.append(posterior_share(gap, x) < 0.5 - ROUNDING)
    opened, in_front = float(np.mean(open_levels)), float(np.mean(front_levels))
    n = len(closed)
    return conclude(
        Part("posteriorly closed shapes", float(n), "", f"{n} levels close the glottis posteriorly", PASS),
        Part("open anteriorly", opened, "1", f"{opened:.0%} of them are open anteriorly", at_least(opened, 1.0, 0.5)),
        Part(
            "more open in front",
            in_front,
            "1",
            f"{in_front:.0%} more in front than behind",
            at_least(in_front, 1.0, 0.5),
        ),
    )


def ta_bulges(series: StaticSeries) -> ClaimOutcome:
    bulge = series.w_b_m.max(axis=1) * MM
    growing = float((np.diff(bulge) > 0.0).mean())
    gap = _gaps(series)
    in_front = [at_place(gap, series.x_m, place) <= CLOSED_M for place in (0.25, 0.5)]
    closed = in_front[0] & in_front[1]
    n = int(closed.sum())
    closes = PASS if closed[-1] else DEVIATION if n else FAIL
    left = float((gap[closed, -1] > CLOSED_M).mean()) if n else float("nan")
    where = f"closed in front and mid-fold from TA {series.levels[closed][0]:g}" if n else "never closed in front"
    return conclude(
        Part("steps with growing bulge", growing, "1", f"the bulge grows in {growing:.0%} of the steps",
             at_least(growing, STEPS_GOOD, STEPS_FAIR)),
        Part("bulge gained", bulge[-1] - bulge[0], "mm", f"by {bulge[-1] - bulge[0]:.2f} mm in all", PASS),
        Part("levels closed in front", float(n), "", where, closes),
        Part("of these, open behind", left, "1", f"{left:.0%} of the closed shapes stay open behind",
             at_least(left, 1.0, 0.5)),
    )  # fmt: skip


def inferior_edge_leads(series: StaticSeries) -> ClaimOutcome:
    lead = series.w_m[:, :, -1] - series.w_m[:, :, 0]
    front, mid, back = (at_place(lead, series.x_m, place) * MM for place in (ENDS[0], 0.5, ENDS[1]))
    # The resting medial plane converges by b tan θ_conv; only a larger lead makes the glottis divergent.
    rest = at_place(series.medial_m[:, :, -1] - series.medial_m[:, :, 0], series.x_m, 0.5) * MM
    strong = series.levels >= STRONG_TA
    least, beyond = float(mid[strong].min()), float((mid - rest)[strong].min())
    gained = float(mid[-1] - mid[0])
    at_ends = np.maximum(np.abs(front), np.abs(back))[strong]
    ends = float((at_ends / mid[strong]).max()) if least > 0.0 else float("nan")  # no lead, no ratio
    ahead = PASS if beyond > 0.0 else DEVIATION if least > 0.0 else FAIL
    return conclude(
        Part("smallest mid-fold lead", least, "mm", f"mid-fold the inferior edge leads by at least {least:.3f} mm, "
             f"{beyond:+.3f} mm beyond a parallel glottis", ahead),
        Part("gained by TA", gained, "mm", f"TA adds {gained:.3f} mm", above(gained, 0.0, 0.0)),
        Part("largest lead near an end, of mid-fold", ends, "1", f"near the ends up to {ends:.2f} of the mid-fold lead",
             below(ends, ENDS_GOOD, ENDS_FAIR)),
    )  # fmt: skip


def ct_straightens(series: StaticSeries) -> ClaimOutcome:
    length = series.x_m[:, -1]
    longer = float((np.diff(length) > 0.0).mean())
    bow = np.abs(series.w_m[:, :, [0, -1]]).max(axis=(1, 2)) / length
    straighter = float((np.diff(bow) < 0.0).mean())
    lost = float(1.0 - bow[-1] / bow[0])
    gained = (length[-1] / length[0] - 1.0) * 100.0
    return conclude(
        Part("steps that lengthen", longer, "1", f"{longer:.0%} of the steps lengthen the folds",
             at_least(longer, STEPS_GOOD, STEPS_FAIR)),
        Part("length gained", gained, "%", f"by {gained:.0f}% in all", PASS),
        Part("steps that straighten", straighter, "1", f"{straighter:.0%} straighten them",
             at_least(straighter, STEPS_GOOD, STEPS_FAIR)),
        Part("bow lost", lost, "1", f"the bow loses {lost:.0%}", at_least(lost, STRAIGHTER, 0.0)),
    )  # fmt: skip


def pca_opens(series: StaticSeries) -> ClaimOutcome:
    gaps = _gaps(series)
    closed = float((weights(series.x_m[0]) * (gaps[0] <= CLOSED_M)).sum() / series.x_m[0, -1])
    gap = gaps[:, -1] * MM
    fall = float(max(-np.diff(gap).min(), 0.0))
    behind = posterior_share(gaps[-1], series.x_m[-1])
    allowed = max(REST_FAIR * gap[-1], CLOSED_MM)
    return conclude(
        Part("closed length at PCA 0", closed, "1", f"PCA 0 closes {closed:.0%} of the length",
             at_least(closed, 1.0, 0.9)),
        Part("largest fall", fall, "mm", f"no step narrows the posterior gap by over {fall:.2f} mm",
             at_most(fall, CLOSED_MM, allowed)),
        Part("posterior gap at PCA 1", gap[-1], "mm", f"PCA 1 opens it to {gap[-1]:.2f} mm",
             above(gap[-1], CLOSED_MM, CLOSED_MM)),
        Part("posterior share of the opening", behind, "1", f"{behind:.0%} of the opening lies behind mid-fold",
             at_least(behind, 0.6, 0.5)),
    )  # fmt: skip


CLAIMS = (
    Claim(
        key="S1",
        title="Adduction closes the posterior gap",
        needs=("static_adduction",),
        picture="static_shapes",
        check=adduction_closes,
        paper_says="Raising LCA and IA together, with CT 0.1 and TA 0, shrinks the posterior gap step by step until "
        f"it closes ({PLACE}, top left).",
        definition=f"Gap at x = L over LCA = IA 0 … 1. Pass: open at 0 (over {CLOSED_MM:g} mm), no step widens it by "
        f"more than {CLOSED_MM:g} mm, at most {CLOSED_MM:g} mm left at 1. Deviation: a step widens it, or a rest is "
        f"left, by up to {REST_FAIR:.0%} of the first gap. Fail: otherwise.",
    ),
    Claim(
        key="S2",
        title="Without TA the adducted folds stay open in front",
        needs=("static_adduction",),
        picture="static_shapes",
        check=adducted_shapes_open_anteriorly,
        paper_says=f"Because TA is relaxed, the shapes of that series keep an anterior opening ({PLACE}, top left).",
        definition=f"Levels whose gap at x = L is closed. Pass: each is open over at least {OPENING_LENGTH:.0%} of "
        "the length within the anterior half, and has more open area in front of mid-fold than behind. Deviation: "
        "each of the two for at least half of these levels. Fail: fewer, or no level closes posteriorly.",
    ),
    Claim(
        key="S3",
        title="TA bulges the folds and leaves a posterior opening",
        needs=("static_ta",),
        picture="static_shapes",
        check=ta_bulges,
        paper_says="Raising TA with CT 0.1 and LCA = IA 0.5 bulges the body medially more and more; the glottis "
        f"closes in front and mid-fold while a posterior opening persists ({PLACE}, top right).",
        definition=f"TA 0 … 1. Pass: the bulge (largest medial beam displacement) grows in {STEPS_GOOD:.0%} of the "
        "steps and overall; at TA 1 the gap is closed at x/L 0.25 and 0.5; at every level where it is, the gap at x "
        f"= L still exceeds {CLOSED_MM:g} mm. Deviation: {STEPS_FAIR:.0%} of the steps; closed there at some TA, "
        "though not at 1; open behind in at least half of those levels. Fail: otherwise.",
    ),
    Claim(
        key="S4",
        title="TA makes the inferior edge lead mid-fold",
        needs=("static_ta",),
        picture="static_shapes",
        check=inferior_edge_leads,
        paper_says="In that series the inferior edge moves medially ahead of the superior one near mid-fold, which "
        f"makes the glottis divergent; near both ends this is largely absent ({PLACE}, text on the top-right panel).",
        definition=f"Lead = w(y = b) − w(y = 0), for TA ≥ {STRONG_TA:g}. Pass: at x/L 0.5 it exceeds the resting "
        "convergence b tan θ_conv at each level (a divergent glottis), is larger at TA 1 than at TA 0, and at x/L "
        f"{ENDS[0]:g} and {ENDS[1]:g} is below half of it. Deviation: the lead is positive without making the glottis "
        "divergent, or the ends have half of it or more but less than all. Fail: otherwise.",
    ),
    Claim(
        key="S5",
        title="CT lengthens and straightens the folds",
        needs=("static_ct",),
        picture="static_shapes",
        check=ct_straightens,
        paper_says="Raising CT with LCA = IA 0.5 and TA 0.2 elongates the folds and makes them progressively "
        f"straighter, with less medial curvature ({PLACE}, bottom left).",
        definition="CT 0 … 1; the bow is the largest |w| of either edge over L. Pass: the length grows in at least "
        f"{STEPS_GOOD:.0%} of the steps and overall, the bow falls in as many and loses at least {STRAIGHTER:.0%} "
        f"overall. Deviation: {STEPS_FAIR:.0%} of the steps; a bow that loses anything. Fail: otherwise.",
    ),
    Claim(
        key="S6",
        title="PCA opens closed folds posteriorly",
        needs=("static_pca",),
        picture="static_shapes",
        check=pca_opens,
        paper_says="With LCA = IA 0.8 and TA 0.5 the glottis starts fully closed; raising PCA abducts the back of "
        f"the folds progressively and opens the glottis there ({PLACE}, bottom right; CT not printed, 0.3 taken).",
        definition="PCA 0 … 1. Pass: closed along the whole length at 0; no step narrows the gap at x = L by more "
        f"than {CLOSED_MM:g} mm; at 1 that gap is open (over {CLOSED_MM:g} mm) and at least 60% of the open area lies "
        f"behind mid-fold. Deviation: closed along 90% at 0; steps back of up to {REST_FAIR:.0%} of the last gap; "
        "half of the area behind. Fail: otherwise.",
    ),
)
