"""Twins in which the air pressure ends between nodes, for a study of the grid error; not used by Vocalis itself.

*Separation.* Vocalis takes the first node, read from the inlet, whose gap is at most d_sep. ``InterpolatedAir`` puts
y_sep between that node and the one before it, where the linearly interpolated gap equals d_sep. The viscous integral
ends there, and the outer half cell of the last attached node is loaded only up to there.

*Closure.* In a closed slice Vocalis loads all nodes up to and including the first contact. ``ClosedAir`` ends the load
where the surfaces meet.
"""

import numpy as np

from tests.support.flow_twin import AirTwin, Flow
from tests.support.fold_twin import FoldTwin
from vfcore.fold.stability import time_step_s
from vfcore.measures.catalogue import MeasureReport, measure_all
from vfcore.measures.signals import Signals
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Simulation

RUN_S = 0.6


class ClosedAir(AirTwin):
    """The air, with the lung pressure in a closed slice ending where the folds meet, not at the next node."""

    def flow(self, half, P_s: float) -> Flow:
        on_nodes = super().flow(half, P_s)
        ny = half.shape[1]
        closed = np.flatnonzero((on_nodes.d_min == 0) & (on_nodes.j_sep < ny - 1))
        if not closed.size:
            return on_nodes
        j, room = on_nodes.j_sep[closed], half[closed]
        rows = np.arange(closed.size)
        before, after = room[rows, j], room[rows, j + 1]  # ≤ 0 < after
        pushed = after / (after - before)  # fraction of the segment under pressure
        middle = 0.5
        width = np.where(np.isin(np.arange(ny), (0, ny - 1)), 0.5, 1.0)
        p_aero = on_nodes.p_aero.copy()
        p_aero[closed, j] = P_s * np.maximum(pushed - middle, 0.0) / width[j]
        p_aero[closed, j + 1] = P_s * (width[j + 1] - middle + np.minimum(pushed, middle)) / width[j + 1]
        return on_nodes._replace(p_aero=p_aero)

    def mean_pressure(self, half, air: Flow, P_s: float, narrowest_before, pushed: float):
        """The instantaneous pressure: a load that ends between nodes does not jump from node to node."""
        return air.p_aero


class InterpolatedAir(AirTwin):
    """The air, with an interpolated separation point."""

    def flow(self, half, P_s: float) -> Flow:
        on_nodes = super().flow(half, P_s)
        gap, d_min = on_nodes.gap, on_nodes.d_min
        nx, ny = half.shape
        free = np.flatnonzero((d_min > 0) & (on_nodes.j_sep < ny - 1))
        if not free.size or P_s <= 0:
            return on_nodes
        g, j, rows = gap[free], on_nodes.j_sep[free], np.arange(free.size)
        d_sep = np.minimum(self.alpha_s * d_min[free], g.max(axis=1))
        # Fraction of the segment from the separated node j to y_sep.
        s = (d_sep - g[rows, j]) / (g[rows, j + 1] - g[rows, j])
        panels = (1 / g[:, :-1] ** 3 + 1 / g[:, 1:] ** 3) * self.dy / 2
        to_inlet = np.zeros_like(g)
        to_inlet[:, :-1] = panels[:, ::-1].cumsum(axis=1)[:, ::-1]
        last = (1 / d_sep**3 + 1 / g[rows, j + 1] ** 3) * (1 - s) * self.dy / 2
        A, B = self.rho_a / (2 * d_sep**2), 12 * self.mu_a * (to_inlet[rows, j + 1] + last)
        q = 2 * P_s / (B + np.sqrt(B**2 + 4 * A * P_s))
        attached = P_s - self.rho_a / 2 * (q[:, None] / g) ** 2 - 12 * self.mu_a * q[:, None] * to_inlet
        p_aero, flow_per_width = on_nodes.p_aero.copy(), on_nodes.flow_per_width.copy()
        p_aero[free] = np.where(np.arange(ny) > j[:, None], attached, 0.0)
        cell = self.dy / 2
        lower = np.where(j + 1 < ny - 1, cell * 2, cell)  # width of the cell of node j + 1
        p_aero[free, j + 1] *= (lower - s * cell) / lower
        flow_per_width[free] = q
        along_x = np.full(nx, self.dx)
        along_x[[0, -1]] /= 2
        return on_nodes._replace(p_aero=p_aero, flow_per_width=flow_per_width, Q_g=along_x @ flow_per_width)


class BothAir(ClosedAir, InterpolatedAir):
    """Both ends of the pressure interpolated."""


TWINS = {"nodes": AirTwin, "separation": InterpolatedAir, "closure": ClosedAir, "both": BothAir}


def measured_voice(request: Simulation, kind: type[AirTwin]) -> MeasureReport:
    """Measures of a run of RUN_S with this air from the flat start; those of sound are meaningless, its sound is 0."""
    ready = prepare(request)
    posture, run = ready.posture, request.run
    twin = FoldTwin(
        posture.strain,
        request.activation.ta,
        posture.glottal_half_angle_rad,
        request.convergence_angle_rad,
        run.nx,
        run.ny,
        air_law=kind,
    )
    step_s = time_step_s(run, ready.glottis)
    record = twin.run(twin.initial_state(), request.subglottal_pressure_pa, step_s, round(RUN_S / step_s))
    still = np.zeros_like(record.t)
    return measure_all(
        Signals(
            sample_rate_hz=1 / step_s,
            glottal_area_m2=record.A_g_min,
            glottal_flow_m3_s=record.Q_g,
            lip_pressure_pa=still,
            far_pressure_pa=still,
            contact_pressure_max_pa=np.maximum(record.p_col_max, 0.0),
            contact_location=still,
            contact_area_m2=still,
            subglottal_pressure_pa=request.subglottal_pressure_pa,
            length_m=twin.k.L,
            strain=posture.strain,
            glottal_half_angle_rad=posture.glottal_half_angle_rad,
            gap_m=2 * posture.half_gap_m,
            medial_area_m2=twin.k.L * twin.k.b,
            air_density_kg_m3=1.14,
            sound_speed_m_s=350.0,
        )
    )
