"""All eight lessons, step by step: the controls are set, and what the text describes is shown and true."""

import json
import re
from pathlib import Path

import pytest

from tests.browser.conftest import DESKTOP, PHONE

LESSONS = Path(__file__).parents[2] / "frontend" / "features" / "lessons"
INDEX = json.loads((LESSONS / "index.json").read_text(encoding="utf-8"))
STATES = {"periodic": "Periodic phonation", "none": "No sustained vibration"}
#: The tab of a panel on a phone.
TAB = {"measures": "numbers", "waves": "waves", "voice": "waves", "folds": "waves"}
#: Steps through a lesson of `steps` steps with its button and returns what each shows; with `answered`, after its
#: result.
WALK = """async ([key, steps, answered]) => {
  const { patch } = await import("/state/request.js");
  const all = (selector) => [...document.querySelectorAll(selector)];
  const until = async (holds) => { while (!holds()) await new Promise(requestAnimationFrame); };
  const seen = [];
  for (let k = 0; k < steps; k++) {
    await until(() => all(`.lesson-card[data-lesson=${key}][data-step="${k}"]`).length);
    await until(() => !answered || document.body.getAttribute("aria-busy") === "false");
    await until(() => all("#panel-content > *, #tab-content > *").length);
    const actions = document.querySelector(".lesson-actions");
    seen.push({
      set: patch.value,
      state: document.querySelector(".phonation-state").textContent,
      cut: all(".lesson-words, .lesson-card").some((e) => e.scrollHeight > e.clientHeight + 1),
      inView: actions.getBoundingClientRect().bottom <= innerHeight,
      words: document.querySelector(".lesson-words").textContent,
      numbers: Object.fromEntries(
        all(".lesson-numbers > div").map((e) => [e.dataset.measure, e.lastChild.textContent])),
      chosen: all("[role=tab][aria-selected=true]").map((e) => e.id),
      button: actions.querySelector(".primary").textContent,
    });
    actions.querySelector(".primary").click();
  }
  await until(() => !all(".lesson-card").length);
  return seen;
}"""


def number(text: str) -> float:
    return float(re.match(r"[\d.−\u202f]+", text)[0].replace("\u202f", "").replace("−", "-"))


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_the_eight_lessons_show_what_they_describe(visit, viewport):
    """The results are the same at both sizes, so only the desktop waits for them."""
    here = visit(viewport=viewport)
    here.page.locator("#tab-more" if viewport is PHONE else "#panel-lessons").click()
    defaults = {row["key"]: row["default"] for row in here.api("parameters")["parameters"]}
    assert len(INDEX) == 8
    for entry in INDEX:
        lesson = json.loads((LESSONS / f"{entry['key']}.json").read_text(encoding="utf-8"))
        here.page.locator(".lesson-row", has_text=lesson["title"]).click()
        walked = here.page.evaluate(WALK, [lesson["key"], len(lesson["steps"]), viewport is DESKTOP])
        assert [seen["button"] for seen in walked] == ["Next"] * (len(walked) - 1) + ["Finish"]
        for k, (step, seen) in enumerate(zip(lesson["steps"], walked, strict=True)):
            where = f"{lesson['key']}, step {k}"
            assert seen["set"] == {path: v for path, v in step["set"].items() if v != defaults[path]}, where
            assert step["say"] in seen["words"] and step["see"] in seen["words"], where
            assert not seen["cut"] and seen["inView"], f"{where}: all text is visible"
            panel = step["look"]["panel"]
            wanted = f"tab-{TAB[panel]}" if viewport is PHONE else f"panel-{panel}"
            assert wanted in seen["chosen"], where
            if viewport is PHONE and TAB[panel] == "waves":
                assert f"panel-{panel}" in seen["chosen"], where
            for claim in step["expect"] if viewport is DESKTOP else ():
                if "state" in claim:
                    assert seen["state"] == STATES[claim["state"]], where
                if "measure" in claim:
                    value = number(seen["numbers"][claim["measure"]])
                    margin = 0.005 * abs(value)  # what is shown is rounded
                    assert value + margin > claim.get("above", -1e99), where
                    assert value - margin < claim.get("below", 1e99), where
    assert here.page.locator(".lesson-row").count() == 8, "back at the list"
