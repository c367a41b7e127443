"""The modal voice: no picture is empty, and every number is that of the server."""

import re

import numpy as np

#: The outline drawn at some stored phases, and the area of the waveform at that sample and its neighbours.
OUTLINES = """async () => {
  const { result } = await import("/state/answers.js");
  const { foldEdges } = await import("/core/glottis.js");
  const { fieldAt } = await import("/core/result.js");
  const { fields, cycle, waves, rate } = result.value;
  return [10, 30, 45, 60, 90].map((k) => {
    const instant = cycle.startS + (k / fields.phases) * cycle.periodS;
    const sample = Math.round(instant * rate);
    const around = Array.from(waves.area.slice(sample - 1, sample + 2));
    return [foldEdges(fields, fieldAt(fields, "w", k / fields.phases)), around];
  });
}"""
PICTURES = {"stage": 0.2, "waves": 0.01, "shapes": 0.003, "map-aero": 0.1, "map-contact": 0.02}


def number(text: str) -> float:
    return float(re.match(r"[\d.−\u202f]+", text)[0].replace("\u202f", "").replace("−", "-"))


def test_every_picture_has_data(visit):
    here = visit()
    here.hold_still(900)  # late in the closed phase: contact
    assert {name: here.ink(name) for name, least in PICTURES.items() if here.ink(name) < least} == {}
    marks = here.page.locator(".map-bar").all_inner_texts()
    assert len(marks) == 2 and all(len(text.split()) >= 3 for text in marks), "both colour bars have numbers"


def test_the_drawn_opening_has_the_area_of_the_waveform(visit):
    here = visit()
    outlines = here.page.evaluate(OUTLINES)
    for edges, around_m2 in outlines:
        area_mm2 = np.trapezoid(2 * np.maximum(edges["inner"], 0), edges["u"])
        assert 1e6 * min(around_m2) - 0.01 < area_mm2 < 1e6 * max(around_m2) + 0.01
    assert max(max(around) for _, around in outlines) > 50e-6, "the glottis was open"


def test_every_measure_is_the_one_of_the_api(visit):
    here = visit()
    here.page.get_by_role("tab", name="Measures").click()
    measures = here.api(f"jobs/{here.result_id()}/result")["measures"]
    catalogue = {row["key"]: row for row in here.api("measures")["measures"]}
    here.page.locator("tr[data-measure]").first.wait_for()
    assert here.page.locator("tr[data-measure]").count() == len(catalogue) == len(measures)
    for key, measure in measures.items():
        row = here.page.locator(f"tr[data-measure={key}]")
        shown = row.locator(".value").inner_text()
        if measure["value"] is None:
            assert shown == "–"
            assert row.locator("xpath=following-sibling::tr[1]").inner_text() == measure["reason"]
        else:
            assert abs(number(shown) - measure["value"]) <= 0.5000001 * 10 ** -catalogue[key]["decimals"], key
            assert shown.endswith(measure["unit"]) or measure["unit"] == "1", key


def test_the_large_numbers_are_the_same_in_their_units(visit):
    here = visit()
    measures = here.api(f"jobs/{here.result_id()}/result")["measures"]
    factors = {"contact_pressure_max_pa": 1e-3}
    cells = here.page.locator(".headline")
    assert cells.count() == 6
    for cell in cells.all():
        key = cell.get_attribute("data-measure")
        shown = cell.locator("b").inner_text()
        decimals = len(shown.partition(".")[2])
        assert abs(number(shown) - measures[key]["value"] * factors.get(key, 1)) <= 0.5000001 * 10**-decimals, key


def test_a_number_opens_its_definition_and_source(visit):
    here = visit()
    here.page.locator(".headline[data-measure=speed_quotient]").click()
    text = here.page.get_by_role("dialog").inner_text()
    row = next(row for row in here.api("measures")["measures"] if row["key"] == "speed_quotient")
    for part in (row["definition"], row["source"], "1.30 to 2.80", "normal modal voice"):
        assert part in text
    here.page.keyboard.press("Escape")
    assert here.page.get_by_role("dialog").count() == 0


def test_the_whole_run_opens_to_zoom(visit):
    here = visit()
    assert here.page.evaluate("window.Plotly === undefined"), "the plot library is loaded on demand"
    here.page.get_by_role("button", name="Zoom").click()
    here.page.wait_for_selector(".plotly-place .main-svg")
    points = here.page.evaluate("document.querySelector('.plotly-place').data.map((trace) => trace.y.length)")
    assert points == [14000] * 5
    assert here.page.locator(".plotly-place .scatterlayer .js-line").count() == 5
    buttons = here.page.locator(".modebar-btn").evaluate_all("all => all.map((button) => button.dataset.title)")
    assert "Download plot as a PNG" in buttons
    assert not re.search("share|cloud|edit", " ".join(buttons), re.IGNORECASE), "nothing offers to send data away"
    here.page.keyboard.press("Escape")
    here.page.wait_for_selector("dialog", state="detached")


def test_the_endoscope_turns_the_view_and_anatomy_can_be_hidden(visit):
    here = visit()
    here.hold_still()
    lying = here.picture("stage")
    here.page.get_by_role("button", name="Endoscope").click()
    here.settle()
    upright = here.picture("stage")
    here.page.get_by_role("checkbox", name="Muscles", exact=True).uncheck()
    here.settle()
    assert len({lying, upright, here.picture("stage")}) == 3


def test_both_themes_are_there_and_kept(visit):
    here = visit(color_scheme="light")
    colour = "getComputedStyle(document.body).backgroundColor"
    light = here.page.evaluate(colour)
    here.page.get_by_role("button", name="Dark theme").click()
    here.settle()
    assert here.page.evaluate(colour) != light
    here.open()
    here.settle()
    assert here.page.evaluate("document.documentElement.dataset.theme") == "dark"
