"""A gesture over HTTP: contours and segments, links to its sound and tables, refusals by path."""

import io
import wave

import numpy as np
import pytest

from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import render

GLIDE = {"activation": {"ct": [[0.1, 0.1], [0.5, 0.9]]}, "vowel": [[0, "a"], [0.4, "i"]], "run": {"duration_s": 0.8}}


@pytest.fixture(scope="module")
def answer(live):
    with live.client() as client:
        answer = client.post("/gestures", json=GLIDE)
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_it_answers_what_python_renders(answer):
    rendered = render(gesture_from_dict(GLIDE))
    fo = np.array([np.nan if v is None else v for v in answer["contours"]["fo_hz"]["values"]])
    assert np.array_equal(fo, rendered.contours["fo_hz"], equal_nan=True)
    assert answer["contours"]["activation.ct"]["values"][-1] == 0.9
    assert [segment["end_s"] for segment in answer["segments"]] == [0.1, 0.4, 0.5, 0.8]
    assert answer["segments"][-1]["measures"]["fo_hz"]["value"] > 170
    assert answer["provenance"]["request"]["vowel"] == GLIDE["vowel"]


def test_its_links_lead_to_sound_and_tables(answer, client):
    with wave.open(io.BytesIO(client.get(answer["links"]["audio"][len("/api/v1") :]).content)) as file:
        assert (file.getframerate(), file.getnframes()) == (48000, 38400)
        assert np.abs(np.frombuffer(file.readframes(38400), "<i2")).max() > 20000
    table = client.get(answer["links"]["contours"][len("/api/v1") :]).text.splitlines()
    assert len(table) == 81
    assert table[0].split(",")[-1] == "activation.ct"
    assert client.get(answer["links"]["netcdf"][len("/api/v1") :]).content[1:4] == b"HDF"


@pytest.mark.parametrize(
    "change, path",
    [
        ({"activation": {"ct": [[0, 0.1], [0, 0.2]]}}, "activation.ct.1.0"),
        ({"activation": {"ct": [[0, 0.1], [1, 1.5]]}}, "activation.ct.1.1"),
        ({"run": {"duration_s": 31}}, "run.duration_s"),
        ({"vowel": [[0, "x"]]}, "vowel.0.1"),
    ],
)
def test_a_bad_breakpoint_is_refused_by_its_path(client, change, path):
    answer = client.post("/gestures", json=GLIDE | change)
    assert answer.status_code == 422
    assert path in {error["path"] for error in answer.json()["errors"]}


def test_a_gesture_that_is_not_kept_says_so(client):
    assert client.get("/gestures/unknown/audio.wav").status_code == 410
