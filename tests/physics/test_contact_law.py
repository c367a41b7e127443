"""Contact pressure: a spring and a damper that act only beyond the medial plane."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.fold_harness import advance, product_and_twin, put_state
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.fold.terms.contact import contact_pressure, touching

K, C = 1e6, 100.0
METRES, SPEEDS = st.floats(-3e-3, 3e-3), st.floats(-3, 3)


@pytest.mark.kernel
@given(w=METRES, G=METRES, velocity=SPEEDS)
def test_the_law_is_spring_and_damper_beyond_the_plane_and_zero_before_it(w, G, velocity):
    expected = K * (w - G) + C * velocity if w > G else 0.0
    assert contact_pressure(w - G, velocity, K, C) == pytest.approx(expected, rel=1e-12, abs=1e-9)
    assert touching(w - G) == (w > G)


def test_the_damper_may_pull_while_the_folds_separate():
    assert contact_pressure(1e-4, -2.0, K, C) == pytest.approx(100.0 - 200.0)


@pytest.mark.kernel
def test_the_record_has_the_largest_push_its_column_and_the_contact_area():
    glottis, twin = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.05, nx=12, ny=6)
    w_m = twin.medial[1:-1] - 1e-4
    w_m[2, 1:4] += [2e-4, 3e-4, 2e-4]  # column 3 of the grid
    w_m[7, 5] += 2.5e-4  # column 8, the inferior edge: half a cell
    march = TimeMarch(glottis, 1e-6, 0.0)
    put_state(march, twin.zero_state()._replace(w_m=w_m))
    sample = dict(zip(RECORD, advance(march, 1)[0], strict=True))
    assert sample["contact_pressure_max_pa"] == pytest.approx(K * 2e-4, rel=1e-9)
    assert sample["contact_column"] == 3
    assert sample["contact_area_m2"] == pytest.approx(3.5 * twin.dx * twin.dy, rel=1e-9)


@pytest.mark.kernel
def test_without_contact_the_column_is_nan_and_the_pressure_zero():
    glottis, twin = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.05, nx=12, ny=6)
    sample = dict(zip(RECORD, advance(TimeMarch(glottis, 1e-6, 0.0), 1)[0], strict=True))
    assert np.isnan(sample["contact_column"])
    assert sample["contact_pressure_max_pa"] == sample["contact_area_m2"] == 0
