"""A request document and a Simulation are equivalent, and invalid documents are refused."""

import json
import math

import pytest

from vfcore.errors import ParameterError
from vfcore.spec import paths
from vfcore.spec.presets import PRESETS
from vfcore.spec.request import document_of, resolve
from vfcore.spec.schema import parameter_schema
from vfcore.spec.simulation import Activation, Model, PostureOverride, Run, Simulation

ROWS = parameter_schema()
NUMBERS = [row for row in ROWS if row["type"] not in ("choice", "boolean")]
CHOICES = [row for row in ROWS if row["type"] == "choice"]


def nested(key, value):
    """The document that sets the dotted ``key`` to ``value`` and nothing else."""
    *parents, last = key.split(".")
    document = {last: value}
    for name in reversed(parents):
        document = {name: document}
    return document


def refusal(document):
    with pytest.raises(ParameterError) as caught:
        resolve(document)
    return caught.value


def test_an_empty_document_is_the_modal_case():
    assert resolve({}) == Simulation() == resolve({"kind": "simulation"})


@pytest.mark.parametrize(
    "request_",
    [
        Simulation(),
        Simulation(activation=Activation(ta=0.1, pca=1.0), subglottal_pressure_pa=432.1, vowel="AE"),
        Simulation(model=Model(variant="text_literal", posture_set="titze2006"), run=Run(nx=30, time_step_s=2e-6)),
        Simulation(posture=PostureOverride(strain=0.2, glottal_half_angle_rad=0.004), run=Run(start="static")),
        resolve({"constants": {"K_col_pa_m": 2e6, "L_0_posture_m": 0.015, "TA_sigma_max_active_pa": 9e4}}),
        resolve({"model": {"posture_set": "palaparthi2019"}, "constants": {"lig_sigma_0_pa": 900.0}}),
        *(resolve(preset.request) for preset in PRESETS),
    ],
)
def test_a_request_survives_a_json_round_trip(request_):
    assert resolve(json.loads(json.dumps(document_of(request_)))) == request_


def test_a_document_names_only_the_constants_that_differ():
    request = resolve({"constants": {"K_col_pa_m": 2e6, "b_0_m": 5e-3, "k_t_n_m": 501.0}})
    assert document_of(request)["constants"] == {"K_col_pa_m": 2e6, "k_t_n_m": 501.0}


@pytest.mark.parametrize("row", NUMBERS, ids=lambda row: row["key"])
def test_every_number_is_refused_outside_its_range_and_by_its_own_name(row):
    for value in (
        math.nextafter(row["min"], -math.inf),
        row["max"] + abs(row["max"]) + 1,
        math.nan,
        -math.inf,
        "1",
        [1],
    ):
        error = refusal(nested(row["key"], value))
        assert error.path == row["key"], value
        assert f"{row['min']:g} to {row['max']:g}" in error.allowed, value


@pytest.mark.parametrize("row", NUMBERS, ids=lambda row: row["key"])
def test_every_number_can_be_set(row):
    value = row["default"] if row["default"] is not None else row["min"]
    assert resolve(nested(row["key"], value)) is not None


@pytest.mark.parametrize("row", CHOICES, ids=lambda row: row["key"])
def test_every_choice_takes_its_options_and_no_other(row):
    for option in row["options"]:
        resolve(nested(row["key"], option))
    for value in ("", "no such", 3, ["i"], {}):
        error = refusal(nested(row["key"], value))
        assert error.path == row["key"]
        assert all(option in error.allowed for option in row["options"])


@pytest.mark.parametrize("key", ["run.nx", "run.ny"])
def test_a_grid_is_a_whole_number(key):
    assert refusal(nested(key, 12.5)).path == key
    request = resolve(nested(key, 12.0))  # JSON does not distinguish 12.0 from 12
    count = getattr(request.run, key.removeprefix("run."))
    assert count == 12 and isinstance(count, int)


@pytest.mark.parametrize("key", ["run.nx", "subglottal_pressure_pa", "constants.K_col_pa_m"])
def test_an_integer_beyond_all_floats_is_out_of_range(key):
    assert refusal(nested(key, 10**400)).path == key


@pytest.mark.parametrize(
    ("document", "path"),
    [
        ({"activation": {"tа": 0.5}}, "activation.tа"),  # a Cyrillic а
        ({"presure": 1000}, "presure"),
        ({"run": {"steps": 3}}, "run.steps"),
        ({"constants": {"K_coll": 1}}, "constants.K_coll"),
        ({"constants": [1]}, "constants"),
        ({"activation": 0.5}, "activation"),
        ({"run": "long"}, "run"),
        ({"kind": "sweep"}, "kind"),
        ({"activation": {"ta": None}}, "activation.ta"),
        ({"activation": {"ta": True}}, "activation.ta"),
        ({"vowel": None}, "vowel"),
        ({"run": {"duration_s": 1.0, "pressure_rise_s": 2.0}}, "run.pressure_rise_s"),
    ],
)
def test_an_invalid_field_is_named(document, path):
    assert refusal(document).path == path


def test_values_that_are_not_objects_are_refused():
    for document in ([], "modal", 3, None):
        assert refusal(document).path == "request"


def test_the_numeric_paths_are_those_of_the_schema():
    assert set(paths.NUMBERS) == {row["key"] for row in NUMBERS}
    assert len(paths.NUMBERS) == len(set(paths.NUMBERS))
