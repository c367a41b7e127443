"""The norms: how a number is judged, how flow is measured, what the command and docs/human.md say."""

import json
from math import nan

import numpy as np
import pytest

from tests.support.inline_pool import InlinePool
from vfcore.constants import FoldConstants
from vfcore.request import simulation_from_dict, simulation_to_dict
from vfcore.variants import VARIANTS
from vfcore.version import MODEL_VERSION
from vocalis_cli.main import main
from vocalis_norms import calibration
from vocalis_norms.efforts import requests
from vocalis_norms.norms import FIFTEEN, NORMS
from vocalis_norms.page import tables
from vocalis_norms.score import answer, judge, judged, score_variant
from vocalis_norms.ship import MADE, PAGE, shipped
from vocalis_norms.voice import flow_measures
from vocalis_paper.report_text import filled

RATE = 35000.0
DOCUMENTS = {name: shipped(name) for name in MADE}


def test_fifteen_norms_of_normal_effort_each_with_source_and_range():
    assert len(FIFTEEN) == 15 and set(FIFTEEN) < set(NORMS)
    for norm in NORMS.values():
        assert norm.low < norm.high and norm.unit and len(norm.source) > 10 and norm.measured


def test_a_number_in_range_passes_and_one_beyond_says_by_how_much():
    norm = NORMS["fo"]
    assert judge(norm, norm.high)[0] == "pass"
    assert judge(norm, norm.high + 12.0) == ("deviation", "+12 Hz")
    assert judge(norm, norm.low - 3.0) == ("deviation", "-3 Hz")
    assert judge(norm, nan)[0] == "fail"


def test_flow_of_a_pulse_train_is_measured_cycle_by_cycle():
    """Triangular pulses of 0.3 L/s over a leak of 0.1 L/s: 60 % open, rising twice as long as falling, 125 Hz."""
    phase = np.arange(int(0.5 * RATE)) / RATE * 125.0 % 1.0
    pulse = np.interp(phase, [0.0, 0.4, 0.6, 1.0], [0.0, 1.0, 0.0, 0.0])
    found = flow_measures((0.1 + 0.3 * pulse) * 1e-3, RATE, 125.0)
    assert found.ac_ml_s == pytest.approx(300, rel=0.06) and found.min_ml_s == pytest.approx(100, abs=1)
    assert found.mfdr_l_s2 == pytest.approx(0.3 / (0.2 / 125), rel=0.03)
    assert found.open_quotient == pytest.approx(0.6 * 0.8, abs=0.02) and found.speed_quotient == pytest.approx(
        2, rel=0.1
    )


def test_a_mask_does_not_see_the_fastest_fall():
    wave = np.sin(2 * np.pi * 100 * np.arange(17500) / RATE) + 0.2 * np.sin(2 * np.pi * 4000 * np.arange(17500) / RATE)
    assert flow_measures(wave * 1e-4, RATE, 100.0).mfdr_l_s2 == pytest.approx(2 * np.pi * 100 * 0.1, rel=0.03)


def test_a_run_without_an_answer_has_no_numbers():
    impossible = simulation_from_dict({"posture": {"strain": -0.45}, "run": {"duration_s": 0.05}})
    runs = dict.fromkeys(requests(impossible), answer(impossible))
    assert all(row["value"] is None or row["verdict"] != "pass" for row in judged(runs)["norms"].values())


def test_human_changes_constants_only_and_says_why():
    for name in ("human", "human_female"):
        variant = VARIANTS[name]
        paper = VARIANTS["paper"]
        assert (variant.posture_set, variant.coupling_gradient, variant.shear) == (
            paper.posture_set, paper.coupling_gradient, paper.shear,
        )  # fmt: skip
        for change in variant.changes:
            assert change.value != getattr(FoldConstants(), change.name) and len(change.why) > 20


def test_a_variant_and_overrides_survive_the_round_trip_of_a_request():
    document = {"model": {"variant": "human", "coupling": "two_way"}, "constants": {"C_coup_pa_s_m": 500}}
    request = simulation_from_dict(document)
    assert request.constants.C_coup_pa_s_m == 500
    assert request.constants.A_muc_0_m2 == VARIANTS["human"].overrides["A_muc_0_m2"]
    echoed = simulation_to_dict(request)
    assert echoed["constants"] == {"C_coup_pa_s_m": 500} and simulation_from_dict(echoed) == request


def test_the_human_voice_meets_the_norms_it_is_shipped_with():
    """At least 12 of 15, and the shipped numbers, on this machine."""
    found = score_variant("human", None, InlinePool())
    kept = DOCUMENTS["norms"]["columns"]["human, two_way"]
    assert found["in_range"] >= 12
    for key in FIFTEEN:
        assert found["norms"][key]["value"] == pytest.approx(kept["norms"][key]["value"], rel=0.01, abs=0.5), key


def candidate(in_range: int, verdicts: str | None, distance: float = 1.0) -> calibration.Candidate:
    """A candidate that meets ``in_range`` norms; ``verdicts``: p, d and f for the claims, in order."""
    words = {"p": "pass", "d": "deviation", "f": "fail"}
    claims = None if verdicts is None else {str(k): words[v] for k, v in enumerate(verdicts)}
    return calibration.Candidate({}, {"in_range": in_range}, distance, claims)


def test_the_study_ranks_by_the_wanted_norms_then_by_claims():
    order = [
        candidate(12, "pppd"), candidate(13, "ppdd"), candidate(13, "pppf"), candidate(15, "ppff", 0.5),
        candidate(15, "ppff", 0.6), candidate(11, "pppp"), candidate(9, None, 0.1),
    ]  # fmt: skip
    mixed = [order[k] for k in (4, 6, 2, 0, 5, 3, 1)]
    assert sorted(mixed, key=lambda one: one.rank) == order


def test_the_front_holds_what_nothing_beats_once_and_only_what_was_judged():
    best = [candidate(13, "ppff"), candidate(13, "pfdd"), candidate(12, "pppd")]
    beaten = [candidate(12, "ppff"), candidate(11, "pppd"), candidate(13, "pfff"), candidate(12, "pppd"),
              candidate(14, None)]  # fmt: skip
    assert calibration.front([*best, *beaten]) == best


def test_a_candidate_with_too_few_norms_is_not_asked_for_claims():
    pool = InlinePool()
    poor = candidate(calibration.ENOUGH - 1, None)
    assert calibration.with_claims(poor, pool) is poor and pool.calls == 0


def test_the_study_stays_in_its_box():
    first, second = (calibration.design(calibration.FACTORS, 8, seed) for seed in (1, 1))
    assert first == second
    for values in first:
        assert all(f.low <= values[f.name] <= f.high for f in calibration.FACTORS)
    for small, whole in zip(calibration.around(first[0], calibration.FACTORS, 0.4), calibration.FACTORS, strict=True):
        assert whole.low <= small.low <= first[0][small.name] <= small.high <= whole.high
        assert small.high / small.low <= (whole.high / whole.low) ** 0.4 * (1 + 1e-9)


def test_the_shipped_study_is_in_order_and_its_front_is_one():
    def counts(one):
        verdicts = list((one["claims"] or {}).values())
        return one["in_range"], verdicts.count("pass"), verdicts.count("fail")

    best, front = ([counts(one) for one in DOCUMENTS["calibration"][name]] for name in ("best", "front"))
    wanted = calibration.WANTED
    ranks = [(max(wanted - norms, 0), fails, -passes) for norms, passes, fails in best]
    assert ranks == sorted(ranks) and best[0][0] >= wanted
    assert len(set(front)) == len(front)
    for norms, passes, fails in front:
        assert not any(n >= norms and p > passes and f < fails for n, p, f in front)


def test_the_variant_lies_in_the_box_of_the_study():
    """Each constant of the study, and no other is changed."""
    own, paper = VARIANTS["human"].constants(), FoldConstants()
    low, high = (getattr(own, f"K_coup_{end}_pa_m") / getattr(paper, f"K_coup_{end}_pa_m") for end in ("min", "max"))
    values = {"K_coup_level": (low * high) ** 0.5, "K_coup_contrast": high / low}
    for f in calibration.CONSTANTS:
        assert f.low <= (values[f.name] if f.name in values else getattr(own, f.name)) <= f.high, f.name
    studied = {f.name for f in calibration.CONSTANTS} | {"K_coup_min_pa_m", "K_coup_max_pa_m"}
    assert set(VARIANTS["human"].overrides) <= studied


def test_human_keeps_as_many_of_the_papers_claims_as_its_coupling_leaves_the_paper():
    """With two-way coupling no more claims fail than with the paper's own constants."""
    scores = {name: column["score"] for name, column in DOCUMENTS["claims"]["columns"].items()}
    assert scores["human, two_way"]["fail"] <= scores["paper, two_way"]["fail"]


def test_docs_say_what_is_shipped_and_it_belongs_to_this_model():
    text = PAGE.read_text(encoding="utf-8")
    assert filled(text, tables(DOCUMENTS)) == text, "run `python -m vocalis_norms.ship --text`"
    for name, document in DOCUMENTS.items():
        assert document["provenance"]["model_version"] == MODEL_VERSION, f"{name}: run `python -m vocalis_norms.ship`"


@pytest.mark.parametrize(
    ("arguments", "named", "allowed"),
    [
        ("--variant mine", "--variant", "human"),
        ("--variant human --coupling both", "--coupling", "one_way | two_way"),
        ("--coupling two_way", "--coupling", "--variant"),
        ("--study --html x.html", "--html", "--study"),
        ("--json /no/such/folder/n.json", "--json", "existing folder"),
    ],
)
def test_what_cannot_be_used_ends_with_one_line_before_any_run(arguments, named, allowed, capsys):
    assert main(["norms", *arguments.split()]) == 2
    line = capsys.readouterr().err
    assert named in line and allowed in line and line.count("\n") == 1


def test_the_command_prints_and_writes_the_table(tmp_path, capsys):
    page, numbers = tmp_path / "n.html", tmp_path / "n.json"
    assert main(["norms", "--variant", "human", "--workers", "1", "--html", str(page), "--json", str(numbers)]) == 0
    shown = capsys.readouterr().out
    assert "of 15 norms of normal effort in range" in shown and "MFDR" in shown
    document = json.loads(numbers.read_text())
    assert list(document["columns"]) == ["human, two_way"] and len(document["norms"]) == len(NORMS)
    assert "Holmberg" in page.read_text() and page.read_text().count("<tr>") == len(NORMS) + 1
