"""Exceptional states: no vibration, a refused value, a server that is busy, lost or locked."""

import re

import pytest

from tests.browser.conftest import server_process

SILENT = "?activation.lca=0.2&activation.ia=0.2&activation.pca=1&subglottal_pressure_pa=300"


def test_without_phonation_the_page_shows_the_cause_and_advice(visit):
    here = visit()
    here.page.get_by_label("Voice").select_option("no_phonation")
    here.settle()
    assert here.state() == "No sustained vibration"
    explanation = here.api(f"jobs/{here.result_id()}/result")["explanation"].removeprefix("No phonation: ")
    why = here.page.locator(".phonation-why").inner_text()
    assert explanation[1:] in why
    for advice in ("less PCA", "more LCA and IA", "more lung pressure"):
        assert advice in why
    assert here.page.locator(".headline[data-measure=fo_hz] b").inner_text() == "–"
    assert here.ink("stage") > 0.2, "the folds are shown at rest"


def test_following_the_advice_brings_the_voice_back(visit):
    here = visit(SILENT)
    for path, value in (("activation.pca", 0), ("activation.lca", 0.8), ("activation.ia", 0.8)):
        here.set(path, value)
    here.set("subglottal_pressure_pa", 1000)
    assert here.state() == "Periodic phonation"


def test_a_refused_value_is_explained_at_its_field_and_the_voice_stays(visit):
    here = visit()
    here.expected = re.compile("422")
    kept = here.result_id()
    field = here.typed("Thyroarytenoid (TA)")
    field.fill("7")
    field.press("Enter")
    refusal = here.page.locator(".control", has=here.slider("activation.ta")).get_by_role("alert")
    refusal.wait_for()
    answer = here.page.request.post(f"{here.address}/api/v1/posture", data={"activation": {"ta": 7}}).json()
    (error,) = answer["errors"]
    assert error["message"] in refusal.inner_text() and error["allowed"] in refusal.inner_text()
    assert field.get_attribute("aria-invalid") == "true"
    assert here.page.get_by_role("alert").filter(has_text=re.compile(r"\S")).count() == 1
    assert here.result_id() == kept and here.state() == "Periodic phonation"
    field.fill("0.5")
    field.press("Enter")
    here.settle()
    assert here.page.get_by_role("alert").filter(has_text=re.compile(r"\S")).count() == 0
    assert here.result_id() != kept


def test_a_value_that_is_not_a_number_is_refused_by_the_server_too(visit):
    here = visit()
    here.expected = re.compile("422")
    here.page.get_by_text("Advanced").click()
    field = here.page.get_by_label("Nodes along the fold")
    field.fill("many")
    field.press("Enter")
    refusal = here.page.locator(".field", has=field).get_by_role("alert")
    refusal.wait_for()
    assert "many" in refusal.inner_text()


def test_the_first_start_shows_its_progress(visit):
    here = visit(wait=False)
    message = '{"status":"ok","ready":false,"message":"compiling the step of the fold (2 of 2)"}'
    here.page.route("**/api/v1/health", lambda route: route.fulfill(body=message, content_type="application/json"))
    here.page.reload()
    here.page.get_by_text("compiling the step of the fold (2 of 2)").wait_for()
    here.page.unroute("**/api/v1/health")
    here.settle()
    assert here.state() == "Periodic phonation"


@pytest.mark.parametrize("shapes_at_hand", [False, True])
def test_a_lost_server_is_reported_and_found_again(visit, shapes_at_hand):
    here = visit()
    if shapes_at_hand:
        with here.page.expect_response(lambda response: response.url.endswith("/postures")):
            here.slider("activation.ct").hover()
        here.page.wait_for_load_state("networkidle")
    here.expected = re.compile("ERR_FAILED")
    calls = re.compile(r"api/v1/(posture|simulate)")
    here.page.route(calls, lambda route: route.abort())
    here.slider("activation.ct").press("ArrowRight")
    here.page.get_by_text("The server does not answer").wait_for()
    here.page.unroute(calls)
    here.page.get_by_text("The server does not answer").wait_for(state="detached")
    here.settle()
    request = here.api(f"jobs/{here.result_id()}/result")["provenance"]["request"]
    assert request["activation"]["ct"] == 0.31


def test_the_page_asks_for_a_token_and_keeps_the_settings(visit):
    with server_process(VOCALIS_TOKEN="open-sesame") as address:
        here = visit(address=address, wait=False)
        here.expected = re.compile("401")
        here.page.get_by_label(re.compile("Token")).fill("open-sesame")
        here.page.keyboard.press("Enter")
        here.page.wait_for_selector(".desktop")
        here.settle()
        here.context.clear_cookies()
        here.slider("activation.ct").press("ArrowRight")
        here.page.get_by_role("heading", name="This server asks for its token").wait_for()
        here.page.get_by_label("Token").fill("wrong")
        here.page.keyboard.press("Enter")
        here.page.get_by_text("That is not the token.").wait_for()
        here.page.get_by_label("Token").fill("open-sesame")
        here.page.keyboard.press("Enter")
        here.settle()
        assert here.typed("Cricothyroid (CT)").input_value() == "0.31"
