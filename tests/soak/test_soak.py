"""kill -9 in the middle of mixed work: nothing accepted is lost, nothing stored is damaged or computed again."""

from dataclasses import asdict

import pytest

from tests.soak.kill_nine import soak


@pytest.mark.timeout(300)
def test_two_kills():
    report = soak(kills=2, seed=7)
    assert report.is_clean, asdict(report)
    assert report.accepted > 5 and report.sweeps > 0 and report.points > 50


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_thirty_kills():
    report = soak(kills=30)
    assert report.is_clean, asdict(report)
