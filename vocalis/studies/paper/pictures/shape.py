"""Static shapes: distance of the edges of one fold from the midline, seen from above."""

import numpy as np

from vocalis.studies.paper.evidence import StaticSeries, VoiceCycle
from vocalis.studies.paper.pictures.plot import COLORS, Plot, ramp, spanning

MM = 1e3
SHOWN = 6  # of the levels of a series
_X, _EDGE = "distance from the anterior end, mm", "fold to midline, mm"


def series(shapes: StaticSeries, muscles: str) -> Plot:
    """Superior (solid) and inferior (dashed) edge for some of the levels; 0 is the midline, contact is below it."""
    shown = np.unique(np.linspace(0, len(shapes.levels) - 1, SHOWN).round().astype(int))
    edges = (shapes.medial_m - shapes.w_m)[:, :, [0, -1]] * MM
    plot = Plot("Static shapes", spanning(_X, shapes.x_m[shown] * MM), spanning(_EDGE, edges[shown], zero=True))
    _midline(plot, shapes.x_m.max() * MM)
    for k in shown:
        level = float(shapes.levels[k])
        color = ramp(0.1 + 0.75 * level)
        plot.line(shapes.x_m[k] * MM, edges[k, :, 0], color, label=f"{muscles} {level:.2g}, superior edge")
        plot.line(shapes.x_m[k] * MM, edges[k, :, 1], color, dashed=True)
    return plot


def rest_and_motion(voice: VoiceCycle) -> Plot:
    """The static edges, and the extremes of the superior edge in the cycle."""
    x = voice.x_m * MM
    rest = (voice.medial_m - voice.static_w_m) * MM
    moving = (voice.medial_m - voice.w_m)[:, :, 0] * MM
    extremes = moving.min(axis=0), moving.max(axis=0)
    plot = Plot("Static shape", spanning(_X, x), spanning(_EDGE, rest, *extremes, zero=True))
    _midline(plot, x[-1])
    plot.line(x, rest[:, 0], COLORS[0], label="static, superior edge")
    plot.line(x, rest[:, -1], COLORS[0], dashed=True, label="static, inferior edge")
    plot.line(x, extremes[0], COLORS[1], label="superior edge, extremes in the cycle")
    plot.line(x, extremes[1], COLORS[1])
    return plot


def _midline(plot: Plot, end: float) -> None:
    plot.line([0.0, end], [0.0, 0.0], "currentColor", dashed=True)
