"""Scaling: time of the march against duration, grid, number of glottises and cores."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import MarchInput, march_many
from vfcore.fold.stability import time_step_s
from vfcore.runs.setup import prepare
from vfcore.spec.simulation import Run, Simulation
from vocalis.bench.rounds import interleaved

ROUNDS = 3
SHORT_S = 0.1
DURATIONS_S = (0.1, 0.5, 2.0)
ACROSS = (10, 20, 40, 80)  # Nx at Ny = 10
ALONG = (6, 10, 20, 40, 80)  # Ny at Nx = 20
GLOTTISES = (1, 8, 16, 64)
CORES = (1, 2, 4)


class Cost(NamedTuple):
    """One row: the amount of ``work``, the time it took, and the time per ``unit`` of work."""

    table: str
    work: str
    seconds: float
    each: float
    unit: str


def march(nx: int = 20, ny: int = 10, duration_s: float = SHORT_S) -> tuple[Callable[[], object], int]:
    """A task that marches the modal voice on a grid, and its number of steps."""
    request = Simulation(run=Run(nx=nx, ny=ny))
    glottis = prepare(request).glottis
    step = time_step_s(request.run, glottis)

    def run():
        moving = TimeMarch(glottis, step, request.subglottal_pressure_pa)
        moving.start(0, None)
        return moving.run(round(duration_s / (step * moving.record_every)))

    return run, round(duration_s / step)


def _many(count: int, threads: int = 1) -> Callable[[], object]:
    glottis = prepare(Simulation()).glottis
    step = time_step_s(Simulation().run, glottis)
    inputs = [MarchInput(glottis, step, 1000.0, SHORT_S)] * count
    part = -(-count // threads)
    parts = [inputs[begin : begin + part] for begin in range(0, count, part)]

    def run():
        with ThreadPoolExecutor(threads) as pool:
            return list(pool.map(lambda some: sum(1 for _ in march_many(some)), parts))

    return run


def costs(cores: int) -> Iterator[Cost]:
    """All tables, each the medians of ROUNDS interleaved rounds."""
    tasks = {seconds: march(duration_s=seconds)[0] for seconds in DURATIONS_S}
    for seconds, took in interleaved(tasks, ROUNDS).items():
        yield Cost("duration", f"{seconds:g} s of voice", took, 1e3 * took / seconds, "ms per s of voice")
    for table, grids in (
        ("columns Nx", [(nx, 10) for nx in ACROSS]),
        ("rows Ny", [(20, ny) for ny in ALONG]),
    ):
        made = {grid: march(*grid) for grid in grids}
        for grid, took in interleaved({grid: task for grid, (task, _) in made.items()}, ROUNDS).items():
            nodes = grid[0] * grid[1] * made[grid][1]
            yield Cost(table, f"{grid[0]}×{grid[1]}", took, 1e9 * took / nodes, "ns per node and step")
    for count, took in interleaved({count: _many(count) for count in GLOTTISES}, ROUNDS).items():
        yield Cost("glottises", f"{count} of {SHORT_S:g} s", took, 1e3 * took / count, "ms per glottis")
    tasks_by_cores = {n: _many(64, n) for n in CORES if n <= cores}
    for n, took in interleaved(tasks_by_cores, ROUNDS).items():
        yield Cost("cores", f"64 glottises on {n}", took, 1e3 * took / 64, "ms per glottis")
