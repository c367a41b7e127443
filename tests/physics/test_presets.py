"""Each preset does what its one sentence tells people to look for."""

from functools import cache

import pytest

from vfcore.presets import PRESETS
from vfcore.request import simulation_from_dict
from vfcore.simulate import simulate

KEYS = [preset.key for preset in PRESETS]


@cache
def run(key: str):
    request = next(preset.request for preset in PRESETS if preset.key == key)
    return simulate(simulation_from_dict({"kind": "simulation", "run": {"duration_s": 0.5}} | request))


def value(key: str, measure: str) -> float:
    return run(key).report.measures[measure].value


def test_the_presets_people_ask_for_are_there():
    asked = {"modal", "breathy", "pressed", "bowed", "high_pitch", "ta_shortening", "pca_abduction", "no_phonation"}
    assert asked <= set(KEYS)


@pytest.mark.parametrize("key", KEYS)
def test_the_voices_vibrate_and_the_silent_ones_do_not(key):
    assert run(key).report.state == ("none" if key in ("pca_abduction", "no_phonation") else "periodic")


def test_modal_meets_along_its_length_and_closes_half_the_cycle():
    assert run("modal").static.closure.pattern == "complete"
    assert 0.4 < value("modal", "closed_quotient") < 0.6


def test_breathy_leaks_through_a_gap_at_the_back():
    assert value("breathy", "gap_mm") > 3
    assert value("breathy", "min_flow_ml_s") > 100 and value("breathy", "closed_quotient") < 0.01


def test_pressed_has_less_flow_and_more_time_closed():
    assert value("pressed", "mean_flow_ml_s") < value("modal", "mean_flow_ml_s")
    assert value("pressed", "closed_quotient") > value("modal", "closed_quotient")


def test_bowed_meets_at_the_back_and_stays_apart_in_front():
    assert run("bowed").static.closure.pattern == "anterior_opening"


def test_ct_makes_the_folds_longer_and_faster():
    assert value("high_pitch", "length_mm") > value("modal", "length_mm") + 1
    assert value("high_pitch", "fo_hz") > value("modal", "fo_hz") + 40


def test_ta_shortens_and_lowers():
    assert value("modal", "length_mm") - value("ta_shortening", "length_mm") == pytest.approx(1.5, abs=0.2)
    assert value("ta_shortening", "fo_hz") < value("modal", "fo_hz") - 10


def test_pca_opens_a_v_with_much_flow():
    assert value("pca_abduction", "gap_mm") == pytest.approx(9, abs=0.5)
    assert value("pca_abduction", "mean_flow_ml_s") > 2 * value("modal", "mean_flow_ml_s")
