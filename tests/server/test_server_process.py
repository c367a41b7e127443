"""The server as a process: its greeting, its token, its end."""

import os
import re
import signal
import socket
import ssl
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from threading import Thread

import httpx
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.server.live_client import Received
from tests.server.live_server import LONG, events, run, wait_until


@contextmanager
def started(*options: str, **environment: str):
    """A server process and the lines it has printed so far."""
    process = subprocess.Popen(
        [sys.executable, "-m", "vocalis.server", "--port", "0", *options],
        env=os.environ | environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    lines: list[str] = []
    reader = Thread(target=lambda: lines.extend(process.stdout))
    reader.start()
    try:
        wait_until(lambda: any(line.startswith("Vocalis: ") for line in lines) or process.poll() is not None, 60)
        yield process, lines
    finally:
        process.kill()
        process.wait()
        reader.join()


def address(lines: list[str]) -> str:
    return re.match(r"Vocalis: (\S+)", lines[0]).group(1)


@pytest.mark.alone
@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_it_says_once_where_it_is_and_stops_within_two_seconds_with_work_streams_and_a_voice(stop, tmp_path):
    with started(VOCALIS_JOBS_DIRECTORY=str(tmp_path)) as (process, lines), ExitStack() as here:
        with httpx.Client(base_url=f"{address(lines)}/api/v1", timeout=60) as client:
            wait_until(lambda: client.get("/health").json()["ready"], 120)
            job = run(client, LONG)
            wait_until(lambda: client.get(f"/jobs/{job['id']}").json()["progress"] > 0)
            stream = events(client, "/events")
            next(stream)
            playing = here.enter_context(connect(f"{address(lines).replace('http', 'ws')}/api/v1/live"))
            received = Received(playing).listen(0.1)
            asked = time.monotonic()
            process.send_signal(stop)
            assert process.wait(10) in (0, -stop)
            assert time.monotonic() - asked < 2
        with pytest.raises(ConnectionClosed) as closed:
            received.listen(2)
        assert closed.value.rcvd.code == 1012
        assert [line.startswith("Vocalis: http://127.0.0.1:") for line in lines] == [True], lines


def test_a_public_address_prints_a_token_once_and_asks_for_it():
    with started("--host", "0.0.0.0") as (_, lines):
        wait_until(lambda: len(lines) >= 4)
        text = "".join(lines)
        token = re.search(r"shown once: (\S+)", text).group(1)
        assert f"/login#{token}" in text and "not encrypted" in text
        url = address(lines).replace("0.0.0.0", "127.0.0.1")
        assert httpx.get(f"{url}/api/v1/measures").status_code == 401
        assert httpx.get(f"{url}/api/v1/measures", headers={"Authorization": f"Bearer {token}"}).status_code == 200


def test_a_token_of_ones_own_is_not_printed():
    with started("--token", "known to its owner") as (_, lines):
        assert httpx.get(f"{address(lines)}/api/v1/measures").status_code == 401
        assert "known to its owner" not in "".join(lines)


def test_a_port_in_use_is_one_clear_line():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        ended = subprocess.run(
            [sys.executable, "-m", "vocalis.server", "--port", port], capture_output=True, text=True, timeout=60
        )
    assert ended.returncode != 0
    assert re.fullmatch(rf"vocalis: cannot listen on 127\.0\.0\.1:{port}: .+\n", ended.stderr)


@pytest.mark.parametrize(
    "options, variables, message",
    [
        ([], {"VOCALIS_PORT": "eighty"}, "VOCALIS_PORT: 'eighty' cannot be used"),
        (["--tls-cert", "/nowhere/cert.pem", "--tls-key", "/nowhere/key.pem"], {}, "certificate and its key"),
        (["--tls-cert", "/nowhere/cert.pem"], {}, "tls_cert and tls_key go together"),
    ],
)
def test_settings_that_cannot_be_used_are_one_clear_line(options, variables, message):
    command = [sys.executable, "-m", "vocalis.server", "--port", "0", *options]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, env=os.environ | variables)
    assert ended.returncode != 0
    assert message in ended.stderr and ended.stderr.startswith("vocalis: ") and ended.stderr.count("\n") == 1


def test_with_a_certificate_it_speaks_https(tmp_path):
    key, certificate = tmp_path / "key.pem", tmp_path / "cert.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", certificate,
         "-days", "1", "-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1"],
        check=True, capture_output=True,
    )  # fmt: skip
    with started("--tls-cert", str(certificate), "--tls-key", str(key)) as (_, lines):
        assert address(lines).startswith("https://")
        trusted = ssl.create_default_context(cafile=str(certificate))
        answer = httpx.get(f"{address(lines)}/api/v1/health", verify=trusted)
        assert answer.json()["status"] == "ok"
        live = f"{address(lines).replace('https', 'wss')}/api/v1/live"
        with connect(
            live, ssl=trusted, open_timeout=60
        ) as playing:  # the server copies the bytes: only it can read them
            received = Received(playing).listen(0.3)
        assert received.sequence == list(range(len(received.sequence))) and len(received.sequence) > 20
