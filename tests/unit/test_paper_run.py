"""Runs without an answer are counted with their reason and never stop the others."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.inline_pool import InlinePool
from vfcore.runs.one import simulate
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Simulation
from vocalis.studies.paper import CASES, CLAIMS, Verdict
from vocalis.studies.paper.cases import MuscleAxis
from vocalis.studies.paper.run.gather import Failure, gather, gather_here, workers
from vocalis.studies.paper.run.score import cases_for, definitions_hash, judge, score

TOO_LONG_A_STEP = resolve({"run": {"time_step_s": 1e-3}})
NO_TENSION = resolve({"constants": {"sigma_1_muc_pa": 0, "sigma_2_muc_pa": 0}})
SHORT = resolve({"run": {"duration_s": 0.25}})


def small(key, *levels, base=SHORT):
    axes = tuple(MuscleAxis(axis.muscles, level) for axis, level in zip(CASES[key].axes, levels, strict=True))
    return {key: replace(CASES[key], axes=axes, base=base)}


def test_a_run_without_an_answer_is_a_cell_of_the_map_and_a_line_of_the_record():
    cases = small("ct_ta_map", (0.2, 0.3), (0.1, 0.2, 0.3), base=TOO_LONG_A_STEP)
    gathered = gather(cases, InlinePool())
    assert gathered.evidence["ct_ta_map"].state.tolist() == [["failed"] * 3] * 2
    assert np.isnan(gathered.evidence["ct_ta_map"].fo_hz).all()
    case, activation, reason = gathered.failures[3]
    assert len(gathered.failures) == 6 and case == "ct_ta_map"
    assert activation == "TA 0.1, CT 0.3, LCA 0.6, IA 0.6, PCA 0" and "run.time_step_s" in reason


def test_the_other_runs_of_a_map_continue():
    cases = small("ct_ta_map", (0.3,), (0.2, 0.4))
    requests = cases["ct_ta_map"].requests()
    one_bad = type("Case", (), {"kind": "map", "axes": cases["ct_ta_map"].axes})()
    one_bad.requests = lambda: [replace(requests[0], run=TOO_LONG_A_STEP.run), requests[1]]
    gathered = gather({"ct_ta_map": one_bad}, InlinePool())
    assert gathered.evidence["ct_ta_map"].state.tolist() == [["failed", "periodic"]]
    assert len(gathered.failures) == 1


def test_runs_in_this_process_give_the_same_evidence():
    """To 1e-5: batches round differently from single runs, and runs of 0.3 s have hardly settled."""
    cases = small("ct_ta_map", (0.3, 0.6), (0.2, 0.4)) | small("pca_sweep", (0.0, 0.5))
    cases |= {"modal": replace(CASES["modal"], base=SHORT)} | small("static_ct", (0.0, 0.5))
    here, there = gather_here(cases), gather(cases, InlinePool()).evidence
    assert set(here) == set(cases)
    for key, evidence in there.items():
        for mine, its in zip(here[key], evidence, strict=True):
            if getattr(mine, "dtype", np.dtype(object)).kind == "f":
                np.testing.assert_allclose(mine, its, rtol=1e-5, atol=0)
            else:
                np.testing.assert_equal(mine, its)
    lost = gather_here(small("ct_ta_map", (0.2, 0.3), (0.1,), base=TOO_LONG_A_STEP))
    assert lost["ct_ta_map"].state.tolist() == [["failed"], ["failed"]]


def test_a_claim_whose_run_has_no_answer_fails_with_the_reason():
    claims = {key: CLAIMS[key] for key in ("S5", "M1", "P4")}
    found = gather(cases_for(NO_TENSION, claims), InlinePool()).evidence
    outcomes = judge(found, claims)
    assert all(isinstance(one, Failure) for one in found.values())
    assert {outcome.verdict for outcome in outcomes.values()} == {Verdict.FAIL}
    assert all("membrane_tension" in outcome.sentence for outcome in outcomes.values())
    assert "CT 0: " in outcomes["S5"].sentence
    assert score(outcomes) == {"pass": 0, "deviation": 0, "fail": 3}


def test_the_map_holds_each_cell_at_its_own_ct_and_ta():
    maps = gather(small("ct_ta_map", (0.3, 0.6), (0.2, 0.4)), InlinePool()).evidence["ct_ta_map"]
    there = simulate(replace(SHORT, activation=replace(SHORT.activation, ct=0.6, ta=0.2, lca=0.6, ia=0.6)))
    assert maps.fo_hz[1, 0] == there.report.measures["fo_hz"].value
    assert len(np.unique(maps.fo_hz)) == 4


def test_the_level_can_be_that_at_30_cm():
    lips, far = (
        gather(small("ct_ta_map", (0.3,), (0.4,)), InlinePool(), level=level).evidence["ct_ta_map"].spl_lips_db[0, 0]
        for level in ("spl_lips_db", "spl_30cm_db")
    )
    assert 10 < lips - far < 60


def test_progress_counts_every_run_once():
    seen = []
    pool = InlinePool()
    gather(small("pca_sweep", (0.0, 0.5)), pool, lambda *step: seen.append(step))
    assert seen == [("pca_sweep", 1, 2), ("pca_sweep", 2, 2)] and pool.calls == 2


def test_only_the_runs_that_the_claims_need_are_run():
    assert list(cases_for(Simulation(), {"P4": CLAIMS["P4"]})) == ["pca_half", "pca_full"]
    assert list(cases_for(Simulation())) == list(CASES)


def test_timing_is_of_both_steps_and_not_left_to_the_workers():
    pool = InlinePool()
    timing = gather({"timing": replace(CASES["timing"], base=SHORT)}, pool).evidence["timing"]
    assert pool.calls == 0
    assert timing.simulated_s == SHORT.run.duration_s
    assert 0 < timing.wall_s_own_step < timing.wall_s_paper_step


def test_worker_processes_give_what_one_process_gives():
    cases = small("pca_sweep", (0.0, 0.5))
    with workers(2) as pool:
        apart = gather(cases, pool).evidence["pca_sweep"]
    here = gather(cases, InlinePool()).evidence["pca_sweep"]
    assert apart.contact_pressure_max_pa == pytest.approx(here.contact_pressure_max_pa, rel=1e-12)


def test_the_hash_follows_the_definitions_and_nothing_else(tmp_path):
    (tmp_path / "claims").mkdir()
    (tmp_path / "claims/static.py").write_text("LIMIT = 1\n")
    (tmp_path / "report.py").write_text("")
    before = definitions_hash(tmp_path)
    (tmp_path / "report.py").write_text("TITLE = 1\n")
    assert definitions_hash(tmp_path) == before
    (tmp_path / "claims/static.py").write_text("LIMIT = 2\n")
    assert definitions_hash(tmp_path) != before
