"""A small plot as SVG: frame, ticks, lines, cells, legend. Words and frame take the colour of the page."""

from collections.abc import Sequence
from html import escape
from typing import NamedTuple

import numpy as np

WIDTH, HEIGHT = 340, 230
LEFT, RIGHT, TOP, BOTTOM = 48, 10, 20, 36
#: Dark blue to yellow, even in lightness; after viridis by Smith and van der Walt (CC0).
_RAMP = np.array([(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)], dtype=float)
COLORS = ("var(--a)", "var(--b)", "var(--c)")

Values = Sequence[float] | np.ndarray


class PlotAxis(NamedTuple):
    """Range and label of one axis; ``low`` is the left or lower end, even if it is the larger number."""

    low: float
    high: float
    label: str


def ramp(share: float) -> str:
    """The colour at ``share`` (0 … 1) of the scale."""
    at = min(max(share, 0.0), 1.0) * (len(_RAMP) - 1)
    k = min(int(at), len(_RAMP) - 2)
    red, green, blue = _RAMP[k] + (at - k) * (_RAMP[k + 1] - _RAMP[k])
    return f"#{round(red):02x}{round(green):02x}{round(blue):02x}"


def spanning(label: str, *values: np.ndarray, zero: bool = False) -> PlotAxis:
    """An axis over all finite values with a margin of 5%; ``zero``: include 0."""
    every = np.concatenate([np.ravel(v) for v in values] + ([np.zeros(1)] if zero else []))
    every = every[np.isfinite(every)]
    low, high = (float(every.min()), float(every.max())) if len(every) else (0.0, 1.0)
    spare = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
    return PlotAxis(low - spare, high + spare, label)


class Plot:
    """A plot: elements are added in data coordinates and drawn in that order by ``svg()``."""

    def __init__(self, title: str, x: PlotAxis, y: PlotAxis):
        self._x, self._y = x, y
        self._body: list[str] = []
        self._legend: list[str] = []
        self._title = title

    def line(self, x: Values, y: Values, color: str, dashed: bool = False, label: str = "") -> None:
        """A line through the points; it breaks where a value is missing."""
        dash = ' stroke-dasharray="4 3"' if dashed else ""
        for part in _finite_runs(np.asarray(x, dtype=float), np.asarray(y, dtype=float)):
            points = " ".join(f"{self._at_x(a):.1f},{self._at_y(b):.1f}" for a, b in part)
            self._body.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"{dash}/>')
        if label:
            swatch = f'<line x1="0" x2="14" y1="-3" y2="-3" stroke="{color}" stroke-width="2"{dash}/>'
            self._legend.append(swatch + f'<text x="18">{escape(label)}</text>')

    def cell(self, x: tuple[float, float], y: tuple[float, float], fill: str) -> None:
        """A filled rectangle between two values of x and two of y."""
        # Rounded before the size is taken, so that neighbours have no gap.
        left, right = (round(self._at_x(v), 1) for v in x)
        bottom, top = (round(self._at_y(v), 1) for v in y)
        size = f'width="{right - left:.1f}" height="{bottom - top:.1f}"'
        self._body.append(f'<rect x="{left}" y="{top}" {size} fill="{fill}"/>')

    def key(self, fill: str, label: str) -> None:
        """A line of the legend for cells."""
        swatch = f'<rect x="0" y="-9" width="14" height="10" fill="{fill}" stroke="currentColor" stroke-width=".5"/>'
        self._legend.append(swatch + f'<text x="18">{escape(label)}</text>')

    def height(self) -> int:
        return HEIGHT + 14 * len(self._legend)

    def svg(self) -> str:
        """The elements, without the outer <svg>: WIDTH by ``height()``."""
        right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
        frame = (
            f'<rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" height="{bottom - TOP}" fill="none" '
            'stroke="currentColor" stroke-width=".7"/>'
        )
        words = [
            f'<text x="{LEFT}" y="13" font-weight="600">{escape(self._title)}</text>',
            f'<text x="{(LEFT + right) / 2}" y="{HEIGHT - 6}" text-anchor="middle">{escape(self._x.label)}</text>',
            f'<text transform="translate(11 {(TOP + bottom) / 2}) rotate(-90)" text-anchor="middle">'
            f"{escape(self._y.label)}</text>",
        ]
        ticks = [
            f'<text x="{self._at_x(v):.1f}" y="{bottom + 13}" text-anchor="middle">{_plain(v)}</text>'
            for v in _ticks(self._x)
        ] + [
            f'<text x="{LEFT - 4}" y="{self._at_y(v) + 4:.1f}" text-anchor="end">{_plain(v)}</text>'
            for v in _ticks(self._y)
        ]
        at = f'<g transform="translate({LEFT} '
        legend = [f'{at}{HEIGHT + 10 + 14 * k})">{entry}</g>' for k, entry in enumerate(self._legend)]
        return "".join([*self._body, frame, *ticks, *words, *legend])

    def _at_x(self, value: float) -> float:
        return LEFT + (value - self._x.low) / (self._x.high - self._x.low) * (WIDTH - RIGHT - LEFT)

    def _at_y(self, value: float) -> float:
        return HEIGHT - BOTTOM - (value - self._y.low) / (self._y.high - self._y.low) * (HEIGHT - BOTTOM - TOP)


def _finite_runs(x: np.ndarray, y: np.ndarray) -> list[np.ndarray]:
    points = np.column_stack([x, y])
    missing = ~np.isfinite(points).all(axis=1)
    parts = np.split(points, np.flatnonzero(missing))
    return [part for part in (p[np.isfinite(p).all(axis=1)] for p in parts) if len(part)]


def _ticks(axis: PlotAxis) -> np.ndarray:
    """Three to six round numbers within the axis."""
    low, high = sorted((axis.low, axis.high))
    rough = (high - low) / 4
    power = 10.0 ** np.floor(np.log10(rough))
    step = power * next(m for m in (1, 2, 2.5, 5, 10) if m * power >= rough * 0.8)
    return np.arange(np.ceil(low / step - 1e-9), high / step + 1e-9) * step


def _plain(value: float) -> str:
    return f"{0.0 if abs(value) < 1e-12 else value:.4g}".replace("-", "−")
