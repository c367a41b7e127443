"""Starts the server, prints its address once, stops it cleanly."""

import logging
import os
import socket
import sys
from contextlib import suppress
from typing import Any

import uvicorn
from pydantic import ValidationError
from sqlalchemy.exc import SQLAlchemyError

from vocalis.server.app import create_app
from vocalis.server.exceptions import StorageUnusable
from vocalis.server.http.access import is_loopback
from vocalis.server.live.handover import HandoverProtocol
from vocalis.server.services import Services
from vocalis.server.settings import Settings

#: Python's threads switch after this long (default 5 ms): a posture must not wait for a run's measures.
SWITCH_S = 0.0005
GRACE_S = 1  # for unfinished answers when the server stops


def serve(
    host: str = "127.0.0.1",
    port: int = 8000,
    token: str | None = None,
    tls_cert: str | None = None,
    tls_key: str | None = None,
) -> None:
    """Serve until SIGINT or SIGTERM.

    On an address that others can reach every request needs a token: ``token``, VOCALIS_TOKEN, or a generated one,
    which is printed once. Exits with one line when the address cannot be used.
    """
    given = {"token": token, "tls_cert": tls_cert, "tls_key": tls_key}
    settings = read_settings(
        host=host, port=port, **{name: value for name, value in given.items() if value is not None}
    )
    sys.setswitchinterval(SWITCH_S)
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s: %(message)s")
    listener = _listen(settings.host, settings.port)
    app = create_app(settings)
    try:
        app.state.services.storage.open()
    except (OSError, StorageUnusable, SQLAlchemyError) as error:
        why = getattr(error, "orig", None) or error
        sys.exit(f"vocalis: the folder of jobs cannot be used: {why}; name another one in VOCALIS_JOBS_DIRECTORY")
    config = uvicorn.Config(
        app,
        log_config=None,
        access_log=False,
        server_header=False,
        ws=HandoverProtocol,
        ws_max_size=65_536,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=GRACE_S,
        ssl_certfile=settings.tls_cert,
        ssl_keyfile=settings.tls_key,
    )
    try:
        config.load()
    except OSError as error:  # an SSLError is one too
        sys.exit(f"vocalis: the certificate and its key cannot be used: {error}")
    with suppress(KeyboardInterrupt):  # uvicorn raises the signal again once it has shut down
        _Server(config, app.state.services, _address(settings, listener)).run(sockets=[listener])


def read_settings(**given: Any) -> Settings:
    """The settings in force; exits with one line when a variable cannot be used."""
    try:
        return Settings(**given)
    except ValidationError as error:
        first = error.errors()[0]
        name = "VOCALIS_" + str(first["loc"][0]).upper() if first["loc"] else "settings"
        sys.exit(f"vocalis: {name}: {first['input']!r} cannot be used: {first['msg']}")


class _Server(uvicorn.Server):
    """Prints its address once it answers, and ends event streams before it waits for open connections."""

    def __init__(self, config: uvicorn.Config, services: Services, address: str):
        super().__init__(config)
        self._services, self._address = services, address

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            _greet(self._services, self._address)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._services.events.close()
        await super().shutdown(sockets)


def _greet(services: Services, address: str) -> None:
    print(f"Vocalis: {address} (Ctrl-C stops it)", flush=True)
    if services.storage.folder.number > 1:
        where = services.storage.folder.path
        print(f"Another server runs the jobs of this folder; this one keeps its own in {where}", flush=True)
    settings, token = services.settings, services.access.token
    if token is not None and settings.token is None:
        # After the #, so that no browser sends it and no log keeps it.
        print(f"Every request needs this token, shown once: {token}\nSign in: {address}/login#{token}", flush=True)
    if settings.tls_cert is None and not is_loopback(settings.host):
        print("The connection is not encrypted; --tls-cert and --tls-key make it so.", flush=True)


def _address(settings: Settings, listener: socket.socket) -> str:
    scheme = "https" if settings.tls_cert else "http"
    host = f"[{settings.host}]" if ":" in settings.host else settings.host
    return f"{scheme}://{host}:{listener.getsockname()[1]}"


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family)
    except OSError as error:
        why = os.strerror(error.errno) if error.errno else str(error)
        sys.exit(f"vocalis: cannot listen on {host}:{port}: {why}; try another --port or --host")
