"""The page without TLS on a name other than localhost: it lists what browsers then block, and the rest works."""

import re
from urllib.parse import urlsplit

import pytest

from tests.browser.conftest import DESKTOP, server_process
from tests.browser.visit import Visit

NAME = "larynx.test"
OVERFLOW = "(() => { const left = document.querySelector('.left'); return left.scrollHeight - left.clientHeight; })()"
PASTED = """() => new Promise((done) => {
  const field = document.createElement("textarea");
  document.body.append(field);
  field.focus();
  field.addEventListener("input", () => { done(field.value); field.remove(); });
})"""


@pytest.fixture(scope="module")
def elsewhere(launch):
    """(browser that resolves a name other than localhost to the server, address)."""
    with server_process(VOCALIS_TOKEN="open-sesame", VOCALIS_ALLOWED_HOSTS=NAME) as address:
        browser = launch(f"--host-resolver-rules=MAP {NAME} 127.0.0.1")
        yield browser, f"http://{NAME}:{urlsplit(address).port}"
        browser.close()


def pasted(here) -> str:
    """The content of the clipboard, pasted into a field."""
    held = here.page.evaluate_handle(f"() => ({{ text: ({PASTED})() }})")
    here.page.keyboard.press("Control+V")
    return held.evaluate("async (held) => await held.text")


def test_a_shared_link_works_and_the_page_lists_what_needs_tls(elsewhere):
    browser, address = elsewhere
    here = Visit(browser.new_context(viewport=DESKTOP), address)
    here.expected = re.compile("Cross-Origin-Opener-Policy")  # browsers ignore it without TLS and log that
    here.open("?activation.ct=0.5")
    here.page.get_by_label("Token").fill("open-sesame")
    here.page.keyboard.press("Enter")
    here.settle()
    assert here.typed("Cricothyroid (CT)").input_value() == "0.50"
    assert not here.page.evaluate("isSecureContext")
    assert "Live sound needs TLS here." in here.page.locator(".left .use").inner_text()
    assert here.page.evaluate(OVERFLOW) == 0, "the line finds room"
    here.page.get_by_role("button", name="Copy link").click()
    assert "Link copied" in here.page.locator(".notice").inner_text()
    assert here.page.evaluate("document.activeElement.textContent").strip() == "Copy link", "the focus stays"
    assert pasted(here) == f"{address}/?activation.ct=0.5"
    here.page.get_by_role("tab", name="Measures").click()
    here.page.get_by_role("button", name="Copy as table").click()
    here.page.get_by_text("Copied: paste it").wait_for()
    assert pasted(here).startswith("Measure\tSymbol\tValue")
    here.page.get_by_role("button", name="Export").click()
    here.page.get_by_role("button", name="As Python or curl").click()
    here.page.get_by_role("button", name="Copy", exact=True).first.click()
    here.page.get_by_text("Copied.").wait_for()
    here.page.keyboard.press("Escape")
    assert pasted(here).startswith("import vfcore"), "from within a dialog too"
    here.page.keyboard.press("?")
    assert "--tls-cert" in here.page.get_by_role("dialog").inner_text(), "the help says what to do about it"
    assert here.complaints == [] and here.strangers == []
    here.context.close()


def test_on_localhost_the_page_does_not_mention_tls(visit):
    here = visit()
    assert "TLS" not in here.page.locator(".left .use").inner_text()
