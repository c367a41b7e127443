"""Two different folds over HTTP: postures, runs in every form of the answer, gestures, refusals by side and field."""

import csv
import io
import json
import struct

import numpy as np
import pytest
import xarray

import vfcore
from tests.server.live_server import finish, run
from vfcore.runs.result import ARRAYS, OF_TWO_WALLS
from vfcore.spec.request import resolve

PALSY = {"right": {"activation": {"ta": 0.1, "lca": 0.5}}, "run": {"duration_s": 0.2}}
MODAL = {"run": {"duration_s": 0.2}}


@pytest.fixture(scope="module")
def python_result():
    return vfcore.simulate(resolve(PALSY))


@pytest.fixture(scope="module")
def job(live):
    with live.client() as client:
        yield finish(client, run(client, PALSY | {"fresh": True}))


def test_a_posture_of_two_folds_has_both(client, python_result):
    answer = client.post("/posture", json={"right": PALSY["right"]}).json()
    for place, side in enumerate(("left", "right")):
        assert answer["sides"][side]["posture"]["strain"] == python_result.postures[place].strain
    assert answer["posture"]["strain"] == python_result.posture.strain
    assert answer["static_shape"] == answer["sides"]["left"]["static_shape"]
    assert "sides" not in client.post("/posture", json={}).json()


def test_an_array_of_one_side_has_the_side_first(client, job, python_result):
    for name, whole in python_result.arrays.items():
        answer = client.get(f"/jobs/{job['id']}/arrays/{name}")
        dims = answer.headers["x-dims"].split(",")
        found = np.frombuffer(answer.content, "<f4").reshape([int(n) for n in answer.headers["x-shape"].split(",")])
        np.testing.assert_array_equal(found, whole.astype(np.float32))
        assert dims == [*(() if len(ARRAYS[name].dims) == whole.ndim else ("side",)), *ARRAYS[name].dims], name
    right = client.get(f"/jobs/{job['id']}/arrays/cycle_wb_m?start=1")
    np.testing.assert_array_equal(
        np.frombuffer(right.content, "<f4").reshape(100, 20), python_result.arrays["cycle_wb_m"][1].astype("<f4")
    )


def test_one_reply_in_bytes_has_every_array_of_both_folds(client, python_result):
    reply = client.post("/simulate", json=PALSY, headers={"Accept": "application/octet-stream"}).content
    (length,) = struct.unpack("<I", reply[:4])
    header, data = json.loads(reply[4 : 4 + length]), reply[4 + length :]
    assert set(header["arrays"]) == set(python_result.arrays) == set(ARRAYS)
    for name, about in header["arrays"].items():
        assert len(about["dims"]) == len(about["shape"])
        found = np.frombuffer(data, "<f4", int(np.prod(about["shape"])), about["offset"]).reshape(about["shape"])
        np.testing.assert_array_equal(found, python_result.arrays[name].astype("<f4"))
    assert header["arrays"]["medial_plane_m"]["dims"] == ["side", "x", "y"]


def test_a_symmetric_voice_has_no_array_of_two_folds(client):
    made = client.post("/simulate", json=MODAL)
    assert not set(OF_TWO_WALLS) & set(made.json()["arrays"]) and "sides" not in made.json()
    for answer, path in (
        (client.get(f"/jobs/{made.json()['id']}/arrays/left_edge_m"), "name"),
        (
            client.post("/simulate?arrays=left_edge_m", json=MODAL, headers={"Accept": "application/octet-stream"}),
            "arrays",
        ),
    ):
        assert answer.status_code == 422
        error = answer.json()["errors"][0]
        assert error["path"] == path and "left_edge_m needs two different folds" in error["message"]
    everything = client.post("/simulate", json=MODAL, headers={"Accept": "application/octet-stream"})
    assert everything.status_code == 200


def test_the_files_of_a_run_of_two_folds(client, job, python_result, tmp_path):
    path = tmp_path / "result.nc"
    path.write_bytes(client.get(f"/jobs/{job['id']}/result.nc").content)
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        np.testing.assert_array_equal(data["cycle_w_m"].sel(side="right"), python_result.arrays["cycle_w_m"][1])
    rows = {row["key"]: row for row in csv.DictReader(io.StringIO(client.get(f"/jobs/{job['id']}/result.csv").text))}
    assert float(rows["gap_mm"]["value"]) == python_result.report.measures["gap_mm"].value
    result = client.get(f"/jobs/{job['id']}/result").json()
    assert set(result["sides"]) == {"left", "right"}
    assert result["provenance"]["request"]["right"] == PALSY["right"]


def test_a_gesture_may_move_one_side(client):
    body = {"right": {"activation": {"ta": [[0.05, 0.4], [0.15, 0.2]]}}, "run": {"duration_s": 0.3}}
    answer = client.post("/gestures", json=body)
    assert answer.status_code == 200, answer.text
    moved = answer.json()["contours"]["right.activation.ta"]
    assert (moved["values"][0], moved["values"][-1]) == (0.4, 0.2)
    sound = client.get(answer.json()["links"]["audio"].removeprefix("/api/v1"))
    assert sound.status_code == 200


@pytest.mark.parametrize("call", ["/posture", "/simulate", "/jobs", "/gestures"])
@pytest.mark.parametrize(
    "body, path",
    [
        ({"right": {"activation": {"ta": 2}}}, "right.activation.ta"),
        ({"left": {"vowel": "i"}}, "left.vowel"),
        ({"left": {"constants": {"K_col_pa_m": 0}}}, "left.constants.K_col_pa_m"),
        ({"lesions": [{"kind": "polyp", "side": "middle"}]}, "lesions.0.side"),
    ],
)
def test_a_refusal_names_side_and_field(client, call, body, path):
    answer = client.post(call, json=body)
    assert answer.status_code == 422
    assert [error["path"] for error in answer.json()["errors"]] == [path]
