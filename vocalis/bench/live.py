"""Played voices: CPU share, buffer underruns and memory.

``python -m vocalis.bench.live [--voices 8] [--seconds 20]`` starts its own server and prints figures as JSON: one voice
at rest, one voice whose muscles move all the time, ``--voices`` moving voices, and one voice more than allowed. Each
client plays as the page does: it buffers WANTED_S of sound and reports the minimum of its buffer. ``--minutes 30``
plays ``--voices`` voices for that time, each replaced by a new one after VISIT_S, and records memory.

It fails if a voice takes more than MOST_SHARE of a core, if the sound has a gap, if the voice too many is not refused,
or if memory grows by more than MOST_GROWTH after the first fifth of the time.
"""

import argparse
import asyncio
import json
import math
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from vocalis.bench.interactive import server_process

BLOCK_S = 0.010
WANTED_S = 0.030
REPORT_S = 0.064
MOVE_S = 1 / 60  # between two movements
SETTLE_S = 2.0  # of a voice, not counted: its onset and the first messages
VISIT_S = 60.0
REST_S = 0.5  # between two visits; by then the server has noticed the end of the first
MOST_SHARE = 0.06
MOST_GROWTH = 0.10
SETTLED = 0.2  # fraction of the time after which caches are full
MB = 2**20


@dataclass
class Received:
    """Counts of the clients of a measurement."""

    blocks: int = 0
    gaps: int = 0
    sent_away: int = 0
    low_s: list[float] = field(default_factory=list)  # minimum of the buffer, one per report


async def play(url: str, seconds: float, moving: bool, received: Received) -> None:
    """One client: receives sound for ``seconds``, with or without moving muscles, and counts gaps."""
    async with connect(f"{url.replace('http', 'ws')}/api/v1/live", max_size=None, compression=None) as socket:
        began = time.monotonic()
        report: dict[str, float] = {}  # sent with the next movement, as in the page
        moves = asyncio.create_task(_move(socket, report)) if moving else None
        ends_s, low_s, reported = 0.0, math.inf, began  # ends_s: when the received sound will have been played
        try:
            while (now := time.monotonic()) < began + seconds:
                frame = await asyncio.wait_for(socket.recv(), 10)
                if isinstance(frame, str):
                    continue
                now = time.monotonic()
                low_s = min(low_s, ends_s - now)
                counted = now > began + SETTLE_S
                received.blocks += counted
                if ends_s < now:
                    received.gaps += counted
                    ends_s = now + WANTED_S
                ends_s += BLOCK_S
                if now > reported + REPORT_S:
                    if counted:
                        received.low_s.append(low_s)
                    report |= {"buffer_ms": max(0.0, 1e3 * low_s), "wanted_buffer_ms": 1e3 * WANTED_S}
                    if not moving:
                        await socket.send(json.dumps(report))
                    low_s, reported = math.inf, now
        finally:
            if moves:
                moves.cancel()


async def _move(socket, report: dict[str, float]) -> None:
    """Move two muscles all the time."""
    began = time.monotonic()
    while True:
        phase = 2 * math.pi * 0.7 * (time.monotonic() - began)
        activation = {"ct": round(0.5 + 0.4 * math.sin(phase), 3), "ta": round(0.4 - 0.3 * math.sin(phase), 3)}
        await socket.send(json.dumps({"activation": activation} | report))
        report.clear()
        await asyncio.sleep(MOVE_S)


def processes(pid: int) -> list[int]:
    """A process and all its descendants."""
    children = [
        child for task in Path(f"/proc/{pid}/task").iterdir() for child in (task / "children").read_text().split()
    ]
    return [pid, *(below for child in children for below in processes(int(child)))]


def cpu_s(pid: int) -> float:
    """CPU time of a process and all its descendants."""
    ticks = 0
    for one in processes(pid):
        fields = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def resident_mb(pid: int) -> float:
    pages = sum(int(Path(f"/proc/{one}/statm").read_text().split()[1]) for one in processes(pid))
    return pages * os.sysconf("SC_PAGE_SIZE") / MB


async def measure(url: str, pid: int, voices: int, moving: bool, seconds: float) -> dict:
    """Play some voices: CPU share per voice, including the server, and the minimum of their buffers."""
    received = Received()
    playing = [asyncio.create_task(play(url, seconds + SETTLE_S, moving, received)) for _ in range(voices)]
    await asyncio.sleep(SETTLE_S)
    before, began = cpu_s(pid), time.monotonic()
    await asyncio.sleep(seconds - 0.5)
    used, took = cpu_s(pid) - before, time.monotonic() - began
    await asyncio.gather(*playing)
    return {
        "voices": voices,
        "moving": moving,
        "share_of_a_core_each": round(used / took / voices, 4),
        "blocks": received.blocks,
        "gaps": received.gaps,
        "least_waiting_ms": round(1e3 * min(received.low_s), 1),
    }


async def one_too_many(url: str, voices: int) -> dict:
    """The answer to one more client while ``voices`` play, and the gaps of those that play."""
    received = Received()
    playing = [asyncio.create_task(play(url, SETTLE_S + 2, False, received)) for _ in range(voices)]
    await asyncio.sleep(SETTLE_S)
    async with connect(f"{url.replace('http', 'ws')}/api/v1/live") as socket:
        answer = json.loads(await asyncio.wait_for(socket.recv(), 10))
    await asyncio.gather(*playing)
    return {"status": answer["problem"]["status"], "detail": answer["problem"]["detail"], "gaps": received.gaps}


async def soak(url: str, pid: int, voices: int, minutes: float) -> dict:
    """Voices that come and go for minutes; memory of the server and of the process that plays."""
    received, resident = Received(), []
    until = time.monotonic() + 60 * minutes

    async def visits(number: int) -> None:
        await asyncio.sleep(number * VISIT_S / voices / 4)
        while (left := until - time.monotonic()) > SETTLE_S:
            try:
                await play(url, min(VISIT_S, left), number % 2 == 0, received)
            except ConnectionClosed:  # this process got too little CPU time to receive its sound
                received.sent_away += 1
            await asyncio.sleep(REST_S)

    playing = [asyncio.create_task(visits(number)) for number in range(voices)]
    while time.monotonic() < until:
        resident.append(resident_mb(pid))
        await asyncio.sleep(1.0)
    await asyncio.gather(*playing)
    settled = resident[int(len(resident) * SETTLED)]
    return {
        "minutes": minutes,
        "voices": voices,
        "blocks": received.blocks,
        "gaps": received.gaps,
        "sent_away": received.sent_away,
        "memory_settled_mb": round(settled, 1),
        "memory_end_mb": round(resident[-1], 1),
        "memory_growth": round(resident[-1] / settled - 1, 4),
    }


@contextmanager
def server(voices: int) -> Iterator[tuple[str, int]]:
    """Address and process of a server that allows ``voices`` voices."""
    with server_process(VOCALIS_LIVE_VOICES=str(voices)) as (address, process):
        yield address, process.pid


async def _all(url: str, pid: int, options: argparse.Namespace) -> dict:
    await play(url, SETTLE_S, True, Received())  # starts the process that plays voices
    if options.minutes:
        return {"soak": await soak(url, pid, options.voices, options.minutes)}
    return {
        "one_at_rest": await measure(url, pid, 1, False, options.seconds),
        "one_moving": await measure(url, pid, 1, True, options.seconds),
        "many_moving": await measure(url, pid, options.voices, True, options.seconds),
        "one_too_many": await one_too_many(url, options.voices),
    }


def kept(found: dict) -> bool:
    """True if every limit was kept."""
    if "soak" in found:
        return (
            found["soak"]["memory_growth"] <= MOST_GROWTH and found["soak"]["gaps"] == found["soak"]["sent_away"] == 0
        )
    alone = (found["one_at_rest"], found["one_moving"])
    return (
        all(one["share_of_a_core_each"] <= MOST_SHARE for one in alone)
        and all(one["gaps"] == 0 for one in (*alone, found["many_moving"], found["one_too_many"]))
        and found["one_too_many"]["status"] == 429
    )


def main() -> int:
    """0 if every limit was kept."""
    parser = argparse.ArgumentParser(prog="python -m vocalis.bench.live", description=__doc__)
    parser.add_argument("--voices", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--minutes", type=float, default=0)
    options = parser.parse_args()
    with server(options.voices) as (url, pid):
        found = asyncio.run(_all(url, pid, options))
    print(json.dumps(found, indent=2))
    return 0 if kept(found) else 1


if __name__ == "__main__":
    sys.exit(main())
