"""Maps over CT and TA, in which excluded cells are drawn and labelled, and curves over PCA."""

import numpy as np

from vocalis.studies.paper.evidence import ActivationMap, PcaSweep
from vocalis.studies.paper.pictures.plot import COLORS, Plot, PlotAxis, ramp, spanning
from vocalis.studies.paper.voicing import STATES, voiced

#: Fill and label of cells without a value. The greys are distinguishable on white and on black.
BLANKS = {
    "subharmonic": ("#c98bb0", "subharmonic: f_o not judged"),
    "weak": ("#b9b9b9", "repeats, but too weak for voice"),
    "irregular": ("#8f6f4f", "irregular"),
    "none": ("#4a4a4a", "no phonation"),
    "failed": ("#d02020", "the run failed"),
}


def measure(maps: ActivationMap, name: str, label: str, states: tuple[str, ...] = STATES) -> Plot:
    """One measure; cells that are not voiced, or not in ``states``, in the colour of their kind."""
    values = np.where(voiced(maps) & np.isin(maps.state, states), getattr(maps, name), np.nan)
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    plot = Plot(label, _axis(maps.ta, "TA"), _axis(maps.ct, "CT"))
    _cells(plot, maps, lambda i, j: ramp((float(values[i, j]) - low) / ((high - low) or 1.0)), np.isfinite(values))
    if len(known):
        for share in (1.0, 0.5, 0.0):
            plot.key(ramp(share), f"{low + share * (high - low):.4g}")
    _name_blanks(plot, maps, np.isfinite(values))
    return plot


def blanks(maps: ActivationMap) -> Plot:
    """Which cells phonate, and the states of the others."""
    plot = Plot("Sustained phonation", _axis(maps.ta, "TA"), _axis(maps.ct, "CT"))
    here = voiced(maps)
    _cells(plot, maps, lambda i, j: ramp(0.6), here)
    plot.key(ramp(0.6), f"phonates: {int(here.sum())} of {here.size} cells")
    _name_blanks(plot, maps, here)
    return plot


def _axis(levels: np.ndarray, label: str) -> PlotAxis:
    half = 0.5 * float(levels[1] - levels[0])
    return PlotAxis(float(levels[0]) - half, float(levels[-1]) + half, label)


def _kinds(maps: ActivationMap) -> np.ndarray:
    """The label of each cell without a value."""
    weak = np.isin(maps.state, STATES) & ~voiced(maps)
    return np.where(weak, "weak", maps.state)


def _cells(plot: Plot, maps: ActivationMap, color, known: np.ndarray) -> None:
    kinds = _kinds(maps)
    half_ct, half_ta = 0.5 * (maps.ct[1] - maps.ct[0]), 0.5 * (maps.ta[1] - maps.ta[0])
    for i, ct in enumerate(maps.ct):
        for j, ta in enumerate(maps.ta):
            fill = color(i, j) if known[i, j] else BLANKS.get(kinds[i, j], BLANKS["weak"])[0]
            plot.cell((ta - half_ta, ta + half_ta), (ct - half_ct, ct + half_ct), fill)


def _name_blanks(plot: Plot, maps: ActivationMap, known: np.ndarray) -> None:
    kinds = _kinds(maps)[~known]
    for kind, (fill, name) in BLANKS.items():
        count = int((kinds == kind).sum())
        if count:
            plot.key(fill, f"{name}: {count} cells")


def sweep(curve: PcaSweep, name: str, label: str, scale: float = 1.0) -> Plot:
    """One measure over PCA; it breaks where nothing repeats."""
    repeats = np.isin(curve.state, STATES)
    values = np.where(repeats, getattr(curve, name) * scale, np.nan)
    plot = Plot(label, PlotAxis(-0.02, 1.02, "PCA"), spanning(label, values))
    missing = int((~repeats).sum())
    silent = f"; not repeating at {missing} of {len(repeats)} levels" if missing else ""
    plot.line(curve.pca, values, COLORS[0], label=f"repeating phonation{silent}")
    return plot
