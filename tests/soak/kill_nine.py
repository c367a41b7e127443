"""Repeated kill -9 under load: counts lost jobs, damaged results, and stored points that were computed twice.

``python -m tests.soak.kill_nine --kills 30`` prints the figures as JSON and fails unless all three are 0.
"""

import argparse
import json
import os
import random
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path

import httpx
import numpy as np

import vfcore
from tests.soak.load import Load
from vfcore.io.result_document import result_document
from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vfcore.spec.request import resolve

READY_S = 120
FINISH_S = 300
ROUNDING = 1e-9
UNFINISHED = ("accepted", "running")


@dataclass
class Report:
    kills: int = 0
    workers_killed: int = 0
    accepted: int = 0
    sweeps: int = 0
    dismissed: int = 0
    points: int = 0
    lost: int = 0
    damaged: int = 0
    recomputed: int = 0
    two_jobs_for_one_key: int = 0
    seconds: float = 0.0
    notes: list[str] = field(default_factory=list)

    @property
    def is_clean(self) -> bool:
        return not (self.lost or self.damaged or self.recomputed or self.two_jobs_for_one_key)


class Server:
    """A server process that can be killed and restarted with the same folder and port."""

    def __init__(self, folder: Path):
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.folder = folder
        self.client = httpx.Client(base_url=f"http://127.0.0.1:{self.port}/api/v1", timeout=30)
        self._process: subprocess.Popen | None = None

    def start(self) -> None:
        environment = os.environ | {"VOCALIS_JOBS_DIRECTORY": str(self.folder), "VOCALIS_JOBS_PER_CLIENT": "1000"}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "vocalis.server", "--port", str(self.port)],
            env=environment,
            stdout=subprocess.DEVNULL,
        )
        deadline = time.monotonic() + READY_S
        while not self._is_ready():
            if self._process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError("the server did not start")
            time.sleep(0.05)

    def kill(self) -> None:
        """kill -9; the workers have to notice it."""
        self._process.kill()
        self._process.wait()

    def kill_worker(self) -> bool:
        found = subprocess.run(
            ["ps", "-o", "pid=,args=", "--ppid", str(self._process.pid)], capture_output=True, text=True
        ).stdout
        pids = [int(line.split()[0]) for line in found.splitlines() if "spawn_main" in line]
        with suppress(ProcessLookupError):
            for pid in pids[:1]:
                os.kill(pid, signal.SIGKILL)
        return bool(pids)

    def _is_ready(self) -> bool:
        with suppress(httpx.TransportError):
            return self.client.get("/health").json()["ready"]
        return False


def soak(kills: int, seed: int = 1, seconds: tuple[float, float] = (0.3, 3.0)) -> Report:
    """Kill the server ``kills`` times after random delays, then check jobs and results."""
    report, began, chance = Report(), time.monotonic(), random.Random(seed)
    with tempfile.TemporaryDirectory(prefix="vocalis-soak-") as name:
        server = Server(Path(name) / "jobs")
        server.start()
        try:
            with _loaded(server, seed) as load:
                while report.kills < kills:
                    time.sleep(chance.uniform(*seconds))
                    if chance.random() < 0.25:
                        report.workers_killed += server.kill_worker()
                        continue
                    server.kill()
                    report.kills += 1
                    server.start()
            _judge(report, server, load)
        finally:
            server.kill()
        _count_points(report, server.folder / "jobs.sqlite")
    report.seconds = round(time.monotonic() - began, 1)
    return report


@contextmanager
def _loaded(server: Server, seed: int) -> Iterator[Load]:
    load = Load(server.client, seed)
    load.start()
    try:
        yield load
    finally:
        load.end.set()
        load.join(60)


def _judge(report: Report, server: Server, load: Load) -> None:
    report.accepted, report.two_jobs_for_one_key = len(load.accepted), load.doubled
    for job_id, body in load.accepted.items():
        report.sweeps += body.get("kind") == "sweep"
        answer = server.client.get(f"/jobs/{job_id}")
        deadline = time.monotonic() + FINISH_S
        while answer.status_code == 200 and answer.json()["status"] in UNFINISHED and time.monotonic() < deadline:
            time.sleep(0.1)
            answer = server.client.get(f"/jobs/{job_id}")
        status = answer.json()["status"] if answer.status_code == 200 else answer.status_code
        if status == "dismissed":
            report.dismissed += 1
        elif status != "successful":
            report.lost += 1
            report.notes.append(f"{job_id}: {status} {answer.json().get('problem')}")
        elif not _is_true(server.client.get(f"/jobs/{job_id}/result").json(), body):
            report.damaged += 1
            report.notes.append(f"{job_id}: another result than that of {body}")


_known: dict[str, dict] = {}


def _is_true(result: dict, body: dict) -> bool:
    """Whether a result equals that of the same request computed here."""
    key = json.dumps(body, sort_keys=True)
    if key not in _known:
        if body.get("kind") == "sweep":
            _known[key] = run_sweep(sweep_from_dict(body), workers=2).document()
        else:
            _known[key] = result_document(vfcore.simulate(resolve(body)))
    wanted = _known[key]
    return result["phonation_state"] == wanted["phonation_state"] and all(
        _same(result["measures"][name], measure) for name, measure in wanted["measures"].items()
    )


def _same(one: dict, other: dict) -> bool:
    """Compare to nine digits: newly compiled and cached code round differently."""
    values = [np.array(measure.get("values", measure.get("value")), float) for measure in (one, other)]
    return np.allclose(*values, rtol=ROUNDING, atol=0, equal_nan=True)


def _count_points(report: Report, path: Path) -> None:
    """Counts points that were computed again after they had been stored (``times``); checks the integrity of the
    file.
    """
    with sqlite3.connect(path) as database:
        if database.execute("PRAGMA integrity_check").fetchone() != ("ok",):
            report.damaged += 1
        report.points, report.recomputed = database.execute(
            "SELECT count(*), coalesce(sum(times > 1), 0) FROM points"
        ).fetchone()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    report = soak(options.kills, options.seed)
    print(json.dumps(asdict(report), indent=2))
    sys.exit(not report.is_clean)


if __name__ == "__main__":
    main()
