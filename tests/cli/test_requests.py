"""Preset, request file, single options and --set make one request; later ones override earlier ones."""

import io
import json

import pytest

from vfcore.spec.lesions import Lesion
from vfcore.spec.presets import PRESETS
from vfcore.spec.request import resolve
from vfcore.spec.schema import parameter_schema
from vfcore.spec.sides import folds_of
from vfcore.spec.simulation import Simulation
from vocalis.cli.main import main
from vocalis.cli.options import POSTURE_OPTIONS, SHAPE_OPTIONS, SIMULATE_OPTIONS


@pytest.fixture
def request_of(monkeypatch):
    """The Simulation that `vocalis simulate ARGUMENTS` would run."""

    class Reached(Exception):
        pass

    seen = []

    def catch(request):
        seen.append(request)
        raise Reached

    monkeypatch.setattr("vocalis.cli.simulate.simulate_watched", catch)

    def of(*arguments):
        with pytest.raises(Reached):
            main(["simulate", *arguments])
        return seen.pop()

    return of


def test_without_options_it_is_the_modal_case(request_of):
    assert request_of() == Simulation()


def test_every_option_sets_its_own_field(request_of):
    rows = {row["key"]: row for row in parameter_schema()}
    for option in SIMULATE_OPTIONS:
        row = rows[option.key]
        value = row["options"][-1] if row["type"] == "choice" else row["min"]
        if option.key == "run.time_step_s":
            value = 2e-6
        is_flag = row["type"] == "boolean"
        value = not row["default"] if is_flag else value
        request = request_of(option.flag, *(() if is_flag else (str(value),)))
        found = request
        for name in option.key.split("."):
            found = getattr(found, name)
        assert found == value
        assert request != Simulation() or value == row["default"]


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.key)
def test_a_preset_is_its_request(request_of, preset):
    assert request_of("--preset", preset.key) == resolve(preset.request)


def test_a_file_and_standard_input_are_the_same(request_of, tmp_path, monkeypatch):
    text = json.dumps({"activation": {"ct": 0.9}, "vowel": "u"})
    path = tmp_path / "request.json"
    path.write_text(text)
    monkeypatch.setattr("sys.stdin", io.StringIO(text))
    from_file = request_of("--request", str(path))
    assert from_file == request_of("--request", "-")
    assert (from_file.activation.ct, from_file.activation.ta, from_file.vowel) == (0.9, 0.4, "u")


def test_later_sources_override_earlier_ones_and_keep_the_rest(request_of, tmp_path):
    path = tmp_path / "request.json"
    path.write_text(json.dumps({"activation": {"ta": 0.1, "ct": 0.1, "lca": 0.1}, "run": {"nx": 30}}))
    request = request_of(
        "--preset", "breathy", "--request", str(path), "--ct", "0.2", "--lca", "0.2", "--set", "activation.lca=0.3"
    )
    a = request.activation
    assert (a.pca, a.ta, a.ct, a.lca) == (0.5, 0.1, 0.2, 0.3)  # preset, file, option, --set
    assert request.run.nx == 30 and request.run.ny == 10


def test_a_preset_is_not_changed_by_what_is_set_on_top(request_of):
    before = json.dumps([preset.request for preset in PRESETS])
    request_of("--preset", "pressed", "--ta", "0.05", "--set", "activation.ct=0.9")
    assert json.dumps([preset.request for preset in PRESETS]) == before


@pytest.mark.parametrize(
    ("setting", "field", "value"),
    [
        ("constants.K_col_pa_m=2e6", lambda r: r.constants.K_col_pa_m, 2e6),
        ("constants.L_0_posture_m=0.015", lambda r: r.posturing.L_0_posture_m, 0.015),
        ("run.start=static", lambda r: r.run.start, "static"),
        ('run.start="static"', lambda r: r.run.start, "static"),
        ("run.time_step_s=null", lambda r: r.run.time_step_s, None),
        ("posture.strain=0.2", lambda r: r.posture.strain, 0.2),
        ("right.activation.ta=0.1", lambda r: [fold.activation.ta for fold in folds_of(r)], [0.4, 0.1]),
        ('left={"posture": {"strain": 0.1}}', lambda r: folds_of(r)[0].posture.strain, 0.1),
        ("lesions.0.kind=scar", lambda r: r.lesions, (Lesion(kind="scar"),)),
        ('lesions=[{"kind": "polyp", "side": "left"}]', lambda r: r.lesions, (Lesion("left", "polyp"),)),
        ('run={"nx": 12, "ny": 6}', lambda r: (r.run.nx, r.run.ny), (12, 6)),
    ],
)
def test_set_reaches_any_field(request_of, setting, field, value):
    assert field(request_of("--set", setting)) == value


def test_set_can_be_repeated(request_of):
    request = request_of("--set", "run.nx=12", "--set", "run.ny=6", "--set", "run.nx=13")
    assert (request.run.nx, request.run.ny) == (13, 6)


@pytest.mark.parametrize(
    ("command", "options"), [("posture", POSTURE_OPTIONS), ("static", SHAPE_OPTIONS), ("simulate", SIMULATE_OPTIONS)]
)
def test_help_shows_every_option_with_its_range_and_unit(capsys, monkeypatch, command, options):
    monkeypatch.setenv("COLUMNS", "200")
    assert main([command, "--help"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    rows = {row["key"]: row for row in parameter_schema()}
    for option in options:
        row = rows[option.key]
        assert option.flag in shown and row["label"] in shown
        if row["type"] not in ("choice", "boolean"):
            assert f"{row['min']:g} to {row['max']:g}" in shown
    assert f"vocalis {command}" in shown and "--set" in shown
