"""Access control: names of this server, tokens, cookies, and the client that a request belongs to.

A client is identified by the first of these that a request has:

- a bearer token (``Authorization: Bearer …``): scripts; on a server without a token any value names a client;
- the anonymous cookie ``vocalis_client``, random, HttpOnly, set in a browser together with the page;
- nothing: all scripts on this machine that send neither are one client.

GET /jobs and GET /events list the jobs of one client. The address of a job needs only its id, which is random and
cannot be guessed.
"""

import hashlib
import hmac
import ipaddress
import secrets
import socket
from collections.abc import Iterable
from dataclasses import dataclass

from starlette.requests import HTTPConnection
from starlette.responses import Response

CLIENT_COOKIE = "vocalis_client"
SESSION_COOKIE = "vocalis_session"
CLIENT_AGE_S = 365 * 86400
SESSION_AGE_S = 30 * 86400


@dataclass(frozen=True, slots=True)
class Access:
    """``token`` None: no token is needed. ``names``: host names a browser may use. ``any_address``: any literal
    address is accepted too (no other site can give it a name, so it needs no list).
    """

    token: str | None
    names: frozenset[str]
    any_address: bool
    secure: bool = False

    def knows_host(self, header: str) -> bool:
        """Whether a Host header names this server: a name that is not on the list may be another site's trick."""
        name = host_name(header)
        return name in self.names or (self.any_address and is_address(name))

    def admits(self, connection: HTTPConnection) -> bool:
        """Whether a request has the token, or the session cookie."""
        if self.token is None:
            return True
        given = bearer(connection)
        if given is not None:
            return self.is_token(given)
        return _same(connection.cookies.get(SESSION_COOKIE, ""), self._session())

    def is_token(self, given: str) -> bool:
        return self.token is not None and _same(given, self.token)

    def open_session(self, response: Response) -> None:
        """Set the session cookie, which replaces the token. It does not contain the token."""
        response.set_cookie(
            SESSION_COOKIE, self._session(), SESSION_AGE_S, httponly=True, samesite="strict", secure=self.secure
        )

    def identify(self, connection: HTTPConnection, response: Response) -> None:
        """Set the cookie that makes a browser a client, unless it has one."""
        if CLIENT_COOKIE not in connection.cookies:
            response.set_cookie(
                CLIENT_COOKIE, secrets.token_urlsafe(18), CLIENT_AGE_S,
                httponly=True, samesite="strict", secure=self.secure,
            )  # fmt: skip

    def _session(self) -> str:
        return hmac.new((self.token or "").encode(), b"vocalis session", hashlib.sha256).hexdigest()


def access_for(host: str, token: str | None, allowed_hosts: Iterable[str] = (), secure: bool = False) -> Access:
    """The rules for a server bound to ``host``; for a public host a token is generated when none is given."""
    names = {"localhost", *(host_name(name) for name in allowed_hosts)}
    if is_loopback(host):
        return Access(token, frozenset(names | {"127.0.0.1", "::1", host}), False, secure)
    names |= {host, socket.gethostname().lower(), socket.getfqdn().lower()}
    return Access(token or secrets.token_urlsafe(24), frozenset(names), True, secure)


async def client_of(connection: HTTPConnection) -> str:
    """The name of the client a request belongs to; see the module."""
    given = bearer(connection)
    if given is not None:
        return "token:" + _digest(given)
    if (cookie := connection.cookies.get(CLIENT_COOKIE)) is not None:
        return "cookie:" + _digest(cookie)
    return "local"


def bearer(connection: HTTPConnection) -> str | None:
    """The bearer token of a request, None when it has none."""
    scheme, _, value = connection.headers.get("authorization", "").partition(" ")
    return value.strip() if scheme.lower() == "bearer" and value.strip() else None


def host_name(header: str) -> str:
    """``example.org`` of ``Example.org:8000``, ``::1`` of ``[::1]:8000``."""
    name = header.strip().lower()
    if name.startswith("["):
        return name[1:].partition("]")[0]
    return name if name.count(":") > 1 else name.partition(":")[0]


def is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach a host."""
    return host == "localhost" or (is_address(host) and ipaddress.ip_address(host).is_loopback)


def _same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode())


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
