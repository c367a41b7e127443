"""The study changes one choice at a time, pairs the helpful ones, and distinguishes better from worse."""

from dataclasses import replace

import pytest

from tests.support.inline_pool import InlinePool
from vfcore.runs.setup import prepare
from vfcore.spec.posture_sets import posture_set
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Activation, Simulation
from vocalis.studies.paper.cases import CASES
from vocalis.studies.paper.claims.claim import ClaimOutcome, Verdict
from vocalis.studies.paper.run.gather import Gathered, gather
from vocalis.studies.paper.study import designed
from vocalis.studies.paper.study.choices import CHOICES, DEFAULT, DESIGNED, Choice, both
from vocalis.studies.paper.study.designed import changes, promising, study_document
from vocalis.studies.paper.study.fold import with_reported_alpha
from vocalis.studies.paper.study.text import study_markdown


def row(name, **verdicts):
    counts = {v: list(verdicts.values()).count(v) for v in ("pass", "deviation", "fail")}
    return {"choice": name, "score": counts, "outcomes": {k: {"verdict": v} for k, v in verdicts.items()}}


DEFAULT_ROW = row("default", A1="deviation", P2="deviation", P3="fail")


@pytest.mark.parametrize("choice", CHOICES, ids=lambda choice: choice.name)
def test_a_choice_is_a_request_that_is_not_the_default(choice):
    changed = resolve(choice.change) != Simulation()
    assert changed or choice.level != DEFAULT.level or choice.fold is not DEFAULT.fold


def test_two_choices_at_once_keep_both_constants():
    at = {choice.name: choice for choice in CHOICES}
    pair = both(at["L_0 of the posturing 15 mm"], at["θ_0 0.239 rad"])
    request = resolve(pair.change)
    assert request.posturing.L_0_posture_m == 0.015 and request.constants.rest_angle_rad == 0.239
    assert resolve(at["θ_0 0.239 rad"].change).posturing.L_0_posture_m == 0.0173
    assert both(at["level at 30 cm"], at["vowel i"]).level == both(at["vowel i"], at["level at 30 cm"]).level
    assert both(at["vowel i"], at["level at 30 cm"]).level == "spl_30cm_db"


def test_pairs_are_made_of_the_best_choice_of_each_factor_that_matters():
    rows = [
        (DEFAULT, DEFAULT_ROW),
        (Choice("start", "a", {}), row("a", A1="pass", P2="deviation", P3="fail")),
        (Choice("start", "b", {}), row("b", A1="pass", P2="pass", P3="fail")),
        (Choice("vowel", "c", {}), row("c", A1="deviation", P2="deviation", P3="fail")),
        (Choice("set", "d", {}), row("d", A1="fail", P2="fail", P3="deviation")),
        (Choice("step", "e", {}, control=True), row("e", A1="pass", P2="pass", P3="pass")),
    ]
    assert [choice.takes for choice in promising(rows)] == ["b", "d"]


def test_changes_and_table_distinguish_better_from_worse():
    other = row("θ_0 0.2 rad", A1="pass", P2="fail", P3="fail")
    assert changes(other, DEFAULT_ROW) == [("A1", "deviation", "pass"), ("P2", "deviation", "fail")]
    line = study_markdown({"rows": [DEFAULT_ROW, other]}).splitlines()[-1]
    assert line == "| θ_0 0.2 rad | 1 | 0 | 2 | A1 pass | P2 fail |"


def test_the_study_runs_default_choices_and_pairs_on_coarse_maps(monkeypatch):
    asked = []

    def gathered(cases, pool, progress, level, fold):
        asked.append((cases["ct_ta_map"].base, len(cases["ct_ta_map"].requests()), level))
        return Gathered({}, [])

    def judged(evidence, claims):
        moved = asked[-1][0].vowel != "a" or asked[-1][2] != "spl_lips_db"
        return {key: ClaimOutcome(Verdict.PASS if moved else Verdict.FAIL, (), "") for key in claims}

    monkeypatch.setattr(designed, "gather", gathered)
    monkeypatch.setattr(designed, "judge", judged)
    monkeypatch.setattr(designed, "warm_up", lambda request: None)
    document = study_document(InlinePool())
    names = [one["choice"] for one in document["rows"]]
    assert names[0] == DEFAULT.name and names[len(CHOICES) + 1].startswith("level at 30 cm + vowel")
    assert len(names) == 1 + len(CHOICES) + 1 + len(DESIGNED)
    assert {cells for _, cells, _ in asked} == {121}
    assert "T1" not in document["rows"][0]["outcomes"] and len(document["rows"][0]["outcomes"]) == 28


def test_the_reported_alpha_stiffens_a_relaxed_stretched_fold_and_reaches_the_runs():
    """Secondary source: up to 27 % more; no change where TA is much stiffer than the ligament."""
    slack = Simulation(activation=Activation(lca=0.6, ia=0.6, ct=0.0, ta=0.0))
    tight = Simulation(activation=Activation(lca=0.6, ia=0.6, ct=0.0, ta=1.0))
    ratios = []
    for request in (slack, tight):
        text, reported = prepare(request), with_reported_alpha(request)
        assert reported.fold.coefficients.beam_tension_n == text.fold.coefficients.beam_tension_n
        mu = [one.fold.coefficients.bending_stiffness_n_m2 for one in (text, reported)]
        ratios.append(mu[1] / mu[0])
    assert 1.2 < ratios[0] < 1.28 and 1.0 < ratios[1] < 1.001
    case = {"static_ta": replace(CASES["static_ta"], base=slack)}
    shapes = [gather(case, InlinePool(), fold=f).evidence["static_ta"].w_b_m[0] for f in (prepare, with_reported_alpha)]
    assert abs(shapes[1] - shapes[0]).max() > 1e-7


def test_tissue_mixes_change_their_tissues_alone():
    at = {choice.name: choice for choice in CHOICES}
    request = resolve(at["posturing tissue TA and muc of alzamendi2020"].change)
    own, other = posture_set("serry2026"), posture_set("alzamendi2020")
    assert (request.posturing.ta, request.posturing.muc, request.posturing.lig) == (other.ta, other.muc, own.lig)
    assert resolve(DESIGNED[-1].change).posturing.L_0_posture_m == 0.015
