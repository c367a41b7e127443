"""Free vibration of the step against the eigenvectors of the system: no air, no dampers, no contact.

The operators come from the twin's energies, not from the product. The fold is held wide open, starts in
its equilibrium plus a few modes, and each modal coordinate must be a cosine at its own frequency.
"""

import numpy as np
import pytest
from scipy.linalg import eigh

from tests.support.fold_harness import (
    NO_DAMPERS,
    SHEARS,
    WIDE_OPEN,
    advance,
    get_state,
    half_step_back,
    product_and_twin,
    put_state,
)
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.spec.simulation import PAPER_STEP_S

SIZE_M = 1e-6


def modes_of(twin):
    """Equilibrium (n,), squared frequencies (n,) and mass-normalised modes (n, n), scaled to 1 µm at their largest."""
    system = twin.linear_operators()
    squares, shapes = eigh(system.K, system.M)
    displacements = np.abs(shapes[: twin.n * (twin.ny + 1)]).max(axis=0)
    return np.linalg.solve(system.K, system.load), squares, shapes * (SIZE_M / displacements)


def ring(glottis, twin, chosen, dt, steps, every):
    """Modal coordinates (samples, modes) of a march that starts with amplitude 1 in each of ``chosen``."""
    rest, _, shapes = modes_of(twin)
    start = twin.unpack(rest + shapes[:, chosen].sum(axis=1), 0.0 * rest)
    march = TimeMarch(glottis, dt, 0.0)
    put_state(march, half_step_back(twin, start, dt))
    mass = np.diag(twin.linear_operators().M)
    weights = shapes * mass[:, None]
    weights /= (shapes * weights).sum(axis=0)
    coordinates = []
    for _ in range(steps // every):
        coordinates.append(weights.T @ (twin.pack(get_state(march))[0] - rest))
        record = advance(march, every)
        assert (record[:, RECORD.index("contact_area_m2")] == 0).all()
    return np.array(coordinates)


@pytest.mark.parametrize("shear", SHEARS)
@pytest.mark.parametrize("posture", [WIDE_OPEN, WIDE_OPEN | {"strain": 0.23, "a_ta": 0.0}], ids=["modal", "stretched"])
def test_each_mode_is_a_cosine_at_its_own_frequency(posture, shear):
    glottis, twin = product_and_twin(**posture, nx=12, ny=6, shear=shear, **NO_DAMPERS)
    chosen = np.r_[0:8, 20, 40]  # the lowest modes, and two short waves
    dt, every = PAPER_STEP_S, 8
    steps = round(20e-3 / dt / every) * every
    coordinates = ring(glottis, twin, chosen, dt, steps, every)
    omega = np.sqrt(modes_of(twin)[1][chosen])
    time = np.arange(len(coordinates)) * dt * every
    # The trapezoidal beam delays and the explicit membrane advances a phase by at most (ω dt)²/12 · ω t.
    phase_error = (omega * dt) ** 2 / 12 * omega * time[-1]
    assert phase_error.max() < 0.02
    away = np.abs(coordinates[:, chosen] - np.cos(np.outer(time, omega))).max(axis=0)
    assert (away < 2 * phase_error + 1e-4).all()
    others = np.delete(coordinates, chosen, axis=1)
    assert np.abs(others).max() < 0.01


@pytest.mark.parametrize("shear", SHEARS)
def test_the_lowest_frequencies_are_exact_to_a_part_in_ten_thousand(shear):
    """On the paper's grid, from the phase of each mode after 40 ms."""
    glottis, twin = product_and_twin(**WIDE_OPEN, shear=shear, **NO_DAMPERS)
    chosen, dt, every = np.arange(6), PAPER_STEP_S, 16
    coordinates = ring(glottis, twin, chosen, dt, round(40e-3 / dt / every) * every, every)[:, chosen]
    exact = twin.mode_frequencies(6)
    time = np.arange(len(coordinates)) * dt * every
    for wave, frequency in zip(coordinates.T, exact, strict=True):
        turned = 2 * np.pi * frequency * time[-1]
        carrier = np.exp(-2j * np.pi * frequency * time) * wave
        whole = int(1 / (frequency * dt * every))  # samples in one period
        late, early = carrier[-whole:].mean(), carrier[:whole].mean()
        slip = np.angle(late / early) / turned
        assert abs(slip) < 1e-4
        assert abs(late) == pytest.approx(0.5, rel=0.03)
