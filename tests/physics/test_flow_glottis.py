"""Area and flow of the whole glottis, summed over slices."""

import numpy as np
import pytest

from tests.support.fold_harness import advance, product_and_twin
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch

AREA, FLOW, CONTACT = (RECORD.index(name) for name in ("glottal_area_m2", "glottal_flow_m3_s", "contact_area_m2"))


def first_sample(pressure_pa=1000.0, **posture):
    glottis, twin = product_and_twin(nx=12, ny=6, **posture)
    return advance(TimeMarch(glottis, 1e-6, pressure_pa), 1)[0], twin


@pytest.mark.kernel
def test_a_straight_open_glottis_has_the_area_of_a_triangle_and_its_bernoulli_flow():
    posture = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.1, "theta_conv": 0.0, "mu_a_pa_s": 0.0}
    sample, twin = first_sample(**posture)
    triangle = twin.k.L**2 * np.tan(0.1)  # both folds; the trapezoid rule is exact
    assert sample[AREA] == pytest.approx(triangle, rel=1e-12)
    assert sample[FLOW] == pytest.approx(np.sqrt(2 * 1000.0 / 1.14) * triangle, rel=1e-12)
    assert sample[CONTACT] == 0


@pytest.mark.kernel
def test_a_converging_glottis_has_the_area_of_its_outlet_and_more_flow_than_that():
    sample, twin = first_sample(strain=0.057, a_ta=0.4, theta_g=0.1, theta_conv=0.1, mu_a_pa_s=0.0)
    outlet = twin.k.L**2 * np.tan(0.1)
    assert sample[AREA] == pytest.approx(outlet, rel=1e-12)
    speed = np.sqrt(2 * 1000.0 / 1.14)
    widest = 2 * twin.k.b * np.tan(0.1)  # upper bound of what the slice at the commissure adds
    assert outlet * speed < sample[FLOW] <= (1.3 * outlet + widest * twin.dx) * speed


@pytest.mark.kernel
def test_without_viscosity_the_flow_is_proportional_to_the_root_of_the_pressure():
    posture = {"strain": 0.057, "a_ta": 0.4, "theta_g": 0.05, "mu_a_pa_s": 0.0}
    low, _ = first_sample(pressure_pa=400.0, **posture)
    high, _ = first_sample(pressure_pa=1600.0, **posture)
    assert high[FLOW] == pytest.approx(2 * low[FLOW], rel=1e-12)


@pytest.mark.kernel
def test_a_closed_glottis_has_no_area_and_no_flow():
    sample, _ = first_sample(strain=0.057, a_ta=0.4, theta_g=0.0)
    assert sample[AREA] == sample[FLOW] == 0
