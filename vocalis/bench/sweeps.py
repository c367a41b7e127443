"""Sweeps through the job system: their time on all cores, and the overhead of the job system.

``python -m vocalis.bench.sweeps [map|large]`` prints figures as JSON.

- ``map``: 21 × 21 runs of 1 s over CT and TA with all measures: on one core without a server, then through the job
  system with one worker and with all workers, in double and in single precision. The runs with all workers are repeated
  ``--rounds`` times, because the cores may be shared. For comparison, the time of a plain compiled loop for the same
  voices on the same cores, without measures.
- ``large``: 10,000 runs of 1 s through the job system, killed with -9 half-way and resumed; memory of all processes;
  the result opened with xarray.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median

import httpx

from vfcore.runs.setup import prepare
from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vocalis.bench.interactive import printed_address
from vocalis.bench.reference import plain_run
from vocalis.bench.rounds import interleaved
from vocalis.server.warmup.compile import compile_everything

MB = 2**20
LOOK_EVERY_S = 0.25
PRESSURE_PA, APART_PA = 1000.0, 0.25  # pressure of the rounds of a map: no point may repeat, the work must not change


def grid(n_ct: int, n_ta: int) -> dict:
    """A sweep of runs of 1 s over CT and TA."""
    axes = [("activation.ct", n_ct), ("activation.ta", n_ta)]
    return {
        "kind": "sweep",
        "axes": [{"parameter": path, "values": [k / (n - 1) for k in range(n)]} for path, n in axes],
    }


@contextmanager
def served(folder: str, workers: int) -> Iterator[tuple[httpx.Client, subprocess.Popen]]:
    """A server process that is ready, with all kernels compiled."""
    compile_everything()
    server = subprocess.Popen(
        [sys.executable, "-m", "vocalis.server", "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"VOCALIS_JOBS_DIRECTORY": folder, "VOCALIS_WORKERS": str(workers)},
    )
    try:
        url = printed_address(server)
        with httpx.Client(base_url=f"{url}/api/v1", timeout=60) as client:
            while not client.get("/health").json()["ready"]:
                time.sleep(0.1)
            yield client, server
    finally:
        server.kill()
        server.wait()


def through_jobs(body: dict, workers: int, rounds: int = 1) -> dict:
    """Time of a sweep as a job, with all workers already running.

    Seconds: median and minimum of ``rounds``. CPU seconds of the server process and of its workers: means.
    """
    with tempfile.TemporaryDirectory(prefix="vocalis-sweeps-") as folder, served(folder, workers) as (client, server):
        start_workers(client)
        worker_pids = children(server.pid)
        server_before, workers_before = processor_s(server.pid), sum(map(processor_s, worker_pids))
        seconds = [to_table(client, body, k) for k in range(rounds)]
        server_s = (processor_s(server.pid) - server_before) / rounds
        workers_s = (sum(map(processor_s, worker_pids)) - workers_before) / rounds
    return {
        "seconds": round(median(seconds), 3),
        "quickest_s": round(min(seconds), 3),
        "server_cpu_s": round(server_s, 3),
        "workers_cpu_s": round(workers_s, 3),
        "job_system_share": round(server_s / (server_s + workers_s), 4),
    }


def start_workers(client: httpx.Client, base: dict | None = None, precision: str = "float64") -> None:
    """Start every worker of a server and load the kernels for a ``base`` request, by a small sweep."""
    body = grid(8, 2) | {"base": (base or {}) | {"vowel": "i"}, "precision": precision}
    warm = client.post("/jobs", json=body).json()
    while client.get(f"/jobs/{warm['id']}").json()["finished"] is None:
        time.sleep(0.1)


def to_table(client: httpx.Client, body: dict, nth: int) -> float:
    """Seconds from the request of a sweep to its complete table, which is fetched after the event ``done``.

    Each ``nth`` has its own pressure, so that no point is cached. RuntimeError if the table is incomplete.
    """
    base = body.get("base", {}) | {"subglottal_pressure_pa": PRESSURE_PA + nth * APART_PA}
    began = time.perf_counter()
    job = client.post("/jobs", json=body | {"base": base}).json()
    with client.stream("GET", f"/jobs/{job['id']}/events") as stream:
        for line in stream.iter_lines():
            if line == "event: done":
                break
    table = client.get(f"/jobs/{job['id']}/result").json()
    took = time.perf_counter() - began
    if table["n_done"] != table["n_total"] or table["n_failed"]:
        raise RuntimeError(f"{table['n_done']} of {table['n_total']} points, {table['n_failed']} without an answer")
    return took


def children(pid: int) -> list[int]:
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(word) for word in listed.split()]


def processor_s(pid: int) -> float:
    """User and system time of a process so far, without its children."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_mb(pid: int) -> float:
    """Resident memory of a process and its children, MB."""
    total = 0
    for one in (pid, *children(pid)):
        try:
            total += int(Path(f"/proc/{one}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        except FileNotFoundError:
            continue
    return total / MB


def measure_map(rounds: int) -> dict:
    """The map of two muscles; with all workers it is repeated ``rounds`` times."""
    body, cores = grid(21, 21), os.cpu_count() or 1
    sweep = sweep_from_dict(body)
    compile_everything()
    began = time.perf_counter()
    run_sweep(sweep, workers=1)
    alone = time.perf_counter() - began
    one, every = through_jobs(body, 1), through_jobs(body, cores, rounds)
    single = through_jobs(body | {"precision": "float32"}, cores, rounds)
    fold, pressure_pa = prepare(sweep.base).fold, sweep.base.subglottal_pressure_pa
    plain_s = len(sweep) / cores * interleaved({"plain": lambda: plain_run(fold, pressure_pa, 1.0)}, 3)["plain"]
    return {
        "points": len(sweep),
        "plain_loop_s": round(plain_s, 1),
        "plain_loop_over_map": round(plain_s / every["seconds"], 1),
        "plain_loop_over_map_float32": round(plain_s / single["seconds"], 1),
        "one_core_without_jobs_s": round(alone, 3),
        "one_worker": one,
        "all_workers": every | {"workers": cores},
        "all_workers_float32": single | {"workers": cores},
        "speed_up_over_one_core": round(alone / every["seconds"], 3),
    }


def measure_large(points: int = 100) -> dict:
    """``points`` × ``points`` runs, with a kill -9 half-way."""
    import xarray

    body, most = grid(points, points), 0.0
    with tempfile.TemporaryDirectory(prefix="vocalis-sweeps-") as folder:
        seconds, halves = 0.0, []
        for wanted in (points * points // 2, points * points):
            with served(folder, os.cpu_count() or 1) as (client, server):
                began = time.perf_counter()
                job = client.post("/jobs", json=body).json()
                halves.append(job["n_done"])
                while (now := client.get(f"/jobs/{job['id']}").json())["n_done"] < wanted:
                    most = max(most, resident_mb(server.pid))
                    time.sleep(LOOK_EVERY_S)
                seconds += time.perf_counter() - began
                if wanted == points * points:
                    while client.get(f"/jobs/{job['id']}").json()["finished"] is None:
                        time.sleep(0.05)
                    path = Path(folder) / "sweep.nc"
                    path.write_bytes(client.get(f"/jobs/{job['id']}/result.nc").content)
        with xarray.open_dataset(path) as opened:
            found = int(opened.fo_hz.count())
            sizes = dict(opened.sizes)
        disk = sum(file.stat().st_size for file in Path(folder).glob("jobs.sqlite*")) / MB
    return {
        "points": now["n_total"],
        "failed": now["n_failed"],
        "seconds": round(seconds, 1),
        "done_at_restart": halves[1],
        "memory_most_mb": round(most, 1),
        "database_mb": round(disk, 1),
        "opened_by_xarray": {"sizes": sizes, "points_with_pitch": found},
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["map", "large"], nargs="?", default="map")
    parser.add_argument("--rounds", type=int, default=5, help="maps in each precision with all workers")
    options = parser.parse_args()
    print(json.dumps(measure_map(options.rounds) if options.what == "map" else measure_large(), indent=2))


if __name__ == "__main__":
    main()
