"""Arithmetic and memory operations of one step of the fold, counted by running its source on counting arrays.

``python -m vocalis.bench.count NX NY [finite] [two] [many]`` prints them as JSON; with finite stretch, for two
different walls, for each glottis of a batch. The loop is run interpreted (NUMBA_DISABLE_JIT=1) with
arrays that count. So the count follows the kernel source: each +, −, ×, ÷ and square root of one vector element is one
operation (a fused multiply-add two), comparisons are counted separately, and each read or write of a number of the
buffer is 8 bytes, whether or not the compiler keeps it in a register. Idle columns that pad a vector count too.
"""

import json
import os
import subprocess
import sys
from collections.abc import Sequence

import numpy as np

TOUCHING_M = 1e-6  # penetration of one row of nodes: the kernel skips contact in open columns
ENOUGH_STEPS = 2  # two steps minus one step is the cost of a step
ARITHMETIC = {np.add, np.subtract, np.multiply, np.divide, np.sqrt, np.negative}
COMPARISONS = {np.less, np.greater}


class Counted(np.ndarray):
    """Array (any shape) whose arithmetic and accesses are counted per element in ``tally``."""

    tally = {"arithmetic": 0, "comparisons": 0, "accesses": 0}

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        plain = [np.asarray(value) for value in inputs]
        result = getattr(ufunc, method)(*plain, **options)
        kind = "arithmetic" if ufunc in ARITHMETIC else "comparisons" if ufunc in COMPARISONS else None
        if kind is not None and any(isinstance(value, Counted) for value in inputs):
            Counted.tally[kind] += np.asarray(result).size
        return np.asarray(result).view(Counted)

    def __array_function__(self, function, types, inputs, options):
        """Selections (``np.where``) and joins (``np.concatenate``) move numbers and are not counted."""
        return np.asarray(function(*map(_plain, inputs), **options)).view(Counted)

    def __getitem__(self, index):
        value = np.asarray(super().__getitem__(index)).view(Counted)
        Counted.tally["accesses"] += value.size
        return value

    def __setitem__(self, index, value):
        Counted.tally["accesses"] += np.asarray(value).size
        np.asarray(self)[index] = value


def _plain(value):
    """A value, or every value of a list, as a plain array if it is counted."""
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return np.asarray(value) if isinstance(value, Counted) else value


def count_step(nx: int, ny: int, *options: str) -> dict[str, int]:
    """Arithmetic operations, comparisons and buffer accesses of one step on nx × ny nodes, in a new process.

    ``options``: "finite", "two", "many", as above.
    """
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-m", "vocalis.bench.count", str(nx), str(ny), *options]
    return json.loads(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def _count(nx: int, ny: int, options: Sequence[str]) -> dict[str, int]:
    from vfcore.fold import assemble
    from vfcore.fold.march import Glottises
    from vfcore.spec.simulation import DEFAULT_STEP_S, Run
    from vocalis.bench.forms import glottis_of

    glottis = glottis_of(Run(nx=nx, ny=ny), finite="finite" in options, two="two" in options)
    form = glottis.form(many="many" in options)
    marching = Glottises([glottis] * form.glottises, form, DEFAULT_STEP_S)
    for side, wall in enumerate(glottis.walls):
        row = assemble.membranes(marching.buffer, marching.layout, "w", side)[ny // 2]
        row[:] = (wall.medial_plane_m[ny // 2] + TOUCHING_M)[:, None]
    buffer, record = marching.buffer.view(Counted), np.empty(len(form.record) * form.glottises)
    totals = []
    for steps in range(1, ENOUGH_STEPS + 1):
        Counted.tally.update(dict.fromkeys(Counted.tally, 0))
        marching.advance(np.full((steps, form.glottises), 1000.0), ENOUGH_STEPS, record, buffer, marching.air)
        totals.append(dict(Counted.tally))
    return {kind: (totals[1][kind] - totals[0][kind]) // form.glottises for kind in Counted.tally}


if __name__ == "__main__":
    print(json.dumps(_count(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])))
