"""Checks of every request before any route: host, origin, token, size; and the headers of every answer."""

from urllib.parse import urlsplit

from starlette.datastructures import MutableHeaders
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from vocalis.server.addresses import API
from vocalis.server.exceptions import BodyTooLarge, NotAuthorised, Refused, WrongHost, WrongOrigin
from vocalis.server.http.access import Access
from vocalis.server.http.errors import answer

SAFE_METHODS = ("GET", "HEAD", "OPTIONS")
LOGIN = "/login"
#: Paths that need no token: health, and signing in.
OPEN_PATHS = (f"{API}/health", f"{API}/session", LOGIN, f"{LOGIN}.js", f"{LOGIN}.css")

HEADERS = {
    # Plotly sets style attributes; scripts come from files of this server only.
    "Content-Security-Policy": "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; media-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'self'; "
    "frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


class Guard:
    """The outermost layer of the application."""

    def __init__(self, app: ASGIApp, access: Access, body_bytes: int):
        self._app, self._access, self._body_bytes = app, access, body_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        connection = HTTPConnection(scope)
        dressed = _with_headers(scope, send)
        try:
            self._check(connection)
        except Refused as error:
            refusal = _refusal(connection, error)
            await (refusal(scope, receive, dressed) if refusal else send({"type": "websocket.close", "code": 1008}))
            return
        await self._app(scope, self._counted(receive), dressed)

    def _check(self, connection: HTTPConnection) -> None:
        headers, path = connection.headers, connection.url.path
        host = headers.get("host", "")
        if not self._access.knows_host(host):
            raise WrongHost(f"This server is not {host!r}; add the name to VOCALIS_ALLOWED_HOSTS if it should be.")
        origin = headers.get("origin")
        if changes_something(connection) and origin is not None and urlsplit(origin).netloc.lower() != host.lower():
            raise WrongOrigin(f"A page of {origin} may not change anything here.")
        if path not in OPEN_PATHS and not self._access.admits(connection):
            raise NotAuthorised("Send the token as 'Authorization: Bearer …', or sign in on the page.")
        length = headers.get("content-length", "0")
        if length.isdecimal() and int(length) > self._body_bytes:
            raise BodyTooLarge(self._too_large())

    def _counted(self, receive: Receive) -> Receive:
        seen = 0

        async def counting() -> Message:
            nonlocal seen
            message = await receive()
            seen += len(message.get("body", b"")) if message["type"] == "http.request" else 0
            if seen > self._body_bytes:
                raise HTTPException(413, self._too_large())
            return message

        return counting

    def _too_large(self) -> str:
        return f"The body may have {self._body_bytes} bytes (VOCALIS_BODY_BYTES)."


def changes_something(connection: HTTPConnection) -> bool:
    """Whether a request may change something; a WebSocket may."""
    return connection.scope["type"] == "websocket" or connection.scope["method"] not in SAFE_METHODS


def _refusal(connection: HTTPConnection, error: Refused) -> Response | None:
    if connection.scope["type"] == "websocket":
        return None
    wants_page = "text/html" in connection.headers.get("accept", "")
    if isinstance(error, NotAuthorised) and wants_page and not changes_something(connection):
        # The query is the voice of a shared link; /login passes it on to the page only.
        query = connection.url.query if connection.url.path == "/" else ""
        return RedirectResponse(f"{LOGIN}?{query}" if query else LOGIN, 303)
    return answer(error)


def _with_headers(scope: Scope, send: Send) -> Send:
    is_api = scope["path"].startswith(f"{API}/")

    async def dressed(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in HEADERS.items():
                headers.setdefault(name, value)
            if is_api:
                headers["Cache-Control"] = "no-store"
            else:
                headers.setdefault("Cache-Control", "no-cache")
        await send(message)

    return dressed
