"""`vocalis serve`: the dashboard and the HTTP API."""

from typing import Annotated

import typer

HELP = """
{summary}

Without a token the server accepts connections from this machine only. --tls-cert and --tls-key switch to HTTPS.

- `vocalis serve` — then open http://127.0.0.1:8000
- `vocalis serve --port 9000`
"""


def serve(
    host: Annotated[str, typer.Option("--host", help="address to listen on")] = "127.0.0.1",
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="port to listen on; 0 takes a free one")] = 8000,
    token: Annotated[str | None, typer.Option("--token", help="password that clients must send")] = None,
    tls_cert: Annotated[str | None, typer.Option("--tls-cert", metavar="FILE", help="certificate, PEM")] = None,
    tls_key: Annotated[str | None, typer.Option("--tls-key", metavar="FILE", help="its private key, PEM")] = None,
) -> None:
    """Serve until interrupted."""
    from vocalis.server.serve import serve as serve_forever

    serve_forever(host, port, token, tls_cert, tls_key)


def register(app: typer.Typer, summary: str) -> None:
    app.command("serve", help=HELP.format(summary=summary))(serve)
