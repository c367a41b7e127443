"""The lessons of the page against the model: every step is run, and the number of every sentence is checked."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from vfcore.airways.resonances import closed_glottis_formants
from vfcore.airways.tract import vowel_tract
from vfcore.runs.one import simulate
from vfcore.spec.paths import NUMBERS
from vfcore.spec.request import resolve

LESSONS = Path(__file__).parents[2] / "frontend" / "features" / "lessons"
PANELS = {"waves", "voice", "folds", "compare", "measures"}
INDEX = json.loads((LESSONS / "index.json").read_text(encoding="utf-8"))


def lesson(key: str) -> dict:
    return json.loads((LESSONS / f"{key}.json").read_text(encoding="utf-8"))


STEPS = [(row["key"], k) for row in INDEX for k in range(row["steps"])]


@cache
def outcome(key: str, step: int):
    """The run of one step: the default voice with the settings of the step."""
    request: dict = {"kind": "simulation", "run": {"duration_s": 0.5}}
    for path, value in lesson(key)["steps"][step]["set"].items():
        *way, leaf = path.split(".")
        place = request
        for part in way:
            place = place.setdefault(part, {})
        place[leaf] = value
    return simulate(resolve(request))


def test_the_index_lists_the_files_as_they_are():
    assert {f"{row['key']}.json" for row in INDEX} | {"index.json"} == {path.name for path in LESSONS.glob("*.json")}
    for row in INDEX:
        full = lesson(row["key"])
        assert row == {name: full[name] for name in ("key", "title", "about")} | {"steps": len(full["steps"])}
    assert len(INDEX) == 8


@pytest.mark.parametrize("key, step", STEPS)
def test_a_step_says_what_to_see_and_the_model_shows_it(key, step):
    step_shown = lesson(key)["steps"][step]
    assert step_shown["say"] and step_shown["see"] and step_shown["look"]["panel"] in PANELS
    assert set(step_shown["set"]) <= {*NUMBERS, "vowel"}
    assert step_shown["expect"], "a step without a checked sentence teaches nothing"
    for wanted in step_shown["expect"]:
        check(wanted, key, step)


def check(wanted: dict, key: str, step: int) -> None:
    found = outcome(key, step)
    if "state" in wanted:
        assert found.report.state == wanted["state"]
    elif "closure" in wanted:
        assert found.static.closure.pattern == wanted["closure"]
    elif "resonance" in wanted:
        between(resonance(found.request.vowel, wanted["resonance"]), wanted)
    elif "least_width_mm_at" in wanted:
        between(least_width_mm(found, wanted["least_width_mm_at"]), wanted)
    elif "inferior_edge_leads" in wanted:
        assert inferior_lead(found) > 0.02, "share of the cycle"
    else:
        value = found.report.measures[wanted["measure"]].value
        assert value is not None
        if "than_step" in wanted:
            change = value - outcome(key, wanted["than_step"]).report.measures[wanted["measure"]].value
            least = wanted["changes_by_at_least"]
            assert change * np.sign(least) >= abs(least), f"{wanted['measure']} changed by {change:g}"
        elif "same_as_step" in wanted:
            other = outcome(key, wanted["same_as_step"]).report.measures[wanted["measure"]].value
            assert value == pytest.approx(other, rel=1e-9)
        else:
            between(value, wanted)


def between(value: float, wanted: dict) -> None:
    assert wanted.get("above", -np.inf) < value < wanted.get("below", np.inf), value


def resonance(vowel: str, number: int) -> float:
    return closed_glottis_formants(vowel_tract(vowel), number).frequency_hz[number - 1]


def least_width_mm(result, level: float) -> float:
    """Smallest width of the glottis in the cycle at a fraction of the length, anterior 0."""
    nearest = (result.arrays["medial_plane_m"] - result.arrays["cycle_w_m"]).min(axis=2)
    narrow = 2e3 * np.maximum(nearest, 0).min(axis=0)
    return float(np.interp(level, np.linspace(0, 1, narrow.size), narrow))


def inferior_lead(result) -> float:
    """Fraction of the cycle by which the lower edge leads the upper at mid-length (lag of their best match)."""
    w = result.arrays["cycle_w_m"]
    upper, lower = (w[:, w.shape[1] // 2, row] - w[:, w.shape[1] // 2, row].mean() for row in (0, -1))
    match = [np.dot(np.roll(lower, shift), upper) for shift in range(len(w))]
    shift = int(np.argmax(match))
    return (shift if shift < len(w) / 2 else shift - len(w)) / len(w)
