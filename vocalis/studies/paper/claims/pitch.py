"""A1–A4: the f_o map over CT and TA (the paper's "Phonatory measures as functions of CT and TA activation")."""

import numpy as np

from vocalis.studies.paper.bands import FAIL, PASS, Part, above, at_least, between, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome, Verdict
from vocalis.studies.paper.evidence import ActivationMap
from vocalis.studies.paper.trends import median_range, rising_share, slope
from vocalis.studies.paper.voicing import COVERAGE, coverage_part, seen

PLACE = "Phonatory measures as functions of CT and TA activation"
CT, TA = 0, 1
#: "Approximate range", printed to tens.
RANGE_HZ, ROUNDED_HZ = (140.0, 220.0), 10.0
OVERLAP_FAIR = 0.5
#: Percentile cut off at both ends, so that no single cell at the border of voicing sets the range.
TAIL = 2.0
#: "Increases", "decreases monotonically": share of neighbouring cells.
TREND_GOOD, TREND_FAIR = 0.95, 0.8
#: Slopes of a column are compared if each half of CT has this many cells. Chance gives half of the columns.
MIN_HALF = 3
COLUMNS_GOOD, COLUMNS_FAIR = 0.8, 0.6


def _fo(maps: ActivationMap) -> np.ndarray:
    return seen(maps, maps.fo_hz, ("periodic",))


def range_of_fo(maps: ActivationMap) -> ClaimOutcome:
    fo = _fo(maps)
    if not np.isfinite(fo).any():
        return conclude(coverage_part(fo))
    low, high = (float(v) for v in np.nanpercentile(fo, (TAIL, 100.0 - TAIL)))
    shared = min(high, RANGE_HZ[1]) - max(low, RANGE_HZ[0])
    overlap = float(max(shared, 0.0) / (max(high, RANGE_HZ[1]) - min(low, RANGE_HZ[0])))
    return conclude(
        coverage_part(fo),
        Part("lowest f_o", low, "Hz", f"f_o starts at {low:.0f} Hz (paper {RANGE_HZ[0]:.0f})", _near(low, 0)),
        Part("highest f_o", high, "Hz", f"f_o ends at {high:.0f} Hz (paper {RANGE_HZ[1]:.0f})", _near(high, 1)),
        Part(
            "shared with the paper's range",
            overlap,
            "1",
            f"the ranges share {overlap:.0%}",
            at_least(overlap, OVERLAP_FAIR, OVERLAP_FAIR),
        ),
    )


def _near(value: float, end: int) -> Verdict:
    """Different ends are a deviation; the overlap of the ranges decides on failure."""
    return between(value, (RANGE_HZ[end] - ROUNDED_HZ, RANGE_HZ[end] + ROUNDED_HZ), (-np.inf, np.inf))


def ct_raises_fo(maps: ActivationMap) -> ClaimOutcome:
    fo = _fo(maps)
    rising = rising_share(fo, CT)
    by_ct, by_ta = median_range(fo, CT), median_range(fo, TA)
    return conclude(
        coverage_part(fo),
        Part("neighbours along CT with rising f_o", rising, "1", f"f_o rises over {rising:.0%} of the steps in CT",
             at_least(rising, TREND_GOOD, TREND_FAIR)),
        Part("median range along CT", by_ct, "Hz", f"CT moves f_o by {by_ct:.0f} Hz", PASS),
        Part("median range along TA", by_ta, "Hz", f"TA moves f_o by {by_ta:.0f} Hz, CT by {by_ct:.0f} Hz",
             above(by_ct, by_ta, 0.0)),
    )  # fmt: skip


def ct_slope_falls(maps: ActivationMap) -> ClaimOutcome:
    fo = _fo(maps)
    flatter = []
    for column in fo.T:
        halves = [np.isfinite(column) & side for side in (maps.ct <= 0.5, maps.ct >= 0.5)]
        if min(half.sum() for half in halves) >= MIN_HALF:
            lower, upper = (slope(maps.ct[half], column[half]) for half in halves)
            flatter.append(upper < lower)
    if not flatter:
        return conclude(Part("columns judged", 0.0, "", "no column has f_o in both halves of CT", FAIL))
    share = float(np.mean(flatter))
    return conclude(
        coverage_part(fo),
        Part(
            "columns flatter above CT 0.5",
            share,
            "1",
            f"f_o flattens in {share:.0%} of {len(flatter)} columns of TA",
            at_least(share, COLUMNS_GOOD, COLUMNS_FAIR),
        ),
    )


def ta_lowers_fo(maps: ActivationMap) -> ClaimOutcome:
    fo = _fo(maps)
    falling = rising_share(-fo, TA)
    return conclude(
        coverage_part(fo),
        Part(
            "neighbours along TA with falling f_o",
            falling,
            "1",
            f"f_o falls over {falling:.0%} of the steps in TA",
            at_least(falling, TREND_GOOD, TREND_FAIR),
        ),
    )


CLAIMS = (
    Claim(
        key="A1",
        title="f_o between about 140 and 220 Hz",
        needs=("ct_ta_map",),
        picture="map",
        check=range_of_fo,
        paper_says=f"Over the map f_o ranges approximately from 140 to 220 Hz ({PLACE}).",
        definition=f"{TAIL:g}nd to {100 - TAIL:g}th percentile of f_o over periodic voiced cells. Pass: both ends "
        f"within {ROUNDED_HZ:g} Hz of the paper's, which are printed to tens. Deviation: the two ranges share at "
        f"least {OVERLAP_FAIR:.0%} of what they span together. Fail: less. {COVERAGE}",
    ),
    Claim(
        key="A2",
        title="CT raises f_o",
        needs=("ct_ta_map",),
        picture="map",
        check=ct_raises_fo,
        paper_says=f"f_o is governed mostly by CT and rises substantially with it ({PLACE}).",
        definition=f"Pairs of neighbouring periodic voiced cells along CT. Pass: f_o rises in {TREND_GOOD:.0%} of the "
        f"pairs, and its range along CT exceeds its range along TA (medians over lines). Deviation: {TREND_FAIR:.0%} "
        f"of the pairs, or TA moves f_o more. Fail: less. {COVERAGE}",
    ),
    Claim(
        key="A3",
        title="f_o is less sensitive to CT at high CT",
        needs=("ct_ta_map",),
        picture="map",
        check=ct_slope_falls,
        paper_says=f"Ever larger changes of CT are needed for the same rise of f_o ({PLACE}).",
        definition=f"Per TA column, least-squares slope of f_o over CT ≤ 0.5 and over CT ≥ 0.5 (at least {MIN_HALF} "
        f"periodic voiced cells each). Pass: flatter above in {COLUMNS_GOOD:.0%} of the columns. Deviation: in "
        f"{COLUMNS_FAIR:.0%} (chance gives half). Fail: in fewer. {COVERAGE}",
    ),
    Claim(
        key="A4",
        title="TA lowers f_o",
        needs=("ct_ta_map",),
        picture="map",
        check=ta_lowers_fo,
        paper_says=f"TA lowers f_o monotonically throughout the phonatory regime ({PLACE}).",
        definition=f"Pairs of neighbouring periodic voiced cells along TA. Pass: f_o falls in {TREND_GOOD:.0%} of the "
        f"pairs. Deviation: in {TREND_FAIR:.0%}. Fail: in fewer. {COVERAGE}",
    ),
)
