"""Start of a run: flat with a bump of 1 nm or in the static shape, with a step or a ramp of lung pressure."""

import numpy as np
import pytest

import vfcore
from tests.support.fold_harness import MODAL, SHEARS, advance, beam, membrane, product_and_twin
from vfcore.fold.form import RECORD
from vfcore.fold.layout import ROTATION
from vfcore.fold.march import TimeMarch
from vfcore.fold.statics import static_shapes_of
from vfcore.spec.simulation import DEFAULT_STEP_S, Run, Simulation

AREA, FLOW, CONTACT = (RECORD.index(name) for name in ("glottal_area_m2", "glottal_flow_m3_s", "contact_area_m2"))
SHORT = 0.05


@pytest.mark.parametrize("shear", SHEARS)
def test_a_flat_start_is_at_rest_but_for_a_bump_of_one_nanometre(shear):
    glottis, twin = product_and_twin(**MODAL, nx=21, ny=11, shear=shear)
    march = TimeMarch(glottis, DEFAULT_STEP_S, 1000.0)
    march.start(0, None)
    w = membrane(march)
    assert w[5, 10] == pytest.approx(1e-9, rel=1e-12) and w.max() == w[5, 10]
    assert np.abs(w.T - twin.whole(twin.initial_state().w_m)).max() < 1e-24
    assert not w[[0, -1]].any() and not w[:, [0, -1]].any()
    for name in ("v", "v_star", *(ROTATION if shear == "rotation" else ())):
        assert not membrane(march, name).any()
    for name in ("w_b", "v_b", "v_star_b"):
        assert not beam(march, name).any()


def test_a_static_start_is_the_static_shape_at_rest():
    glottis, _ = product_and_twin(**MODAL)
    shape, march = static_shapes_of(glottis)[0], TimeMarch(glottis, DEFAULT_STEP_S, 1000.0)
    march.start(0, [shape])
    assert (membrane(march) == shape.w_m).all() and (beam(march) == shape.w_b).all()
    assert not membrane(march, "v").any() and not beam(march, "v_b").any()


def test_a_run_starts_where_the_request_says():
    """The static shape of the modal fold is closed by contact; the flat start barely touches."""
    static = vfcore.simulate(Simulation(run=Run(duration_s=SHORT, start="static")))
    flat = vfcore.simulate(Simulation(run=Run(duration_s=SHORT)))
    touching = static.arrays["contact_area_m2"][0]
    assert touching > 0.5 * static.coefficients.length_m * static.coefficients.thickness_m
    assert flat.arrays["contact_area_m2"][0] < 0.2 * touching
    assert static.arrays["contact_pressure_max_pa"][0] == pytest.approx(
        1e6 * (static.arrays["static_w_m"] - static.arrays["medial_plane_m"]).max(), rel=1e-9
    )


def test_both_starts_give_the_same_modal_voice():
    voices = [vfcore.simulate(Simulation(run=Run(duration_s=0.6, start=start))) for start in ("flat", "static")]
    pitch, flow = ([v.report.measures[key].value for v in voices] for key in ("fo_hz", "mean_flow_ml_s"))
    assert pitch[0] == pytest.approx(pitch[1], rel=1e-4)
    assert flow[0] == pytest.approx(flow[1], rel=1e-3)


def test_the_pressure_rises_linearly_to_its_full_value():
    march = TimeMarch(product_and_twin(**MODAL)[0], DEFAULT_STEP_S, 800.0, rise_s=0.1)
    times = np.array([0.0, 0.025, 0.05, 0.0999, 0.1, 0.3])
    pressures = march.pressure_at(times / DEFAULT_STEP_S)
    assert pressures == pytest.approx([0.0, 200.0, 400.0, 799.2, 800.0, 800.0])


def test_without_a_rise_the_pressure_is_full_from_the_first_step():
    march = TimeMarch(product_and_twin(**MODAL)[0], DEFAULT_STEP_S, 800.0)
    assert (march.pressure_at(np.arange(3)) == 800.0).all()


def test_the_flow_of_an_open_glottis_follows_the_root_of_the_rising_pressure():
    """A wide open fold hardly moves in the first milliseconds: Q ∝ √P_s."""
    glottis, _ = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.4, theta_conv=0.2, mu_a_pa_s=0.0)
    [shape] = static_shapes_of(glottis)
    march = TimeMarch(glottis, DEFAULT_STEP_S, 10.0, rise_s=40 * DEFAULT_STEP_S)
    march.start(0, [shape])
    flow = advance(march, 60)[:, FLOW]
    assert flow[0] == 0
    assert flow[[10, 20, 40]] / flow[40] == pytest.approx(np.sqrt([0.25, 0.5, 1.0]), rel=5e-3)
    assert flow[59] == pytest.approx(flow[40], rel=5e-3)


def test_a_ramp_and_a_step_give_the_same_voice():
    voices = [vfcore.simulate(Simulation(run=Run(duration_s=0.8, pressure_rise_s=rise))) for rise in (0.0, 0.1)]
    pitch = [voice.report.measures["fo_hz"].value for voice in voices]
    assert pitch[0] == pytest.approx(pitch[1], rel=1e-4)
    onset = [np.argmax(voice.arrays["glottal_flow_m3_s"] > 1e-4) for voice in voices]
    assert onset[1] > onset[0] + 100


def test_without_pressure_no_air_flows_and_the_folds_settle_into_the_static_shape():
    glottis, _ = product_and_twin(**MODAL)
    march = TimeMarch(glottis, DEFAULT_STEP_S, 0.0)
    march.start(0, None)
    record = advance(march, round(1.5 / DEFAULT_STEP_S))
    assert not record[:, FLOW].any()
    [shape] = static_shapes_of(glottis)
    assert np.abs(membrane(march) - shape.w_m).max() < 0.01 * np.abs(shape.w_m).max()
    assert record[-1, CONTACT] > 0 and record[-1, AREA] == 0
