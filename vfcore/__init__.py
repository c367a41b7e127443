"""Vocalis core: from five laryngeal muscles to vibrating folds, pressures, measures and sound.

>>> import vfcore
>>> result = vfcore.simulate(vfcore.Simulation())
>>> result.report.state
'periodic'
"""

from vfcore.fold.constants import FoldConstants
from vfcore.larynx.posture.equilibrium import solve_posture
from vfcore.measures.catalogue import CATALOGUE
from vfcore.measures.catalogue import measure_all as measure
from vfcore.measures.signals import Signals
from vfcore.runs.one import simulate
from vfcore.runs.result import ARRAYS, SimulationResult
from vfcore.runs.setup import static_shape
from vfcore.spec.larynx import Larynx
from vfcore.spec.request import patched, resolve
from vfcore.spec.simulation import Activation, Model, PostureOverride, Run, Simulation
from vfcore.version import CODE_VERSION, MODEL_VERSION

__version__ = CODE_VERSION
__all__ = [
    "ARRAYS",
    "CATALOGUE",
    "CODE_VERSION",
    "MODEL_VERSION",
    "Activation",
    "FoldConstants",
    "Larynx",
    "Model",
    "PostureOverride",
    "Run",
    "Signals",
    "Simulation",
    "SimulationResult",
    "measure",
    "patched",
    "resolve",
    "simulate",
    "solve_posture",
    "static_shape",
]
