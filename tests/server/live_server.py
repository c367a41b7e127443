"""A real server in a thread, for tests: uvicorn on a free port, with its services accessible."""

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from tempfile import TemporaryDirectory

import httpx
import uvicorn

from vocalis.server.app import create_app
from vocalis.server.live.handover import HandoverProtocol
from vocalis.server.services import Services
from vocalis.server.settings import Settings

SHORT = {"run": {"duration_s": 0.1}}
#: The paper's step for a minute: over half a minute of work, so that a test can act while it runs.
LONG = {"run": {"duration_s": 60, "time_step_s": 1.7857142857142857e-6}}


@dataclass(frozen=True)
class Live:
    """A running server."""

    url: str
    services: Services

    def client(self, **headers: str) -> httpx.Client:
        """A client with cookies of its own."""
        return httpx.Client(base_url=f"{self.url}/api/v1", headers=headers, timeout=60)


@contextmanager
def serving(**settings) -> Iterator[Live]:
    """Serve with these settings until the block ends; the kernels are compiled when it begins."""
    with TemporaryDirectory(prefix="vocalis-jobs-") as folder:
        yield from _serving(
            create_app(Settings(_env_file=None, **{"jobs_directory": folder, "warm_workers": 0} | settings))
        )


def _serving(app) -> Iterator[Live]:
    config = uvicorn.Config(
        app, host="127.0.0.1", port=0, ws=HandoverProtocol, ws_per_message_deflate=False, log_level="warning",
        timeout_graceful_shutdown=1,
    )  # fmt: skip
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        services: Services = app.state.services
        wait_until(lambda: server.started and services.kernels.ready, seconds=120)
        port = server.servers[0].sockets[0].getsockname()[1]
        yield Live(f"http://127.0.0.1:{port}", services)
    finally:
        app.state.services.events.close()
        server.should_exit = True
        thread.join()


def wait_until(condition, seconds: float = 60) -> None:
    """Return when ``condition()`` holds; fail when it never does."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"still not so after {seconds} s"
        time.sleep(0.02)


def finish(client: httpx.Client, job: dict, seconds: float = 60) -> dict:
    """The job once it is finished, however it ended."""
    wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["finished"] is not None, seconds)
    return client.get(f"/jobs/{job['id']}").json()


def run(client: httpx.Client, body: dict, **headers: str) -> dict:
    """Hand a job in."""
    answer = client.post("/jobs", json=body, headers=headers)
    assert answer.status_code == 202, answer.text
    return answer.json()


@dataclass(frozen=True)
class SentEvent:
    id: str
    name: str
    data: dict


def events(client: httpx.Client, path: str, last_id: str | None = None) -> Iterator[SentEvent]:
    """Events of a stream as they come."""
    headers = {"Last-Event-ID": last_id} if last_id else {}
    with client.stream("GET", path, headers=headers) as answer:
        assert answer.status_code == 200, answer.read()
        assert answer.headers["content-type"].startswith("text/event-stream")
        fields: dict[str, str] = {}
        for line in answer.iter_lines():
            if line:
                name, _, value = line.partition(": ")
                fields[name] = value
            elif "data" in fields:
                yield SentEvent(fields["id"], fields["event"], json.loads(fields["data"]))
                fields = {}
