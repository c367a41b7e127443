"""Accessibility: axe finds nothing serious, a phone needs no horizontal scrolling."""

from pathlib import Path

import pytest

from tests.browser.conftest import DESKTOP, PHONE

AXE = (Path(__file__).parent / "vendor" / "axe.min.js").read_text(encoding="utf-8")


def findings(here, colours_only: bool = False) -> list[str]:
    """Serious and critical findings of axe on the page; only contrast, where the rest was checked before."""
    if not here.page.evaluate("'axe' in window"):
        here.page.evaluate(AXE)
    options = {"resultTypes": ["violations"]}
    if colours_only:
        options["runOnly"] = ["color-contrast"]
    answer = here.page.evaluate("options => axe.run(document, options)", options)
    return [
        f"{rule['id']}: {node['target']} {node['failureSummary']}"
        for rule in answer["violations"]
        if rule["impact"] in ("serious", "critical")
        for node in rule["nodes"]
    ]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_on_a_desktop(visit, scheme):
    here = visit("?activation.ct=0.5", color_scheme=scheme)
    colours = scheme == "dark"  # all else was checked in the light theme
    here.page.get_by_text("Advanced").click()
    assert findings(here, colours) == []
    here.page.keyboard.press("a")
    for panel in ("Spectrum", "Folds", "A / B", "Measures", "Lessons", "Runs"):
        here.page.get_by_role("tab", name=panel).click()
        assert findings(here, colours) == []
    here.page.get_by_role("tab", name="Lessons").click()
    here.page.locator(".lesson-row").first.click()
    here.page.wait_for_selector(".lesson-card")
    assert findings(here, colours) == []
    here.page.locator(".headline").first.click()
    here.page.get_by_role("dialog").wait_for()
    assert findings(here, colours) == []
    here.page.keyboard.press("Escape")
    for further, title in (("Report to print", "Report"), ("As Python or curl", "This voice as code")):
        here.page.get_by_role("button", name="Export").click()
        here.page.get_by_role("dialog", name="Export and share").wait_for()
        assert findings(here, colours) == []
        here.page.get_by_role("button", name=further).click()
        here.page.get_by_role("dialog", name=title).wait_for()
        assert findings(here, colours) == []
        here.page.keyboard.press("Escape")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_on_a_phone_and_nothing_is_wider_than_it(visit, scheme):
    here = visit(viewport=PHONE, has_touch=True, color_scheme=scheme)
    colours = scheme == "dark"
    here.page.keyboard.press("a")
    places = [
        "#tab-muscles",
        "#tab-waves",
        "#panel-voice",
        "#panel-folds",
        "#panel-compare",
        "#tab-numbers",
        "#tab-more",
    ]
    for tab in places:
        here.page.locator(tab).click()
        here.settle()
        assert here.page.evaluate("document.scrollingElement.scrollWidth") <= 390, tab
        assert findings(here, colours) == [], tab


def test_axe_finds_nothing_when_values_are_refused_or_nothing_vibrates(visit):
    here = visit("?activation.pca=1&subglottal_pressure_pa=100")
    assert here.state() == "No sustained vibration"
    assert findings(here) == []


def test_the_desktop_layout_fits_one_screen_without_scrolling(visit):
    here = visit(viewport=DESKTOP)
    sizes = here.page.evaluate(
        "[document.scrollingElement, ...document.querySelectorAll('.left, .panel, .strip, .centre')]"
        ".map((e) => [e.className || e.tagName, e.scrollHeight - e.clientHeight, e.scrollWidth - e.clientWidth])"
    )
    assert [size for size in sizes if size[1] > 1 or size[2] > 1] == []


#: Whether the sentence of the preset is fully inside the bar.
INSIDE = """() => {
  const [bar, line] = [".top", ".look-for"].map((name) => document.querySelector(name).getBoundingClientRect());
  return line.height > 0 && line.top >= bar.top && line.bottom <= bar.bottom;
}"""


def test_the_sentence_of_every_preset_is_fully_visible_on_every_desktop(visit):
    here = visit()
    presets = here.page.locator(".preset option").evaluate_all("all => all.map((option) => option.value)")
    assert len(presets) == 8
    for width, height in ((1440, 900), (1100, 700)):
        here.page.set_viewport_size({"width": width, "height": height})
        for preset in presets:
            here.page.locator(".preset select").select_option(preset)
            assert here.page.evaluate(INSIDE), (preset, width)
    here.settle()


def test_the_picture_of_the_folds_stays_on_top_on_a_phone(visit):
    here = visit(viewport=PHONE, has_touch=True)
    here.page.mouse.wheel(0, 600)
    here.page.wait_for_timeout(200)
    assert here.page.evaluate("scrollY") > 200
    box = here.page.locator("canvas[data-picture=stage]").bounding_box()
    tabs = here.page.get_by_role("tablist").bounding_box()
    assert box["y"] >= 0 and tabs["y"] < 844 / 2 + 60, "folds and tabs are still visible"


def test_the_state_is_announced_once_the_controls_rest(visit):
    here = visit()
    live = here.page.locator("[aria-live=polite]")
    live.filter(has_text="Periodic phonation, 150 hertz, 101 decibels").wait_for(state="attached")
    here.page.get_by_label("Voice").select_option("no_phonation")
    live.filter(has_text="No sustained vibration.").wait_for(state="attached")
