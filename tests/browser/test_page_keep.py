"""Exports of the page: report, figures, tables, code."""

import csv
import io
import re
import shlex
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from tests.browser.conftest import DESKTOP, PHONE, ROOT


def keep(here):
    here.page.get_by_role("button", name="Export").first.click()
    return here.page.get_by_role("dialog")


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_figures_are_exported_as_vectors_and_as_pixels(visit, viewport):
    here = visit(viewport=viewport)
    here.page.locator("#tab-waves" if viewport == PHONE else "#panel-folds").click()
    here.settle()
    dialog = keep(here)
    for name in dialog.locator("[data-figure]").evaluate_all("all => all.map((row) => row.dataset.figure)"):
        row = dialog.locator(f"[data-figure={name}]")
        with here.page.expect_download() as waiting:
            row.get_by_role("button", name="SVG").click()
        drawing = ElementTree.parse(waiting.value.path()).getroot()
        shapes = [element for element in drawing.iter() if element.tag.endswith(("path", "rect", "text", "image"))]
        assert len(shapes) > 10, name
        assert "NaN" not in ElementTree.tostring(drawing, "unicode"), name
    with here.page.expect_download() as waiting:
        dialog.locator("[data-figure=stage]").get_by_role("button", name="PNG").click()
    head = waiting.value.path().read_bytes()[:24]
    wide = here.page.locator("canvas[data-picture=stage]").bounding_box()["width"]
    assert head[1:4] == b"PNG" and int.from_bytes(head[16:20], "big") == pytest.approx(3 * wide, abs=3)


def test_data_are_exported_as_csv_netcdf_and_sound(visit):
    here = visit()
    dialog = keep(here)
    with here.page.expect_download() as waiting:
        dialog.get_by_role("button", name="Waves (CSV)").click()
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text())))
    assert float(rows[-1]["time_s"]) == pytest.approx(0.5, abs=1e-3)
    assert max(float(row["glottal_flow_m3_s"]) for row in rows) == pytest.approx(3.9e-3, rel=0.3)
    for name, start in (("Measures (CSV)", b""), ("netCDF", b"\x89HDF"), ("Sound", b"RIFF")):
        with here.page.expect_download() as waiting:
            dialog.get_by_role("link", name=name).click()
        assert waiting.value.path().read_bytes().startswith(start), name


def done(command: list[str]) -> str:
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120, check=True).stdout


def test_the_printed_python_and_curl_give_the_same_voice(visit):
    here = visit("?activation.ct=0.7&vowel=i&model.variant=human&constants.C_coup_pa_s_m=10")
    shown = here.api(f"jobs/{here.result_id()}/result")
    dialog = keep(here)
    dialog.get_by_role("button", name="As Python or curl").click()
    python = here.page.locator("[data-code=python]").inner_text()
    curl = here.page.locator("[data-code=curl]").inner_text()
    ran = done([sys.executable, "-c", python])
    pitch = float(re.search(r"^fo_hz (\S+)", ran, re.M)[1])
    assert pitch == shown["measures"]["fo_hz"]["value"]
    asked = done(shlex.split(curl.replace("\\\n", " ")))
    assert f'"{here.result_id()}"' in asked, "the same request is the same result"


def pages(here) -> int:
    """Number of A4 pages of the printed page."""
    return len(re.findall(rb"/Type /Page\b", here.page.pdf(format="A4")))


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_report_is_one_white_page_with_the_displayed_values(visit, scheme):
    here = visit("?activation.pca=0.5", color_scheme=scheme)
    here.page.keyboard.press("a")
    here.set("activation.lca", 1)
    keep(here).get_by_role("button", name="Report to print").click()
    report = here.page.locator("article.report")
    report.get_by_label("Notes").fill("The gap narrows.")
    text = report.inner_text()
    assert "LCA\n1.00" in text and "Posterior gap" in text and "B − A" in text
    assert "activation.lca=1" in text, "the link is on it"
    for name in ("report-stage", "report-spectrum", "report-waves"):
        assert here.ink(name) > 0.02, name
    assert report.evaluate("e => getComputedStyle(e).color") == "rgb(28, 35, 38)", "dark on white in both themes"
    assert pages(here) == 1
    here.page.emulate_media(media="print")
    assert not here.page.locator(".desktop").is_visible() and report.is_visible()
    here.page.emulate_media(media="screen")
    here.page.reload()
    here.settle()
    keep(here).get_by_role("button", name="Report to print").click()
    assert here.page.get_by_label("Notes").input_value() == "The gap narrows.", "notes stay in this browser"


def test_measures_are_copied_as_a_table_with_range_source_and_reason(visit):
    here = visit("?activation.pca=1&subglottal_pressure_pa=100", permissions=["clipboard-read", "clipboard-write"])
    here.page.get_by_role("tab", name="Measures").click()
    here.page.get_by_role("button", name="Copy as table").click()
    here.page.get_by_text("Copied").wait_for()
    rows = [line.split("\t") for line in here.page.evaluate("navigator.clipboard.readText()").splitlines()]
    assert rows[0][:4] == ["Measure", "Symbol", "Value", "Unit"] and len({len(row) for row in rows}) == 1
    quotient = next(row for row in rows if row[0] == "Speed quotient")
    assert quotient[2] == "" and quotient[4] == "1.3 – 2.8" and "Chen" in quotient[5] and quotient[7]
    shown = here.page.locator("tr[data-measure=speed_quotient] .expected").inner_text()
    assert "1.3 – 2.8" in shown and "Chen" in shown, "range and source are in the table"
    keep(here).get_by_role("button", name="Report to print").click()
    assert "No phonation" in here.page.locator("article.report header").inner_text(), "why, once"
    assert pages(here) == 1, "reasons do not extend the report to a second page"


def test_a_caution_about_the_papers_constants_is_shown_only_for_a_voice_with_them(visit):
    here = visit("?model.variant=text_literal")
    here.page.get_by_role("tab", name="Measures").click()
    open_dialog = here.page.locator("dialog")

    def places() -> list[bool]:
        """Whether the table, the dialog of a measure and the report show the sentence."""
        table = here.page.locator(".measure-table")
        texts = [table.inner_text()]
        table.locator("tr[data-measure=fo_hz] button").click()
        texts.append(open_dialog.filter(has=here.page.locator(".facts")).inner_text())
        open_dialog.get_by_role("button", name="Close").click()
        keep(here).get_by_role("button", name="Report to print").click()
        texts.append(here.page.locator("article.report").inner_text())
        open_dialog.get_by_role("button", name="Close").click()
        return ["well above human values" in text for text in texts]

    assert places() == [True] * 3
    for variant in ("human", "paper", "human_female"):
        here.page.locator(".variant select").select_option(variant)
        here.settle()
        assert places() == [variant == "paper"] * 3, variant
