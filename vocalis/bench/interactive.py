"""Response time of the calls behind the page, on an idle server and while jobs keep every worker process busy.

``python -m vocalis.bench.interactive`` starts its own server and prints one row per call. No request is repeated, so
none is answered from a cache.
"""

import argparse
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import httpx
import numpy as np

from vocalis.server.warmup.compile import compile_everything

CALLS = 100
RUN_S = 0.5
BUSY_S = 60.0  # simulated; at the paper's step about half a minute of work each
PAPER_STEP_S = 1.7857142857142857e-6
READY_WITHIN_S = 180
#: 95th percentile allowed for a call, ms, with or without jobs.
POSTURE_MS, RUN_MS = 20.0, 60.0
SECOND_MS = 40.0  # 1 s of voice on an idle machine


@contextmanager
def server_process(**environment: str) -> Iterator[tuple[str, subprocess.Popen]]:
    """Address and process of a new server that is ready, with all kernels compiled."""
    compile_everything()
    process = subprocess.Popen(
        [sys.executable, "-m", "vocalis.server", "--port", "0"],
        env=os.environ | {"VOCALIS_WARM_WORKERS": "0"} | environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        address = printed_address(process)
        deadline = time.monotonic() + READY_WITHIN_S
        while not httpx.get(f"{address}/api/v1/health", timeout=60).json()["ready"]:
            if time.monotonic() > deadline:
                raise TimeoutError(f"the kernels were not compiled within {READY_WITHIN_S} s")
            time.sleep(0.1)
        yield address, process
    finally:
        process.terminate()
        process.wait(20)


def printed_address(process: subprocess.Popen) -> str:
    """The address that a server prints first. RuntimeError if its first line has none."""
    line = process.stdout.readline() if process.stdout else ""
    found = re.search(r"https?://[^\s/#]+", line)
    if found is None:
        raise RuntimeError(f"the server printed no address: {line!r}")
    return found[0]


@contextmanager
def server() -> Iterator[httpx.Client]:
    """A client of a new server process."""
    with server_process() as (address, _), httpx.Client(base_url=f"{address}/api/v1", timeout=60) as client:
        yield client


def posture(client: httpx.Client, ct: float) -> httpx.Response:
    return client.post("/posture", json={"activation": {"ct": ct}})


def run(client: httpx.Client, ct: float, duration_s: float = RUN_S) -> httpx.Response:
    """A run of ``duration_s`` with all its arrays."""
    body = {"activation": {"ct": ct}, "run": {"duration_s": duration_s}}
    return client.post("/simulate", json=body, headers={"Accept": "application/octet-stream"})


def milliseconds(call: Callable, client: httpx.Client, offset: float, calls: int = CALLS) -> np.ndarray:
    """Milliseconds of each of ``calls`` calls, measured at the client."""
    times = []
    for k in range(calls):
        began = time.perf_counter()
        call(client, offset + k / (2 * calls)).raise_for_status()
        times.append(1e3 * (time.perf_counter() - began))
    return np.array(times)


@contextmanager
def busy(client: httpx.Client) -> Iterator[int]:
    """Start as many long jobs as the server has workers; dismiss them at the end."""
    workers = client.get("/health").json()["engine"]["workers"]
    request = {"run": {"duration_s": BUSY_S, "time_step_s": PAPER_STEP_S}}
    jobs = [client.post("/jobs", json=request | {"subglottal_pressure_pa": 900 + k}).json() for k in range(workers)]
    while any(client.get(f"/jobs/{job['id']}").json()["progress"] == 0 for job in jobs):
        time.sleep(0.1)
    yield workers
    for job in jobs:
        client.delete(f"/jobs/{job['id']}")


def report(name: str, times: np.ndarray, wanted_ms: float) -> bool:
    p50, p95 = np.percentile(times, [50, 95])
    print(f"{name:38} p50 {p50:6.1f}  p95 {p95:6.1f}  max {times.max():6.1f}  wanted p95 < {wanted_ms:g}", flush=True)
    return p95 < wanted_ms


def main() -> int:
    """0 if every call stays within its bound."""
    argparse.ArgumentParser(prog="python -m vocalis.bench.interactive", description=__doc__).parse_args()
    with server() as client:
        posture(client, 0.3), run(client, 0.3)
        kept = [
            report("posture", milliseconds(posture, client, 0.001), POSTURE_MS),
            report("0.5 s, all arrays", milliseconds(run, client, 0.001), RUN_MS),
            report("1 s, all arrays", milliseconds(partial(run, duration_s=1.0), client, 0.001), SECOND_MS),
        ]
        with busy(client) as jobs:
            kept += [
                report(f"posture, {jobs} job(s) running", milliseconds(posture, client, 0.002), POSTURE_MS),
                report(f"0.5 s, all arrays, {jobs} job(s) running", milliseconds(run, client, 0.002), RUN_MS),
            ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
