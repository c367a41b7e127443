"""The catalogue: every measure is present, described, and has a value or a reason; the call is fast enough for live
use.
"""

import json
import math
import time

import numpy as np
import pytest

from tests.support.synthetic_waves import MM2, alternating, raised_pulse, signals_from, steady_phase, times, triangle
from vfcore.errors import ParameterError
from vfcore.measures import CATALOGUE, Catalogue, measure_all

T = times()
KEYS = {
    "fo_hz", "spl_lips_db", "spl_30cm_db", "closed_quotient", "open_quotient", "speed_quotient", "contact_quotient",
    "mean_flow_ml_s", "ac_flow_ml_s", "min_flow_ml_s", "mfdr_l_s2", "naq", "h1_h2_flow_db", "h1_h2_sound_db", "cpp_db",
    "jitter_percent", "shimmer_percent", "hnr_db", "contact_pressure_max_pa", "contact_location",
    "contact_impulse_pa_s", "contact_area_mm2", "glottal_gap_area_mm2", "efficiency", "efficiency_db", "strain",
    "length_mm", "glottal_half_angle_deg", "gap_mm", "peak_area_mm2",
}  # fmt: skip
COLUMNS = ("key", "symbol", "name", "unit", "group", "signal", "definition", "formula", "source", "version")
STEADY = {"mean_flow_ml_s", "strain", "length_mm", "glottal_half_angle_deg", "gap_mm"}
PHASE = steady_phase(T, 149.6)
PULSES = 20 * MM2 * raised_pulse(PHASE, 0.506, 1.52)
VOICES = {
    "periodic": PULSES,
    "subharmonic": PULSES * alternating(PHASE, 0.7),
    "irregular": PULSES * (1 + 0.4 * np.sin(2 * np.pi * 0.382 * 149.6 * T)),
    "none": PULSES * np.exp(-T / 0.2),
}


def test_every_measure_of_the_contract_is_in_the_catalogue():
    assert set(CATALOGUE.keys()) >= KEYS


def test_every_row_is_described():
    for row in CATALOGUE.as_rows():
        for column in (
            "key",
            "symbol",
            "name",
            "unit",
            "group",
            "signal",
            "definition",
            "formula",
            "source",
            "version",
        ):
            assert row[column].strip(), (row["key"], column)
        assert row["definition"].endswith("."), row["key"]
        assert row["decimals"] >= 0
        normal = row["normal_range"]
        assert normal is None or (normal["low"] <= normal["high"] and normal["who"] and normal["source"])


def test_the_catalogue_is_plain_data():
    rows = CATALOGUE.as_rows()
    assert json.loads(json.dumps(rows, allow_nan=False)) == rows
    assert [row["key"] for row in rows] == list(CATALOGUE.keys())


def test_two_rows_with_one_key_are_refused():
    row = CATALOGUE["fo_hz"]
    with pytest.raises(ValueError, match="same key"):
        Catalogue((row, row))


@pytest.mark.parametrize("state", VOICES)
def test_every_measure_has_a_finite_value_or_a_sentence(state):
    report = measure_all(signals_from(VOICES[state]))
    assert report.state == state
    assert report.explanation.endswith(".")
    assert set(report.measures) == set(CATALOGUE.keys())
    for key, measure in report.measures.items():
        assert measure.unit == CATALOGUE[key].unit
        if measure.value is None:
            assert measure.reason[0].isupper(), key
            assert measure.reason.endswith("."), key
        else:
            assert measure.reason is None, key
            assert type(measure.value) is float, key
            assert math.isfinite(measure.value), key


@pytest.mark.parametrize(("state", "missing"), [
    ("periodic", {"jitter_percent", "shimmer_percent", "hnr_db"}),
    ("subharmonic", {"jitter_percent", "shimmer_percent", "hnr_db", "h1_h2_flow_db", "h1_h2_sound_db"}),
    ("irregular", {"h1_h2_flow_db", "h1_h2_sound_db"}),
    ("none", set(CATALOGUE.keys()) - STEADY),
])  # fmt: skip
def test_measures_without_a_value_by_state(state, missing):
    measures = measure_all(signals_from(VOICES[state])).measures
    assert {key for key, measure in measures.items() if measure.value is None} == missing


def test_without_phonation_every_reason_names_it():
    report = measure_all(signals_from(VOICES["none"]))
    assert report.measures["fo_hz"].reason == report.measures["spl_30cm_db"].reason == report.explanation


def test_a_voice_without_recognisable_cycles_keeps_its_level():
    rng = np.random.default_rng(8)
    starts = np.cumsum(rng.uniform(0.4, 1.6, 400) / 150)
    report = measure_all(signals_from(10 * MM2 * triangle(np.interp(T, starts, np.arange(400)), 0.5, 1.5)))
    assert report.state == "irregular"
    assert report.measures["spl_30cm_db"].value is not None
    assert report.measures["fo_hz"].value is None
    assert "No sequence of cycles" in report.measures["fo_hz"].reason
    assert report.cycles == 0


def test_posture_is_passed_on_in_the_units_of_the_table():
    measures = measure_all(signals_from(VOICES["none"])).measures
    assert measures["strain"].value == 0.057
    assert measures["length_mm"].value == pytest.approx(15.85)
    assert measures["glottal_half_angle_deg"].value == pytest.approx(0.01 * 180 / math.pi)
    assert measures["gap_mm"].value == pytest.approx(2 * 15.85 * math.tan(0.01))


@pytest.mark.parametrize("state", VOICES)
def test_single_precision_gives_the_same_measures(state):
    double = signals_from(VOICES[state])
    waves = {
        name: getattr(double, name).astype(np.float32)
        for name in ("glottal_area_m2", "glottal_flow_m3_s", "lip_pressure_pa", "far_pressure_pa",
                     "contact_pressure_max_pa", "contact_location", "contact_area_m2")
    }  # fmt: skip
    single = measure_all(signals_from(VOICES[state], **waves))
    expected = measure_all(double)
    assert single.state == expected.state
    for key, measure in expected.measures.items():
        if measure.value is None:
            assert single.measures[key].value is None, key
        else:
            assert single.measures[key].value == pytest.approx(measure.value, rel=2e-3, abs=1e-9), key


@pytest.mark.parametrize(("field", "value", "word"), [
    ("glottal_flow_m3_s", np.zeros(10), "shape"),
    ("lip_pressure_pa", np.full(len(T), np.nan), "not finite"),
    ("strain", math.inf, "not finite"),
    ("sample_rate_hz", 0.0, "too low"),
])  # fmt: skip
def test_signals_that_cannot_be_measured_are_refused_by_name(field, value, word):
    with pytest.raises(ParameterError, match=word) as caught:
        signals_from(PULSES, **{field: value})
    assert caught.value.path == f"signals.{field}"


def test_a_second_of_voice_is_measured_within_a_hundredth_of_a_second():
    signals = signals_from(PULSES)
    measure_all(signals)
    durations = []
    for _ in range(15):
        start = time.process_time()
        measure_all(signals)
        durations.append(time.process_time() - start)
    assert min(durations) <= 0.010
