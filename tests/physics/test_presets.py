"""Each preset does what its description says."""

from functools import cache

import pytest

from vfcore.runs.one import simulate
from vfcore.spec.presets import PRESETS
from vfcore.spec.request import resolve

KEYS = [preset.key for preset in PRESETS]


SILENT = ("pca_abduction", "no_phonation")
#: Presets whose voice does not repeat on a variant.
IRREGULAR = {("bowed", "human")}
#: f_o of high_pitch above that of modal, Hz. The human folds stretch in the modal voice too.
RISE_HZ = {"paper": 40, "human": 20}
VARIANTS = ("paper", "human")


@cache
def run(key: str, variant: str = "paper"):
    """The preset on a variant with the source–tract coupling that it brings."""
    request = next(preset.request for preset in PRESETS if preset.key == key)
    model = {"variant": variant, "coupling": {"paper": "one_way", "human": "two_way"}[variant]}
    return simulate(resolve({"run": {"duration_s": 0.5}, "model": model} | request))


def value(key: str, measure: str, variant: str = "paper") -> float:
    return run(key, variant).report.measures[measure].value


def test_the_expected_presets_exist():
    asked = {"modal", "breathy", "pressed", "bowed", "high_pitch", "ta_shortening", "pca_abduction", "no_phonation"}
    assert asked <= set(KEYS)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("key", KEYS)
def test_voiced_presets_vibrate_and_silent_ones_do_not(key, variant):
    voiced = "irregular" if (key, variant) in IRREGULAR else "periodic"
    assert run(key, variant).report.state == ("none" if key in SILENT else voiced)


def test_modal_meets_along_its_length_and_closes_half_the_cycle():
    assert run("modal").static.closure.pattern == "complete"
    assert 0.4 < value("modal", "closed_quotient") < 0.6


@pytest.mark.parametrize("variant", VARIANTS)
def test_breathy_leaks_through_a_gap_at_the_back(variant):
    assert value("breathy", "gap_mm", variant) > 3
    assert value("breathy", "min_flow_ml_s", variant) > 100 and value("breathy", "closed_quotient", variant) < 0.01


def test_pressed_has_less_flow_and_more_time_closed():
    assert value("pressed", "mean_flow_ml_s") < value("modal", "mean_flow_ml_s")
    assert value("pressed", "closed_quotient") > value("modal", "closed_quotient")


def test_bowed_meets_at_the_back_and_stays_apart_in_front():
    assert run("bowed").static.closure.pattern == "anterior_opening"


@pytest.mark.parametrize("variant", VARIANTS)
def test_ct_makes_the_folds_longer_and_faster(variant):
    assert value("high_pitch", "length_mm", variant) > value("modal", "length_mm", variant) + 1
    assert value("high_pitch", "fo_hz", variant) > value("modal", "fo_hz", variant) + RISE_HZ[variant]


def test_ta_shortens_and_lowers():
    assert value("modal", "length_mm") - value("ta_shortening", "length_mm") == pytest.approx(1.5, abs=0.2)
    assert value("ta_shortening", "fo_hz") < value("modal", "fo_hz") - 10


def test_pca_opens_a_v_with_much_flow():
    assert value("pca_abduction", "gap_mm") == pytest.approx(9, abs=0.5)
    assert value("pca_abduction", "mean_flow_ml_s") > 2 * value("modal", "mean_flow_ml_s")
