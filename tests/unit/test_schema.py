"""The parameter schema has every field of a request, with valid values."""

import dataclasses

import pytest

from vfcore.fold.constants import FoldConstants
from vfcore.io.result_document import json_text
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set
from vfcore.spec.presets import PRESETS
from vfcore.spec.request import document_of, resolve
from vfcore.spec.schema import GROUPS, parameter_catalogue, parameter_schema, sensible_step
from vfcore.spec.simulation import BROUGHT_BY_VARIANT, VARIANTS, VOWELS, Simulation

ROWS = {row["key"]: row for row in parameter_schema()}


def leaves(document, prefix=""):
    for key, value in document.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


def test_every_field_of_a_request_has_a_row_with_its_default():
    document = document_of(Simulation())
    not_rows = ("kind", "posture", "left", "right", "lesions")
    fields = {key: value for key, value in leaves(document) if key not in not_rows}
    brought = {f"model.{name}" for name in BROUGHT_BY_VARIANT}
    assert {key: value for key, value in fields.items() if key not in brought} == {
        key: ROWS[key]["default"] for key in fields if key not in brought
    }
    assert all(ROWS[key]["default"] is None and ROWS[key]["nullable"] for key in brought), "the variant's own"
    assert {key for key in ROWS if not key.startswith(("constants.", "posture."))} == set(fields)


def test_every_constant_of_the_paper_has_a_row():
    defaults = FoldConstants()
    for field in dataclasses.fields(FoldConstants):
        assert ROWS[f"constants.{field.name}"]["default"] == getattr(defaults, field.name)


def test_posturing_constants_state_their_value_in_every_published_set():
    row = ROWS["constants.TA_sigma_max_active_pa"]
    assert row["default"] == 1e5  # N/m², the paper's table
    assert row["default_by_posture_set"] == {
        "serry2026": 1e5, "alzamendi2020": 1.5e5, "titze2006": 1.05e5, "palaparthi2019": 1.8e5,
    }  # fmt: skip
    assert posture_set("titze2006").value("TA_sigma_max_active_pa") == 1.05e5
    assert all(
        set(r["default_by_posture_set"]) == set(POSTURE_SETS) for r in ROWS.values() if "default_by_posture_set" in r
    )


@pytest.mark.parametrize("row", ROWS.values(), ids=ROWS)
def test_every_row_can_make_a_control(row):
    assert row["label"] and row["source"] and row["group"] in GROUPS
    if row["type"] == "choice":
        assert row["options"] and (row["nullable"] or row["default"] in row["options"])
        assert (row["min"], row["max"], row["step"], row["unit"]) == (None, None, None, None)
    elif row["type"] == "boolean":
        assert row["default"] in (True, False) and (row["options"], row["unit"], row["step"]) == (None, None, None)
    else:
        assert row["min"] < row["max"] and row["unit"] and row["options"] is None
        assert row["nullable"] or row["min"] <= row["default"] <= row["max"]
        assert 0 < row["step"] <= row["max"] - row["min"]


def test_muscles_come_first_and_groups_are_contiguous():
    groups = [row["group"] for row in ROWS.values()]
    assert groups[:5] == ["muscles"] * 5
    assert list(dict.fromkeys(groups)) == list(GROUPS)
    assert groups == sorted(groups, key=GROUPS.index)


def test_the_catalogue_is_strict_json_and_complete():
    catalogue = parameter_catalogue()
    assert json_text(catalogue)
    assert [vowel["key"] for vowel in catalogue["vowels"]] == list(VOWELS)
    assert {vowel["key"]: vowel["ipa"] for vowel in catalogue["vowels"]}["AE"] == "æ"
    assert [variant["key"] for variant in catalogue["variants"]] == list(VARIANTS)
    assert catalogue["variants"][0]["shear"] == "kelvin_voigt" and catalogue["variants"][1]["shear"] == "rotation"
    assert [preset["key"] for preset in catalogue["presets"]] == [preset.key for preset in PRESETS]
    for preset in catalogue["presets"]:
        resolve(preset["request"])


@pytest.mark.parametrize(
    ("default", "low", "high", "step"),
    [(1e6, 1e4, 1e9, 1e4), (0.7, 0, 2, 0.005), (-0.0101, -0.03, -0.001, 1e-4), (0.0, 0, 5, 0.05), (2.37, 0, 20, 0.02)],
)
def test_an_undeclared_step_is_a_round_hundredth(default, low, high, step):
    assert sensible_step(default, low, high) == step
