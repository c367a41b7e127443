"""The page and its files: static files, Plotly's bundle from the installed package, the login page."""

import gzip
import mimetypes
import stat
from functools import lru_cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from fastapi import APIRouter, FastAPI, HTTPException, Request, Response
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles
from starlette.datastructures import Headers
from starlette.routing import Match, Mount
from starlette.types import Scope

from vocalis.server.addresses import API
from vocalis.server.http.guard import LOGIN
from vocalis.server.services import Shared

router = APIRouter(include_in_schema=False)
DAY_S, YEAR_S = 86_400, 365 * 86_400
LOGIN_FILES = Path(__file__).parent.parent / "login"


def page_directory() -> Path:
    """The folder of the page's files."""
    return Path(str(files("vocalis.frontend")))


@router.api_route("/", methods=["GET", "HEAD"])
def index(request: Request, shared: Shared) -> Response:
    """The page; sets the cookie that makes the browser a client."""
    path = page_directory() / "index.html"
    if not path.is_file():
        raise HTTPException(404, "The files of the page are not installed; the API is there.")
    response = FileResponse(path)
    shared.access.identify(request, response)
    return response


@router.get(LOGIN)
@router.get(f"{LOGIN}.{{ending}}")
def login(ending: str = "html") -> Response:
    """The page that asks for the token."""
    if ending not in ("html", "js", "css"):
        raise HTTPException(404)
    return FileResponse(LOGIN_FILES / f"login.{ending}")


@router.api_route("/vendor/plotly.min.js", methods=["GET", "HEAD"])
def plotly(request: Request) -> Response:
    """Plotly's bundle: kept by browsers for a day, or for a year when requested by its version (``?v=``)."""
    installed = version("plotly")
    age = f"max-age={YEAR_S}, immutable" if request.query_params.get("v") == installed else f"max-age={DAY_S}"
    etag = f'W/"plotly-{installed}"'
    headers = {"ETag": etag, "Cache-Control": f"private, {age}", "Vary": "Accept-Encoding"}
    if etag in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    compressed = "gzip" in request.headers.get("accept-encoding", "")
    if compressed:
        headers["Content-Encoding"] = "gzip"
    return Response(_plotly(compressed), headers=headers, media_type="text/javascript")


@lru_cache(maxsize=2)
def _plotly(compressed: bool) -> bytes:
    content = files("plotly").joinpath("package_data/plotly.min.js").read_bytes()
    return gzip.compress(content, 6) if compressed else content


class Kept(NamedTuple):
    """A file of the page, ready to be sent: read and compressed once, until it changes."""

    etag: str
    media_type: str
    plain: bytes
    compressed: bytes


@lru_cache(maxsize=512)
def _kept(path: str, changed_ns: int, size: int) -> Kept:
    plain = Path(path).read_bytes()
    media_type = mimetypes.guess_type(path)[0] or "application/octet-stream"
    return Kept(f'W/"{changed_ns:x}-{size:x}"', media_type, plain, gzip.compress(plain, 6))


class PageFiles(StaticFiles):
    """The folder without its Python files.

    A page requests about a hundred small files at once: they are sent from memory, already compressed, and without
    a thread.
    """

    async def get_response(self, path: str, scope: Scope) -> Response:
        full, status = self.lookup_path(path)
        if status is None or not stat.S_ISREG(status.st_mode) or scope["method"] not in ("GET", "HEAD"):
            return await super().get_response(path, scope)
        kept = _kept(full, status.st_mtime_ns, status.st_size)
        requested = Headers(scope=scope)
        headers = {"ETag": kept.etag, "Vary": "Accept-Encoding"}
        if kept.etag in requested.get("if-none-match", ""):
            return Response(status_code=304, headers=headers)
        packs = "gzip" in requested.get("accept-encoding", "") and len(kept.compressed) < len(kept.plain)
        if packs:
            headers["Content-Encoding"] = "gzip"
        return Response(kept.compressed if packs else kept.plain, headers=headers, media_type=kept.media_type)

    def lookup_path(self, path: str):
        return ("", None) if path.endswith((".py", ".pyc")) else super().lookup_path(path)


class OutsideApi(Mount):
    """Leaves out the paths of the API, so that a wrong method there is 405 and not a missing file."""

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        return (Match.NONE, {}) if scope["path"].startswith(f"{API}/") else super().matches(scope)


def install(app: FastAPI) -> None:
    """Serve the page; to be called after all other routes are installed."""
    app.include_router(router)
    app.router.routes.append(OutsideApi("/", PageFiles(directory=page_directory()), name="page"))
