"""Runs that several tests share, made once."""

from typing import NamedTuple

import numpy as np
import pytest

import vfcore
from tests.support.fold_harness import advance
from vfcore.fold.march import TimeMarch
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import PAPER_STEP_S, Activation, Run, Simulation


class CycleOfModalVoice(NamedTuple):
    """One cycle of the modal case at the paper's own time step, one line per step, from opening to opening.

    Fields (time, x, y) at the nx − 2 inner slices (the ends never move); waves (time,); SI units.
    """

    time_s: np.ndarray
    w_m: np.ndarray
    medial_m: np.ndarray
    p_aero_pa: np.ndarray
    p_col_pa: np.ndarray
    area_m2: np.ndarray
    flow_m3_s: np.ndarray
    opening: slice
    closing: slice

    @property
    def gap_m(self) -> np.ndarray:
        return 2 * np.maximum(self.medial_m - self.w_m, 0)


@pytest.fixture(scope="session")
def modal():
    """The exemplar case: (LCA, IA, PCA, CT, TA) = (.8, .8, 0, .3, .4), 1000 Pa, one second on 20 × 10 nodes."""
    return vfcore.simulate(Simulation())


@pytest.fixture(scope="session")
def modal_cycle():
    glottis = prepare(Simulation()).glottis
    [fold] = glottis.walls
    march = TimeMarch(glottis, PAPER_STEP_S, 1000.0)
    march.start(0, None)
    area = march.run(round(0.5 / PAPER_STEP_S / march.record_every))[:, 0]
    closed = area == 0
    opens = np.flatnonzero(closed[:-1] & ~closed[1:])
    fields = march.cycle(opens[-3], opens[-2], (opens[-2] - opens[-3]) * march.record_every)
    again = TimeMarch(glottis, PAPER_STEP_S, 1000.0)
    again.start(0, None)
    lines = advance(again, opens[-2] * march.record_every)[opens[-3] * march.record_every :]
    area = lines[:, 0]
    peak, last = int(area.argmax()), int(np.flatnonzero(area > 1e-3 * area.max())[-1])
    first = int(np.flatnonzero(area > 1e-3 * area.max())[0])
    inner = np.s_[:, 1:-1]
    return CycleOfModalVoice(
        fields["cycle_time_s"],
        fields["cycle_w_m"][0][inner],
        fold.medial_plane_m.T[1:-1],
        fields["cycle_aerodynamic_pressure_pa"][inner],
        fields["cycle_contact_pressure_pa"][inner],
        area,
        lines[:, 1],
        slice(first, peak),
        slice(peak, last + 1),
    )


@pytest.fixture(scope="session")
def voice():
    """Measures and state of a one-second run: ``voice(activation=…, run=…)``, each made once."""
    known = {}

    def run(muscles=(), **settings):
        key = (tuple(sorted(dict(muscles).items())), tuple(sorted(settings.items())))
        if key not in known:
            known[key] = vfcore.simulate(Simulation(activation=Activation(**dict(muscles)), run=Run(**settings)))
        return known[key]

    return run
