"""Many clients on one server while a sweep runs: errors, memory and response time of postures.

``python -m vocalis.bench.serving [--clients 100] [--seconds 300]`` prints the figures as JSON. Each client requests one
posture per second. It fails on a status other than 200 or 429, if memory grows by more than 10 % after the first fifth
of the time, or if the 95th percentile is 100 ms or more.
"""

import argparse
import asyncio
import json
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter

import httpx

from vocalis.bench.interactive import printed_address

SWEEP = {
    "kind": "sweep",
    "axes": [
        {"parameter": "activation.ct", "values": [k / 199 for k in range(200)]},
        {"parameter": "activation.ta", "values": [k / 199 for k in range(200)]},
    ],
}
MOST_GROWTH = 0.10
MOST_P95_S = 0.100
SETTLED = 0.2  # fraction of the time after which caches are full
LOOK_EVERY_S = 1.0
MB = 2**20


async def _client(client: httpx.AsyncClient, number: int, until: float, answers: Counter, seconds: list[float]) -> None:
    chance = random.Random(number)
    await asyncio.sleep(chance.random())  # so that the clients do not start at the same time
    turn = time.monotonic()
    while time.monotonic() < until:
        body = {"activation": {muscle: chance.random() for muscle in ("ta", "ct", "lca", "ia")}}
        began = time.monotonic()
        answer = await client.post("/posture", json=body, headers={"Authorization": f"Bearer client-{number}"})
        if answer.status_code == 200:
            seconds.append(time.monotonic() - began)
        answers[answer.status_code] += 1
        turn += 1.0
        await asyncio.sleep(max(0.0, turn - time.monotonic()))


async def _memory(pid: int, until: float, resident: list[float]) -> None:
    while time.monotonic() < until:
        with open(f"/proc/{pid}/statm") as file:
            resident.append(int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / MB)
        await asyncio.sleep(LOOK_EVERY_S)


async def _measure(url: str, pid: int, clients: int, seconds: float) -> dict:
    answers: Counter[int] = Counter()
    delays: list[float] = []
    resident: list[float] = []
    # Close idle connections before the server does, after 5 s.
    limits = httpx.Limits(max_connections=clients, max_keepalive_connections=clients, keepalive_expiry=3)
    async with httpx.AsyncClient(base_url=f"{url}/api/v1", limits=limits, timeout=30) as client:
        while not (await client.get("/health")).json()["ready"]:
            await asyncio.sleep(0.1)
        sweep = (await client.post("/jobs", json=SWEEP)).json()
        until = time.monotonic() + seconds
        requesting = [_client(client, number, until, answers, delays) for number in range(clients)]
        await asyncio.gather(_memory(pid, until, resident), *requesting)
        done = (await client.get(f"/jobs/{sweep['id']}")).json()
        await client.delete(f"/jobs/{sweep['id']}")
    delays.sort()
    settled = resident[int(len(resident) * SETTLED)]
    return {
        "clients": clients,
        "seconds": seconds,
        "answers": {str(status): count for status, count in sorted(answers.items())},
        "errors": sum(count for status, count in answers.items() if status not in (200, 429)),
        "posture_p50_ms": round(1e3 * delays[len(delays) // 2], 1),
        "posture_p95_ms": round(1e3 * delays[int(len(delays) * 0.95)], 1),
        "posture_max_ms": round(1e3 * delays[-1], 1),
        "memory_settled_mb": round(settled, 1),
        "memory_end_mb": round(resident[-1], 1),
        "memory_growth": round(resident[-1] / settled - 1, 4),
        "sweep_points_done": done["n_done"],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=300)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="vocalis-serving-") as folder:
        server = subprocess.Popen(
            [sys.executable, "-m", "vocalis.server", "--port", "0"],
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | {"VOCALIS_JOBS_DIRECTORY": folder},
        )
        try:
            url = printed_address(server)
            found = asyncio.run(_measure(url, server.pid, options.clients, options.seconds))
        finally:
            server.kill()
            server.wait()
    print(json.dumps(found, indent=2))
    good = found["errors"] == 0 and found["memory_growth"] <= MOST_GROWTH and found["posture_p95_ms"] < 1e3 * MOST_P95_S
    sys.exit(not good)


if __name__ == "__main__":
    main()
