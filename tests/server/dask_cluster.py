"""A real Dask scheduler and real worker processes, for tests."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread

from tests.server.live_server import wait_until

_SCHEDULER = """
import asyncio
from distributed import Scheduler
async def main():
    async with Scheduler(host="127.0.0.1", port=0, dashboard_address=None, dashboard=False) as scheduler:
        print("at", scheduler.address, flush=True)
        await scheduler.finished()
asyncio.run(main())
"""
_WORKER = """
import asyncio, sys
from distributed import Worker
{before}
async def main():
    async with Worker(sys.argv[1], nthreads=1, dashboard=False, local_directory=sys.argv[2]) as worker:
        await worker.finished()
asyncio.run(main())
"""


@contextmanager
def scheduler() -> Iterator[str]:
    """A scheduler; its address."""
    process = subprocess.Popen([sys.executable, "-c", _SCHEDULER], stdout=subprocess.PIPE, text=True)
    lines: list[str] = []
    reader = Thread(target=lambda: lines.extend(process.stdout))
    reader.start()
    try:
        wait_until(lambda: lines, 30)
        yield re.match(r"at (\S+)", lines[0]).group(1)
    finally:
        process.kill()
        process.wait()
        reader.join()


@contextmanager
def workers(address: str, folder, count: int, before: str = "") -> Iterator[list[subprocess.Popen]]:
    """Worker processes of one thread each; ``before`` is run in each before it begins."""
    code = _WORKER.format(before=before)
    command = [sys.executable, "-c", code, address, str(folder)]
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    processes = [subprocess.Popen(command, env=environment) for _ in range(count)]
    try:
        yield processes
    finally:
        for process in processes:
            process.kill()
            process.wait()
