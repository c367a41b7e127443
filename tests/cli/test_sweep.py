"""`vocalis sweep` as a process: axes, files, resuming, refusals."""

import json
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
import xarray

from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vocalis.cli.axes import axis

README = Path(__file__).parents[2] / "README.md"
SHORT = ("--duration", "0.1")


def vocalis(*arguments, **options) -> subprocess.CompletedProcess:
    command = [sys.executable, "-c", "from vocalis.cli.main import run; run()", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=200, **options)


@pytest.mark.parametrize(
    "text, parameter, values",
    [
        ("activation.ct=0:1:5", "activation.ct", [0, 0.25, 0.5, 0.75, 1]),
        ("activation.ct=0:0.3:4", "activation.ct", [0, 0.1, 0.2, 0.3]),
        ("run.nx=10,20", "run.nx", [10, 20]),
        ("activation.lca,activation.ia=0.5", ["activation.lca", "activation.ia"], [0.5]),
    ],
)
def test_axis_values_are_rounded_as_a_person_would_write_them(text, parameter, values):
    assert axis(text) == {"parameter": parameter, "values": values}


def test_a_sweep_is_printed_as_the_document_of_the_api():
    ended = vocalis("sweep", "--axis", "activation.ct=0.2,0.6", "--ta", "0.3", *SHORT, "--json", "--workers", "1")
    assert ended.returncode == 0, ended.stderr
    body = {
        "base": {"activation": {"ta": 0.3}, "run": {"duration_s": 0.1}},
        "axes": [{"parameter": "activation.ct", "values": [0.2, 0.6]}],
    }
    assert json.loads(ended.stdout) == run_sweep(sweep_from_dict(body), workers=1).document()


def test_a_document_and_a_selection(tmp_path):
    (tmp_path / "points.json").write_text(
        json.dumps(
            {"base": {"run": {"duration_s": 0.1}}, "points": [{"activation.ct": 0.2}, {"run.time_step_s": 1e-3}]}
        )
    )
    ended = vocalis("sweep", "--sweep", "points.json", "--measures", "mean_flow_ml_s", "--csv", "out.csv", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert "1 failed" in ended.stdout and "run.time_step_s" in ended.stdout
    assert (tmp_path / "out.csv").read_text().count("\n") == 3
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.csv", "points.json"], "the journal is gone"


@pytest.mark.parametrize(
    "arguments, message",
    [
        ((), "--axis: is missing"),
        (("--axis", "activation.ct"), "'activation.ct' is not an axis"),
        (("--axis", "activation.ct=0:1"), "is not a range"),
        (("--axis", "activation.ct=0:1:0"), "no valid count"),
        (("--axis", "activation.ct=0:2:3"), "axes.0.values.2: 2 is out of range"),
        (("--axis", "activation.ct=0,x"), "axes.0.values.1: 'x' is not a number"),
        (("--axis", "vowel=1"), "axes.0.parameter"),
        (("--axis", "activation.ct=1", "--measures", "f0"), "measures.0"),
        (("--axis", "activation.ct=1", "--workers", "0"), "--workers: 0 is out of range"),
        (("--axis", "activation.ct=1", "--netcdf", "/nowhere/x.nc"), "--netcdf"),
        (("--sweep", "/nowhere.json"), "--sweep: /nowhere.json"),
        (("--axis", "activation.ct=1", "--scheduler", "tcp://127.0.0.1:9"), "--scheduler: tcp://127.0.0.1:9"),
    ],
)
def test_bad_input_is_one_clear_line_and_exit_code_2(arguments, message):
    ended = vocalis("sweep", *arguments)
    assert ended.returncode == 2
    assert message in ended.stderr and ended.stderr.startswith("vocalis: ") and ended.stderr.count("\n") == 1, (
        ended.stderr
    )


def test_a_killed_sweep_resumes(tmp_path):
    arguments = (
        "sweep",
        "--axis",
        "activation.ct=0:1:120",
        "--duration",
        "0.4",
        "--netcdf",
        "map.nc",
        "--workers",
        "1",
    )
    command = [sys.executable, "-c", "from vocalis.cli.main import run; run()", *arguments]
    running = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL)
    journal = tmp_path / "map.nc.journal"
    deadline = time.monotonic() + 100
    while kept(journal) == 0:
        assert time.monotonic() < deadline and running.poll() is None
        time.sleep(0.05)
    running.kill()
    running.wait()
    before = kept(journal)
    assert 0 < before < 120 and not (tmp_path / "map.nc").exists()
    ended = vocalis(*arguments, cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert not journal.exists()
    with xarray.open_dataset(tmp_path / "map.nc") as opened:
        assert opened.attrs["points_done"] == 120
        assert (opened.phonation_state != "pending").all()


def kept(journal: Path) -> int:
    import sqlite3

    try:
        with sqlite3.connect(f"file:{journal}?mode=ro", uri=True) as file:
            return file.execute("SELECT count(*) FROM points").fetchone()[0]
    except sqlite3.Error:
        return 0


def test_the_map_of_the_readme_opens_in_xarray(tmp_path):
    found = re.search(r"^ *\.venv/bin/vocalis (sweep .+)$", README.read_text(), re.MULTILINE)
    assert found is not None
    command = found[1].replace(":21", ":3").split()
    assert vocalis(*command, "--duration", "0.3", cwd=tmp_path).returncode == 0
    with xarray.open_dataset(tmp_path / command[-1]) as dataset:
        pitch = dataset.fo_hz.load()
    assert pitch.dims == ("activation_ct", "activation_ta") and pitch.shape == (3, 3)
    assert pitch.attrs["units"] == "Hz" and 50 < float(pitch.max()) < 500
