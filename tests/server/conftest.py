"""One server for all tests that need no settings of their own."""

import secrets

import pytest

from tests.server.live_client import Received, voice
from tests.server.live_server import Live, serving


def pytest_ignore_collect(collection_path, config):
    """What takes long to collect is left out where it would not run."""
    if collection_path.name == "test_server_openapi_bounds.py" and "not slow" in config.option.markexpr:
        return True


@pytest.fixture(scope="session")
def live() -> Live:
    with serving(workers=1) as server:  # what waits and what runs is then known
        yield server


@pytest.fixture
def client(live):
    """A client of its own: no other test sees its jobs."""
    with live.client(Authorization=f"Bearer {secrets.token_hex(8)}") as made:
        yield made


@pytest.fixture(scope="module")
def voice_server():
    """A server for two voices whose process of voices has started."""
    with serving(live_voices=2) as server:
        with voice(server) as first:
            Received(first).listen(0.1)
        yield server
