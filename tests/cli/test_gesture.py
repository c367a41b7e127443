"""`vocalis gesture` as a process: breakpoints as options, contours, consistent files, refusals."""

import csv
import json
import subprocess
import sys
import wave
from pathlib import Path

import numpy as np
import pytest
import xarray

VOCALIS = Path(sys.executable).with_name("vocalis")
GLIDE = ["gesture", "--ct", "0.3:0.1,0.7:0.9", "--duration", "1.0"]


def vocalis(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run([VOCALIS, *arguments], capture_output=True, text=True)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """One glide with every kind of output: the printed document and the folder of its files."""
    folder = tmp_path_factory.mktemp("gesture")
    files = [f"--{kind}={folder / f'glide.{kind}'}" for kind in ("wav", "netcdf", "csv")]
    done = vocalis(*GLIDE, "--json", *files)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout, parse_constant=lambda name: pytest.fail(f"{name} is not JSON")), folder


def test_the_document_holds_contours_and_a_measured_stretch_between_breakpoints(finished):
    document, _ = finished
    contours = {name: contour["values"] for name, contour in document["contours"].items()}
    assert {len(values) for values in contours.values()} == {100}
    assert contours["activation.ct"][0] == 0.1 and contours["activation.ct"][-1] == 0.9
    assert contours["fo_hz"][-1] - contours["fo_hz"][25] == pytest.approx(52, abs=4)
    assert document["contours"]["fo_hz"]["unit"] == "Hz"
    assert [stretch["end_s"] for stretch in document["segments"]] == [0.3, 0.7, 1.0]
    assert document["segments"][-1]["measures"]["fo_hz"]["value"] == pytest.approx(177.7, abs=1)


def test_the_files_hold_the_printed_values(finished):
    document, folder = finished
    with open(folder / "glide.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    printed = document["contours"]["fo_hz"]["values"]
    assert [None if row["fo_hz"] == "" else float(row["fo_hz"]) for row in rows] == printed
    with xarray.open_dataset(folder / "glide.netcdf") as kept:
        assert kept["contour_fo_hz"].attrs["units"] == "Hz"
        assert kept["glottal_area_m2"].size == 28_000
        assert kept["contour_activation_ct"].values[-1] == 0.9
    with wave.open(str(folder / "glide.wav")) as file:
        assert (file.getframerate(), file.getnframes(), file.getnchannels()) == (48_000, 48_000, 1)
        assert np.abs(np.frombuffer(file.readframes(48_000), "<i2")).max() > 20_000


def test_the_printed_gesture_renders_to_the_same_sound(finished, tmp_path):
    document, folder = finished
    request = tmp_path / "recorded.json"
    request.write_text(json.dumps(document["provenance"]["request"]))
    done = vocalis("gesture", "--request", str(request), "--wav", str(tmp_path / "again.wav"))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "again.wav").read_bytes() == (folder / "glide.wav").read_bytes()
    assert "periodic" in done.stdout and "f_o Hz" in done.stdout


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["--ct", "0:0.1,0:0.2"], "activation.ct.1.0"),
        (["--ct", "0:0.1,1:1.5"], "activation.ct.1.1"),
        (["--ct", "0.1:0.2:0.3"], "activation.ct.0.1"),
        (["--wav", "/nowhere/at/all.wav"], "--wav"),
    ],
)
def test_an_invalid_gesture_is_refused_in_one_line_that_names_the_field(arguments, message):
    done = vocalis("gesture", *arguments)
    assert done.returncode != 0 and done.stdout == ""
    assert message in done.stderr and len(done.stderr.strip().splitlines()) == 1
