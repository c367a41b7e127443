"""Twin of the air flow through the glottis, from the gap alone. Written from the paper, "Aerodynamic pressure".

Arrays are [x, y]; y = 0 is the outlet, the last row the inlet. SI units.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vfcore.fold.terms.air import MIN_GAP_CHANGE_M


class Flow(NamedTuple):
    """Flow through the slices: fields over (nx, ny), slice values over (nx,), totals as floats."""

    p_aero: np.ndarray  # Pa
    gap: np.ndarray  # m
    flow_per_width: np.ndarray  # m²/s, positive towards the mouth
    d_min: np.ndarray  # m
    j_sep: np.ndarray  # row of separation; of a closed slice, its closed row nearest the inlet
    A_g_min: float  # m²
    Q_g: float  # m³/s


@dataclass(frozen=True)
class AirTwin:
    """Quasi-steady viscous Bernoulli flow in slices of width ``dx`` with nodes ``dy`` apart, m."""

    dx: float
    dy: float
    alpha_s: float
    rho_a: float  # kg/m³
    mu_a: float  # Pa·s

    def flow(self, half, P_s: float) -> Flow:
        """Flow through the half gaps ``half`` (nx, ny), m, negative where the folds overlap; P_s in Pa."""
        nx, ny = half.shape
        gap = 2 * np.maximum(half, 0.0)
        d_min, d_max = gap.min(axis=1), gap.max(axis=1)
        d_sep = np.minimum(self.alpha_s * d_min, d_max)
        # The first row from the inlet (last row) whose gap is at most d_sep. In a closed slice d_sep = 0, and this is
        # the closed row nearest the inlet.
        fallen = gap <= d_sep[:, None]
        j_sep = ny - 1 - np.argmax(fallen[:, ::-1], axis=1)

        p_aero, flow_per_width = np.zeros_like(gap), np.zeros(nx)
        rows = np.arange(ny)
        closed = d_min == 0
        shut = closed[:, None] & (rows >= j_sep[:, None])
        p_aero[shut] = P_s

        free = np.flatnonzero(~closed)
        if free.size:
            g = gap[free]
            panels = (1 / g[:, :-1] ** 3 + 1 / g[:, 1:] ** 3) * self.dy / 2
            to_inlet = np.zeros_like(g)  # ∫_y^b dη / d_g³
            to_inlet[:, :-1] = panels[:, ::-1].cumsum(axis=1)[:, ::-1]
            A = self.rho_a / (2 * d_sep[free] ** 2)
            B = 12 * self.mu_a * to_inlet[np.arange(free.size), j_sep[free]]
            # (B - √(B² + 4 A P_s)) / 2A, multiplied out: no cancellation in narrow slices.
            dq = -2 * P_s / (B + np.sqrt(B**2 + 4 * A * P_s)) if P_s > 0 else np.zeros(free.size)
            bernoulli = self.rho_a / 2 * (dq[:, None] / g) ** 2
            attached = P_s - bernoulli + 12 * self.mu_a * dq[:, None] * to_inlet
            p_aero[free] = np.where(rows > j_sep[free, None], attached, 0.0)
            flow_per_width[free] = -dq

        along_x = np.full(nx, self.dx)
        along_x[[0, -1]] /= 2
        return Flow(p_aero, gap, flow_per_width, d_min, j_sep, float(along_x @ d_min), float(along_x @ flow_per_width))

    def mean_pressure(self, half, air: Flow, P_s: float, narrowest_before, pushed: float):
        """p_aero (nx, ny), Pa, averaged from half a step before to half a step after, as slices close and open.

        ``air``: the flow through ``half``. ``narrowest_before`` (nx,): smallest half gap of each slice one step before,
        m. ``pushed``: how far the lung pressure moves the half gap in one step, m. The whole slice is assumed to move
        at the speed of that minimum. A node downstream of the separation has P_s while the slice is closed at it or
        further downstream, and not in a row nearer to the inlet.
        """
        to_here = np.minimum.accumulate(half[:, ::-1], axis=1)[:, ::-1]  # running minimum from the inlet
        change = np.abs(half.min(axis=1) - narrowest_before) + pushed + MIN_GAP_CHANGE_M
        closed = np.clip(0.5 - to_here / change[:, None], 0.0, 1.0)
        closed_upstream = np.pad(closed, ((0, 0), (0, 1)))[:, 1:]
        attached = np.arange(half.shape[1]) > air.j_sep[:, None]
        return np.where(attached, air.p_aero, np.maximum(closed[:, :1] - closed_upstream, 0.0) * P_s)
