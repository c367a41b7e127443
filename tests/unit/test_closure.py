"""Closure patterns of synthetic gaps, and of postures with a clinically known pattern."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import vfcore
from vfcore.fold.closure import CLOSED_GAP_M, PATTERNS, describe_closure
from vfcore.spec.simulation import Activation, Simulation

LENGTH_M = 0.016
X = np.linspace(0, 1, 41)
OPEN_M = 1e-3


def shape_of(gap, x=X):
    return describe_closure(np.asarray(gap, dtype=float), x * LENGTH_M)


DRAWN = {
    "complete": np.zeros(41),
    "posterior_opening": np.where(X > 0.6, OPEN_M, 0),
    "anterior_opening": np.where(X < 0.5, OPEN_M, 0),
    "hourglass": np.where(np.abs(X - 0.5) < 0.15, 0, OPEN_M),
    "spindle": np.where(np.abs(X - 0.5) < 0.25, OPEN_M, 0),
    "open": X * OPEN_M + 2 * CLOSED_GAP_M,
}


@pytest.mark.parametrize("pattern", PATTERNS)
def test_each_pattern_is_recognised(pattern):
    assert shape_of(DRAWN[pattern]).pattern == pattern


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("nodes", [12, 20, 21, 80])
def test_a_pattern_does_not_depend_on_the_grid(pattern, nodes):
    x = np.linspace(0, 1, nodes)
    gap = DRAWN[pattern][np.rint(x * 40).astype(int)]
    assert shape_of(gap, x).pattern == pattern


def test_the_commissure_is_closed_in_every_larynx_and_does_not_count():
    gap = np.full(41, OPEN_M)
    gap[0] = 0
    assert shape_of(gap).pattern == "open" and shape_of(gap).closed_fraction == 0


@pytest.mark.parametrize("at", [1, 20, 39])
def test_a_single_node_is_not_a_region(at):
    touching, apart = np.full(41, OPEN_M), np.zeros(41)
    touching[at : at + 2] = 0
    apart[at : at + 2] = OPEN_M
    assert shape_of(touching).pattern == "open"
    assert shape_of(apart).pattern == "complete"


def test_a_gap_too_small_to_be_seen_is_closed():
    assert shape_of(np.full(41, 0.99 * CLOSED_GAP_M)).pattern == "complete"
    assert shape_of(np.full(41, 1.01 * CLOSED_GAP_M)).pattern == "open"


def test_several_alternations_are_named_by_the_end_that_is_open():
    quarters = np.minimum(X * 4, 3).astype(int)
    assert shape_of(np.where(quarters % 2 == 1, OPEN_M, 0)).pattern == "posterior_opening"
    assert shape_of(np.where(quarters % 2 == 0, OPEN_M, 0)).pattern == "anterior_opening"


def test_the_open_area_is_the_integral_of_the_gap_and_the_fraction_counts_nodes():
    shape = shape_of(np.where(X >= 0.5, OPEN_M, 0))
    assert shape.open_area_m2 == pytest.approx(0.5 * LENGTH_M * OPEN_M + 0.5 * OPEN_M * LENGTH_M / 40, rel=1e-12)
    assert shape.closed_fraction == pytest.approx(19 / 40)


@given(st.lists(st.floats(0, 5e-3), min_size=6, max_size=60))
def test_every_gap_has_one_pattern_of_the_six(gap):
    shape = shape_of(gap, np.linspace(0, 1, len(gap)))
    assert shape.pattern in PATTERNS
    assert 0 <= shape.closed_fraction <= 1 and shape.open_area_m2 >= 0


@pytest.mark.parametrize(
    ("muscles", "pattern"),
    [
        ({}, "complete"),
        ({"pca": 0.2, "ta": 0.5}, "posterior_opening"),
        ({"lca": 0.5, "ia": 0.5, "ct": 0.1}, "posterior_opening"),
        ({"lca": 1.0, "ia": 1.0, "ct": 0.1, "ta": 0.0}, "anterior_opening"),
        ({"pca": 1.0}, "open"),
        ({"lca": 0.1, "ia": 0.1, "ct": 0.1, "ta": 0.0}, "open"),
    ],
    ids=["modal", "some PCA", "little adduction, TA", "full adduction, no TA", "full PCA", "hardly adducted"],
)
def test_a_real_posture_has_the_pattern_the_paper_describes(muscles, pattern):
    assert vfcore.static_shape(Simulation(activation=Activation(**muscles))).closure.pattern == pattern
