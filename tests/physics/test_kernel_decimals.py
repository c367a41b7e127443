"""Numbers as text: what is written reads back as the number, to the last decimal."""

import json

import numpy as np
import pytest

from vfcore.kernels.decimals import ROOM, write_decimals

pytestmark = pytest.mark.kernel


def written(values, factor: float, decimals: int) -> str:
    out = np.zeros(len(values) * ROOM + 2, np.uint8)
    return out[: write_decimals(np.array(values, float), factor, decimals, out)].tobytes().decode()


@pytest.mark.parametrize(
    "values, factor, decimals, text",
    [
        ([], 1.0, 2, "[]"),
        ([0.0, 1.0, -1.0], 1.0, 0, "[0,1,-1]"),
        ([0.0, 0.04, -0.04, 0.06], 1.0, 1, "[0.0,0.0,0.0,0.1]"),
        ([1.5e-6, -12.346e-6], 1e6, 2, "[1.50,-12.35]"),
        ([0.015, -1e-6], 1.0, 6, "[0.015000,-0.000001]"),
        ([np.nan, np.inf, -1e15, 1.0], 1.0, 1, "[null,null,null,1.0]"),
    ],
)
def test_it_is_the_text_of_a_list(values, factor, decimals, text):
    assert written(values, factor, decimals) == text


def test_what_is_read_back_is_nearest():
    values = np.random.default_rng(2).normal(0.0, 300.0, 2000)
    for decimals in (0, 1, 6, 9):
        found = np.array(json.loads(written(values, 0.1, decimals)))
        assert np.abs(found - 0.1 * values).max() <= 0.5001 * 10.0**-decimals
    assert len(written([-9.99e14] * 3, 1.0, 0)) <= 3 * ROOM
