"""`vocalis simulate` as a process: the same numbers as in Python, consistent files, fast help."""

import csv
import json
import os
import pty
import subprocess
import sys
import threading
import time
import wave
from pathlib import Path

import numpy as np
import pytest
import xarray

from vfcore.io.result_document import result_document
from vfcore.runs.one import simulate
from vfcore.spec.simulation import Activation, Run, Simulation

VOCALIS = Path(sys.executable).with_name("vocalis")
REQUEST = Simulation(activation=Activation(ct=0.5, ta=0.3), vowel="i", run=Run(duration_s=0.6))
ARGUMENTS = ["simulate", "--ct", "0.5", "--ta", "0.3", "--vowel", "i", "--duration", "0.6"]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """One real run with every kind of output: the process and the folder of its files."""
    folder = tmp_path_factory.mktemp("simulate")
    files = [f"--{kind}={folder / f'voice.{kind}'}" for kind in ("wav", "netcdf", "csv")]
    done = subprocess.run([VOCALIS, *ARGUMENTS, "--json", *files], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done, folder


@pytest.fixture(scope="module")
def result():
    return simulate(REQUEST)


def leaves(value, path=""):
    """The plain values of a document by their path."""
    if isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(item, f"{path}.{key}")
    else:
        yield path, value


def test_json_is_the_answer_of_the_python_api(finished, result):
    """To rounding: two processes that compile at the same time may order sums differently."""
    printed = json.loads(finished[0].stdout, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))
    expected = json.loads(json.dumps(result_document(result)))
    for document in (printed, expected):
        for key in ("created", "kernel_seconds"):
            assert document["provenance"].pop(key)
        assert 0 < document["posture"].pop("residual") < 1e-12
    printed, expected = dict(leaves(printed)), dict(leaves(expected))
    assert printed.keys() == expected.keys()
    for path, value in expected.items():
        if isinstance(value, float):
            assert printed[path] == pytest.approx(value, rel=1e-9, abs=1e-15), path
        else:
            assert printed[path] == value, path
    assert printed[".phonation_state"] == "periodic"


def test_only_the_files_are_reported_with_json(finished):
    assert [line.split()[0] for line in finished[0].stderr.splitlines() if line.startswith("wrote")] == ["wrote"] * 3
    assert "compiling" not in finished[0].stderr and "\x1b" not in finished[0].stderr


def test_the_sound_has_the_reported_pitch(finished):
    """From the autocorrelation of the written samples, not from the area that vfcore measures."""
    with wave.open(str(finished[1] / "voice.wav")) as file:
        assert (file.getframerate(), file.getsampwidth(), file.getnchannels()) == (48000, 2, 1)
        samples = np.frombuffer(file.readframes(file.getnframes()), dtype="<i2").astype(float)
    assert len(samples) == pytest.approx(0.6 * 48000, abs=2)
    assert np.abs(samples).max() == pytest.approx(32767 * 10 ** (-3 / 20), abs=2)
    steady = samples[len(samples) // 2 :] - samples[len(samples) // 2 :].mean()
    correlation = np.fft.irfft(np.abs(np.fft.rfft(steady, 2 * len(steady))) ** 2)[: len(steady) // 2]
    correlation /= np.arange(len(steady), len(steady) - len(correlation), -1)
    period = 48000 // 400 + int(np.argmax(correlation[48000 // 400 : 48000 // 70]))
    left, peak, right = correlation[period - 1 : period + 2]
    period += 0.5 * (left - right) / (left - 2 * peak + right)
    reported = json.loads(finished[0].stdout)["measures"]["fo_hz"]["value"]
    assert 48000 / period == pytest.approx(reported, rel=5e-3)


def test_the_files_hold_the_values_of_the_json(finished):
    measures = json.loads(finished[0].stdout)["measures"]
    with xarray.open_dataset(finished[1] / "voice.netcdf", engine="h5netcdf") as stored:
        in_netcdf = {key: float(stored[f"measure_{key}"]) for key in measures}
        assert stored["glottal_flow_m3_s"].attrs["units"] == "m3 s-1" and stored.sizes["time"] == 16800
    with (finished[1] / "voice.csv").open(newline="") as file:
        in_csv = {row["key"]: row["value"] for row in csv.DictReader(file)}
    for key, measure in measures.items():
        if measure["value"] is None:
            assert np.isnan(in_netcdf[key]) and in_csv[key] == ""
        else:
            assert in_netcdf[key] == float(in_csv[key]) == measure["value"]


def read_all(terminal: int, seen: bytearray) -> None:
    """Read until the other end is closed."""
    while True:
        try:
            block = os.read(terminal, 65536)
        except OSError:  # Linux: closed
            return
        if not block:
            return
        seen += block


def test_a_terminal_shows_compilation_and_the_run():
    reader, terminal = pty.openpty()
    environment = os.environ | {"TERM": "xterm", "COLUMNS": "100"}
    process = subprocess.Popen(
        [VOCALIS, "simulate", "--duration", "5"], stdout=subprocess.PIPE, stderr=terminal, env=environment, text=True
    )
    os.close(terminal)
    seen = bytearray()
    # A terminal must be read, or the writer blocks.
    watching = threading.Thread(target=read_all, args=(reader, seen), daemon=True)
    watching.start()
    table, _ = process.communicate(timeout=120)
    watching.join()
    os.close(reader)
    assert process.returncode == 0
    assert b"compiling kernels" in seen and b"simulating 5 s" in seen
    assert "fundamental frequency" in table and "Hz" in table and "cmH" in table


def test_help_comes_at_once():
    seconds = []
    for _ in range(3):
        began = time.perf_counter()
        done = subprocess.run([VOCALIS, "--help"], capture_output=True, text=True)
        seconds.append(time.perf_counter() - began)
    assert done.returncode == 0 and "thyroarytenoid" in done.stdout
    assert min(seconds) < 1.5


@pytest.mark.parametrize("arguments", [["--help"], ["posture"], ["posture", "--json"], ["posture", "--constants"]])
def test_a_closed_pipe_gives_no_traceback(arguments):
    reader, writer = os.pipe()
    os.close(reader)
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    done = subprocess.run([VOCALIS, *arguments], stdout=writer, stderr=subprocess.PIPE, text=True, env=buffered)
    os.close(writer)
    assert done.stderr == "" and done.returncode in (0, 1)


def test_error_bars_come_on_request_in_table_json_and_csv(tmp_path):
    arguments = [VOCALIS, "simulate", "--duration", "0.3", "--error-estimate"]
    table = subprocess.run([*arguments, f"--csv={tmp_path / 'm.csv'}"], capture_output=True, text=True)
    assert table.returncode == 0 and "± grid error" in table.stdout and "20 × 10, 29 × 15, 39 × 19" in table.stdout
    document = json.loads(subprocess.run([*arguments, "--json"], capture_output=True, text=True).stdout)
    bars = document["error_estimate"]["measures"]
    with open(tmp_path / "m.csv", encoding="utf-8", newline="") as file:
        rows = {row["key"]: row for row in csv.DictReader(file)}
    assert float(rows["fo_hz"]["error_half_width"]) == bars["fo_hz"]["half_width"] > 0.0
    assert rows["jitter_percent"]["error_reason"] == bars["jitter_percent"]["reason"]
    plain = subprocess.run([*arguments[:-1], "--no-error-estimate"], capture_output=True, text=True)
    assert plain.returncode == 0 and "± grid error" not in plain.stdout
