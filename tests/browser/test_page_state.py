"""Views are functions of the state, however it was reached, and can be mounted and unmounted repeatedly."""

from tests.browser.visit import FRAMES, Visit

#: Every figure on the page, drawn from the current state: {name: SVG}.
FIGURES = """async () => {
  const { figures, svgOf } = await import("/core/export.js");
  return Object.fromEntries(figures.value.filter((f) => f.paint).map((figure) => [figure.name, svgOf(figure, "#fff")]));
}"""
COUNTS = """async () => {
  const { figures } = await import("/core/export.js");
  return [figures.value.length, document.querySelectorAll("*").length];
}"""
MOVE = "e => { e.value = 0.7; e.dispatchEvent(new Event('input', { bubbles: true })); }"
PANELS = ("waves", "voice", "folds", "compare", "measures")


def seen(here: Visit) -> dict[str, str]:
    """The figures and the text of every panel."""
    found = {}
    for panel in PANELS:
        here.page.locator(f"#panel-{panel}").click()
        here.painted()
        found |= here.page.evaluate(FIGURES)
        found[panel] = here.page.locator("#panel-content").inner_text()
    return found


def test_the_same_state_looks_the_same_however_it_was_reached(visit):
    here = visit()
    here.set("activation.lca", 0.5)
    here.page.locator(".preset select").select_option("breathy")
    here.page.get_by_role("button", name="Endoscope").click()
    here.page.get_by_role("button", name="Anterior left").click()
    here.hold_still(420)
    by_hand = seen(here)

    here.page.wait_for_url("**/?activation.pca=0.5")
    other = visit("?activation.pca=0.5")
    other.hold_still(420)
    by_link = seen(other)
    assert len(by_link) > 10
    assert [name for name in by_link if by_hand[name] != by_link[name]] == []


def test_unmounting_leaves_nothing_behind(visit):
    here = visit()
    here.hold_still()
    counts = []
    for _ in range(2):
        for panel in ("voice", "folds", "measures", "lessons", "run", "play", "map", "waves"):
            here.page.locator(f"#panel-{panel}").click()
            here.page.locator("#panel-content > *").first.wait_for()
        here.painted()
        counts.append(here.page.evaluate(COUNTS))
    assert counts[0] == counts[1]

    here.page.get_by_role("button", name="Play the motion").click()
    asked = []
    here.page.on("request", lambda request: asked.append(request.url))
    here.page.evaluate("dispatchEvent(new PageTransitionEvent('pagehide', { persisted: false }))")
    here.page.evaluate(FRAMES, 3)  # what was already scheduled to be painted
    still = here.picture("stage")
    here.slider("activation.ct").evaluate(MOVE)
    here.page.keyboard.press("?")
    here.page.wait_for_timeout(300)
    assert asked == [] and here.picture("stage") == still, "a page that is left sends and animates nothing"
    assert here.page.get_by_role("dialog").count() == 0, "and handles no keys"
