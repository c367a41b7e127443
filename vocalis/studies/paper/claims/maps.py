"""A5–A9: blank cells, flow, level and quotients over CT and TA.

Maps have axes (CT, TA) and are NaN outside voiced cells (vocalis.studies.paper.voicing).
"""

import numpy as np

from vocalis.studies.paper.bands import (
    DEVIATION,
    FAIL,
    PASS,
    ROUNDING,
    Part,
    at_least,
    at_most,
    below,
    between,
    conclude,
)
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome, Verdict
from vocalis.studies.paper.evidence import ActivationMap
from vocalis.studies.paper.trends import lines, median_range, median_spearman, rising_share, smoothed, valley_depth
from vocalis.studies.paper.voicing import COVERAGE, MAX_BELOW_MEDIAN_DB, MIN_AC_OVER_MEAN, coverage_part, seen, voiced

PLACE = "Phonatory measures as functions of CT and TA activation"
CT, TA = 0, 1
#: A5: blank regions are more than single cells and less than half of the map; "primarily" at high TA.
BLANK_GOOD, BLANK_FAIR = (0.01, 0.5), (1e-6, 0.75)
PRIMARILY, MORE_THAN_CHANCE = 0.75, 0.6
#: A6: "generally", and "relatively modest" against the effect of TA.
GENERALLY_GOOD, GENERALLY_FAIR = 0.8, 0.6
MODEST_GOOD, MODEST_FAIR = 0.5, 1.0
#: A7: a valley is at least 1 dB deep, about the smallest audible difference in level.
VALLEY_DB, VALLEY_LINES_GOOD, VALLEY_LINES_FAIR = 1.0, 0.5, 0.25
#: A8: the highest tenth of SQ, in the lowest third of CT; "tends to" as a rank correlation.
TOP, LOW_CT, TOP_GOOD, TOP_FAIR = 90.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0
TENDS = 0.5
#: A9: a difference in CQ is at least the tolerance of M3; the paper's diagonal ends at TA 0.8, CT 0.4.
CQ_STEP, DIAGONAL_TA_PER_CT, AROUND = 0.03, 2.0, 0.1
DIAGONAL_CT = (0.15, 0.4)
ROWS_GOOD, ROWS_FAIR = 2.0 / 3.0, 1.0 / 3.0


def high_ta_is_blank(maps: ActivationMap) -> ClaimOutcome:
    blank = ~voiced(maps)
    share = float(blank.mean())
    silent = float((maps.state == "none").mean())
    ct, ta = np.nonzero(blank)
    high = float((maps.ta[ta] >= 0.5 - ROUNDING).mean()) if len(ta) else float("nan")
    low = float((maps.ct[ct] <= 0.5 + ROUNDING).mean()) if len(ct) else float("nan")
    return conclude(
        Part("blank cells", share, "of the map", f"{share:.1%} of the map does not phonate",
             between(share, BLANK_GOOD, BLANK_FAIR)),
        Part("silent cells", silent, "of the map", f"{silent:.1%} is silent", PASS),
        Part("blank cells at TA ≥ 0.5", high, "1", f"{high:.0%} of the blank cells have TA ≥ 0.5",
             at_least(high, PRIMARILY, MORE_THAN_CHANCE)),
        # The text gives the lost tension as the cause, not low CT itself, so blank cells at high CT are at most a
        # deviation.
        Part("blank cells at CT ≤ 0.5", low, "1", f"{low:.0%} of them have CT ≤ 0.5",
             at_least(low, MORE_THAN_CHANCE, 0.0)),
    )  # fmt: skip


def ta_lowers_flow(maps: ActivationMap) -> ClaimOutcome:
    flow = seen(maps, maps.mean_flow_ml_s)
    falling = rising_share(-flow, TA)
    by_ct, by_ta = median_range(flow, CT, relative=True), median_range(flow, TA, relative=True)
    ratio = by_ct / by_ta if by_ta > 0.0 else float("nan")
    return conclude(
        coverage_part(flow),
        Part("neighbours along TA with falling flow", falling, "1", f"mean flow falls over {falling:.0%} of the steps "
             "in TA", at_least(falling, GENERALLY_GOOD, GENERALLY_FAIR)),
        Part("median range along TA", by_ta, "of the mean", f"TA moves it by {by_ta:.0%} of its mean", PASS),
        Part("effect of CT over that of TA", ratio, "1", f"CT moves it {ratio:.2f} times as much as TA",
             at_most(ratio, MODEST_GOOD, MODEST_FAIR)),
    )  # fmt: skip


def loud_at_high_ct(maps: ActivationMap) -> ClaimOutcome:
    spl = seen(maps, maps.spl_lips_db)
    high_ct, low_ta = maps.ct >= 0.5 - ROUNDING, maps.ta <= 0.5 + ROUNDING
    means = {
        "high CT, low TA": _mean(spl[high_ct][:, low_ta]),
        "high CT, high TA": _mean(spl[high_ct][:, ~low_ta]),
        "low CT, low TA": _mean(spl[~high_ct][:, low_ta]),
        "low CT, high TA": _mean(spl[~high_ct][:, ~low_ta]),
    }
    loudest = max(means, key=lambda name: np.nan_to_num(means[name], nan=-np.inf))
    gain = _mean(spl[high_ct]) - _mean(spl[~high_ct])
    where = PASS if loudest == "high CT, low TA" else DEVIATION if gain > 0.0 else FAIL
    valleys = [[valley_depth(line) >= VALLEY_DB for _, line in lines(smoothed(spl), axis)] for axis in (CT, TA)]
    cut = max((float(np.mean(v)) for v in valleys if v), default=float("nan"))
    return conclude(
        coverage_part(spl),
        Part("loudest quarter", loudest, "", f"the loudest quarter of the map is at {loudest}", where),
        Part("upper over lower half of CT", gain, "dB", f"the upper half of CT is {gain:+.1f} dB against the lower",
             PASS),
        Part("lines across a valley", cut, "1", f"a valley of {VALLEY_DB:g} dB cuts {cut:.0%} of the lines",
             at_least(cut, VALLEY_LINES_GOOD, VALLEY_LINES_FAIR)),
    )  # fmt: skip


def sq_falls_with_ct(maps: ActivationMap) -> ClaimOutcome:
    sq = seen(maps, maps.speed_quotient)
    if not np.isfinite(sq).any():
        return conclude(coverage_part(sq))
    ct, _ = np.nonzero(sq >= np.nanpercentile(sq, TOP))
    top = float((maps.ct[ct] <= LOW_CT + ROUNDING).mean())
    tendency = median_spearman(sq, CT)
    return conclude(
        coverage_part(sq),
        Part("highest tenth of SQ at CT ≤ 1/3", top, "1", f"{top:.0%} of the highest SQ lie at CT ≤ 1/3",
             at_least(top, TOP_GOOD, TOP_FAIR)),
        Part("median rank correlation with CT", tendency, "1",
             f"SQ goes with CT by a rank correlation of {tendency:.2f}", _tends_to_fall(tendency)),
    )  # fmt: skip


def _tends_to_fall(correlation: float) -> Verdict:
    return PASS if correlation <= -TENDS + ROUNDING else below(correlation, -TENDS, 0.0)


def cq_has_two_low_regions(maps: ActivationMap) -> ClaimOutcome:
    cq = seen(maps, maps.closed_quotient)
    if not np.isfinite(cq).any():
        return conclude(coverage_part(cq))
    tendency = median_spearman(cq, TA)
    at_zero, quarter, mean = _mean(cq[:, :1]), float(np.nanpercentile(cq, 25.0)), _mean(cq)
    rows = [k for k, c in enumerate(maps.ct) if DIAGONAL_CT[0] - ROUNDING <= c <= DIAGONAL_CT[1] + ROUNDING]
    crossed = float(np.mean([_diagonal_is_low(cq[k], maps.ta, maps.ct[k]) for k in rows])) if rows else float("nan")
    return conclude(
        coverage_part(cq),
        Part("median rank correlation with TA", tendency, "1",
             f"CQ goes with TA by a rank correlation of {tendency:.2f}", at_least(tendency, TENDS, 1e-3)),
        Part("mean CQ at TA 0", at_zero, "1",
             f"CQ at TA 0 is {at_zero:.2f}, over the map {mean:.2f}, its lower quartile {quarter:.2f}",
             at_most(at_zero, quarter, mean)),
        Part("rows with a low diagonal", crossed, "1", f"{crossed:.0%} of the rows show the low diagonal with more "
             "closure on both sides", at_least(crossed, ROWS_GOOD, ROWS_FAIR)),
    )  # fmt: skip


def _diagonal_is_low(row: np.ndarray, ta: np.ndarray, ct: float) -> bool:
    """Whether CQ on the diagonal is CQ_STEP below its largest value on each side, without TA = 0."""
    offset = ta - DIAGONAL_TA_PER_CT * ct
    on, before, after = (
        np.abs(offset) <= AROUND + ROUNDING,
        offset < -AROUND - ROUNDING,
        offset > AROUND + ROUNDING,
    )
    groups = [row[where & np.isfinite(row)] for where in (on, before & (ta > 0.0), after)]
    if not all(len(group) for group in groups):
        return False
    return bool(min(groups[1].max(), groups[2].max()) - groups[0].min() >= CQ_STEP)


def _mean(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if len(finite) else float("nan")


CLAIMS = (
    Claim(
        key="A5",
        title="No sustained phonation at high TA",
        needs=("ct_ta_map",),
        picture="map",
        check=high_ta_is_blank,
        paper_says="Some combinations give no sustained, physiologically relevant oscillation, primarily at high TA, "
        f"where the shortened membrane has too little tension ({PLACE}, blank regions).",
        definition="A cell is blank unless its state is periodic or subharmonic, its AC flow is at least "
        f"{MIN_AC_OVER_MEAN:g} of the mean flow, and its SPL is within {MAX_BELOW_MEDIAN_DB:g} dB of the median. "
        f"Pass: {BLANK_GOOD[0]:.0%} to {BLANK_GOOD[1]:.0%} of the map is blank, {PRIMARILY:.0%} of that at TA ≥ 0.5, "
        f"{MORE_THAN_CHANCE:.0%} at CT ≤ 0.5. Deviation: any blank cells up to {BLANK_FAIR[1]:.0%} of the map, "
        f"{MORE_THAN_CHANCE:.0%} at TA ≥ 0.5 (chance gives half), anywhere in CT. Fail: otherwise.",
    ),
    Claim(
        key="A6",
        title="Mean flow falls with TA, hardly moves with CT",
        needs=("ct_ta_map",),
        picture="map",
        check=ta_lowers_flow,
        paper_says=f"Mean flow generally decreases with TA; CT has a relatively modest influence ({PLACE}).",
        definition=f"Pass: mean flow falls in {GENERALLY_GOOD:.0%} of the pairs of neighbouring cells along TA, and "
        f"its relative range along CT is at most {MODEST_GOOD:g} of that along TA (medians over lines). Deviation: in "
        f"{GENERALLY_FAIR:.0%} of the pairs; CT moves it no more than TA. Fail: otherwise. {COVERAGE}",
    ),
    Claim(
        key="A7",
        title="Loudest at high CT and low TA, across a quiet cone",
        needs=("ct_ta_map",),
        picture="map",
        check=loud_at_high_ct,
        paper_says="SPL is largest at high CT, above all with little TA; a cone of low SPL separates two louder "
        f"regions ({PLACE}).",
        definition="SPL at the lips. Pass: of the four quarters of the map (cut at 0.5) the one of high CT and low "
        f"TA has the highest mean; after a 3 × 3 mean, at least {VALLEY_LINES_GOOD:.0%} of the lines along CT, or "
        f"along TA, cross a place {VALLEY_DB:g} dB below summits on both sides. Deviation: another quarter, but the "
        f"upper half of CT is the louder; {VALLEY_LINES_FAIR:.0%} of the lines. Fail: otherwise. That the quiet "
        f"region is a cone, and not another band, is left to the eye. {COVERAGE}",
    ),
    Claim(
        key="A8",
        title="SQ largest at low CT",
        needs=("ct_ta_map",),
        picture="map",
        check=sq_falls_with_ct,
        paper_says=f"The largest SQ generally occur at low CT; SQ tends to decrease as CT rises ({PLACE}).",
        definition="Pass: two thirds of the highest tenth of SQ lie at CT ≤ 1/3, and the rank correlation of SQ with "
        f"CT (median over TA columns) is −{TENDS:g} or below. Deviation: one third of them (chance gives as much); a "
        f"negative correlation. Fail: otherwise. {COVERAGE}",
    ),
    Claim(
        key="A9",
        title="CQ rises with TA between two low regions",
        needs=("ct_ta_map",),
        picture="map",
        check=cq_has_two_low_regions,
        paper_says="Overall CQ increases with TA; it is low along TA = 0 and along a diagonal from the origin to "
        f"about TA 0.8, CT 0.4, with higher values between ({PLACE}).",
        definition=f"Pass: the rank correlation of CQ with TA (median over CT rows) is {TENDS:g} or above; mean CQ at "
        f"TA 0 is at most the map's lower quartile; in two thirds of the rows CT {DIAGONAL_CT[0]:g} … "
        f"{DIAGONAL_CT[1]:g}, CQ within {AROUND:g} of TA = 2 CT falls {CQ_STEP:g} (the tolerance of M3) below its "
        "maxima on both sides. Deviation: a positive correlation; mean CQ at TA 0 below the map's mean; a third of "
        f"the rows. Fail: otherwise. {COVERAGE}",
    ),
)
