"""What the page promises in numbers: nothing jumps, the first view comes at once, a drag leaves room in every frame."""

import json

import pytest

from tests.browser.conftest import DESK, MOVING, PHONE
from tests.browser.trace import CATEGORIES, scripts_of_frames
from tests.browser.visit import Visit

SIZES = pytest.mark.parametrize("viewport", [DESK, PHONE], ids=["desk", "phone"])
#: Sums all that moved by itself, as cumulative layout shift does, and also what moved in answer to the hand.
SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => {
  for (const { value, sources } of list.getEntries())
    window.shifts.push({ value, what: sources.map(({ node }) => node?.className || node?.nodeName) });
}).observe({ type: "layout-shift", buffered: true });
"""


#: The observer is told a frame or two after the shift.
LATER = """() => new Promise((done) => {
  const frame = (n) => (n ? requestAnimationFrame(() => frame(n - 1)) : done(window.shifts.splice(0)));
  frame(4);
})"""


def shifted(here) -> float:
    """What has moved since the last call; prints it where it is more than nothing."""
    shifts = here.page.evaluate(LATER)
    for shift in shifts:
        print(shift)
    return sum(shift["value"] for shift in shifts)


def drag(here, path: str, moves: int, pause_ms: float) -> None:
    """With a real pointer from the middle of a slider to and fro."""
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
    """Less than a fiftieth of the screen in all, over the load, every tab, every preset and a drag."""
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


#: When the first picture of the folds, and when everything that follows from a voice, was painted after navigation, ms.
PAINTED = """(name) => {
  const times = performance.getEntriesByName(name).map((e) => e.startTime + e.duration);
  return times.length ? Math.min(...times) : null;
}"""


@pytest.mark.alone
@SIZES
def test_the_first_view_comes_at_once(chromium, server, viewport, capsys):
    """As a stranger, nothing kept by the browser. Prints the better of two; the bound is for a machine that is busy."""
    times = {"slider to shape": [], "slider to all": []}
    for _ in range(2):
        here = Visit(chromium.new_context(viewport=viewport), server)
        here.open()
        here.settle()
        assert here.ink("stage") > 0.1, "what was painted is a picture"
        for name, seen in times.items():
            seen.append(here.page.evaluate(PAINTED, name))
        assert here.complaints == [] and here.strangers == []
        here.context.close()
    shape, everything = (min(seen) for seen in times.values())
    with capsys.disabled():
        print(f"\nfirst view, {viewport['width']} px: folds after {shape:.0f} ms, everything after {everything:.0f} ms")
    assert everything < 6000


#: What is open while the hand drags, at each size; the phone has its sliders under a tab of their own.
OPEN = {"desk": ["panel-voice", "panel-folds"], "phone": ["tab-muscles"]}


@pytest.mark.alone
@pytest.mark.parametrize("size", OPEN)
def test_a_drag_leaves_room_in_every_frame(visit, chromium, size, capsys):
    """Prints the scripting of a frame; the bound is on the middle one, for machines that do other things besides."""
    here = visit(viewport={"desk": DESK, "phone": PHONE}[size], **MOVING)
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
