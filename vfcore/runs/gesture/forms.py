"""Compiled forms of the step, before a voice needs them.

To compile a form takes 3 to 10 s, to load it from the cache of kernels 20 ms. A mark file in the cache says that a form
has been compiled, so that a process in which nothing may wait can leave the compiling to another one.
"""

from contextlib import suppress
from dataclasses import astuple
from pathlib import Path

import numpy as np

from vfcore.fold.form import StepForm
from vfcore.fold.layout import layout_of
from vfcore.fold.march import AT_REST
from vfcore.fold.step import step_kernel
from vfcore.kernels.jit import kernel_directory
from vfcore.runs.setup import postures_of
from vfcore.spec.request import resolve
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Simulation


def form_of(request: Simulation) -> StepForm:
    """The form of the step in which a run or a voice of the request begins, without solving its posture."""
    folds, run, model = folds_of(request), request.run, request.model
    return StepForm(
        nx=run.nx,
        ny=run.ny,
        walls=len(folds),
        rotation=model.shear == "rotation",
        finite=model.stretch == "finite",
        patched=any(fold.lesions for fold in folds),
        coupled=model.coupling == "two_way",
    )


def is_loaded(form: StepForm) -> bool:
    """Whether this process can march the form at once."""
    return bool(getattr(step_kernel(form), "signatures", True))  # interpreted, there is nothing to load


def is_compiled(form: StepForm) -> bool:
    """Whether the form is known to be in the cache of kernels."""
    return _mark(form).exists()


def load(form: StepForm) -> None:
    """Load the step of a form in this process, and the posture of two sides where it has two walls; compile first what
    the cache does not have.
    """
    if form.walls == 2:
        postures_of(folds_of(resolve({"right.activation.ta": 0.1})))
    nothing = np.empty(0, form.precision)
    buffer = np.zeros(layout_of(form).size, form.precision)
    step_kernel(form)(buffer, nothing, 1, nothing, nothing, nothing, nothing, AT_REST)  # a march of no steps
    with suppress(OSError):  # a folder without write permission
        _mark(form).touch()


def _mark(form: StepForm) -> Path:
    return kernel_directory() / f"step-{'-'.join(map(str, astuple(form)))}"
