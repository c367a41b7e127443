"""All eight lessons, walked step by step: the hand is where the step says, what it speaks of is shown and true."""

import json
import re
from pathlib import Path

import pytest

from tests.browser.conftest import DESK, PHONE

LESSONS = Path(__file__).parents[2] / "frontend" / "lessons"
INDEX = json.loads((LESSONS / "index.json").read_text(encoding="utf-8"))
STATES = {"periodic": "Periodic phonation", "none": "No sustained vibration"}
#: On a phone the tab a panel stands under.
TAB = {"measures": "numbers", "waves": "waves", "voice": "waves", "folds": "waves"}
#: What a step shows; with ``answered``, once the voice it set has answered.
SHOWN = """async (answered) => {
  const { changedValues } = await import("/params.js");
  const { schema, values } = await import("/state/request.js");
  const frame = () => new Promise(requestAnimationFrame);
  while (answered && document.body.getAttribute("aria-busy") !== "false") await frame();
  const all = (selector) => [...document.querySelectorAll(selector)];
  while (!all("#panel-content > *, #tab-content > *").length) await frame();
  return {
    set: changedValues(schema.value, values.value),
    state: document.querySelector(".phonation-state").textContent,
    cut: all(".lesson-words, .lesson-card").some((e) => e.scrollHeight > e.clientHeight + 1),
    inView: document.querySelector(".lesson-actions").getBoundingClientRect().bottom <= innerHeight,
    words: document.querySelector(".lesson-words").textContent,
    numbers: Object.fromEntries(all(".lesson-numbers > div").map((e) => [e.dataset.measure, e.lastChild.textContent])),
    chosen: all("[role=tab][aria-selected=true]").map((e) => e.id),
  };
}"""


def number(text: str) -> float:
    return float(re.match(r"[\d.−\u202f]+", text)[0].replace("\u202f", "").replace("−", "-"))


@pytest.mark.parametrize("viewport", [DESK, PHONE], ids=["desk", "phone"])
def test_the_eight_lessons_show_what_they_speak_of(visit, viewport):
    """What the voices do is the same at both sizes and is waited for on the desk."""
    here = visit(viewport=viewport)
    here.page.locator("#tab-more" if viewport is PHONE else "#panel-lessons").click()
    defaults = {row["key"]: row["default"] for row in here.api("parameters")["parameters"]}
    assert len(INDEX) == 8
    for entry in INDEX:
        lesson = json.loads((LESSONS / f"{entry['key']}.json").read_text(encoding="utf-8"))
        here.page.locator(".lesson-row", has_text=lesson["title"]).click()
        for k, step in enumerate(lesson["steps"]):
            where = f"{lesson['key']}, step {k}"
            here.page.wait_for_selector(f".lesson-card[data-lesson={lesson['key']}][data-step='{k}']")
            seen = here.page.evaluate(SHOWN, viewport is DESK)
            assert seen["set"] == {path: value for path, value in step["set"].items() if value != defaults[path]}, where
            assert step["say"] in seen["words"] and step["see"] in seen["words"], where
            assert not seen["cut"] and seen["inView"], f"{where}: all of it can be read"
            panel = step["look"]["panel"]
            wanted = f"tab-{TAB[panel]}" if viewport is PHONE else f"panel-{panel}"
            assert wanted in seen["chosen"], where
            if viewport is PHONE and TAB[panel] == "waves":
                assert f"panel-{panel}" in seen["chosen"], where
            for claim in step["expect"] if viewport is DESK else ():
                if "state" in claim:
                    assert seen["state"] == STATES[claim["state"]], where
                if "measure" in claim:
                    value = number(seen["numbers"][claim["measure"]])
                    margin = 0.005 * abs(value)  # what is shown is rounded
                    assert value + margin > claim.get("above", -1e99), where
                    assert value - margin < claim.get("below", 1e99), where
            last = k == len(lesson["steps"]) - 1
            here.page.get_by_role("button", name="Finish" if last else "Next").click()
        here.page.wait_for_selector(".lesson-card", state="detached")
    assert here.page.locator(".lesson-row").count() == 8, "back at the list"
