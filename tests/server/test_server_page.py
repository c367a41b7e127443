"""How the page's files are served."""

import gzip
from importlib.metadata import version
from importlib.resources import files

import httpx
import pytest

PLOTLY = "/vendor/plotly.min.js"


@pytest.fixture(scope="module")
def http(live):
    with httpx.Client(base_url=live.url) as client:
        yield client


def test_every_answer_carries_the_safeguards(http):
    for path in ("/", "/api/v1/health", "/nothing", PLOTLY):
        headers = http.get(path).headers
        policy = dict(part.strip().partition(" ")[::2] for part in headers["content-security-policy"].split(";"))
        assert policy["default-src"] == "'self'" and policy["script-src"] == "'self'", path
        assert policy["frame-ancestors"] == "'none'"
        assert headers["x-content-type-options"] == "nosniff" and headers["referrer-policy"] == "no-referrer"


def test_the_page_is_there_and_makes_the_browser_a_client(live):
    with httpx.Client(base_url=live.url) as browser:
        answer = browser.get("/")
        assert answer.status_code == 200 and answer.headers["content-type"].startswith("text/html")
        (cookie,) = answer.headers.get_list("set-cookie")
        assert cookie.startswith("vocalis_client=")
        assert "httponly" in cookie.lower() and "samesite=strict" in cookie.lower()
        assert "set-cookie" not in browser.get("/").headers


def test_files_are_checked_for_changes_and_not_sent_again(http):
    first = http.get("/core/api.js")
    assert first.status_code == 200 and first.headers["content-type"].startswith("text/javascript")
    assert first.headers["cache-control"] == "no-cache"
    assert http.get("/core/api.js", headers={"If-None-Match": first.headers["etag"]}).status_code == 304


def test_the_pages_folder_gives_no_python_and_nothing_outside(http):
    for path in ("/__init__.py", "/../pyproject.toml", "/%2e%2e/pyproject.toml", "/vendor/"):
        assert http.get(path).status_code == 404, path


def test_plotly_comes_from_the_installed_package_compressed_once_and_kept(http):
    plain = http.get(PLOTLY, headers={"Accept-Encoding": "identity"})
    assert plain.content == files("plotly").joinpath("package_data/plotly.min.js").read_bytes()
    with http.stream("GET", PLOTLY, headers={"Accept-Encoding": "gzip"}) as packed:
        raw = b"".join(packed.iter_raw())
    assert packed.headers["content-encoding"] == "gzip" and gzip.decompress(raw) == plain.content
    assert "max-age=86400" in plain.headers["cache-control"]
    assert "immutable" in http.get(f"{PLOTLY}?v={version('plotly')}").headers["cache-control"]
    assert http.get(PLOTLY, headers={"If-None-Match": plain.headers["etag"]}).status_code == 304


def test_text_is_compressed_arrays_are_not_and_the_api_is_not_stored(http):
    parameters = http.get("/api/v1/parameters")
    assert parameters.headers["content-encoding"] == "gzip" and parameters.headers["cache-control"] == "no-store"
    arrays = http.post(
        "/api/v1/simulate", json={"run": {"duration_s": 0.1}}, headers={"Accept": "application/octet-stream"}
    )
    assert "content-encoding" not in arrays.headers
