"""Many folds in one buffer: independent of each other, equal to single runs, and divergence affects one fold only."""

import numpy as np
import pytest

from tests.support.fold_harness import MODAL, product_and_twin
from vfcore.errors import Cancelled, DivergenceError
from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import OF_EACH, MarchInput, march_many
from vfcore.fold.statics import static_shapes_of
from vfcore.spec.simulation import DEFAULT_STEP_S

OPEN_BACK = {"strain": -0.004, "a_ta": 0.4, "theta_g": 0.192}
LONG = {"strain": 0.23, "a_ta": 0.0, "theta_g": 0.018}
SHAPES = (MODAL, OPEN_BACK, LONG, MODAL | {"shear": "rotation"}, MODAL | {"nx": 12, "ny": 6})
OVERLAPPING = MODAL | {"theta_g": 0.0, "theta_conv": -0.02}  # along the whole length, ends included
CASES = [*(case | {"theta_conv": conv} for conv in (0.02, 0.05) for case in SHAPES), OVERLAPPING]


def inputs(duration_s=0.02):
    glottises = [product_and_twin(**case)[0] for case in CASES]
    return [
        MarchInput(
            glottis,
            DEFAULT_STEP_S,
            800.0 + 50.0 * k,
            duration_s,
            0.005 * (k % 3),
            static_shapes_of(glottis) if k % 2 else None,
        )
        for k, glottis in enumerate(glottises)
    ]


def alone(one):
    march = TimeMarch(one.glottis, one.time_step_s, one.pressure_pa, one.rise_s)
    march.start(0, one.start)
    return march.run(round(one.duration_s / one.sample_s))


@pytest.mark.parametrize("single_precision", [False, True])
def test_the_record_of_a_fold_does_not_depend_on_its_neighbours_or_its_place(single_precision):
    some = inputs()
    together = dict(march_many(some, single_precision=single_precision))
    assert sorted(together) == list(range(len(some)))
    reverse = dict(march_many(some[::-1], single_precision=single_precision))
    for k, one in enumerate(some):
        [(_, single)] = march_many([one], single_precision=single_precision)
        for other in (single, reverse[len(some) - 1 - k]):
            assert np.array_equal(together[k].record, other.record, equal_nan=True)


def test_each_fold_moves_as_it_does_alone():
    some = inputs()
    for k, result in march_many(some):
        expected = alone(some[k])
        for column, name in enumerate(OF_EACH):
            scale = np.nanmax(np.abs(expected[:, column]), initial=1e-30)
            assert result.record[:, column] == pytest.approx(
                expected[:, column], rel=1e-12, abs=1e-12 * scale, nan_ok=True
            ), name


def test_single_precision_is_the_same_voice_to_a_thousandth_through_onset():
    [(_, result)] = march_many(inputs()[:1], single_precision=True)
    area = alone(inputs()[0])[:, 0]
    assert np.abs(result.record[:, 0] - area).max() < 1e-3 * area.max()


def test_a_fold_that_diverges_is_reported_as_alone_and_disturbs_no_other():
    glottis, _ = product_and_twin(**MODAL)
    calm = MarchInput(glottis, DEFAULT_STEP_S, 1000.0, 0.03)
    wild = MarchInput(glottis, DEFAULT_STEP_S, 1e8, 0.03)
    (_, first), (_, second), (_, third) = march_many([calm, wild, calm])
    with pytest.raises(DivergenceError) as caught:
        alone(wild)
    assert isinstance(second, DivergenceError) and str(second) == str(caught.value)
    [(_, undisturbed)] = march_many([calm])
    for result in (first, third):
        assert np.array_equal(result.record, undisturbed.record, equal_nan=True)


def test_a_stop_takes_effect_between_chunks():
    asked = []

    def stop():
        asked.append(None)
        return len(asked) > 2

    with pytest.raises(Cancelled):
        list(march_many(inputs(0.1)[:2], stop=stop))
    assert len(asked) == 3
