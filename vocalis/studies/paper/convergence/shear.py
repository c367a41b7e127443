"""Convergence in y of the printed rotation equation and of the Kelvin–Voigt membrane.

Two numbers of the modal fold with more and more rows, both with the coupling stiffest at the inferior edge:

- in the run, the difference of neighbouring rows relative to the motion, which halves with the spacing for a smooth
  surface;
- without air and contact, the number of modes of the first half-wave along the fold in the frequency range of the
  voice. A membrane with shear stiffness across y has a few on any grid. In the rotation equation the rotation follows
  the slope, G̃γ = J̃φ̈: shear adds an inertia J̃ κ² to ρ_s but no stiffness. The finer the wave across y (κ), the lower
  its frequency, and each additional row adds an undamped mode below the voice.
"""

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np

from vfcore.errors import VocalisError
from vfcore.fold.assemble import Fold
from vfcore.runs.one import simulate
from vfcore.runs.result import SimulationResult
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import SHEAR_FORMS, Model, Run, Simulation
from vocalis.studies.paper.run.document import plain_number

ROWS = (10, 14, 20, 28, 40)
#: Upper limit, well above the voice of the modal case (150 Hz) and its first overtones.
VOICE_HZ = 500.0


def shear_rows(pool: ProcessPoolExecutor) -> list[Callable[[], dict[str, Any]]]:
    """One deferred row of the table for each shear form and number of rows."""
    return [pool.submit(shear_row, shear, ny).result for shear in SHEAR_FORMS for ny in ROWS]


def shear_row(shear: str, ny: int) -> dict[str, Any]:
    """The modal fold with one form of the shear on ``ny`` rows."""
    request = Simulation(model=Model(shear=shear), run=Run(ny=ny))
    rates = mode_rates(prepare(request).fold)
    voiced = rates[(rates.imag > 0.0) & (rates.imag < 2.0 * np.pi * VOICE_HZ)]
    row = {"shear": shear, "ny": ny, "modes": len(voiced), "least_decay_per_s": plain_number(-voiced.real.max())}
    try:
        result = simulate(request)
    except VocalisError:
        return row | {"state": "diverges", "fo_hz": None, "jump": None}
    fo = result.report.measures["fo_hz"].value if result.report.state == "periodic" else None
    jump = row_jump(result) if result.report.state != "none" else float("nan")
    return row | {"state": result.report.state, "fo_hz": plain_number(fo), "jump": plain_number(jump)}


def row_jump(result: SimulationResult) -> float:
    """Rms difference of neighbouring rows over the rms motion, both relative to their means over the stored cycle."""
    w = result.arrays["cycle_w_m"]
    moving = w - w.mean(axis=0)
    return float(np.sqrt(np.mean(np.diff(moving, axis=2) ** 2) / np.mean(moving**2)))


def mode_rates(fold: Fold) -> np.ndarray:
    """Eigenvalues, s⁻¹, of the membrane's motion sin(πx/L) over a beam at rest: imaginary part 2π × frequency,
    real part minus the decay.
    """
    c, k, ny, dy = fold.coefficients, fold.constants, fold.ny, fold.dy
    slope = (np.eye(ny, k=1) - np.eye(ny))[:-1] / dy  # of w between rows
    width = np.full(ny, dy)
    width[[0, -1]] /= 2
    spread = -slope.T * dy / width[:, None]  # divergence of a flux that is 0 beyond the edges
    K = np.diag(c.membrane_tension_n_m * (np.pi / c.length_m) ** 2 + fold.field("coupling")[:, 0])
    C = k.C_coup_pa_s_m * np.eye(ny)
    K, C = K - c.membrane_shear_n_m * spread @ slope, C - c.membrane_shear_viscosity_n_s_m * spread @ slope
    mass = np.full(ny, c.membrane_density_kg_m2)
    if fold.rotation:
        angle = np.eye(ny - 1)
        G, eta = c.membrane_shear_n_m, c.membrane_shear_viscosity_n_s_m
        K = np.block([[K, G * spread], [-k.G_m_pa * slope, k.G_m_pa * angle]])
        C = np.block([[C, eta * spread], [-k.eta_m_pa_s * slope, k.eta_m_pa_s * angle]])
        mass = np.concatenate([mass, np.full(ny - 1, c.rotation_inertia_kg_m)])
    zero, one = np.zeros_like(K), np.eye(len(mass))
    return np.linalg.eigvals(np.block([[zero, one], [-K / mass[:, None], -C / mass[:, None]]]))
