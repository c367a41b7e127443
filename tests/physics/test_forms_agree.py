"""The same glottis in every form of the step: mirrored or two walls, uniform or patched, alone or side by side.

Sums in another order differ in the last digits, and contact makes such a difference grow along a voice. Tolerances are
those of the records' largest values.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import vfcore
from tests.support.fold_harness import MODAL, fields_of, fold_of, membrane
from tests.support.wall_twin import WallTwin
from vfcore.airways.coupled import airways
from vfcore.fold.assemble import Fold, Glottis
from vfcore.fold.constants import FoldConstants
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.fold.march_many import OF_EACH, MarchInput, march_many
from vfcore.runs.many import run_points
from vfcore.runs.setup import prepare
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S

P_S = 800.0
GRID = {"nx": 12, "ny": 6}
#: With airways the paper's dampers let the displacement pass its bound.
DAMPED = FoldConstants(C_coup_pa_s_m=40.0)
WALL = WallTwin(**MODAL, **GRID, constants=DAMPED)
LEFT, RIGHT = WALL, WallTwin(0.09, 0.1, 0.05, **GRID, constants=DAMPED)
STRETCHES = ("linear", "finite")
LESION = {"kind": "custom", "x": 0.5, "y": 0.5, "length_mm": 10, "width_mm": 4}
COLUMN = {name: k for k, name in enumerate(RECORD)}


def ways():
    return airways("a", 1.14, 350.0, DEFAULT_STEP_S)


def run(glottis: Glottis, duration_s: float, coupled: bool = False, many: bool = False, patched: bool = False):
    """The record of a march from the flat start, its columns by name."""
    air = ways() if coupled else None
    if many:
        [(_, result)] = march_many([MarchInput(glottis, DEFAULT_STEP_S, P_S, duration_s, airways=air)])
        return dict(zip(OF_EACH, result.record.T, strict=True))
    form = replace(glottis.form(coupled=coupled), patched=True) if patched else None
    march = TimeMarch(glottis, DEFAULT_STEP_S, P_S, airways=air, form=form)
    march.start(0, None)
    record = march.run(round(duration_s / DEFAULT_STEP_S))
    return dict(zip(march.form.record, record.T, strict=True))


def assert_same(found: dict, wanted: dict, tolerance: float, names=None):
    """Each column to ``tolerance`` of its largest value; where the largest push is, only where one pushes clearly."""
    assert wanted["contact_pressure_max_pa"].max() > 100 and wanted["glottal_flow_m3_s"].max() > 1e-4
    for name in names or wanted:
        differ = np.abs(found[name] - wanted[name])
        if name == "contact_column":
            differ = differ[wanted["contact_pressure_max_pa"] > 1.0]
        assert np.nanmax(differ) <= tolerance * np.nanmax(np.abs(wanted[name])), name


# ---- two walls ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("many", [False, True], ids=["alone", "batch"])
@pytest.mark.parametrize("coupled", [False, True], ids=["one-way", "two-way"])
@pytest.mark.parametrize("stretch", STRETCHES)
def test_two_equal_walls_are_a_fold_and_its_mirror_image(stretch, coupled, many):
    fold = fold_of(replace(WALL, stretch=stretch))
    one, two = (run(Glottis(walls), 0.05, coupled, many) for walls in ((fold,), (fold, fold)))
    assert_same(two, one, 1e-9, one)
    if not many:
        assert np.array_equal(two["left_edge_m"], two["right_edge_m"])


@pytest.mark.parametrize("kind", ["linear", "finite", "rotation", "patch", "coupled"])
def test_exchanged_walls_exchange_their_edges_and_leave_the_record(kind):
    changes = {"finite": {"stretch": "finite"}, "rotation": {"shear": "rotation"}}.get(kind, {})
    left, right = (fold_of(replace(wall, **changes)) for wall in (LEFT, RIGHT))
    if kind == "patch":
        right = with_patch(right)
    here, there = (run(Glottis(walls), 0.05, kind == "coupled") for walls in ((left, right), (right, left)))
    there["left_edge_m"], there["right_edge_m"] = there["right_edge_m"], there["left_edge_m"]
    assert_same(there, here, 1e-9)
    assert np.abs(here["left_edge_m"] - here["right_edge_m"]).max() > 1e-4


def test_walls_that_meet_off_the_midline_touch_no_more_than_those_that_meet_on_it():
    """Both planes lean by 0.3 mm to the same side at the back; nothing moves, and only the closed row is at rest."""
    left = replace(WALL, theta_g=0.02)
    length = [replace(WALL, strain=strain).k.L for strain in (left.strain, 0.09)]
    right = replace(WALL, strain=0.09, theta_g=-float(np.arctan(np.tan(0.02) * length[0] / length[1])))
    march = TimeMarch(Glottis((fold_of(left), fold_of(right))), DEFAULT_STEP_S, 0.0)
    record = np.empty((1, len(march.form.record)))
    march.advance(np.zeros(1), 1, record)
    assert np.abs(membrane(march, "G")[0]).max() > 3e-4
    assert (membrane(march, "G") >= -membrane(march, "G", side=1)).all()
    assert record[0, COLUMN["contact_area_m2"]] == record[0, COLUMN["contact_pressure_max_pa"]] == 0


# ---- material ------------------------------------------------------------------------------------------------


def with_patch(fold: Fold) -> Fold:
    """The fold with its middle twice as heavy."""
    fields = fold.fields.copy()
    fields[1, :, fold.nx // 3 : fold.nx // 2] *= 2.0
    return replace(fold, fields=fields, patched=True)


@pytest.mark.parametrize("changes", [{}, {"stretch": "finite"}, {"shear": "rotation"}], ids=["linear", "finite", "rot"])
@pytest.mark.parametrize("walls", [1, 2])
def test_uniform_material_as_fields_is_the_uniform_fold(walls, changes):
    folds = tuple(fold_of(replace(wall, **changes)) for wall in (LEFT, RIGHT)[:walls])
    uniform, fields = (run(Glottis(folds), 0.05, patched=patched) for patched in (False, True))
    assert_same(fields, uniform, 1e-9)


@pytest.mark.parametrize("many", [False, True], ids=["alone", "batch"])
def test_a_lesion_without_effect_is_no_lesion(many):
    """Ratios of 1 + 1e-7 change the voice by about as much."""
    ratios = dict.fromkeys(("mass_ratio", "stiffness_ratio", "viscosity_ratio"), 1.0000001)
    request = {"run": GRID, "subglottal_pressure_pa": P_S}
    plain, with_lesion = (
        prepare(resolve(request | lesions)).glottis for lesions in ({}, {"lesions": [LESION | ratios]})
    )
    assert with_lesion.form().patched and not plain.form().patched
    found, wanted = run(with_lesion, 0.05, many=many), run(plain, 0.05, many=many)
    assert_same(found, wanted, 1e-4, ("glottal_area_m2", "glottal_flow_m3_s"))
    stiff = prepare(resolve(request | {"lesions": [LESION | {"stiffness_ratio": 2}]})).glottis
    moved = run(stiff, 0.05, many=many)["glottal_flow_m3_s"] - wanted["glottal_flow_m3_s"]
    assert np.abs(moved).max() > 0.05 * wanted["glottal_flow_m3_s"].max()


def test_fields_of_the_twin_are_those_of_the_product():
    fold = fold_of(WALL)
    for found, wanted in zip(fields_of(WALL), fold.fields, strict=True):
        inside = found != 0  # the idle ends of intervals and half rows
        assert found[inside] == pytest.approx(wanted[inside], rel=1e-12)


# ---- batches --------------------------------------------------------------------------------------------------


@cache
def several() -> list[Glottis]:
    """Nine glottises of each kind that a batch may hold together or apart."""
    found = []
    for k in range(9):
        wall = replace(WALL, strain=0.03 + 0.01 * k)
        found.append(Glottis((fold_of(wall),)))
        found.append(Glottis((fold_of(replace(wall, stretch="finite")),)))
        found.append(Glottis((fold_of(wall), fold_of(RIGHT))))
        found.append(Glottis((with_patch(fold_of(wall)),)))
    return found


def batch(coupled: bool, duration_s: float = 0.02, order: int = 1, single_precision: bool = False):
    some = [
        MarchInput(glottis, DEFAULT_STEP_S, 800.0 + 40.0 * k, duration_s, airways=ways() if coupled else None)
        for k, glottis in enumerate(several())
    ]
    found = dict(march_many(some[::order], single_precision=single_precision))
    return some, [found[k] for k in range(len(some))][::order]


@pytest.mark.parametrize("coupled", [False, True], ids=["one-way", "two-way"])
def test_each_glottis_of_a_batch_moves_as_it_does_alone(coupled):
    some, results = batch(coupled)
    for one, result in zip(some, results, strict=True):
        march = TimeMarch(one.glottis, DEFAULT_STEP_S, one.pressure_pa, airways=one.airways)
        march.start(0, None)
        wanted = march.run(round(0.02 / DEFAULT_STEP_S))
        for name in ("glottal_area_m2", "glottal_flow_m3_s", "contact_area_m2", "contact_pressure_max_pa"):
            column = wanted[:, COLUMN[name]]
            assert np.abs(result.record[:, COLUMN[name]] - column).max() <= 1e-9 * column.max(), name


@pytest.mark.parametrize("single_precision", [False, True], ids=["double", "single"])
@pytest.mark.parametrize("coupled", [False, True], ids=["one-way", "two-way"])
def test_a_glottis_is_the_same_to_the_bit_whatever_its_neighbours(coupled, single_precision):
    some, forwards = batch(coupled, single_precision=single_precision)
    _, backwards = batch(coupled, order=-1, single_precision=single_precision)
    for one, here, there in zip(some, forwards, backwards, strict=True):
        assert np.array_equal(here.record, there.record, equal_nan=True)
        [(_, alone)] = march_many([one], single_precision=single_precision)
        assert np.array_equal(here.record, alone.record, equal_nan=True)


@pytest.mark.parametrize("coupled", [False, True], ids=["one-way", "two-way"])
def test_single_precision_is_the_same_voice_to_a_hundredth_through_onset(coupled):
    double, single = (batch(coupled, single_precision=single)[1] for single in (False, True))
    for a, b in zip(double, single, strict=True):
        area = a.record[:, 0]
        assert np.abs(b.record[:, 0] - area).max() < 1e-2 * area.max()


@pytest.mark.parametrize(
    "patch",
    [
        {"subglottal_pressure_pa": 700, "model": {"variant": "human"}},
        {"right": {"activation": {"ta": 0.35}}, "model": {"variant": "human"}},
        {"lesions": [LESION | {"stiffness_ratio": 2, "side": "left"}], "model": {"coupling": "two_way"}},
    ],
    ids=["human", "two sides", "lesion"],
)
def test_points_with_airways_are_the_runs_of_their_requests(patch):
    requests = [resolve(patch | {"activation": {"ct": ct}, "run": {"duration_s": 0.4}}) for ct in (0.1, 0.3)]
    for request, point in zip(requests, run_points(requests, precision="float64"), strict=True):
        alone = vfcore.simulate(request).report
        assert point.report.state == alone.state == "periodic"
        fo = alone.measures["fo_hz"].value
        assert fo is not None and point.report.measures["fo_hz"].value == pytest.approx(fo, rel=1e-4)
