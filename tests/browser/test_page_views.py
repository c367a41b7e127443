"""More views: spectrum and tract, folds over time, two voices, history, lessons."""

import json
from pathlib import Path

import pytest

from tests.browser.conftest import DESKTOP, MOVING, PHONE

LESSONS = Path(__file__).parents[2] / "frontend" / "features" / "lessons"


def show(here, panel: str) -> None:
    """Open a panel, on a desktop or a phone, and wait until its pictures are painted."""
    if not here.page.locator(f"#panel-{panel}").count():
        here.page.locator("#tab-waves").click()
    here.page.locator(f"#panel-{panel}").click()
    here.painted()


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_the_spectrum_follows_voice_and_vowel(visit, viewport):
    here = visit(viewport=viewport)
    show(here, "voice")
    before = {name: here.picture(name) for name in ("spectrum", "spectrogram", "tract")}
    assert all(here.ink(name) > 0.01 for name in before)
    assert "671 · 947" in here.page.locator(".resonances").inner_text()
    if viewport == PHONE:
        here.page.locator("#tab-muscles").click()
    here.page.locator("input[name=vowel][value=i]").check(force=True)
    here.settle()
    show(here, "voice")
    assert "671 · 947" not in here.page.locator(".resonances").inner_text()
    assert [name for name in before if here.picture(name) == before[name]] == []


def test_expensive_pictures_wait_until_the_controls_rest(visit):
    here = visit()
    show(here, "voice")
    before = here.picture("spectrum")
    moved = here.page.evaluate(
        """async (before) => {
          const slider = document.querySelector("#control-activation-ct");
          const canvas = document.querySelector("canvas[data-picture=spectrum]");
          let changed = false;
          for (let k = 0; k < 20; k++) {
            slider.value = 0.3 + 0.02 * k;
            slider.dispatchEvent(new Event("input", { bubbles: true }));
            await new Promise((done) => setTimeout(done, 50));
            changed ||= canvas.toDataURL() !== before;
          }
          return changed;
        }""",
        before,
    )
    assert not moved, "nothing expensive is painted during a drag"
    here.painted()
    assert here.picture("spectrum") != before


def moment(percent: int) -> str:
    """Label of the one of six moments of the cycle that contains a phase."""
    return f"Look at {round(100 * (percent * 6 // 100 + 0.5) / 6)} % of the cycle"


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_kymogram_levels_and_the_shared_cursor(visit, viewport):
    here = visit("?activation.lca=0.4", viewport=viewport)
    show(here, "folds")
    middle = here.picture("kymogram")
    assert here.ink("kymogram") > 0.1 and here.ink("vibrogram") > 0.1
    here.page.get_by_role("button", name="80 %").click()
    here.settle()
    assert here.picture("kymogram") != middle
    field = here.page.locator("[data-picture=vibrogram-cursor]")
    field.scroll_into_view_if_needed()
    box = field.bounding_box()
    here.page.mouse.click(box["x"] + 0.6 * box["width"], box["y"] + 0.5 * box["height"])
    here.settle()
    held = int(here.page.locator(".percent").inner_text().strip(" %\u2007"))
    here.page.wait_for_timeout(200)
    assert held == int(here.page.locator(".percent").inner_text().strip(" %\u2007")), "the phase is held"
    assert here.ink("cycle-strip") > 0.1
    assert here.page.locator(".moments [aria-pressed=true]").get_attribute("aria-label") == moment(held)
    lines = here.page.locator("[data-picture=kymogram-cursor] i")
    places = lines.evaluate_all("all => all.map((line) => line.getBoundingClientRect().left)")
    cycle = places[1] - places[0]
    start = here.page.locator("[data-picture=kymogram-cursor]").bounding_box()["x"]
    rem = here.page.evaluate("parseFloat(getComputedStyle(document.documentElement).fontSize)")
    assert (places[0] - start - 2.9 * rem) / cycle == pytest.approx(held / 100, abs=0.02), "one cursor for all views"


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_a_and_b_side_by_side_as_difference_and_to_hear(visit, viewport):
    here = visit("?activation.pca=0.5", viewport=viewport)
    here.page.keyboard.press("a")
    here.page.locator("[aria-live=polite]", has_text="A is held").first.wait_for(state="attached")
    if viewport == PHONE:
        here.page.locator("#tab-muscles").click()
    here.set("activation.lca", 1)
    show(here, "compare")
    gap = here.page.locator("tr[data-compared=gap_mm]").inner_text().split("\t")
    assert gap[1:] == ["5.80 mm", "4.78 mm", "−1.02"]
    assert here.page.locator("tr.setting").inner_text().split("\t")[:3] == ["Lateral cricoarytenoid", "0.80", "1.00"]
    both = here.picture("compare")
    here.page.get_by_role("button", name="Difference").click()
    here.settle()
    assert here.picture("compare") != both
    here.page.locator(".compare").get_by_role("button", name="Folds").click()
    here.hold_still(100)
    closed = here.picture("compare-folds")
    here.hold_still(900)
    assert here.ink("compare-folds") > 0.2 and here.picture("compare-folds") != closed, "both at the shared phase"
    here.page.get_by_role("button", name="In turn").click()
    here.page.get_by_role("button", name="Stop", exact=True).first.wait_for()
    here.page.locator(".compare-hear").get_by_role("button", name="Stop").click()
    here.page.locator("h1").click()
    here.page.keyboard.press("b")
    if viewport == PHONE:
        here.page.locator("#tab-muscles").click()
    here.set("activation.ct", 0.8)
    show(here, "compare")
    assert here.page.locator("tr[data-compared=gap_mm]").inner_text().split("\t") == gap, "B is held too"
    here.page.get_by_role("button", name="Go back to A").click()
    here.settle()
    here.page.wait_for_url("**/?activation.pca=0.5")


def test_undo_and_redo_step_through_the_voices_of_the_visit(visit):
    here = visit()
    here.painted()
    for path, value in (("activation.ct", 0.6), ("activation.ta", 0.1)):
        here.set(path, value)
        here.painted()
    here.page.locator("h1").click()
    here.page.keyboard.press("Control+z")
    here.settle()
    assert here.typed("Thyroarytenoid (TA)").input_value() == "0.40"
    assert here.typed("Cricothyroid (CT)").input_value() == "0.60"
    here.page.keyboard.press("Control+z")
    here.settle()
    assert here.page.get_by_label("Voice").locator("option:checked").inner_text() == "Modal voice"
    here.page.keyboard.press("Control+Shift+z")
    here.page.keyboard.press("Control+Shift+z")
    here.settle()
    assert here.typed("Thyroarytenoid (TA)").input_value() == "0.10"
    show(here, "run")
    assert here.page.locator(".history b").all_inner_texts() == ["TA 0.10", "CT 0.60", "Modal voice"]
    here.page.locator(".history button").last.click()
    here.settle()
    assert here.typed("Cricothyroid (CT)").input_value() == "0.30"


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_a_lesson_sets_the_model_and_describes_what_to_see(visit, viewport):
    here = visit(viewport=viewport)
    if viewport == PHONE:
        here.page.locator("#tab-more").click()
    else:
        here.page.locator("#panel-lessons").click()
    lesson = json.loads((LESSONS / "why-voice-stops.json").read_text(encoding="utf-8"))
    here.page.locator(".lesson-row").nth(7).wait_for()
    here.page.locator(".lesson-row", has_text=lesson["title"]).click()
    here.page.wait_for_selector(".lesson-card[data-step='0']")
    for k in range(1, 3):
        here.page.get_by_role("button", name="Next").click()
        here.page.wait_for_selector(f".lesson-card[data-step='{k}']")
    here.settle()
    assert lesson["steps"][2]["see"] in here.page.locator(".lesson-words").inner_text()
    assert here.state() == "No sustained vibration"
    here.page.get_by_role("button", name="Back", exact=True).click()
    here.settle()
    assert here.state() == "Periodic phonation"
    here.page.get_by_role("button", name="All lessons").click()
    here.page.wait_for_selector(".lesson-card", state="detached")


def test_the_strobe_shows_as_many_cycles_a_second_at_any_pitch(visit):
    """Rate over the displayed time: after a pause of over 100 ms, as on a busy machine, the motion continues where it
    was.
    """
    here = visit(**MOVING)
    here.page.locator(".speed select").select_option("strobe 1")
    rate, steps = here.page.evaluate(
        """async () => {
          const { phase } = await import("/state/motion.js");
          let last = phase.peek(), before = null, turned = 0, shownMs = 0, steps = 0;
          const stop = phase.subscribe((now) => {
            if (now === last) return;
            const at = performance.now();
            if (before !== null) {
              turned += now - last - Math.floor(now - last);
              shownMs += Math.min(at - before, 100);
            }
            steps++;
            [last, before] = [now, at];
          });
          await new Promise((done) => setTimeout(done, 1500));
          stop();
          return [turned / (shownMs / 1e3), steps];
        }"""
    )
    assert rate == pytest.approx(1, abs=0.2)
    assert 5 < steps <= 40, "flashes, not a film"


def test_when_the_motion_stops_the_numbers_are_those_of_the_picture(visit):
    here = visit()
    apart = here.page.evaluate(
        """async () => {
          const { phase, readout, setMoving } = await import("/state/motion.js");
          const apart = [];
          for (let k = 0; k < 8; k++) {
            setMoving(true);
            await new Promise((done) => setTimeout(done, 170 + 13 * k));
            setMoving(false);
            apart.push(Math.abs(readout.peek() - phase.peek()));
          }
          return apart;
        }"""
    )
    assert apart == [0] * 8
