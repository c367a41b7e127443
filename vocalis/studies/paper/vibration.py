"""Modes of a fold along its length, and the places of contact, over one cycle."""

import numpy as np
from scipy.fft import dst

from vocalis.studies.paper.evidence import VoiceCycle

#: Smallest peak contact of a phase, as a share of the strongest contact of the cycle.
STRONG = 0.1


def higher_mode_share(w_m: np.ndarray) -> float:
    """Share of the energy of ``w_m`` (p, nx, ny) about its mean over the cycle in modes sin(nπx/L), n ≥ 2."""
    moving = w_m - w_m.mean(axis=0)
    energy = (dst(moving[:, 1:-1], type=1, axis=1) ** 2).sum(axis=(0, 2))
    return float(energy[1:].sum() / max(energy.sum(), 1e-300))


def contact_regions(voice: VoiceCycle) -> list[int]:
    """Thirds of the length (0 anterior, 2 posterior) that the peak contact visits in one cycle, in order from the area
    peak on, without repeats.
    """
    peak = np.roll(voice.contact_pa.max(axis=2), -int(voice.area_m2.argmax()), axis=0)  # (p, nx)
    strong = peak.max(axis=1) > STRONG * max(peak.max(), 0.0)
    place = peak[strong].argmax(axis=1) / (peak.shape[1] - 1)
    thirds = np.minimum((3.0 * place).astype(int), 2)
    return [int(third) for k, third in enumerate(thirds) if k == 0 or third != thirds[k - 1]]
