"""Who may come in: addresses, tokens, origins."""

import httpx
import pytest

from tests.server.live_server import SHORT, run, serving
from vocalis.server.http.access import access_for, host_name, is_loopback

TOKEN = "a token of this test"
BEARER = {"Authorization": f"Bearer {TOKEN}"}


@pytest.fixture(scope="module")
def closed():
    with serving(token=TOKEN) as server:
        yield server


def test_on_this_machine_no_token_is_needed(live):
    with live.client() as client:
        assert client.get("/jobs").status_code == 200


@pytest.mark.parametrize("path", ["/parameters", "/jobs", "/events", "/openapi.json", "/jobs/x/arrays/time_s"])
def test_with_a_token_the_api_asks_for_it(closed, path):
    with closed.client() as client:
        answer = client.get(path)
        assert answer.status_code == 401 and answer.headers["www-authenticate"] == "Bearer"
        assert answer.headers["content-type"] == "application/problem+json"
        assert client.get(path, headers={"Authorization": "Bearer wrong"}).status_code == 401
        assert client.post("/posture", json={}).status_code == 401


def test_a_script_shows_the_token_as_bearer(closed):
    with closed.client(**BEARER) as client:
        assert client.get("/jobs").status_code == 200
        assert client.post("/posture", json={}).status_code == 200


def test_health_stays_open(closed):
    with closed.client() as client:
        assert client.get("/health").json()["status"] == "ok"


def test_the_page_and_its_files_ask_for_the_token_too(closed):
    page = httpx.get(closed.url, headers={"Accept": "text/html"})
    assert page.status_code == 303 and page.headers["location"] == "/login"
    shared = httpx.get(f"{closed.url}/?activation.ct=0.5&vowel=i", headers={"Accept": "text/html"})
    assert shared.headers["location"] == "/login?activation.ct=0.5&vowel=i", "a shared link keeps its voice"
    for path in ("/", "/main.js", "/vendor/plotly.min.js"):
        assert httpx.get(closed.url + path).status_code == 401
    for path in ("/login", "/login.js", "/login.css"):
        assert httpx.get(closed.url + path).status_code == 200


def test_signing_in_gives_a_cookie_that_scripts_cannot_read_and_that_is_not_the_token(closed):
    with closed.client() as client:
        assert client.post("/session", json={"token": "wrong"}).status_code == 401
        assert not client.cookies
        answer = client.post("/session", json={"token": TOKEN})
        assert answer.status_code == 200
        for cookie in answer.headers.get_list("set-cookie"):
            assert "httponly" in cookie.lower() and "samesite=strict" in cookie.lower()
            assert TOKEN not in cookie
        assert client.get("/jobs").status_code == 200
        client.cookies.set("vocalis_session", "0" * 64)
    with closed.client() as stranger:
        stranger.cookies.set("vocalis_session", "0" * 64)
        assert stranger.get("/jobs").status_code == 401


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8000", "127.0.0.1.evil.example", "10.1.2.3", ""])
def test_a_name_that_is_not_this_servers_is_refused(live, host):
    with live.client(Host=host) as client:
        for path in ("/health", "/parameters"):
            answer = client.get(path)
            assert answer.status_code == 421 and answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("host", ["localhost", "localhost:1234", "127.0.0.1", "[::1]:8000", "LOCALHOST"])
def test_names_of_this_machine_are_taken(live, host):
    with live.client(Host=host) as client:
        assert client.get("/health").status_code == 200


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1"])
def test_another_sites_page_can_change_nothing(live, origin):
    with live.client(Origin=origin) as client:
        for answer in (client.post("/jobs", json=SHORT), client.delete("/jobs/x"), client.post("/session", json={})):
            assert answer.status_code == 403 and answer.headers["content-type"] == "application/problem+json"


def test_this_servers_own_page_can(live):
    with live.client(Origin=live.url) as client:
        assert client.post("/posture", json={}).status_code == 200


def test_no_answer_is_shared_with_other_sites(live):
    with live.client(Origin="https://evil.example") as client:
        answer = client.get("/parameters")
        assert "access-control-allow-origin" not in answer.headers
        assert answer.headers["cross-origin-resource-policy"] == "same-origin"


def test_a_public_address_has_a_token_even_when_none_was_given():
    public = access_for("0.0.0.0", None)
    assert public.token and len(public.token) >= 32
    assert access_for("0.0.0.0", None).token != public.token
    assert access_for("127.0.0.1", None).token is None
    assert access_for("192.168.1.7", "given").token == "given"


def test_a_public_server_takes_addresses_and_its_own_names_only():
    public = access_for("0.0.0.0", None, allowed_hosts=("voice.example:443",))
    for host in ("192.168.1.7:8000", "[fe80::1]:8000", "localhost", "Voice.Example"):
        assert public.knows_host(host), host
    for host in ("evil.example", "", "1.2.3.4.evil.example"):
        assert not public.knows_host(host), host


@pytest.mark.parametrize("header, name", [("A.b:80", "a.b"), ("[::1]:80", "::1"), ("::1", "::1"), ("x", "x"), ("", "")])
def test_the_name_in_a_host_header(header, name):
    assert host_name(header) == name


def test_only_addresses_of_this_machine_are_loopback():
    assert is_loopback("127.0.0.1") and is_loopback("::1") and is_loopback("localhost") and is_loopback("127.8.8.8")
    assert not is_loopback("0.0.0.0") and not is_loopback("192.168.1.1") and not is_loopback("example.org")


def test_scripts_that_show_nothing_are_one_client_and_a_browser_is_its_cookie(live):
    with live.client() as script, live.client() as other, live.client() as browser:
        job = run(script, SHORT | {"fresh": True})
        browser.cookies.set("vocalis_client", "a browser's own")
        listed = [made["id"] for made in other.get("/jobs").json()["jobs"]]
        assert job["id"] in listed
        assert browser.get("/jobs").json()["jobs"] == []
        assert browser.get(f"/jobs/{job['id']}").status_code == 200, "the id is enough"
