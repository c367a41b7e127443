"""Arithmetic and memory operations of one step of the fold, counted by running its source on numbers that count.

``python -m vocalis_bench.count NX NY`` prints them as JSON. The loop is run interpreted (NUMBA_DISABLE_JIT=1) with
every number replaced by a ``Counted`` and every array by one that counts its accesses. So the count follows the
kernel as it is written: each +, −, ×, ÷ and square root is one operation (a fused multiply-add two), min, max and
comparisons are counted apart, each read or write of the buffer is 8 bytes, whether or not the compiler keeps the value
in a register. Idle columns that ride along are work done, and count.
"""

import json
import math
import os
import subprocess
import sys

ENOUGH_STEPS = 2  # the second minus the first: what one more step costs


class Counted(float):
    """A float whose arithmetic is tallied in ``tally``."""

    tally = {"arithmetic": 0, "comparisons": 0, "accesses": 0}


def _operation(name: str, kind: str):
    plain = getattr(float, name)

    def counted(self, *other):
        Counted.tally[kind] += 1
        value = plain(self, *other)
        return Counted(value) if type(value) is float else value

    return counted


for _name in ("add", "sub", "mul", "truediv"):
    setattr(Counted, f"__{_name}__", _operation(f"__{_name}__", "arithmetic"))
    setattr(Counted, f"__r{_name}__", _operation(f"__r{_name}__", "arithmetic"))
for _name in ("lt", "gt", "le", "ge"):
    setattr(Counted, f"__{_name}__", _operation(f"__{_name}__", "comparisons"))
Counted.__neg__ = _operation("__neg__", "arithmetic")


class CountedArray:
    """An array (n,) whose every read and write is tallied."""

    def __init__(self, values):
        self.values = [Counted(value) for value in values]
        self.size = len(self.values)

    def __getitem__(self, index):
        Counted.tally["accesses"] += 1
        return self.values[index]

    def __setitem__(self, index, value):
        Counted.tally["accesses"] += 1
        self.values[index] = Counted(value)


def count_step(nx: int, ny: int) -> dict[str, int]:
    """Arithmetic operations, comparisons and buffer accesses of one step on nx × ny nodes, in another process."""
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-m", "vocalis_bench.count", str(nx), str(ny)]
    return json.loads(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def _count(nx: int, ny: int) -> dict[str, int]:
    import numpy as np

    from vfcore import assemble
    from vfcore.kernels import flow
    from vfcore.kernels import fold as kernel
    from vfcore.kernels.layout import RECORD
    from vfcore.params import DEFAULT_STEP_S, Run, Simulation
    from vfcore.simulate import prepare

    def square_root(value):
        Counted.tally["arithmetic"] += 1
        return Counted(math.sqrt(value))

    flow.math = type("CountingMath", (), {"sqrt": staticmethod(square_root)})
    fold = prepare(Simulation(run=Run(nx=nx, ny=ny))).fold
    advance = kernel.step_kernel(nx, ny, fold.rotation)
    buffer = CountedArray(assemble.new_buffer(fold, DEFAULT_STEP_S))
    scalars = [Counted(value) for value in assemble.scalars(fold, DEFAULT_STEP_S)]
    totals = []
    for steps in range(1, ENOUGH_STEPS + 1):
        Counted.tally.update(dict.fromkeys(Counted.tally, 0))
        advance(buffer, scalars, CountedArray([1000.0] * steps), ENOUGH_STEPS, np.empty((1, len(RECORD))))
        totals.append(dict(Counted.tally))
    return {kind: totals[1][kind] - totals[0][kind] for kind in Counted.tally}


if __name__ == "__main__":
    print(json.dumps(_count(int(sys.argv[1]), int(sys.argv[2]))))
