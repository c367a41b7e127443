"""Quality in numbers: no layout shift, a fast first view, and short scripts in every frame of a drag."""

import json

import pytest

from tests.browser.conftest import DESKTOP, MOVING, PHONE
from tests.browser.trace import CATEGORIES, scripts_of_frames
from tests.browser.visit import Visit

SIZES = pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
#: Records all layout shifts: those of cumulative layout shift, and also those after user input.
SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => {
  for (const { value, sources } of list.getEntries())
    window.shifts.push({ value, what: sources.map(({ node }) => node?.className || node?.nodeName) });
}).observe({ type: "layout-shift", buffered: true });
"""


#: The observer is notified a frame or two after the shift.
LATER = """() => new Promise((done) => {
  const frame = (n) => (n ? requestAnimationFrame(() => frame(n - 1)) : done(window.shifts.splice(0)));
  frame(4);
})"""


def shifted(here) -> float:
    """The layout shift since the last call; printed unless it is 0."""
    shifts = here.page.evaluate(LATER)
    for shift in shifts:
        print(shift)
    return sum(shift["value"] for shift in shifts)


def drag(here, path: str, moves: int, pause_ms: float) -> None:
    """Drag a slider back and forth from its middle with a real pointer."""
    slider = here.slider(path)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    here.page.mouse.move(box["x"] + box["width"] / 2, y)
    here.page.mouse.down()
    for k in range(moves):
        share = 0.5 + 0.35 * ((k % 40) / 20 - 1) * (1 if k % 80 < 40 else -1)
        here.page.mouse.move(box["x"] + share * box["width"], y)
        here.page.wait_for_timeout(pause_ms)
    here.page.mouse.up()


@SIZES
def test_nothing_jumps(visit, viewport):
    """Total layout shift below a fiftieth of the screen over the load, every tab, every preset and a drag."""
    here = visit(viewport=viewport, init=SHIFTS)
    moved = {"load": shifted(here)}
    tabs = here.page.get_by_role("tab")
    for name in tabs.all_inner_texts():
        here.page.get_by_role("tab", name=name, exact=True).click()
        here.settle()
        here.page.evaluate("scrollTo(0, 0)")
        moved[name] = shifted(here)
    tabs.first.click()
    here.settle()
    for preset in here.page.locator(".preset option").evaluate_all("all => all.map((o) => o.value)"):
        here.page.locator(".preset select").select_option(preset)
        here.settle()
        moved[preset] = shifted(here)
    drag(here, "activation.ct", 20, 15)
    here.settle()
    moved["drag"] = shifted(here)
    assert sum(moved.values()) < 0.02, {name: share for name, share in moved.items() if share}


#: Time from navigation to the first picture of the folds, or to all pictures of a voice, ms.
PAINTED = """(name) => {
  const times = performance.getEntriesByName(name).map((e) => e.startTime + e.duration);
  return times.length ? Math.min(...times) : null;
}"""


@pytest.mark.alone
@SIZES
def test_the_first_view_comes_at_once(chromium, server, viewport, capsys):
    """First visit with an empty cache. Prints the better of two; the bound allows for a busy machine."""
    times = {"slider to shape": [], "slider to all": []}
    for _ in range(2):
        here = Visit(chromium.new_context(viewport=viewport), server)
        here.open()
        here.settle()
        assert here.ink("stage") > 0.1, "the painted picture is not empty"
        for name, seen in times.items():
            seen.append(here.page.evaluate(PAINTED, name))
        assert here.complaints == [] and here.strangers == []
        here.context.close()
    shape, everything = (min(seen) for seen in times.values())
    with capsys.disabled():
        print(f"\nfirst view, {viewport['width']} px: folds after {shape:.0f} ms, everything after {everything:.0f} ms")
    assert everything < 6000


#: The open panel during the drag at each size; on a phone the sliders have a tab of their own.
OPEN = {"desktop": ["panel-voice", "panel-folds"], "phone": ["tab-muscles"]}


@pytest.mark.alone
@pytest.mark.parametrize("size", OPEN)
def test_a_drag_leaves_room_in_every_frame(visit, chromium, size, capsys):
    """Prints the scripting time of a frame; the bound is on the median, to allow for other work on the machine."""
    here = visit(viewport={"desktop": DESKTOP, "phone": PHONE}[size], **MOVING)
    here.page.keyboard.press("a")
    for place in OPEN[size]:
        here.page.locator(f"#{place}").click()
        here.painted()
        chromium.start_tracing(page=here.page, categories=CATEGORIES)
        drag(here, "activation.ct", 50, 12)
        times = sorted(scripts_of_frames(json.loads(chromium.stop_tracing())["traceEvents"]))
        assert len(times) > 20, "frames were painted"
        p50, p95 = times[len(times) // 2], times[int(0.95 * len(times))]
        with capsys.disabled():
            print(
                f"\nscripts in a frame of a drag, {size}, {place}: p50 {p50:.1f} ms, p95 {p95:.1f} ms of {len(times)}"
            )
        assert p50 < 16
        here.settle()
