"""What a finished job gives, against the same run in Python."""

import csv
import io
import wave

import numpy as np
import pytest
import xarray

import vfcore
from tests.server.live_server import finish, run
from vfcore.runs.result import ARRAYS, OF_TWO_WALLS
from vfcore.spec.request import resolve

VOICED = {"run": {"duration_s": 0.4}}
SILENT = {"subglottal_pressure_pa": 0, "run": {"duration_s": 0.1}}


@pytest.fixture(scope="module")
def python_result():
    return vfcore.simulate(resolve(VOICED))


@pytest.fixture(scope="module")
def job(live):
    with live.client() as client:
        yield finish(client, run(client, VOICED | {"fresh": True}))


def floats(answer) -> np.ndarray:
    shape = [int(length) for length in answer.headers["x-shape"].split(",")]
    return np.frombuffer(answer.content, "<f4").reshape(shape)


@pytest.mark.parametrize("name", [name for name in ARRAYS if name not in OF_TWO_WALLS])
def test_arrays_are_those_of_the_python_run(client, job, python_result, name):
    answer = client.get(f"/jobs/{job['id']}/arrays/{name}")
    assert answer.headers["content-type"] == "application/octet-stream"
    np.testing.assert_array_equal(floats(answer), python_result.arrays[name].astype(np.float32))
    assert answer.headers["x-dims"] == ",".join(ARRAYS[name].dims)
    assert answer.headers["x-unit"] == ARRAYS[name].unit


def test_a_part_of_an_array_is_start_stop_stride_on_the_first_axis(client, job, python_result):
    answer = client.get(f"/jobs/{job['id']}/arrays/glottal_flow_m3_s?start=100&stop=5000&stride=7")
    expected = python_result.arrays["glottal_flow_m3_s"][100:5000:7].astype(np.float32)
    np.testing.assert_array_equal(floats(answer), expected)
    rate = python_result.provenance.sample_rate_hz
    assert float(answer.headers["x-sample-rate-hz"]) == pytest.approx(rate / 7, rel=1e-12)
    answer = client.get(f"/jobs/{job['id']}/arrays/cycle_w_m?start=99")
    assert answer.headers["x-shape"] == "1,20,10"


@pytest.mark.parametrize("query, path", [("stop=999999", "stop"), ("start=9&stop=5", "start"), ("stride=0", "stride")])
def test_a_part_that_is_not_there_is_refused_not_shortened(client, job, query, path):
    answer = client.get(f"/jobs/{job['id']}/arrays/time_s?{query}")
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["path"] == path


def test_an_unknown_array_is_refused_with_the_names_there_are(client, job):
    answer = client.get(f"/jobs/{job['id']}/arrays/loudness")
    assert answer.status_code == 422 and "glottal_area_m2" in answer.json()["errors"][0]["allowed"]


def sound(answer) -> np.ndarray:
    with wave.open(io.BytesIO(answer.content)) as file:
        assert (file.getframerate(), file.getsampwidth(), file.getnchannels()) == (48000, 2, 1)
        return np.frombuffer(file.readframes(file.getnframes()), "<i2") / 32767


def test_sound_peaks_at_minus_3_dbfs_and_says_its_gain(client, job, python_result):
    answer = client.get(f"/jobs/{job['id']}/audio.wav")
    assert answer.headers["content-type"] == "audio/wav"
    received = sound(answer)
    assert len(received) == pytest.approx(0.4 * 48000, abs=2)
    assert 20 * np.log10(np.abs(received).max()) == pytest.approx(-3, abs=0.01)
    peak_pa = np.abs(received).max() / float(answer.headers["x-gain"])
    pressure = python_result.arrays["radiated_pressure_pa"]
    assert peak_pa == pytest.approx(np.abs(pressure - pressure.mean()).max(), rel=0.1)


def test_sound_that_is_not_normalised_keeps_levels_comparable(client, job):
    gain = float(client.get(f"/jobs/{job['id']}/audio.wav?normalize=false").headers["x-gain"])
    assert gain == pytest.approx(1 / 6325, rel=1e-3)


def test_no_phonation_is_silence(client):
    made = finish(client, run(client, SILENT))
    answer = client.get(f"/jobs/{made['id']}/audio.wav")
    assert float(answer.headers["x-gain"]) == 0 and not sound(answer).any()
    result = client.get(f"/jobs/{made['id']}/result").json()
    assert result["phonation_state"] == "none"
    assert result["measures"]["fo_hz"]["value"] is None and result["measures"]["fo_hz"]["reason"]


def test_the_netcdf_file_reads_back_with_units(client, job, python_result, tmp_path):
    answer = client.get(f"/jobs/{job['id']}/result.nc")
    path = tmp_path / "result.nc"
    path.write_bytes(answer.content)
    with xarray.open_dataset(path, engine="h5netcdf", decode_times=False) as data:
        assert data["glottal_flow_m3_s"].attrs["units"] == "m3 s-1"
        np.testing.assert_array_equal(data["cycle_w_m"], python_result.arrays["cycle_w_m"])
        assert data.attrs["phonation_state"] == "periodic"


def test_the_csv_file_has_every_measure(client, job, python_result):
    rows = {row["key"]: row for row in csv.DictReader(io.StringIO(client.get(f"/jobs/{job['id']}/result.csv").text))}
    assert set(vfcore.CATALOGUE.keys()) <= set(rows)
    assert float(rows["fo_hz"]["value"]) == python_result.report.measures["fo_hz"].value


def test_a_synchronous_run_is_reachable_by_its_id_as_a_job_is(client, python_result):
    made = client.post("/simulate", json=VOICED).json()
    answer = client.get(made["links"]["array"].replace("{name}", "cycle_w_m").removeprefix("/api/v1"))
    np.testing.assert_array_equal(floats(answer), python_result.arrays["cycle_w_m"].astype(np.float32))
    for link in ("audio", "netcdf", "csv", "result"):
        assert client.get(made["links"][link].removeprefix("/api/v1")).status_code == 200
    assert client.get(f"/jobs/{made['id']}").json()["status"] == "successful"
