"""Pictures draw the values that exist and label those that are missing."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from tests.support.synthetic_evidence import CT, HALF_SINE, TA, activation_map, series, states, sweep, voice_of, wave
from vocalis.studies.paper import CLAIMS
from vocalis.studies.paper.pictures.by_claim import figure
from vocalis.studies.paper.pictures.muscle_maps import BLANKS, blanks, measure
from vocalis.studies.paper.pictures.plot import Plot, PlotAxis
from vocalis.studies.paper.run.gather import Failure

VOICE = voice_of(wave(), speed_quotient=1.5, closed_quotient=0.5)
FOUND = {
    "static_adduction": series(half_gap=lambda a: 1e-3 * (1 - a)), "static_ta": series(),
    "static_ct": series(superior=lambda a: 1e-4 * HALF_SINE),
    "static_pca": series(), "modal": VOICE, "pca_half": VOICE, "pca_full": VOICE, "ct_ta_map": activation_map(),
    "pca_sweep": sweep(),
}  # fmt: skip


def drawn(plot: Plot) -> ET.Element:
    return ET.fromstring(f"<svg>{plot.svg()}</svg>")


def words(plot: Plot) -> str:
    return " | ".join(text.text for text in drawn(plot).iter("text"))


@pytest.mark.parametrize("key", [key for key in CLAIMS if key != "T1"])
def test_every_claim_on_runs_has_a_picture_with_labelled_axes(key):
    plot = figure(CLAIMS[key], FOUND).plot
    tree = drawn(plot)
    assert len(list(tree.iter("polyline"))) + len(list(tree.iter("rect"))) > 1
    assert len(list(tree.iter("text"))) > 6  # title, two axes, ticks
    assert "nan" not in plot.svg()


def test_claims_on_one_map_share_its_picture():
    keys = {figure(CLAIMS[key], FOUND).key for key in ("A1", "A2", "A3", "A4")}
    assert len(keys) == 1 and figure(CLAIMS["A6"], FOUND).key not in keys


def test_a_run_without_an_answer_has_no_picture():
    assert figure(CLAIMS["M1"], {"modal": Failure("diverged")}) is None


def test_cells_without_phonation_are_drawn_in_their_own_colour_and_counted():
    maps = activation_map(state=states((TA > 0.9) & (CT < 0.2), "none"))
    plot = blanks(maps)
    silent = int(((TA > 0.9) & (CT < 0.2)).sum())
    fills = [rect.get("fill") for rect in drawn(plot).iter("rect")]
    assert fills.count(BLANKS["none"][0]) == silent + 1  # and its line of the legend
    assert f"no phonation: {silent} cells" in words(plot) and f"phonates: {441 - silent} of 441" in words(plot)


def test_failed_weak_and_irregular_cells_are_distinguished():
    state = states(TA > 0.9, "failed")
    state[0] = "irregular"
    level = np.where(CT > 0.96, 60.0, 130.0)
    text = words(measure(activation_map(state=state, spl_lips_db=level), "mean_flow_ml_s", "flow"))
    assert "the run failed: 40 cells" in text and "irregular: 21 cells" in text
    assert "repeats, but too weak for voice: 19 cells" in text


def test_f_o_excludes_and_labels_subharmonic_cells():
    maps = activation_map(state=states(TA > 0.9, "subharmonic"))
    assert "subharmonic: f_o not judged: 42 cells" in words(figure(CLAIMS["A1"], {"ct_ta_map": maps}).plot)
    assert "subharmonic" not in words(figure(CLAIMS["A6"], {"ct_ta_map": maps}).plot)


def test_a_map_without_voiced_cells_is_still_drawn():
    silent = activation_map(state=states(TA >= 0, "none"))
    assert "no phonation: 441 cells" in words(figure(CLAIMS["A8"], {"ct_ta_map": silent}).plot)


def test_a_curve_breaks_where_nothing_repeats():
    state = np.full(21, "periodic", dtype="U11")
    state[8:11] = "irregular"
    plot = figure(CLAIMS["P2"], {"pca_sweep": sweep(state=state)}).plot
    assert len(list(drawn(plot).iter("polyline"))) == 2
    assert "not repeating at 3 of 21 levels" in words(plot)


def test_points_land_where_the_axes_say():
    plot = Plot("t", PlotAxis(0.0, 2.0, "x"), PlotAxis(0.0, 10.0, "y"))
    plot.line([0.0, 2.0], [0.0, 10.0], "red")
    plot.cell((0.0, 2.0), (0.0, 10.0), "blue")
    tree = drawn(plot)
    cell, frame = tree.findall("rect")
    x, y, width, height = (float(cell.get(name)) for name in ("x", "y", "width", "height"))
    assert tree.find("polyline").get("points") == f"{x:.1f},{y + height:.1f} {x + width:.1f},{y:.1f}"
    assert [float(frame.get(name)) for name in ("x", "y", "width", "height")] == [x, y, width, height]


def test_ticks_are_round_numbers_within_an_axis_that_may_run_backwards():
    plot = Plot("t", PlotAxis(0.0, 1.0, "x"), PlotAxis(1.05, -0.05, "y/b"))
    rows = [t for t in drawn(plot).iter("text") if t.get("text-anchor") == "end"]
    assert [t.text for t in rows] == ["0", "0.25", "0.5", "0.75", "1"]
    heights = [float(t.get("y")) for t in rows]
    assert heights == sorted(heights)  # 0, the superior edge, on top
