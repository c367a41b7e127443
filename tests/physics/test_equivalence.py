"""The fast step hides no physics: 300 random postures against the plain loop at the paper's step."""

import numpy as np
import pytest

from tests.support.equivalence import BOUNDS, SAME_STATE, compare, report, survey
from vfcore.params import Simulation


def test_the_modal_voice_is_that_of_the_papers_step():
    found = compare(Simulation())
    assert found.states == ("periodic", "periodic")
    assert all(deviation <= bound for deviation, (_, bound, _) in zip(found.deviations, BOUNDS, strict=True))


@pytest.mark.slow
def test_random_voices_are_those_of_the_papers_step():
    found = survey(300)
    same = [one for one in found if one.states[0] == one.states[1]]
    assert len(same) >= SAME_STATE * len(found), report(found)
    periodic = np.array([one.deviations for one in same if one.states[0] == "periodic"])
    assert len(periodic) > 100
    for k, (key, bound, _) in enumerate(BOUNDS):
        assert np.nanpercentile(periodic[:, k], 90) <= bound, f"{key}: {report(found)}"
