"""Fixtures: a server process and Chromium. At the end of every visit, the console and foreign requests are checked."""

import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from tests.browser.visit import Visit

sync_api = pytest.importorskip("playwright.sync_api")

ROOT = Path(__file__).resolve().parents[2]
READY_WITHIN_S = 180
CHROMIUM = "/usr/bin/chromium"
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--autoplay-policy=no-user-gesture-required",
]
#: Continuous motion takes half a core, so only tests of the motion enable it.
STILL = {"reduced_motion": "reduce"}
MOVING = {"reduced_motion": "no-preference"}
DESKTOP = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}


def pytest_collection_modifyitems(items):
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


@contextmanager
def server_process(**environment: str) -> Iterator[str]:
    """The address of a server process that is ready to compute."""
    process = subprocess.Popen(
        [sys.executable, "-m", "vocalis.server", "--port", "0"],
        cwd=ROOT,
        env=os.environ | {"PYTHONUNBUFFERED": "1"} | environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        address = re.search(r"https?://[^\s/#]+", process.stdout.readline())[0]
        deadline = time.monotonic() + READY_WITHIN_S
        while not httpx.get(f"{address}/api/v1/health", timeout=10).json()["ready"]:
            assert time.monotonic() < deadline, "the kernels were not compiled in time"
            time.sleep(0.1)
        yield address
    finally:
        process.terminate()
        process.wait(20)


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    with server_process() as address:
        yield address


@pytest.fixture(scope="session")
def launch():
    """``launch(argument, …)`` starts a Chromium with further arguments."""
    path = CHROMIUM if Path(CHROMIUM).exists() else None
    with sync_api.sync_playwright() as playwright:
        yield lambda *further: playwright.chromium.launch(executable_path=path, args=[*ARGUMENTS, *further])


@pytest.fixture(scope="session")
def chromium(launch):
    browser = launch()
    yield browser
    browser.close()


@pytest.fixture
def visit(chromium, server) -> Iterator[Callable[..., Visit]]:
    """``visit(query, viewport=…, …)`` opens the page; at the end, the console must be empty and no other origin may
    have been requested.
    """
    visits = []

    def open_page(
        query: str = "", viewport=DESKTOP, address: str = server, init: str = "", wait: bool = True, **context
    ):
        made = Visit(chromium.new_context(**STILL | {"viewport": viewport} | context), address, init)
        visits.append(made)
        made.open(query)
        if wait:
            made.settle()
        return made

    yield open_page
    for made in visits:
        made.context.close()
    for made in visits:
        assert made.complaints == [], "the console must stay empty"
        assert made.strangers == [], "no other origin may be requested"


@pytest.fixture
def modules(chromium, server):
    """Run a script that imports modules of the page, without the page: ``modules("async () => …", argument)``.

    Each test has modules of its own, whose state no other test has changed.
    """
    page = chromium.new_page()
    page.goto(f"{server}/icon.svg")
    yield page.evaluate
    page.close()
