"""Invalid input ends with exit code 2 and one line that names the field, the value and the allowed values."""

import io

import pytest

from vocalis.cli.main import main

# arguments after the command, and what the line has to contain
REFUSED = [
    ("--ta 1.5", "activation.ta", "1.5", "0 to 1"),
    ("--ta -0.1", "activation.ta", "-0.1", "0 to 1"),
    ("--ta abc", "activation.ta", "abc", "0 to 1"),
    ("--ta nan", "activation.ta", "nan", "0 to 1"),
    ("--pca inf", "activation.pca", "inf", "0 to 1"),
    ("--ia=", "activation.ia", "''", "0 to 1"),
    ("--pressure -1", "subglottal_pressure_pa", "-1", "0 to 5000 Pa"),
    ("--pressure 1e9", "subglottal_pressure_pa", "1e+09", "0 to 5000 Pa"),
    ("--convergence-angle 2", "convergence_angle_rad", "2", "-0.02 to 0.3 rad"),
    ("--nx 1", "run.nx", "1", "6 to 200"),
    ("--nx 1000000", "run.nx", "1e+06", "6 to 200"),
    ("--nx nan", "run.nx", "nan", "6 to 200"),
    ("--ny 2.5", "run.ny", "2.5", "3 to 100"),
    ("--duration 0", "run.duration_s", "0", "0.02 to 60 s"),
    ("--duration 86400", "run.duration_s", "86400", "0.02 to 60 s"),
    ("--time-step 0", "run.time_step_s", "0", "1e-08 to 0.001 s"),
    ("--time-step 9e-4", "run.time_step_s", "0.0009", "up to"),
    ("--pressure-rise 2", "run.pressure_rise_s", "2", "1 s"),
    ("--vowel q", "vowel", "q", "i | I"),
    ("--variant best", "model.variant", "best", "text_literal"),
    ("--posture-set mine", "model.posture_set", "mine", "alzamendi2020"),
    ("--coupling-gradient up", "model.coupling_gradient", "up", "superior_stiff"),
    ("--shear none", "model.shear", "none", "kelvin_voigt"),
    ("--start middle", "run.start", "middle", "flat | static"),
    ("--preset nobody", "--preset", "nobody", "modal"),
    ("--set constants.K_coll=1", "constants.K_coll", "", "vocalis posture --constants"),
    ("--set constants.K_col_pa_m=NaN", "constants.K_col_pa_m", "nan", "10000 to 1e+09 Pa/m"),
    ("--set presure=3", "presure", "", "subglottal_pressure_pa"),
    ("--set activation=3", "activation", "int", "object"),
    ("--set vowel=a --set vowel.x=3", "vowel.x", "", "vowel"),
    ("--set vowel", "--set", "vowel", "PATH=VALUE"),
    ("--set =3", "--set", "=3", "PATH=VALUE"),
    ("--set kind=sweep", "kind", "sweep", "simulation"),
    ("--request /no/such.json", "--request", "/no/such.json", "JSON"),
    ("--request /", "--request", "/", "JSON"),
    ("--wav /no/such/folder/x.wav", "--wav", "/no/such/folder/x.wav", "existing folder"),
    ("--netcdf /", "--netcdf", "/", "existing folder"),
    ("--csv /proc/x.csv", "--csv", "/proc/x.csv", "existing folder"),
    ("--tta 0.5", "--tta", "", ""),
    ("--ta", "--ta", "", "argument"),
    ("loudly", "loudly", "", ""),
]


def refusal(capsys, *arguments):
    """The one line that a refused command prints."""
    assert main(arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1 and printed.err.endswith("\n")
    return printed.err


@pytest.mark.parametrize(("arguments", "field", "value", "allowed"), REFUSED, ids=[case[0] for case in REFUSED])
def test_it_is_refused_in_one_line(capsys, arguments, field, value, allowed):
    line = refusal(capsys, "simulate", *arguments.split())
    assert line.startswith("vocalis: ") and field in line and value in line and allowed in line


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("{'ta': 1}", "not JSON"),
        ("", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[1]", "list, not an object"),
        ("null", "NoneType, not an object"),
        ('{"activation": {"ta": NaN}}', "activation.ta: nan is not finite"),
        ('{"activation": {"ta": "0.4"}}', "activation.ta: '0.4' is not a number"),
        ('{"run": {"nx": 1e6}}', "run.nx"),
    ],
    ids=["single quotes", "empty", "deep", "list", "null", "NaN", "text", "grid"],
)
def test_a_request_that_cannot_be_read_is_refused_with_the_reason(capsys, monkeypatch, text, what):
    monkeypatch.setattr("sys.stdin", io.StringIO(text))
    assert what in refusal(capsys, "simulate", "--request", "-")


def test_a_file_that_is_not_text_is_refused(capsys, tmp_path):
    path = tmp_path / "request.json"
    path.write_bytes(b"\xff\xfe\x00")
    assert "UTF-8" in refusal(capsys, "posture", "--request", str(path))


def test_an_unwritable_file_is_found_out_before_the_run(capsys, monkeypatch):
    monkeypatch.setattr("vocalis.cli.simulate.simulate_watched", lambda request: pytest.fail("the run started"))
    assert "/no/such/folder" in refusal(capsys, "simulate", "--wav", "/no/such/folder/x.wav")


def test_a_full_disk_is_reported_in_one_line(capsys, monkeypatch, tmp_path):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("vocalis.cli.simulate.write_netcdf", full)
    assert main(["simulate", "--duration", "0.05", "--json", "--netcdf", str(tmp_path / "x.nc")]) == 2
    assert "--netcdf" in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize("command", ["posture", "static", "simulate"])
def test_an_unknown_command_or_field_is_refused_everywhere(capsys, command):
    assert "activation.ta" in refusal(capsys, command, "--ta", "2")
    assert command + "s" in refusal(capsys, command + "s")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--posture-set palaparthi2019 --set constants.kappa_n_m_rad=1e-5", "no posture"),
        ("--set constants.K_coup_max_pa_m=1e4 --set constants.C_coup_pa_s_m=0 --pressure 5000", "diverged"),
    ],
)
def test_a_request_without_an_answer_ends_with_code_1(capsys, arguments, sentence):
    assert main(["simulate", *arguments.split()]) == 1
    printed = capsys.readouterr()
    assert printed.out == "" and printed.err.count("\n") == 1 and sentence in printed.err
