"""The page without a mouse."""

from tests.browser.conftest import MOVING

FOCUSED = "document.activeElement.id || document.activeElement.className || document.activeElement.tagName"


def test_numbers_choose_the_muscles_and_arrows_move_them(visit):
    here = visit()
    for key, muscle in zip("12345", ("ta", "ct", "lca", "ia", "pca"), strict=True):
        here.page.keyboard.press(key)
        here.page.wait_for_selector(f"#control-activation-{muscle}:focus")
    here.page.keyboard.press("2")
    here.page.wait_for_selector("#control-activation-ct:focus")
    here.page.keyboard.press("ArrowRight")
    assert here.typed("Cricothyroid (CT)").input_value() == "0.31"
    here.page.keyboard.press("Shift+ArrowLeft")
    assert here.typed("Cricothyroid (CT)").input_value() == "0.21"
    here.page.keyboard.press("End")
    assert here.typed("Cricothyroid (CT)").input_value() == "1.00"
    here.page.keyboard.press("ArrowRight")
    assert here.typed("Cricothyroid (CT)").input_value() == "1.00", "the end is the end"
    here.settle()


def test_typing_a_value_types_and_does_not_choose_a_muscle(visit):
    here = visit()
    field = here.typed("Interarytenoid (IA)")
    field.focus()
    here.page.keyboard.type("0,25")
    here.page.keyboard.press("Enter")
    here.settle()
    assert field.input_value() == "0.25", "a decimal comma is understood"
    field.focus()
    here.page.keyboard.type("0.9")
    here.page.keyboard.press("Escape")
    assert field.input_value() == "0.25", "Escape takes the typing back"


def test_help_opens_closes_and_gives_the_focus_back(visit):
    here = visit()
    here.page.keyboard.press("1")
    here.page.wait_for_selector("#control-activation-ta:focus")
    here.page.keyboard.press("?")
    assert "choose a muscle" in here.page.get_by_role("dialog").inner_text()
    here.page.keyboard.press("Escape")
    here.page.wait_for_selector("dialog", state="detached")
    here.page.wait_for_selector("#control-activation-ta:focus")
    assert here.page.evaluate(FOCUSED) == "control-activation-ta"


def test_space_sounds_m_moves_and_brackets_step_through_the_cycle(visit):
    here = visit(**MOVING)
    here.page.keyboard.press("Space")
    here.page.get_by_role("button", name="Stop", exact=True).wait_for()
    here.page.keyboard.press("Space")
    here.page.get_by_role("button", name="Listen").wait_for()
    here.page.keyboard.press("m")
    here.page.get_by_role("button", name="Play the motion").wait_for()
    here.hold_still(500)
    here.page.locator("h1").click()
    for _ in range(3):
        here.page.keyboard.press("]")
    assert here.page.locator(".percent").inner_text().strip() == "53 %"
    here.page.keyboard.press("[")
    assert here.page.locator(".percent").inner_text().strip() == "52 %"


def test_tab_reaches_everything_in_reading_order(visit):
    here = visit()
    seen = []
    for _ in range(60):
        here.page.keyboard.press("Tab")
        seen.append(here.page.evaluate(FOCUSED))
        if seen[-1] == "BODY":
            break
    wanted = [
        "control-activation-ta",
        "control-activation-pca",
        "control-subglottal_pressure_pa",
        "scrub",
        "panel-waves",
        "headline",
        "listen",
    ]
    assert [seen.index(name) for name in wanted] == sorted(seen.index(name) for name in wanted)


def test_arrows_move_between_tabs(visit):
    here = visit()
    here.page.get_by_role("tab", name="Waves").focus()
    here.page.keyboard.press("ArrowRight")
    assert here.page.get_by_role("tab", name="Spectrum").get_attribute("aria-selected") == "true"
    for _ in range(3):
        here.page.keyboard.press("ArrowRight")
    assert here.page.get_by_role("tab", name="Measures").get_attribute("aria-selected") == "true"
    here.page.locator("tr[data-measure]").nth(20).wait_for()
