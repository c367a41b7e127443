"""A first visit: from opening the page to a printed report that compares two voices."""

import time

import pytest

from tests.browser.conftest import DESKTOP, PHONE

WITHIN_S = 60
#: Share of the pixels of the posterior half of the folds in the colour of the opening.
OPEN_BEHIND = """() => {
  const canvas = document.querySelector("canvas[data-picture=stage]");
  const [width, height] = [canvas.width >> 1, canvas.height];
  const copy = new OffscreenCanvas(width + 1, height).getContext("2d", { willReadFrequently: true });
  copy.drawImage(canvas, -width, 0);
  copy.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--opening");
  copy.fillRect(width, 0, 1, 1);
  const [r, g, b] = copy.getImageData(width, 0, 1, 1).data;
  const { data } = copy.getImageData(0, 0, width, height);
  let open = 0;
  for (let k = 0; k < data.length; k += 4)
    if (Math.abs(data[k] - r) + Math.abs(data[k + 1] - g) + Math.abs(data[k + 2] - b) < 12) open++;
  return (4 * open) / data.length;
}"""
#: Whether all of an element's text can be seen.
WHOLE = "e => e.scrollHeight <= e.clientHeight + 1 && e.scrollWidth <= e.clientWidth + 1"
#: Peak of the output to the loudspeaker.
LOUDNESS = """
window.peak = 0;
const connect = AudioNode.prototype.connect;
AudioNode.prototype.connect = function (target, ...rest) {
  if (target === this.context.destination) {
    const analyser = this.context.createAnalyser();
    connect.call(this, analyser);
    const samples = new Float32Array(analyser.fftSize);
    setInterval(() => {
      analyser.getFloatTimeDomainData(samples);
      window.peak = Math.max(window.peak, ...samples);
    }, 50);
  }
  return connect.call(this, target, ...rest);
};
window.print = () => { window.printed = true; };
"""


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_a_first_visit_from_opening_to_report_works_without_a_manual(visit, viewport):
    """Open, choose breathy, see the gap, run, hear, hold A, raise LCA, compare, print the report."""
    phone = viewport is PHONE
    start = time.monotonic()
    here = visit(viewport=viewport, init=LOUDNESS)
    tab = here.page.get_by_role("tab")
    here.hold_still(0)
    assert here.page.evaluate(OPEN_BEHIND) < 0.002, "the modal voice is closed at the start of its cycle"

    here.page.locator(".preset select").select_option("breathy")
    here.settle()
    sentence = here.page.locator(".phonation-why" if phone else ".look-for")
    assert "gap stays open at the back" in sentence.inner_text()
    assert sentence.evaluate(WHOLE), "the sentence is not cut off"
    assert here.page.evaluate(OPEN_BEHIND) > 0.01, "the gap is seen"

    here.page.get_by_role("button", name="Listen").first.click()
    sounding = "new Promise((done) => { const f = () => (window.peak > 0.01 ? done(true) : setTimeout(f, 50)); f(); })"
    assert here.page.evaluate(sounding)
    here.page.get_by_role("button", name="Stop", exact=True).first.click()

    if phone:
        tab.get_by_text("More").click()
    here.page.get_by_role("button", name="Hold A").first.click()
    if phone:
        here.page.get_by_text("A is held. Change something").first.wait_for()
        tab.get_by_text("Muscles").click()
    slider = here.slider("activation.lca")
    slider.focus()
    for _ in range(2):
        here.page.keyboard.press("Shift+ArrowRight")
    here.settle()
    assert here.typed("Lateral cricoarytenoid (LCA)").input_value() == "1.00"
    if phone:
        tab.get_by_text("Waves").first.click()
        tab.get_by_text("A / B").click()
    here.painted()
    gap = here.page.locator("tr[data-compared=gap_mm]")
    assert gap.locator(".change").inner_text().startswith("−"), "LCA narrows the gap"
    assert here.ink("compare") > 0.01
    here.page.get_by_role("button", name="Hear B").click()
    here.page.get_by_role("button", name="Hear B").wait_for(state="detached")

    here.page.get_by_role("button", name="Export").first.click()
    here.page.get_by_role("button", name="Report to print").click()
    report = here.page.locator("article.report")
    assert gap.locator(".change").inner_text() in report.inner_text(), "the comparison is on the report"
    dialog = here.page.get_by_role("dialog")
    assert dialog.evaluate("e => e.scrollWidth <= e.clientWidth"), "the report fits its window"
    here.page.get_by_role("button", name="Print").click()
    assert here.page.evaluate("window.printed") is True
    assert time.monotonic() - start < WITHIN_S
