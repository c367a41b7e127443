"""What played voices cost and whether they ever stop: share of a core, dips of the sound that waits, memory.

``python -m vocalis.bench.live [--voices 8] [--seconds 20]`` starts a server of its own and prints figures as JSON:
one voice at rest, one whose muscles move all the time, as many moving as ``--voices``, and one voice too many. Each
client plays as the page does: it has WANTED_S of sound waiting and says how much there was at least. ``--minutes 30``
plays the many voices that long, a new one for each that has sounded VISIT_S, and watches memory.

It fails when a voice takes more than MOST_SHARE of a core, when a sound has a gap, when one voice too many is not told
so, and when memory grows by more than MOST_GROWTH after the first fifth of the time.
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
HAND_S = 1 / 60  # between two movements
SETTLE_S = 2.0  # of a voice, not counted: its onset, and the server's first words
VISIT_S = 60.0
REST_S = 0.5  # between two visits: the server has noticed by then that the first is over
MOST_SHARE = 0.06
MOST_GROWTH = 0.10
SETTLED = 0.2  # of the time: caches are filled by then
MB = 2**20


@dataclass
class Heard:
    """What the clients of a stretch have found."""

    blocks: int = 0
    gaps: int = 0
    sent_away: int = 0
    dips_s: list[float] = field(default_factory=list)  # the least that waited, report by report


async def play(url: str, seconds: float, moving: bool, heard: Heard) -> None:
    """One client: takes sound for a while, moves muscles or not, and counts what it would have missed."""
    async with connect(f"{url.replace('http', 'ws')}/api/v1/live", max_size=None, compression=None) as socket:
        began = time.monotonic()
        report: dict[str, float] = {}  # rides on the next movement, as the page's does
        moves = asyncio.create_task(_move(socket, report)) if moving else None
        ends_s, low_s, reported = 0.0, math.inf, began  # when the sound that has come will have been played
        try:
            while (now := time.monotonic()) < began + seconds:
                frame = await asyncio.wait_for(socket.recv(), 10)
                if isinstance(frame, str):
                    continue
                now = time.monotonic()
                low_s = min(low_s, ends_s - now)
                counted = now > began + SETTLE_S
                heard.blocks += counted
                if ends_s < now:
                    heard.gaps += counted
                    ends_s = now + WANTED_S
                ends_s += BLOCK_S
                if now > reported + REPORT_S:
                    if counted:
                        heard.dips_s.append(low_s)
                    report |= {"buffer_ms": max(0.0, 1e3 * low_s), "wanted_buffer_ms": 1e3 * WANTED_S}
                    if not moving:
                        await socket.send(json.dumps(report))
                    low_s, reported = math.inf, now
        finally:
            if moves:
                moves.cancel()


async def _move(socket, report: dict[str, float]) -> None:
    """A hand that never rests, on two muscles."""
    began = time.monotonic()
    while True:
        phase = 2 * math.pi * 0.7 * (time.monotonic() - began)
        activation = {"ct": round(0.5 + 0.4 * math.sin(phase), 3), "ta": round(0.4 - 0.3 * math.sin(phase), 3)}
        await socket.send(json.dumps({"activation": activation} | report))
        report.clear()
        await asyncio.sleep(HAND_S)


def processes(pid: int) -> list[int]:
    """A process and all below it."""
    children = [
        child for task in Path(f"/proc/{pid}/task").iterdir() for child in (task / "children").read_text().split()
    ]
    return [pid, *(below for child in children for below in processes(int(child)))]


def cpu_s(pid: int) -> float:
    """Processor time of a process and all below it."""
    ticks = 0
    for one in processes(pid):
        fields = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def resident_mb(pid: int) -> float:
    pages = sum(int(Path(f"/proc/{one}/statm").read_text().split()[1]) for one in processes(pid))
    return pages * os.sysconf("SC_PAGE_SIZE") / MB


async def stretch(url: str, pid: int, voices: int, moving: bool, seconds: float) -> dict:
    """Some voices for a while: their share of a core each, server and all, and the sound they had waiting."""
    heard = Heard()
    playing = [asyncio.create_task(play(url, seconds + SETTLE_S, moving, heard)) for _ in range(voices)]
    await asyncio.sleep(SETTLE_S)
    before, began = cpu_s(pid), time.monotonic()
    await asyncio.sleep(seconds - 0.5)
    used, took = cpu_s(pid) - before, time.monotonic() - began
    await asyncio.gather(*playing)
    return {
        "voices": voices,
        "moving": moving,
        "share_of_a_core_each": round(used / took / voices, 4),
        "blocks": heard.blocks,
        "gaps": heard.gaps,
        "least_waiting_ms": round(1e3 * min(heard.dips_s), 1),
    }


async def one_too_many(url: str, voices: int) -> dict:
    """What the next client is told while ``voices`` play, and whether they go on."""
    heard = Heard()
    playing = [asyncio.create_task(play(url, SETTLE_S + 2, False, heard)) for _ in range(voices)]
    await asyncio.sleep(SETTLE_S)
    async with connect(f"{url.replace('http', 'ws')}/api/v1/live") as socket:
        said = json.loads(await asyncio.wait_for(socket.recv(), 10))
    await asyncio.gather(*playing)
    return {"status": said["problem"]["status"], "detail": said["problem"]["detail"], "gaps": heard.gaps}


async def soak(url: str, pid: int, voices: int, minutes: float) -> dict:
    """Voices that come and go for minutes; memory of the server and of the process that plays."""
    heard, resident = Heard(), []
    until = time.monotonic() + 60 * minutes

    async def visits(number: int) -> None:
        await asyncio.sleep(number * VISIT_S / voices / 4)
        while (left := until - time.monotonic()) > SETTLE_S:
            try:
                await play(url, min(VISIT_S, left), number % 2 == 0, heard)
            except ConnectionClosed:  # this process was not given the time to take its sound
                heard.sent_away += 1
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
        "blocks": heard.blocks,
        "gaps": heard.gaps,
        "sent_away": heard.sent_away,
        "memory_settled_mb": round(settled, 1),
        "memory_end_mb": round(resident[-1], 1),
        "memory_growth": round(resident[-1] / settled - 1, 4),
    }


@contextmanager
def server(voices: int) -> Iterator[tuple[str, int]]:
    """Address and process of a server that takes so many voices."""
    with server_process(VOCALIS_LIVE_VOICES=str(voices)) as (address, process):
        yield address, process.pid


async def _all(url: str, pid: int, options: argparse.Namespace) -> dict:
    await play(url, SETTLE_S, True, Heard())  # the process of the voices starts with the first one
    if options.minutes:
        return {"soak": await soak(url, pid, options.voices, options.minutes)}
    return {
        "one_at_rest": await stretch(url, pid, 1, False, options.seconds),
        "one_moving": await stretch(url, pid, 1, True, options.seconds),
        "many_moving": await stretch(url, pid, options.voices, True, options.seconds),
        "one_too_many": await one_too_many(url, options.voices),
    }


def kept(found: dict) -> bool:
    """Whether every promise was kept."""
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
    """0 when every promise was kept."""
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
