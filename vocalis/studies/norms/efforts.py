"""The runs of the norms: one speaker, one posture, and one lung pressure per effort.

A norm does not fix the muscles. POSTURE is the posture that the calibration study adopts with the constants of
``human``; every variant is scored in it.
"""

from collections.abc import Iterator
from dataclasses import replace

from vfcore.spec.simulation import Activation, Simulation

#: Activation of a man's normal voice; a little PCA leaves the posterior gap that most people have.
POSTURE = Activation(lca=0.68, ia=0.68, pca=0.24, ct=0.12, ta=0.53)
#: Lung pressure of soft, normal and loud voice, men: Holmberg, Hillman & Perkell (1988), approximate.
EFFORTS_PA = {"soft": 500.0, "normal": 600.0, "loud": 850.0}
PA_PER_CMH2O = 98.0665
#: Björklund & Sundberg (2016) give the level at 10 cmH₂O and its rise per doubling, for the syllable [pæ].
LEVEL_PA = {"half": 5 * PA_PER_CMH2O, "level": 10 * PA_PER_CMH2O}
LEVEL_VOWEL = "AE"
#: Pressures tried for the phonation threshold, which is resolved to one step.
THRESHOLD_PA = tuple(range(100, 701, 100))
THRESHOLD_RUN_S = 0.4


def requests(base: Simulation) -> dict[str, Simulation]:
    """The runs by name, from ``base``: a variant with its coupling, constants and posture."""
    return dict(_requests(base))


def _requests(base: Simulation) -> Iterator[tuple[str, Simulation]]:
    for effort, pressure in EFFORTS_PA.items():
        yield effort, replace(base, subglottal_pressure_pa=pressure)
    for name, pressure in LEVEL_PA.items():
        yield name, replace(base, subglottal_pressure_pa=pressure, vowel=LEVEL_VOWEL)
    short = replace(base, run=replace(base.run, duration_s=THRESHOLD_RUN_S))
    for pressure in THRESHOLD_PA:
        yield f"threshold {pressure}", replace(short, subglottal_pressure_pa=float(pressure))
