"""The convolution in blocks against its twin."""

import numpy as np
import pytest

from vfcore.kernels.response import respond

pytestmark = pytest.mark.kernel


@pytest.mark.parametrize("n, taps", [(350, 1700), (7, 3), (6, 40), (5, 1)])
def test_joined_blocks_equal_the_convolution_of_the_whole(n, taps):
    chance = np.random.default_rng(1)
    signal, response = chance.normal(size=6 * n), chance.normal(size=taps)
    memory, out = np.zeros(taps - 1 + n), np.empty((6, n))
    for block, row in zip(signal.reshape(6, n), out, strict=True):
        respond(block, memory, response[::-1].copy(), row)
    np.testing.assert_allclose(out.ravel(), np.convolve(signal, response)[: 6 * n], rtol=0, atol=1e-12 * taps)
