"""A picture of glottal flow and sound spectrum of three vowels with one-way and two-way coupling."""

from collections.abc import Sequence

import numpy as np

from vfcore.runs.result import SimulationResult
from vocalis.studies.norms.coupling import Pair
from vocalis.studies.paper.pictures.plot import WIDTH, Plot, PlotAxis, spanning

COLORS = {"one_way": "#1f6fb2", "two_way": "#c8501e"}
SHOWN_S, HIGHEST_HZ, DEEPEST_DB = 0.02, 5000.0, 70.0


def picture(pairs: Sequence[Pair]) -> str:
    """A self-contained SVG, one column per vowel: flow above, spectrum of the pressure at 30 cm below."""
    rows = [[_flow(pair) for pair in pairs], [_spectrum(pair) for pair in pairs]]
    heights = [max(plot.height() for plot in row) for row in rows]
    body = "".join(
        f'<g transform="translate({k * WIDTH} {sum(heights[:r])})">{plot.svg()}</g>'
        for r, row in enumerate(rows)
        for k, plot in enumerate(row)
    )
    size = f'width="{WIDTH * len(pairs)}" height="{sum(heights)}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11" fill="#333" '
        f'color="#333"><rect width="100%" height="100%" fill="#fff"/>{body}</svg>\n'
    )


def _both(pair: Pair) -> list[tuple[str, SimulationResult]]:
    return [("one_way", pair.one_way), ("two_way", pair.two_way)]


def _flow(pair: Pair) -> Plot:
    waves = []
    for way, result in _both(pair):
        rate = result.provenance.sample_rate_hz
        # Both start where the glottis is smallest, so that the two pulses overlap.
        area, flow = result.arrays["glottal_area_m2"], result.arrays["glottal_flow_m3_s"]
        first = len(area) // 2
        first += int(area[first : first + round(SHOWN_S * rate)].argmin())
        piece = flow[first : first + round(SHOWN_S * rate)] * 1e6
        waves.append((way, np.arange(len(piece)) / rate * 1e3, piece))
    y = spanning("glottal flow, mL/s", *(wave for _, _, wave in waves), zero=True)
    plot = Plot(f"/{pair.vowel}/, {pair.variant}", PlotAxis(0, SHOWN_S * 1e3, "time, ms"), y)
    for way, time, wave in waves:
        plot.line(time, wave, COLORS[way], label=way.replace("_", "-"))
    return plot


def _spectrum(pair: Pair) -> Plot:
    curves = []
    for way, result in _both(pair):
        sound = result.arrays["far_pressure_pa"][len(result.arrays["far_pressure_pa"]) // 2 :]
        level = 20 * np.log10(np.abs(np.fft.rfft(sound * np.hanning(len(sound)))) / len(sound) + 1e-12)
        freqs = np.fft.rfftfreq(len(sound), 1 / result.provenance.sample_rate_hz)
        keep = freqs < HIGHEST_HZ
        curves.append((way, freqs[keep], level[keep]))
    top = max(float(level.max()) for _, _, level in curves)
    plot = Plot(
        "spectrum at 30 cm", PlotAxis(0, HIGHEST_HZ / 1e3, "frequency, kHz"), PlotAxis(-DEEPEST_DB, 3, "level, dB")
    )
    for way, freqs, level in curves:
        plot.line(freqs / 1e3, np.maximum(level - top, -DEEPEST_DB), COLORS[way], label=way.replace("_", "-"))
    return plot
