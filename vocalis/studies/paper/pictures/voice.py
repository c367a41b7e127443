"""One cycle of a voice: waveforms over its phases, and contact."""

import numpy as np

from vocalis.studies.paper.evidence import VoiceCycle
from vocalis.studies.paper.geometry import full_gap, slice_gap, weights
from vocalis.studies.paper.pictures.plot import COLORS, Plot, PlotAxis, ramp, spanning

MM, MM2, KPA = 1e3, 1e6, 1e-3
_TIME = "time, ms"


def _time(voice: VoiceCycle) -> np.ndarray:
    return (voice.time_s - voice.time_s[0]) * 1e3


def waves(voice: VoiceCycle) -> Plot:
    """Glottal area and flow, each over its peak."""
    t = _time(voice)
    area, flow = voice.area_m2, voice.flow_m3_s
    title = "Area and flow" if voice.repeats else "Area and flow, last 10 ms: no cycle"
    plot = Plot(title, spanning(_TIME, t), PlotAxis(-0.05, 1.05, "of the peak"))
    plot.line(t, area / max(area.max(), 1e-30), COLORS[0], label=f"area, peak {area.max() * MM2:.3g} mm²")
    plot.line(t, flow / max(flow.max(), 1e-30), COLORS[1], label=f"flow, peak {flow.max() * 1e6:.0f} mL/s")
    return plot


def channel(voice: VoiceCycle) -> Plot:
    """Mean gap at the inlet and at the outlet: convergent where the inlet is the wider."""
    t, x = _time(voice), weights(voice.x_m)
    gap = full_gap(voice.w_m, voice.medial_m)
    inlet, outlet = ((gap[:, :, edge] @ x) / x.sum() * MM for edge in (-1, 0))
    plot = Plot("Inlet and outlet", spanning(_TIME, t), spanning("mean gap, mm", inlet, outlet, zero=True))
    plot.line(t, inlet, COLORS[0], label="inlet (inferior edge)")
    plot.line(t, outlet, COLORS[1], label="outlet (superior edge)")
    return plot


def contact_over_height(voice: VoiceCycle) -> Plot:
    """Largest contact pressure of each row of y over the cycle."""
    return _contact(voice, voice.contact_pa.max(axis=1), "y/b (0 superior)", flip=True)


def contact_over_length(voice: VoiceCycle) -> Plot:
    """Largest contact pressure of each slice of x over the cycle."""
    return _contact(voice, voice.contact_pa.max(axis=2), "x/L (0 anterior)", flip=False)


def _contact(voice: VoiceCycle, pressure: np.ndarray, label: str, flip: bool) -> Plot:
    t = _time(voice)
    peak = max(float(pressure.max()), 1e-9)
    half_t, n = 0.5 * (t[1] - t[0]), pressure.shape[1]
    half = 0.5 / (n - 1)
    y = PlotAxis(1 + half, -half, label) if flip else PlotAxis(-half, 1 + half, label)
    plot = Plot("Contact pressure", PlotAxis(t[0] - half_t, t[-1] + half_t, _TIME), y)
    levels = np.ceil(8 * np.clip(pressure, 0.0, None) / peak).astype(int)
    for row in range(n):
        place = sorted((row / (n - 1) - half, row / (n - 1) + half), reverse=flip)
        for begin, end, level in _stretches(levels[:, row]):
            if level:
                plot.cell((t[begin] - half_t, t[end - 1] + half_t), (place[0], place[1]), ramp((level - 0.5) / 8))
    plot.key(ramp(0.95), f"strongest, {peak * KPA:.3g} kPa; blank: no contact")
    return plot


def _stretches(levels: np.ndarray):
    """(begin, end, level) of the runs of equal level."""
    cuts = np.flatnonzero(np.diff(levels)) + 1
    for begin, end in zip([0, *cuts], [*cuts, len(levels)], strict=True):
        yield begin, end, levels[begin]


def contact_range(voice: VoiceCycle) -> Plot:
    """Largest and smallest contact pressure over the surface."""
    t = _time(voice)
    high, low = (f(voice.contact_pa, axis=(1, 2)) * KPA for f in (np.max, np.min))
    plot = Plot("Contact pressure", spanning(_TIME, t), spanning("kPa", high, low, zero=True))
    plot.line(t, high, COLORS[0], label="largest on the surface")
    plot.line(t, low, COLORS[1], label="smallest on the surface")
    return plot


def air_pressure(voice: VoiceCycle) -> Plot:
    """Mean size of the aerodynamic pressure over the surface, with the area."""
    t = _time(voice)
    node = np.outer(weights(voice.x_m), weights(voice.y_m))
    mean = np.tensordot(np.abs(voice.aerodynamic_pa), node / node.sum(), axes=2)
    scale = max(float(mean.max()), 1e-9)
    plot = Plot("Air pressure on the fold", spanning(_TIME, t), spanning("mean |p|, Pa", mean, zero=True))
    plot.line(t, mean, COLORS[0], label="mean size of the air pressure")
    plot.line(t, voice.area_m2 / max(voice.area_m2.max(), 1e-30) * scale, COLORS[1], dashed=True, label="area, scaled")
    return plot


def lasting_gap(voice: VoiceCycle) -> Plot:
    """The gap along the length at the smallest and the largest area of the cycle."""
    gap = slice_gap(voice.w_m, voice.medial_m) * MM
    x = voice.x_m * MM
    least, most = gap[int(voice.area_m2.argmin())], gap[int(voice.area_m2.argmax())]
    plot = Plot(
        "Gap along the folds", spanning("distance from the anterior end, mm", x), spanning("gap, mm", most, zero=True)
    )
    plot.line(x, most, COLORS[1], label="at the largest area")
    plot.line(x, least, COLORS[0], label="at the smallest area")
    return plot
