"""A longer run in the background: progress, cancel, result, files."""

import re

PAPER_STEP = "?run.time_step_s=1.7857142857142857e-6"


def test_a_longer_run_shows_its_progress_and_can_be_cancelled(visit):
    here = visit(PAPER_STEP)
    here.page.get_by_role("tab", name="Runs").click()
    here.page.get_by_label("Duration").fill("10")
    here.page.get_by_role("button", name="Run").click()
    status = here.page.locator(".job p[role=status]")
    status.filter(has_text=re.compile(r"Running · ([1-9]|\d\d) %")).wait_for(timeout=60_000)
    assert 0 < float(here.page.locator(".job progress").get_attribute("value")) < 1
    here.page.get_by_role("button", name="Cancel").click()
    status.filter(has_text="Cancelled").wait_for(timeout=3000)
    assert here.api("jobs")["jobs"][0]["status"] == "dismissed"
    here.page.get_by_role("button", name="Run").wait_for()


def test_a_finished_run_can_be_shown_played_and_exported(visit):
    here = visit("?activation.ct=0.7")
    live = here.result_id()
    here.page.get_by_role("tab", name="Runs").click()
    here.page.get_by_label("Duration").fill("3")
    here.page.get_by_role("button", name="Run").click()
    here.page.get_by_role("button", name="Show here").click(timeout=60_000)
    here.page.wait_for_selector(f".strip:not([data-result='{live}'])")
    job = here.api("jobs")["jobs"][0]
    assert here.result_id() == job["id"] and job["request"]["run"]["duration_s"] == 3
    shown = here.page.locator(".headline[data-measure=fo_hz] b").inner_text()
    assert abs(float(shown) - here.api(f"jobs/{job['id']}/result")["measures"]["fo_hz"]["value"]) < 0.06
    here.page.get_by_role("tab", name="Waves").click()
    here.settle()
    assert here.ink("waves") > 0.01
    here.page.get_by_role("tab", name="Runs").click()
    for link in here.page.locator(".run-actions a").all():
        assert here.page.request.get(link.get_attribute("href")).status == 200
    here.slider("activation.ct").press("ArrowRight")
    here.settle()
    assert here.result_id() not in (live, job["id"]), "the next movement goes back to live"


def test_a_refused_run_shows_the_reason(visit):
    here = visit()
    here.expected = re.compile("422|429")
    refusal = '{"status":422,"title":"Too long","detail":"This run is too long for this server."}'
    here.page.route(
        "**/api/v1/jobs",
        lambda route: route.fulfill(status=422, body=refusal, content_type="application/problem+json"),
    )
    here.page.get_by_role("tab", name="Runs").click()
    here.page.get_by_role("button", name="Run").click()
    here.page.get_by_text("This run is too long for this server.").wait_for()
