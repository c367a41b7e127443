"""Two different folds on the page: the left one is drawn, and the page says so."""

import os

import pytest

from tests.browser.conftest import DESKTOP, PHONE
from tests.browser.visit import INK

DIFFER = "The folds differ; the picture shows the left one."
LEFT = """async () => {
  const { result, posture } = await import("/state/answers.js");
  const { fields } = result.value;
  return {
    sizes: ["x", "y", "medial", "w"].map((name) => fields[name].length),
    grid: [fields.nx, fields.ny, fields.phases],
    length: fields.x[fields.nx - 1],
    left: posture.value.sides.left.posture.length_m,
    right: posture.value.sides.right.posture.length_m,
  };
}"""


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_a_link_with_two_folds_shows_the_left_one_and_says_so(visit, viewport):
    made = visit("?right.activation.ta=0.1&right.activation.ct=0.8", viewport=viewport)
    assert made.page.get_by_text(DIFFER).is_visible()
    assert made.page.evaluate(INK, "stage") > 0.01
    shown = made.page.evaluate(LEFT)
    nx, ny, phases = shown["grid"]
    assert shown["sizes"] == [nx, ny, nx * ny, phases * nx * ny]
    assert shown["length"] == pytest.approx(shown["left"], rel=1e-6) != pytest.approx(shown["right"], rel=1e-3)
    if folder := os.environ.get("VOCALIS_SCREENSHOTS"):
        made.page.screenshot(path=f"{folder}/sides-{viewport['width']}.png")


def test_a_symmetric_voice_says_nothing_of_two_folds(visit):
    assert visit().page.get_by_text(DIFFER).count() == 0
