"""A kind of job that is added from outside works everywhere: at the wire, in the workers, on disk, after a restart."""

import ast
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

import vocalis.server
from tests.server.live_server import SHORT, finish, run, wait_until
from tests.server.test_server_process import address
from tests.server.test_server_refusals import problem

SERVER = Path(vocalis.server.__file__).resolve().parent
TEXT = "one two two three"
WORDS = {"kind": "words", "text": TEXT}
#: The toy kind is registered first, as a module of jobs/kinds would be; it stays out of this process.
_SERVE = "import tests.server.toy_kind; from vocalis.server.__main__ import main; main()"


@contextmanager
def serving_words(folder, *, code=_SERVE):
    """A server with the toy kind, in a process of its own; it is killed at the end."""
    environment = os.environ | {"VOCALIS_JOBS_DIRECTORY": str(folder), "VOCALIS_WORKERS": "1"}
    command = [sys.executable, "-c", code, "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
    try:
        lines = [process.stdout.readline()]
        with httpx.Client(base_url=f"{address(lines)}/api/v1", timeout=60) as client:
            yield client
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()


def test_a_new_kind_runs_survives_kill_nine_and_answers(tmp_path):
    with serving_words(tmp_path) as client:
        done = finish(client, run(client, WORDS))
        assert (done["kind"], done["status"], done["progress"], done["n_total"]) == ("words", "successful", 1.0, 1)
        assert set(done["links"]) == {"self", "events", "result", "csv"}
        assert run(client, WORDS | {"text": " ".join(TEXT.split())})["id"] == done["id"], "the same content"
        slow = run(client, WORDS | {"text": "a b c d e f g h", "seconds": 0.2})
        wait_until(lambda: client.get(f"/jobs/{slow['id']}").json()["progress"] > 0)
    with serving_words(tmp_path) as client:
        assert client.get(f"/jobs/{done['id']}").json() == done
        assert client.get(f"/jobs/{done['id']}/result").json() == {"counts": {"one": 1, "two": 2, "three": 1}}
        assert client.get(f"/jobs/{done['id']}/result.csv").text == "one,1\ntwo,2\nthree,1\n"
        assert finish(client, slow)["status"] == "successful"
        listed = client.get("/jobs", params={"kind": "words"}).json()["jobs"]
        assert [job["id"] for job in listed] == [slow["id"], done["id"]]
        assert client.get("/jobs", params={"kind": "simulation"}).json()["jobs"] == []


def test_a_new_kind_is_refused_and_described_like_any_other(tmp_path):
    with serving_words(tmp_path) as client:
        for body, path in (
            (WORDS | {"text": " "}, "text"),
            (WORDS | {"text": "word " * 500}, "text"),
            (WORDS | {"text": 3}, "text"),
            (WORDS | {"colour": 1}, "colour"),
        ):
            assert [error["path"] for error in problem(client.post("/jobs", json=body), 422)["errors"]] == [path]
        job = finish(client, run(client, WORDS))
        for form in ("result.nc", "audio.wav", "arrays/time_s"):
            assert "words" in problem(client.get(f"/jobs/{job['id']}/{form}"), 404)["detail"]
        schemas = client.get("/openapi.json").json()["components"]["schemas"]
        assert {"WordsBody", "WordsAnswer"} <= schemas.keys()
        assert schemas["JobAnswer"]["properties"]["kind"]["enum"] == ["simulation", "sweep", "words"]
        assert finish(client, run(client, SHORT))["status"] == "successful", "the other kinds are untouched"


def test_jobs_of_a_kind_that_the_server_no_longer_knows_are_listed_and_end(tmp_path):
    with serving_words(tmp_path) as client:
        done = finish(client, run(client, WORDS))
        slow = run(client, WORDS | {"text": "a b c d e f g h", "seconds": 5})
        wait_until(lambda: client.get(f"/jobs/{slow['id']}").json()["status"] == "running")
    with serving_words(tmp_path, code="from vocalis.server.__main__ import main; main()") as client:
        listed = client.get("/jobs").json()["jobs"]
        assert [job["id"] for job in listed] == [slow["id"], done["id"]]
        assert listed[0]["status"] == "failed" and "'words'" in listed[0]["problem"]["detail"]
        assert "'words'" in problem(client.get(f"/jobs/{done['id']}/result"), 404)["detail"]


def kind_names_compared(path: Path) -> list[int]:
    """Lines in which something is compared with the name of a kind."""
    names = {"simulation", "sweep"}
    return [
        node.lineno
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Compare)
        and any(isinstance(part, ast.Constant) and part.value in names for part in (node.left, *node.comparators))
    ]


@pytest.mark.parametrize("room", ["jobs", "routes", "http", "schemas"])
def test_no_room_compares_the_kind_of_a_job(room):
    found = {path.name: lines for path in (SERVER / room).rglob("*.py") if (lines := kind_names_compared(path))}
    assert not found
