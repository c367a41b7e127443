"""The Paper section: every figure is shown on desktop and phone, opens its case, and can be computed again."""

import re

import pytest

from tests.browser.conftest import DESKTOP, PHONE
from tests.browser.test_page_access import findings
from vocalis.studies.paper.report.ship import SCOREBOARD, shipped

SECTIONS = ("static", "modal", "maps", "pca", "scoreboard")
CANVASES = {
    "static": ("paper-static_adduction", "paper-static_ta", "paper-static_ct", "paper-static_pca"),
    "modal": ("paper-waves", "paper-shapes", "paper-matrix"),
}
PLOTS = {
    "maps": ("fo_hz", "mean_flow_ml_s", "spl_lips_db", "speed_quotient", "closed_quotient"),
    "pca": ("contact_pressure_max_pa", "contact_location"),
}
#: The place of a point of the pitch map on the page.
PLACE_OF = """([ta, ct]) => {
  const plot = document.querySelector("[data-plot=fo_hz]");
  const { xaxis, yaxis } = plot._fullLayout;
  const box = plot.getBoundingClientRect();
  return [box.x + xaxis._offset + xaxis.l2p(ta), box.y + yaxis._offset + yaxis.l2p(ct)];
}"""
SIZES = pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])


def open_section(visit, section, **context):
    here = visit(f"?paper={section}", wait=False, **context)
    here.page.wait_for_selector(".paper-content .claims, .score-table", state="attached")
    for name in PLOTS.get(section, ()):
        here.page.wait_for_selector(f"[data-plot={name}] .main-svg", state="attached")
    here.page.wait_for_selector("body[aria-busy=false]")
    here.page.wait_for_timeout(200)
    return here


@SIZES
@pytest.mark.parametrize("section", SECTIONS)
def test_every_part_is_drawn_fits_and_is_open_to_all(visit, section, viewport):
    here = open_section(visit, section, viewport=viewport, color_scheme="dark" if viewport is PHONE else "light")
    for name in CANVASES.get(section, ()):
        assert here.ink(name) > 0.01, name
    for name in PLOTS.get(section, ()):
        values = here.page.evaluate(
            f"document.querySelector('[data-plot={name}]').data[0].{'z' if section == 'maps' else 'y'}.flat()"
        )
        assert sum(value is not None for value in values) > 0.8 * len(values), name
    assert here.page.evaluate("document.scrollingElement.scrollWidth") <= viewport["width"]
    assert findings(here) == []
    assert f"paper={section}" in here.page.url


def test_the_verdicts_are_shown_with_the_figures(visit):
    here = open_section(visit, "pca")
    assert "fail" in here.page.locator("[data-claim=P3]").inner_text()
    here.page.get_by_role("tab", name="Scoreboard").click()
    assert here.page.locator(".score-table tbody tr").count() == 29
    outcomes = shipped(SCOREBOARD)["variants"]["paper"]["outcomes"].values()
    passed = sum(one["verdict"] == "pass" for one in outcomes)
    assert f"Paper {passed} pass" in here.page.locator(".score-table caption").inner_text()


def test_a_level_opens_its_posture(visit):
    here = open_section(visit, "static")
    here.page.get_by_role("button", name="LCA = IA 0.7: open in the instrument").click()
    here.settle()
    values = {m: here.slider(f"activation.{m}").input_value() for m in ("lca", "ia", "ct", "ta", "pca")}
    assert values == {"lca": "0.7", "ia": "0.7", "ct": "0.1", "ta": "0", "pca": "0"}
    here.page.wait_for_url(lambda address: "paper=" not in address)


def test_a_voice_opens_in_the_instrument(visit):
    here = open_section(visit, "modal")
    modal = here.picture("paper-matrix")
    here.page.get_by_role("button", name="PCA 0.5", exact=True).click()
    here.page.wait_for_timeout(200)
    assert here.picture("paper-matrix") != modal
    here.page.get_by_role("button", name="Open in the instrument").click()
    here.settle()
    assert here.page.get_by_label("Voice").input_value() == "breathy"


@SIZES
def test_a_cell_of_a_map_opens_its_voice(visit, viewport):
    here = open_section(visit, "maps", viewport=viewport)
    plot = here.page.locator("[data-plot=fo_hz]")
    plot.scroll_into_view_if_needed()
    x, y = here.page.evaluate(PLACE_OF, [0.2, 0.6])
    here.page.mouse.move(x - 3, y)
    here.page.mouse.move(x, y)
    here.page.wait_for_timeout(200)
    here.page.mouse.click(x, y)
    here.page.wait_for_selector(".paper", state="detached")
    here.settle()
    assert here.slider("activation.ct").input_value() == "0.6"
    assert here.slider("activation.ta").input_value() == "0.2"


def test_cells_without_a_value_are_named(visit):
    here = open_section(visit, "maps")
    assert "irregular (" in here.page.locator(".cell-legend").inner_text()


def test_the_cases_of_a_figure_open_without_a_pointer(visit):
    here = open_section(visit, "pca")
    here.page.get_by_role("combobox", name="PCA", exact=True).select_option("0.8")
    here.page.get_by_role("button", name="Open in the instrument").click()
    here.settle()
    assert here.slider("activation.pca").input_value() == "0.8"


def test_a_figure_is_computed_again_and_the_shipped_one_comes_back(visit):
    here = open_section(visit, "static")
    canvas = here.page.locator("canvas[data-picture=paper-static_ct]")
    before, box = len(here.picture("paper-static_ct")), canvas.bounding_box()
    tools = here.page.locator(".figure-tools[data-figure=static_ct]")
    tools.get_by_role("button", name="Compute again").click()
    tools.get_by_text("Computed here").wait_for()
    here.page.wait_for_timeout(200)
    # Shipped numbers are rounded, so pixels may differ, but hardly the size of the picture.
    assert len(here.picture("paper-static_ct")) == pytest.approx(before, rel=0.03), "the same picture again"
    assert canvas.bounding_box() == box, "nothing jumps"
    tools.get_by_role("button", name="Back to shipped").click()
    assert tools.get_by_text("Computed here").count() == 0


def test_a_long_computation_can_be_stopped(visit):
    here = open_section(visit, "maps")
    tools = here.page.locator(".figure-tools")
    tools.get_by_role("button", name="Compute again").click()
    tools.get_by_text(re.compile(r"^[1-9]\d* of 441")).wait_for()
    tools.get_by_role("button", name="Cancel").click()
    tools.get_by_role("button", name="Compute again").wait_for()
    assert tools.get_by_text("Computed here").count() == 0
