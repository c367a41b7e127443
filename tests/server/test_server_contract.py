"""The calls of the outside contract that answer at once, key by key, and against the Python core."""

import json
import struct

import numpy as np
import pytest

import vfcore
from tests.server.live_server import SHORT
from vfcore.airways.coupled import tract_of
from vfcore.airways.resonances import closed_glottis_formants
from vfcore.airways.tract import vowel_tract
from vfcore.runs.result import ARRAYS, OF_TWO_WALLS
from vfcore.runs.setup import prepare
from vfcore.spec.address import address
from vfcore.spec.lesions import KINDS
from vfcore.spec.paths import NUMBERS, NUMBERS_BEYOND
from vfcore.spec.request import document_of, resolve, values_of
from vfcore.spec.sides import folds_of
from vfcore.spec.variants import VARIANTS
from vocalis.server.schemas.neighbours import NeighboursBody, requests_of
from vocalis.server.schemas.requests import GestureBody, JobBody, gesture_of, simulation_of
from vocalis.server.schemas.sweeps import SweepBody, sweep_of

AS_BYTES = {"Accept": "application/octet-stream"}


def test_health_says_version_engine_and_that_kernels_are_ready(client):
    answer = client.get("/health").json()
    assert answer["status"] == "ok"
    assert answer["version"] == vfcore.CODE_VERSION
    assert answer["model_version"] == vfcore.MODEL_VERSION
    assert set(answer["engine"]) == {"name", "workers"} and answer["engine"]["workers"] >= 1
    assert answer["ready"] is True
    assert "ready" in answer["message"]


def test_parameters_lists_every_number_a_request_may_set(client):
    answer = client.get("/parameters").json()
    rows = {row["key"]: row for row in answer["parameters"]}
    assert set(NUMBERS) <= set(rows)
    assert {"key", "label", "unit", "default", "min", "max", "step", "group", "help"} <= set(rows["activation.ta"])
    assert {"presets", "vowels", "variants"} <= set(answer)
    assert answer["sides"] == ["left", "right"]
    per_side = {f"{side}.{key}" for side in answer["sides"] for key, row in rows.items() if row["per_side"]}
    in_lists = {
        f"{of['key']}.{k}.{row['key']}"
        for of in answer["lists"]
        for k in range(of["at_most"])
        for row in of["parameters"]
        if row["unit"]
    }
    assert per_side | in_lists == set(NUMBERS_BEYOND)
    assert {kind["key"] for kind in answer["lesion_kinds"]} == set(KINDS)
    assert "modal" in [preset["key"] for preset in answer["presets"]]


def test_every_preset_is_a_request_that_can_be_used(client):
    for preset in client.get("/parameters").json()["presets"]:
        answer = client.post("/posture", json=preset["request"])
        assert answer.status_code == 200, (preset["key"], answer.text)


def test_measures_is_the_catalogue(client):
    rows = client.get("/measures").json()["measures"]
    assert [row["key"] for row in rows] == list(vfcore.CATALOGUE.keys())
    assert all({"symbol", "unit", "definition", "formula", "source"} <= set(row) for row in rows)


def test_posture_answers_what_the_core_finds(client):
    body = {"kind": "simulation", "activation": {"ct": 0.7}}
    answer = client.post("/posture", json=body).json()
    ready = prepare(resolve(body))
    assert set(answer) >= {"posture", "coefficients", "static_shape"}
    assert answer["posture"]["strain"] == ready.posture.strain
    assert answer["posture"]["converged"] is True
    assert answer["coefficients"]["beam_tension_n"] == ready.fold.coefficients.beam_tension_n
    shape = answer["static_shape"]
    assert shape["closure_pattern"] == ready.static.closure.pattern
    np.testing.assert_array_equal(shape["superior_m"], ready.static.w_m[0])
    np.testing.assert_array_equal(shape["medial_inferior_m"], ready.static.medial_m[-1])


@pytest.mark.parametrize(
    "parameter, muscles", [("activation.ct", ["ct"]), (["activation.lca", "activation.ia"], ["lca", "ia"])]
)
def test_postures_are_the_answers_of_posture_one_by_one(client, parameter, muscles):
    values = [0.9, 0.31, 0.3]
    base = {"kind": "simulation", "activation": {"ta": 0.2}, "convergence_angle_rad": 0.05}
    answers = client.post("/postures", json={"base": base, "parameter": parameter, "values": values}).json()["answers"]
    for value, answer in zip(values, answers, strict=True):
        activation = {"ta": 0.2} | dict.fromkeys(muscles, value)
        assert answer == client.post("/posture", json=base | {"activation": activation}).json()


def test_a_posture_given_directly_skips_the_muscles(client):
    answer = client.post("/posture", json={"posture": {"strain": 0.2, "glottal_half_angle_rad": 0.004}}).json()
    assert answer["posture"]["strain"] == 0.2
    assert answer["posture"]["glottal_half_angle_rad"] == 0.004


@pytest.fixture(scope="module")
def python_result():
    return vfcore.simulate(resolve(SHORT))


def test_simulate_answers_the_result_document_and_an_id(client, python_result):
    answer = client.post("/simulate", json=SHORT).json()
    assert answer["phonation_state"] == python_result.report.state
    assert set(answer["measures"]) == set(vfcore.CATALOGUE.keys())
    for key, measure in python_result.report.measures.items():
        assert answer["measures"][key] == {"value": measure.value, "unit": measure.unit, "reason": measure.reason}
    assert set(answer["arrays"]) == set(ARRAYS).difference(OF_TWO_WALLS)
    assert answer["arrays"]["cycle_w_m"]["shape"] == [100, 20, 10]
    assert answer["provenance"]["model_version"] == vfcore.MODEL_VERSION
    assert client.get(f"/jobs/{answer['id']}/result").json()["measures"] == answer["measures"]


def test_the_same_request_has_the_same_id_however_it_is_written(client):
    written_out = {"kind": "simulation", "subglottal_pressure_pa": 1000, "run": {"duration_s": 0.1, "nx": 20}}
    assert client.post("/simulate", json=SHORT).json()["id"] == client.post("/simulate", json=written_out).json()["id"]
    other = client.post("/simulate", json=SHORT | {"subglottal_pressure_pa": 1001}).json()
    assert other["id"] != client.post("/simulate", json=SHORT).json()["id"]


def read_bundle(content: bytes):
    """The page's own reading of a bundle: header, and each array by its offset."""
    (length,) = struct.unpack("<I", content[:4])
    header, data = json.loads(content[4 : 4 + length]), content[4 + length :]
    assert (4 + length) % 4 == 0, "a Float32Array needs an aligned start"
    arrays = {}
    for name, entry in header["arrays"].items():
        assert entry["offset"] % 4 == 0 and entry["dtype"] == "float32"
        count = int(np.prod(entry["shape"]))
        arrays[name] = np.frombuffer(data, "<f4", count, entry["offset"]).reshape(entry["shape"])
    assert len(data) == 4 * sum(array.size for array in arrays.values())
    return header, arrays


def test_bytes_carry_every_array_of_the_python_result(client, python_result):
    answer = client.post("/simulate", json=SHORT, headers=AS_BYTES)
    assert answer.headers["content-type"] == "application/octet-stream"
    header, arrays = read_bundle(answer.content)
    assert header["phonation_state"] == python_result.report.state and header["id"]
    assert set(arrays) == set(ARRAYS).difference(OF_TWO_WALLS)
    for name, array in arrays.items():
        np.testing.assert_array_equal(array, python_result.arrays[name].astype(np.float32), err_msg=name)
        assert header["arrays"][name]["unit"] == ARRAYS[name].unit
        assert header["arrays"][name]["dims"] == list(ARRAYS[name].dims)


def test_bytes_can_be_restricted_to_chosen_arrays(client):
    answer = client.post("/simulate?arrays=glottal_area_m2,cycle_wb_m", json=SHORT, headers=AS_BYTES)
    _, arrays = read_bundle(answer.content)
    assert list(arrays) == ["glottal_area_m2", "cycle_wb_m"]
    refused = client.post("/simulate?arrays=loudness", json=SHORT, headers=AS_BYTES)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["path"] == "arrays"


def test_the_tract_is_the_one_the_voice_goes_through(client):
    answer = client.get("/tract/i").json()
    tubes = vowel_tract("i")
    assert answer["areas_m2"] == list(tubes.areas_m2)
    assert [row["frequency_hz"] for row in answer["formants"]] == list(closed_glottis_formants(tubes, 5).frequency_hz)
    gain = dict(zip(answer["frequency_hz"], answer["lip_pressure_per_flow_pa_s_m3"], strict=True))
    peak = max((f for f in gain if f < 800), key=gain.get)
    assert peak == pytest.approx(answer["formants"][0]["frequency_hz"], abs=10)
    faster = client.get("/tract/i", params={"c_a_m_s": 420}).json()
    assert faster["formants"][1]["frequency_hz"] == pytest.approx(1.2 * answer["formants"][1]["frequency_hz"], rel=0.01)
    assert client.get("/tract/y").status_code == 422


def test_a_tract_is_the_one_of_the_run(client):
    """Under every variant, vowel and air: the tract that a run of the same settings is filtered by."""
    for variant in VARIANTS:
        for vowel in ("a", "i"):
            answer = client.get(f"/tract/{vowel}", params={"variant": variant, "c_a_m_s": 340}).json()
            document = {"vowel": vowel, "model": {"variant": variant}, "constants": {"c_a_m_s": 340}}
            tract = tract_of(resolve(document))
            assert (answer["section_length_m"], answer["areas_m2"]) == (tract.section_length_m, list(tract.areas_m2))
    man, woman = (
        client.get("/tract/a", params={"variant": v}).json()["formants"][0] for v in ("human", "human_female")
    )
    assert woman["frequency_hz"] > 1.1 * man["frequency_hz"]


def test_a_variant_brings_its_coupling_over_http(client):
    for model, coupling in (
        ({"variant": "human"}, "two_way"), ({"variant": "human", "coupling": "one_way"}, "one_way"), ({}, "one_way")
    ):  # fmt: skip
        body = {"model": model, "run": {"duration_s": 0.02}}
        answer = client.post("/simulate", json=body).json()
        assert answer["provenance"]["request"]["model"]["coupling"] == coupling


def test_an_answer_repeats_the_request_as_it_was_made(client):
    """A voice spelled out by its constants is the variant's voice, computed once; each answer names its own request."""
    spelled = {"model": {"coupling": "two_way", "stretch": "finite"}, "constants": dict(VARIANTS["human"].overrides)}
    run = {"run": {"duration_s": 0.02}}
    named, by_constants = (
        client.post("/simulate", json=body | run).json() for body in ({"model": {"variant": "human"}}, spelled)
    )
    assert named["id"] == by_constants["id"] and named["measures"] == by_constants["measures"]
    assert named["provenance"]["created"] == by_constants["provenance"]["created"], "computed once"
    assert named["provenance"]["request"]["model"]["variant"] == "human"
    assert by_constants["provenance"]["request"]["constants"] == spelled["constants"]


NULLS = [(path, part) for path in ("/simulate", "/posture", "/jobs", "/gestures") for part in ("activation", "model",
         "constants")] + [(path, "run") for path in ("/simulate", "/jobs", "/gestures")]  # fmt: skip


@pytest.mark.parametrize(("path", "part"), NULLS)
def test_a_part_that_is_null_is_refused(client, path, part):
    answer = client.post(path, json={part: None})
    assert answer.status_code == 422 and [error["path"] for error in answer.json()["errors"]] == [part]
    optional = {"posture": None, "left": None, "right": {"posture": None}}
    assert client.post("/posture", json=optional).status_code == 200


@pytest.mark.parametrize("variant", VARIANTS)
def test_a_request_is_resolved_as_the_core_resolves_it(client, variant):
    """Values, shortest patch, document and address; and a run of the same body answers at that address."""
    body = {"model": {"variant": variant}, "constants": {"K_col_pa_m": 1e6}, "run": {"duration_s": 0.02}}
    answer, wanted = client.post("/resolve", json=body).json(), resolve(body)
    assert answer["values"] == values_of(wanted) and answer["request"] == document_of(wanted)
    assert resolve(answer["patch"]) == wanted == resolve(answer["request"])
    assert client.post("/simulate", json=body).json()["id"] == answer["id"] == address(wanted)
    assert client.post("/resolve", json={"activation": {"ta": 9}}).json()["errors"][0]["path"] == "activation.ta"


TWO_FOLDS = {
    "right": {"activation": {"ta": 0.1}, "constants": {"K_col_pa_m": 2e6}, "posture": {"strain": 0.1}},
    "lesions": [{"kind": "nodule"}, {"kind": "polyp", "side": "left", "height_mm": 1}],
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_sides_and_lesions_are_resolved_as_the_core_resolves_them(client, variant):
    body = {"model": {"variant": variant}} | TWO_FOLDS
    answer, wanted = client.post("/resolve", json=body).json(), resolve(body)
    assert len(folds_of(wanted)) == 2
    assert answer["values"] == values_of(wanted) and answer["request"] == document_of(wanted)
    assert resolve(answer["patch"]) == wanted == resolve(answer["request"]) and answer["id"] == address(wanted)
    by_position = body | {"lesions": {"0": body["lesions"][0], "1": body["lesions"][1]}}
    assert client.post("/resolve", json=by_position).json() == answer, "as the page has them"
    mirrored = {"left": TWO_FOLDS["right"], "right": TWO_FOLDS["right"]}
    assert client.post("/resolve", json=mirrored).json()["id"] == address(resolve(TWO_FOLDS["right"]))


def test_every_body_takes_sides_and_lesions():
    wanted = resolve(TWO_FOLDS)
    objects = JobBody.model_json_schema()["$defs"]
    assert set(objects["SideBody"]["properties"]) == {"activation", "constants", "convergence_angle_rad", "posture"}
    assert "K_col_pa_m" in (own := objects["ConstantsSideBody"]["properties"]) and "rho_a_kg_m3" not in own
    assert simulation_of(JobBody.model_validate(TWO_FOLDS)) == wanted
    axis = {"parameter": "right.activation.ta", "values": [0.1, 0.2]}
    sweep = sweep_of(SweepBody.model_validate({"kind": "sweep", "base": TWO_FOLDS, "axes": [axis]}))
    assert sweep.request(0) == wanted and folds_of(sweep.request(1))[1].activation.ta == 0.2
    row = NeighboursBody.model_validate({"base": TWO_FOLDS, "parameter": "lesions.1.height_mm", "values": [1, 0.5]})
    assert [request.lesions[1].height_mm for request in requests_of(row)] == [1, 0.5] and requests_of(row)[0] == wanted
    moving = {"right": {"activation": {"ta": [[0, 0.1], [1, 0.3]]}}, "lesions": [{"x": [[0, 0.4], [1, 0.6]]}]}
    half = gesture_of(GestureBody.model_validate(moving)).at(0.5)
    assert half.lesions[0].x == 0.5 and [fold.activation.ta for fold in folds_of(half)] == [0.4, 0.2]
