"""Other programs that make a second of voice, timed in the same rounds if they are installed.

- VocalTractLab (Birkholz; PyPI ``vocaltractlab-cython``, GPL-3, optional extra ``compare``): 1 s of /a/ with its
  geometric glottis. It prescribes the motion of the folds, Vocalis computes it. So the ratio compares waiting times,
  not solvers.
- The readable twin of the tests, at the default step, if the tests are installed with the benchmarks.
"""

import importlib
import importlib.util
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np

from vfcore.spec.simulation import DEFAULT_STEP_S

TWIN_STEPS = 200
STATES_PER_S = 400
FOLDER = Path(__file__).resolve().parents[2]


def tasks() -> dict[str, Callable[[], object]]:
    """The tasks that can run here, for ``interleaved``."""
    found = {}
    if importlib.util.find_spec("vocaltractlab_cython") is not None:
        found["vocaltractlab"] = _vocaltractlab()
    twin = _twin()
    if twin is not None:
        found["twin"] = twin
    return found


def rows(seconds: Mapping[str, float]) -> Iterator[tuple[str, str, float, str]]:
    """Rows (key, label, value, unit) from the times of ``tasks``: seconds per second of voice, and ratios."""
    if "twin" in seconds:
        took = seconds["twin"] / (TWIN_STEPS * DEFAULT_STEP_S)
        yield "twin_s", "readable twin of the tests, 1 s of voice", took, "s"
        yield "twin_ratio", "  twin / kernel", took / seconds["kernel"], "×"
    if "vocaltractlab" in seconds:
        took = seconds["vocaltractlab"]
        yield "vocaltractlab_s", "VocalTractLab, 1 s of /a/", took, "s"
        yield "vocaltractlab_ratio", "  VocalTractLab / our request → result", took / seconds["result"], "×"


def _vocaltractlab() -> Callable[[], object]:
    vtl = importlib.import_module("vocaltractlab_cython")
    samples = round(vtl.get_constants()["sr_audio"] / STATES_PER_S)
    tract, glottis = vtl.get_shape("a", "tract"), vtl.get_shape("modal", "glottis")
    states = STATES_PER_S + 1
    return lambda: vtl.synth_block(np.tile(tract, (states, 1)), np.tile(glottis, (states, 1)), samples)


def _twin() -> Callable[[], object] | None:
    sys.path.insert(0, str(FOLDER))
    try:  # an installed wheel has no tests
        if importlib.util.find_spec("tests.support") is None:
            return None
        twin = importlib.import_module("tests.support.fold_twin").FoldTwin(0.057, 0.4, 0.0)
    except ModuleNotFoundError:
        return None
    finally:
        sys.path.remove(str(FOLDER))
    return lambda: twin.run(twin.initial_state(), 1000.0, DEFAULT_STEP_S, TWIN_STEPS)
