"""P1–P4: phonation as PCA opens the glottis (the paper's "Abductory effects of PCA activation on phonation")."""

import numpy as np

from vocalis.studies.paper.bands import DEVIATION, FAIL, PASS, ROUNDING, Part, at_least, between, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.claims.cycle import convergence_part
from vocalis.studies.paper.claims.modal import on_cycle, periodic_part
from vocalis.studies.paper.evidence import PcaSweep, VoiceCycle
from vocalis.studies.paper.geometry import posterior_share, slice_gap
from vocalis.studies.paper.vibration import contact_regions, higher_mode_share

SECTION = "Abductory effects of PCA activation on phonation"
EXEMPLAR = "Exemplar case with posterior glottal opening"
FORCES = "Contact forces and posterior glottal opening"
MM2 = 1e6
#: P1: an opening is at least 0.1 mm², the smallest change of area that counts as phonation.
OPEN_MM2 = 0.1
BEHIND_GOOD, BEHIND_FAIR = 2.0 / 3.0, 0.5
#: P2, in percent: a change below 0.5 is within the error of the time step; then "modest" and "slight"; "substantially".
NOTICED, SLIGHT = 0.5, 20.0
LATE_GOOD, LATE_FAIR = 20.0, 5.0
PEAK_PCA, LATE_HALF, NEARLY = 0.95, 0.5, 0.99
#: P3: near mid-fold; the anterior shift in x/L, and the smallest one that a grid of 20 nodes resolves.
MODERATE, MID = 0.6, 0.1
CUSP = (0.65, 0.9)
SHIFT, NODE = 0.1, 0.05
#: P4: energy in the second and higher modes along the folds; changes of region within a cycle.
MODES, MODES_GROWTH_GOOD, MODES_GROWTH_FAIR = 0.1, 2.0, 1.25
CHANGES_GOOD, CHANGES_FAIR = 2, 1


@on_cycle
def posterior_gap_voice(half: VoiceCycle) -> ClaimOutcome:
    nadir = int(half.area_m2.argmin())
    left = float(half.area_m2[nadir]) * MM2
    behind = posterior_share(slice_gap(half.w_m[nadir], half.medial_m), half.x_m)
    return conclude(
        periodic_part(half),
        Part("smallest area in the cycle", left, "mm²", f"{left:.2f} mm² never close",
             at_least(left, OPEN_MM2, OPEN_MM2)),
        Part("of it behind mid-fold", behind, "1", f"{behind:.0%} of that lies behind mid-fold",
             at_least(behind, BEHIND_GOOD, BEHIND_FAIR)),
        *convergence_part(half),
    )  # fmt: skip


def contact_pressure_rises_late(sweep: PcaSweep) -> ClaimOutcome:
    known, p = _phonating(sweep, sweep.contact_pressure_max_pa)
    if not known[0] or not known[-1] or known.mean() < 0.5:
        return conclude(_known_part(sweep, known))
    pca = sweep.pca[known]
    top, bottom = _largest_fall(p)
    rise, fall, late = (100.0 * (b / a - 1.0) for a, b in ((p[0], p[top]), (p[top], p[bottom]), (p[bottom], p[-1])))
    at = float(pca[p.argmax()])
    second = p[pca >= LATE_HALF - ROUNDING]
    ends_high = PASS if at >= PEAK_PCA - ROUNDING else DEVIATION if p[-1] >= NEARLY * second.max() else FAIL
    small = ((NOTICED, SLIGHT), (NOTICED, np.inf))
    return conclude(
        _known_part(sweep, known),
        Part("early rise", rise, "%", f"contact pressure first rises by {rise:.1f}%", between(rise, *small)),
        Part(
            "fall",
            -fall,
            "%",
            f"then falls by {-fall:.1f}%, from PCA {pca[top]:g} to {pca[bottom]:g}",
            between(-fall, *small),
        ),
        Part("late rise", late, "%", f"then rises by {late:.1f}% up to PCA 1", at_least(late, LATE_GOOD, LATE_FAIR)),
        Part("PCA of the highest pressure", at, "1", f"the highest, {p.max():.0f} Pa, comes at PCA {at:g}", ends_high),
    )


def _largest_fall(p: np.ndarray) -> tuple[int, int]:
    """Start and end of the largest fall of ``p`` before its last value."""
    before = p[:-1]
    bottom = int((np.maximum.accumulate(before) - before).argmax())
    return int(before[: bottom + 1].argmax()), bottom


def contact_place_shifts(sweep: PcaSweep) -> ClaimOutcome:
    known, place = _phonating(sweep, sweep.contact_location)
    pca = sweep.pca[known]
    low, late = pca <= MODERATE + ROUNDING, (pca >= CUSP[0] - ROUNDING) & (pca <= CUSP[1] + ROUNDING)
    if not known[-1] or not low.any() or not late.any():
        return conclude(_known_part(sweep, known))
    mid = float((np.abs(place[low] - 0.5) <= MID + ROUNDING).mean())
    foremost, at = float(place[late].min()), float(pca[late][place[late].argmin()])
    shift, back = float(np.median(place[low]) - foremost), float(place[-1] - foremost)
    return conclude(
        _known_part(sweep, known),
        Part("near mid-fold up to PCA 0.6", mid, "1",
             f"{mid:.0%} of the places up to PCA {MODERATE:g} are near mid-fold", at_least(mid, 1.0, 0.8)),
        Part("anterior shift", shift, "x/L", f"it moves forward by {shift:.2f} of the length, furthest at PCA {at:g}",
             at_least(shift, SHIFT, NODE)),
        Part("return by PCA 1", back, "x/L", f"and back by {back:.2f}", at_least(back, NODE, 0.01)),
    )  # fmt: skip


def higher_modes(full: VoiceCycle, half: VoiceCycle) -> ClaimOutcome:
    if not full.repeats or not half.repeats:
        which, silent = (1, full) if not full.repeats else (0.5, half)
        why = f"PCA {which:g} holds no cycle to follow: {silent.explanation.rstrip('.')}"
        return conclude(Part("cycle", "none", "", why, FAIL))
    share, before = higher_mode_share(full.w_m), higher_mode_share(half.w_m)
    growth = share / max(before, 1e-9)
    changes = len(contact_regions(full)) - 1
    return conclude(
        periodic_part(full),
        Part("energy in higher modes", share, "1", f"modes above the first along the folds hold {share:.0%}",
             at_least(share, MODES, 0.0)),
        Part("of that at PCA 0.5", growth, "1", f"{growth:.1f} times their share at PCA 0.5",
             at_least(growth, MODES_GROWTH_GOOD, MODES_GROWTH_FAIR)),
        Part("changes of region", float(changes), "per cycle",
             f"the highest contact changes region {max(changes, 0)} times",
             at_least(changes, CHANGES_GOOD, CHANGES_FAIR)),
    )  # fmt: skip


def _phonating(sweep: PcaSweep, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask of the levels with repeating phonation and contact (pressure above 0), and ``values`` there."""
    known = np.isin(sweep.state, ("periodic", "subharmonic")) & (values > 0.0)
    return known, values[known]


def _known_part(sweep: PcaSweep, known: np.ndarray) -> Part:
    share = float(known.mean())
    silent = ", ".join(f"{level:g}" for level in sweep.pca[~known])
    ends = known[0] and known[-1]
    verdict = at_least(share, 1.0, 0.9) if ends else FAIL
    says = "contact at every PCA" if share == 1.0 else f"no repeating phonation with contact at PCA {silent}"
    return Part("levels with repeating phonation and contact", share, "1", says, verdict)


CLAIMS = (
    Claim(
        key="P1",
        title="PCA 0.5 phonates with a lasting posterior opening",
        needs=("pca_half",),
        picture="cycle",
        check=posterior_gap_voice,
        paper_says="With PCA 0.5 the waveforms stay periodic and the glottis mostly converges while opening and "
        f"diverges while closing, with a posterior opening that persists ({SECTION}: {EXEMPLAR}).",
        definition=f"Pass: periodic; the smallest area in the cycle is at least {OPEN_MM2:g} mm², two thirds of it "
        "behind mid-fold; convergent and divergent as in M5. Deviation: subharmonic; half of it behind mid-fold; a "
        "deviation of M5. Fail: otherwise.",
    ),
    Claim(
        key="P2",
        title="Contact pressure: up a little, down a little, then far up",
        needs=("pca_sweep",),
        picture="curve",
        check=contact_pressure_rises_late,
        paper_says="With rising PCA the maximum contact pressure rises modestly, falls slightly, and beyond a "
        f"critical PCA rises substantially, with its peak at PCA 1 ({SECTION}: {FORCES}).",
        definition="contact_pressure_max_pa over PCA. The fall is the largest one before the last level; the early "
        f"rise leads to its start, the late rise from its end to PCA 1. Pass: early rise and fall {NOTICED:g} to "
        f"{SLIGHT:g}% each; late rise at least {LATE_GOOD:g}%; highest value at PCA ≥ {PEAK_PCA:g}; repeating "
        f"phonation at every level. Deviation: larger early changes; a late rise of at least {LATE_FAIR:g}%; PCA 1 "
        f"the highest (within 1%) only of PCA ≥ {LATE_HALF:g}; a tenth of the levels without repeating phonation. "
        "Fail: otherwise, or no value at PCA 0 or 1.",
    ),
    Claim(
        key="P3",
        title="The place of highest contact jumps forward and returns",
        needs=("pca_sweep",),
        picture="curve",
        check=contact_place_shifts,
        paper_says="Up to moderate PCA the place stays near mid-fold; near PCA 0.7 it shifts clearly forward, has a "
        f"cusp near 0.8, and then moves back ({SECTION}: {FORCES}).",
        definition=f"contact_location over PCA. Pass: within {MID:g} of 0.5 for every PCA ≤ {MODERATE:g}; its most "
        f"anterior value for PCA {CUSP[0]:g} … {CUSP[1]:g} lies at least {SHIFT:g} in front of the median before; at "
        f"PCA 1 it is at least {NODE:g} (one node) behind that value; repeating phonation at every level. Deviation: "
        f"within {MID:g} for 80% of those PCA; a shift of {NODE:g}; a return of 0.01; a tenth of the levels without "
        "repeating phonation. Fail: otherwise, or no value at PCA 0 or 1.",
    ),
    Claim(
        key="P4",
        title="PCA 1: higher modes, contact in alternating regions",
        needs=("pca_full", "pca_half"),
        picture="cycle",
        check=higher_modes,
        paper_says="At PCA 1 the waveforms remain periodic; higher-order anterior–posterior modes appear that "
        f"moderate PCA does not show, and the peak contact alternates between regions within the cycle ({SECTION}: "
        f"{FORCES}).",
        definition="Displacement about its mean over the cycle, in modes sin(nπx/L); anterior, middle and posterior "
        f"third. Pass: periodic; modes n ≥ 2 hold {MODES:.0%} of the energy and {MODES_GROWTH_GOOD:g} times their "
        "share at PCA 0.5; while the largest contact pressure exceeds a tenth of its maximum, its place changes "
        f"third at least {CHANGES_GOOD} times a cycle. Deviation: subharmonic; less energy in them; "
        f"{MODES_GROWTH_FAIR:g} times their share; one change. Fail: otherwise, or no phonation.",
    ),
)
