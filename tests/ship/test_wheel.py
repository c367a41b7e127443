"""The wheel, installed in an empty environment, serves the page; Windows users start it in the same way."""

import json
import os
import shutil
import subprocess
import sys
import time
import urllib.request
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
READY_WITHIN_S = 240  # kernels are compiled from nothing, beside other tests
SWEPT_WITHIN_S = 60


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    """Built from a copy, so that no build folder is left in the project."""
    source, out = tmp_path_factory.mktemp("source") / "vocalis", tmp_path_factory.mktemp("dist")
    ignored = shutil.ignore_patterns(
        ".git", ".venv", "build", "*.egg-info", "__pycache__", "tests", "out", ".*_cache", "node_modules"
    )
    shutil.copytree(ROOT, source, ignore=ignored)
    subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(out), str(source)], check=True
    )
    return next(out.glob("vocalis-*.whl"))


def test_the_wheel_holds_page_and_data_in_two_packages(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    assert "vocalis/frontend/index.html" in names
    assert "vocalis/frontend/vendor/preact.js" in names
    assert "vfcore/spec/data/story2008_area_functions.json" in names
    top = {name.split("/")[0] for name in names if not name.split("/")[0].endswith(".dist-info")}
    assert top == {"vfcore", "vocalis"}
    assert "vocalis/server/login/login.html" in names
    assert {"vfcore/py.typed", "vocalis/py.typed"} <= set(names)


@pytest.mark.first
def test_the_wheel_in_an_empty_environment_serves_the_page(wheel, tmp_path):
    environment = tmp_path / "env"
    subprocess.run([sys.executable, "-m", "venv", str(environment)], check=True)
    bin_folder = environment / ("Scripts" if os.name == "nt" else "bin")
    subprocess.run([bin_folder / "python", "-m", "pip", "install", "--quiet", "--no-compile", str(wheel)], check=True)
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "NUMBA", "VOCALIS"))}
    server = subprocess.Popen(
        [bin_folder / "vocalis", "serve", "--port", "0"],
        cwd=tmp_path,
        env=clean | {"VOCALIS_DATA": str(tmp_path / "data"), "PYTHONUNBUFFERED": "1", "VOCALIS_COMPILE_FORMS": "false"},
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        address = server.stdout.readline().split()[1].rstrip("/")
        page = urllib.request.urlopen(address + "/", timeout=20).read().decode()
        assert "Vocalis" in page
        assert urllib.request.urlopen(address + "/vendor/plotly.min.js", timeout=20).status == 200
        _wait_until_ready(address)
        request = urllib.request.Request(
            address + "/api/v1/simulate",
            data=json.dumps({"kind": "simulation", "run": {"duration_s": 0.5}}).encode(),
            headers={"Content-Type": "application/json"},
        )
        result = json.load(urllib.request.urlopen(request, timeout=60))
        assert result["phonation_state"] == "periodic"
        _the_first_map_compiles_nothing(address, tmp_path / "data" / "kernels")
    finally:
        server.terminate()
        server.wait(timeout=20)


def _the_first_map_compiles_nothing(address: str, kernels: Path) -> None:
    """After the start of the server, the kernels of maps are compiled before the first map is requested."""
    deadline = time.monotonic() + READY_WITHIN_S
    while not list(kernels.rglob("complete")):
        assert time.monotonic() < deadline, "not everything was compiled in time"
        time.sleep(0.5)
    compiled = sorted(kernels.rglob("*.nbc"))
    base = {"kind": "simulation", "run": {"duration_s": 0.1}}
    sweep = {"kind": "sweep", "base": base, "axes": [{"parameter": "activation.ct", "values": [0.2, 0.4]}]}
    body = json.dumps(sweep).encode()
    opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
    request = urllib.request.Request(address + "/api/v1/jobs", data=body, headers={"Content-Type": "application/json"})
    job = json.load(opener.open(request, timeout=20))
    deadline = time.monotonic() + SWEPT_WITHIN_S
    while job["status"] in ("accepted", "running"):
        assert time.monotonic() < deadline, job
        time.sleep(0.1)
        job = json.load(opener.open(f"{address}/api/v1/jobs/{job['id']}", timeout=20))
    assert job["status"] == "successful" and job["n_failed"] == 0
    assert sorted(kernels.rglob("*.nbc")) == compiled


def _wait_until_ready(address: str) -> None:
    deadline = time.monotonic() + READY_WITHIN_S
    while time.monotonic() < deadline:
        health = json.load(urllib.request.urlopen(address + "/api/v1/health", timeout=20))
        if health["ready"]:
            return
        time.sleep(0.5)
    raise AssertionError(f"not ready within {READY_WITHIN_S} s: {health}")
