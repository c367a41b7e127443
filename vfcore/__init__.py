"""Vocalis core: from five laryngeal muscles to vibrating folds, pressures, measures and sound.

>>> import vfcore
>>> result = vfcore.simulate(vfcore.Simulation())
>>> result.report.state
'periodic'
"""

from vfcore.constants import FoldConstants
from vfcore.measures.catalogue import CATALOGUE
from vfcore.measures.catalogue import measure_all as measure
from vfcore.measures.signals import Signals
from vfcore.params import Activation, Model, PostureOverride, Run, Simulation
from vfcore.posture.equilibrium import solve_posture
from vfcore.result import ARRAYS, SimulationResult
from vfcore.simulate import simulate, static_shape
from vfcore.version import CODE_VERSION, MODEL_VERSION

__version__ = CODE_VERSION
__all__ = [
    "ARRAYS",
    "CATALOGUE",
    "CODE_VERSION",
    "MODEL_VERSION",
    "Activation",
    "FoldConstants",
    "Model",
    "PostureOverride",
    "Run",
    "Signals",
    "Simulation",
    "SimulationResult",
    "measure",
    "simulate",
    "solve_posture",
    "static_shape",
]
