"""The map over two parameters: it fills, can be read and compared, opens its voices, and can be stopped."""

import re

import pytest

from tests.browser.conftest import DESKTOP, PHONE
from tests.browser.test_page_access import findings

SHOWN = "document.querySelector('[data-plot=map]').data[0].z.flat()"
#: The place of a point of the map on the page.
PLACE_OF = """([right, up]) => {
  const plot = document.querySelector("[data-plot=map]");
  const { xaxis, yaxis } = plot._fullLayout;
  const box = plot.getBoundingClientRect();
  return [box.x + xaxis._offset + xaxis.l2p(right), box.y + yaxis._offset + yaxis.l2p(up)];
}"""
#: The pitches behind the pad, once half of the map has arrived.
PAD_PITCHES = """async () => {
  const { padMap } = await import("/features/play/pad-map.js");
  const many = () => padMap.value?.fo.filter((pitch) => pitch !== null).length > 60;
  while (!many()) await new Promise((resolve) => setTimeout(resolve, 50));
  return padMap.value.fo;
}"""
SIZES = pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])


def open_map(visit, steps: int = 3, query: str = "", **context):
    here = visit(f"?map{query}", **context)
    for direction in ("Up", "To the right"):
        field = here.page.get_by_role("textbox", name=f"{direction}: steps")
        field.fill(str(steps))
        field.press("Tab")
    return here


def make(here) -> None:
    here.page.get_by_role("button", name="Make").click()
    here.page.locator(".map-files").wait_for()
    here.page.wait_for_function("() => document.querySelector('[data-plot=map] .main-svg')")
    here.page.locator(".map-run progress").wait_for(state="detached")


@SIZES
def test_a_map_fills_and_is_open_to_all(visit, viewport):
    here = open_map(visit, viewport=viewport, color_scheme="dark" if viewport is PHONE else "light")
    make(here)
    pitches = here.page.evaluate(SHOWN)
    known = [value for value in pitches if value is not None]
    assert len(pitches) == 9
    assert len(known) >= 6
    assert all(80 < value < 300 for value in known)
    assert here.page.evaluate("document.scrollingElement.scrollWidth") <= viewport["width"]
    assert findings(here) == []
    assert "map=" in here.page.url

    here.page.locator(".map-tools select").select_option("mean_flow_ml_s")
    here.page.wait_for_function(f"() => Math.max(...{SHOWN}) > 400")
    assert here.page.locator(".map-title").inner_text() == "Mean flow (mL/s)"


@SIZES
def test_a_cell_opens_its_voice(visit, viewport):
    here = open_map(visit, viewport=viewport)
    make(here)
    here.page.locator("[data-plot=map]").scroll_into_view_if_needed()
    x, y = here.page.evaluate(PLACE_OF, [0.5, 0.5])
    here.page.mouse.move(x - 3, y)
    here.page.mouse.move(x, y)
    here.page.wait_for_timeout(200)
    here.page.mouse.click(x, y)
    here.page.wait_for_url(lambda address: "activation.ct=0.5" in address and "activation.ta=0.5" in address)

    choice = here.page.get_by_role("group", name="Choose a cell")
    choice.get_by_label("CT").select_option(label="1")
    choice.get_by_label("TA").select_option(label="0")
    assert "Hz" in choice.locator("output").inner_text()
    choice.get_by_role("button", name="Load this voice").press("Enter")
    here.page.wait_for_url(lambda address: "activation.ct=1" in address and "activation.ta=0" in address)


def test_a_map_follows_the_controls_is_compared_and_exported(visit):
    here = open_map(visit)
    make(here)
    before = here.page.evaluate(SHOWN)
    here.page.get_by_role("button", name="Hold as A").click()
    here.page.get_by_label("Follow the other sliders").check()
    here.set("subglottal_pressure_pa", 1300)
    here.page.wait_for_function(f"before => JSON.stringify({SHOWN}) !== JSON.stringify(before)", arg=before)
    here.page.locator(".map-run progress").wait_for(state="detached")
    after = here.page.evaluate(SHOWN)
    here.page.get_by_role("button", name="B − A").click()
    here.page.wait_for_function("() => document.querySelector('.map-title').innerText.startsWith('B − A')")
    wanted = [None if None in pair else pair[1] - pair[0] for pair in zip(before, after, strict=True)]
    assert here.page.evaluate(SHOWN) == wanted
    scale = here.page.evaluate("(({ zmin, zmax }) => [zmin, zmax])(document.querySelector('[data-plot=map]').data[0])")
    assert scale[0] == -scale[1]
    with here.page.expect_download() as download:
        here.page.get_by_role("link", name="CSV").click()
    rows = [line for line in download.value.path().read_text().splitlines() if line and not line.startswith("#")]
    assert len(rows) == 10
    assert "fo_hz" in rows[0]
    here.page.get_by_role("button", name="Export", exact=True).click()
    figure = here.page.locator("[data-figure=map]")
    with here.page.expect_download() as download:
        figure.get_by_role("button", name="SVG").click()
    drawing = download.value.path().read_text()
    for words in ("B − A: Fundamental frequency (Hz)", "Cricothyroid (CT)", "Thyroarytenoid (TA)"):
        assert words in drawing
    with here.page.expect_download() as download:
        figure.get_by_role("button", name="PNG").click()
    assert download.value.path().read_bytes()[1:4] == b"PNG"


def test_a_long_map_can_be_stopped(visit):
    here = open_map(visit, steps=50, query="&convergence_angle_rad=0.021")
    here.page.get_by_role("button", name="Make the map").click()
    here.page.wait_for_function("() => document.querySelector('.map-run progress')?.value > 0")
    here.page.get_by_role("button", name="Cancel").click()
    here.page.get_by_role("button", name="Make it again").wait_for()
    here.page.wait_for_function("() => document.querySelector('[data-plot=map] .main-svg')")
    assert here.page.evaluate(f"{SHOWN}.some((value) => value === null)")
    newest = here.api("jobs?limit=1")["jobs"][0]
    assert newest["status"] == "dismissed"


def test_an_invalid_map_is_refused_with_the_reason(visit):
    here = open_map(visit)
    here.page.get_by_role("combobox", name="Up: parameter").select_option("activation.ta")
    here.page.get_by_role("button", name="Make the map").click()
    assert "must differ" in here.page.locator(".map-panel > .refusal").inner_text()
    here.page.get_by_role("combobox", name="Up: parameter").select_option("activation.ct")
    here.page.get_by_role("textbox", name="Up: to").fill("3")
    here.page.get_by_role("textbox", name="Up: to").press("Tab")
    here.expected = re.compile("422")
    here.page.get_by_role("button", name="Make the map").click()
    here.page.locator(".map-panel > .refusal").get_by_text("axes.0").wait_for()


def test_the_pad_has_a_map_of_pitch_behind_it(visit):
    here = visit()
    here.page.get_by_role("tab", name="Play").click()
    here.page.wait_for_timeout(200)
    bare = here.picture("play-pad")
    pitches = here.page.evaluate(PAD_PITCHES)
    assert sum(80 < (pitch or 0) < 300 for pitch in pitches) > 60
    here.page.wait_for_timeout(200)
    assert len(here.picture("play-pad")) > 1.02 * len(bare), "the cells are painted"
