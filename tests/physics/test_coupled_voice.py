"""Two-way coupling of the whole fold: forces against the twin, the limit of wide airways, order in the time step."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.airways_twin import AirwaysTwin
from tests.support.fold_harness import beam, get_state, membrane, product_and_twin
from vfcore.airways.coupled import Airways, airways
from vfcore.airways.tract import Tract
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.runs.one import simulate
from vfcore.spec.request import resolve
from vfcore.spec.simulation import DEFAULT_STEP_S, SECTION_TRAVEL_S

RHO, C, P_S = 1.14, 350.0, 800.0
DAMPED = {"C_coup_pa_s_m": 300.0}
FLOW, INLET, OUTLET = (RECORD.index(name) for name in ("glottal_flow_m3_s", "inlet_pressure_pa", "outlet_pressure_pa"))


def step(march: TimeMarch) -> np.ndarray:
    """Advance by one step; returns its row of the record."""
    record = np.empty(len(RECORD))
    march.advance(np.array([P_S]), 1, record)
    return record


@pytest.mark.kernel
def test_along_a_voice_flow_pressures_and_forces_equal_the_twins():
    """With a step of one section of travel the twin needs no geometry between steps."""
    glottis, twin = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.01, nx=12, ny=6, **DAMPED)
    ways = airways("a", RHO, C, SECTION_TRAVEL_S)
    march, air = TimeMarch(glottis, SECTION_TRAVEL_S, P_S, 0.0, ways), AirwaysTwin(ways)
    march.start(0, None)
    seen, room_before = [], np.zeros(glottis.nx)
    for n in range(1400):
        state = get_state(march)
        extrapolated = state._replace(
            v_m=membrane(march, "v_star")[:, 1:-1].T.copy(),
            v_b=beam(march, "v_star_b")[1:-1].copy(),
        )
        air.step(P_S, lambda drop, w=state.w_m: np.sign(drop) * twin.flow(w, abs(drop)).Q_g)
        line = step(march)
        seen.append((line[FLOW], air.flow, line[INLET], air.inlet, line[OUTLET], air.outlet))
        if n % 100 == 99 and line[INLET] > line[OUTLET]:
            drop = line[INLET] - line[OUTLET]
            aero = twin.mean_pressure(state.w_m, drop, room_before, SECTION_TRAVEL_S)[1:-1] + line[OUTLET]
            without = twin.acceleration(extrapolated, 0.0)[0] + twin.flow(state.w_m, 0.0).p_aero[1:-1] / twin.k.rho_s
            v, v_star = (membrane(march, name)[:, 1:-1].T for name in ("v", "v_star"))
            moved = 2 * (v_star - v) / SECTION_TRAVEL_S  # v* is half an increment beyond v
            wanted = without - aero / twin.k.rho_s
            assert np.abs(moved - wanted).max() < 2e-3 * np.abs(wanted).max()
        room_before = (twin.medial - twin.whole(state.w_m)).min(axis=1)
    flow, flow_twin, inlet, inlet_twin, outlet, outlet_twin = np.array(seen).T
    assert flow.max() > 1e-4 and outlet.min() < -50
    assert np.abs(flow - flow_twin).max() < 2e-3 * flow.max()
    assert np.abs(inlet - inlet_twin).max() < 2e-3 * P_S and np.abs(outlet - outlet_twin).max() < 2e-3 * P_S


def wide(factor: float) -> Airways:
    """Airways with all areas times ``factor``, so their pressures are smaller by that factor."""
    ways = airways("a", RHO, C, DEFAULT_STEP_S)

    def widened(tract: Tract) -> Tract:
        return replace(tract, areas_m2=tuple(area * factor for area in tract.areas_m2))

    return Airways(widened(ways.subglottal), widened(ways.supraglottal), ways.substeps)


def test_with_wide_airways_the_voice_becomes_that_of_one_way_coupling():
    glottis, _ = product_and_twin(strain=0.057, a_ta=0.4, theta_g=0.01, **DAMPED)
    records = {}
    for factor in (None, 25.0, 100.0):
        march = TimeMarch(glottis, DEFAULT_STEP_S, P_S, 0.0, wide(factor) if factor else None)
        march.start(0, None)
        records[factor] = march.run(280)
    size = records[None][:, FLOW].max()
    apart = {f: np.abs(records[f][:, FLOW] - records[None][:, FLOW]).max() / size for f in (25.0, 100.0)}
    assert apart[100.0] < 0.03 and apart[100.0] < 0.4 * apart[25.0]
    pressure = {f: np.abs(records[f][:, OUTLET]).max() for f in (25.0, 100.0)}
    assert pressure[100.0] < 0.4 * pressure[25.0] and pressure[100.0] < 0.1 * P_S


@pytest.mark.parametrize("stretch", ["linear", "finite"])
def test_the_voice_converges_with_the_time_step(stretch):
    """At second order with linear stretch; with finite stretch the errors are so small that no order shows."""
    model = {"variant": "human", "coupling": "two_way", "stretch": stretch}
    document = {"subglottal_pressure_pa": 600, "model": model}
    usual, half, finest = (
        simulate(resolve(document | {"run": {"duration_s": 0.5, "time_step_s": sections * SECTION_TRAVEL_S}})).report
        for sections in (4, 2, 1)  # steps that all allow the same tract; the default step is five sections
    )
    own = simulate(resolve(document | {"run": {"duration_s": 0.5}})).report
    assert usual.state == half.state == finest.state == own.state == "periodic"
    for key, most in {"fo_hz": 0.003, "mean_flow_ml_s": 0.02, "ac_flow_ml_s": 0.02, "peak_area_mm2": 0.015}.items():
        fine = finest.measures[key].value
        own_apart, apart, nearer = (abs(report.measures[key].value / fine - 1) for report in (own, usual, half))
        assert own_apart <= most, key
        assert nearer <= (apart / 4 if stretch == "linear" else most / 8), key


def test_fields_of_a_cycle_lie_between_the_pressures_around_the_glottis():
    """The air pressure on the folds is the inlet pressure upstream and the outlet pressure after separation."""
    result = simulate(resolve({"subglottal_pressure_pa": 600, "model": {"variant": "human", "coupling": "two_way"}}))
    at, time = result.arrays["cycle_time_s"], result.arrays["time_s"]
    inlet, outlet = (np.interp(at, time, result.arrays[f"{end}_pressure_pa"]) for end in ("inlet", "outlet"))
    field = result.arrays["cycle_aerodynamic_pressure_pa"]
    low, high = np.minimum(inlet, outlet)[:, None, None], np.maximum(inlet, outlet)[:, None, None]
    assert (field > low - 40).all() and (field < high + 40).all()
    assert np.ptp(inlet) > 100 and np.ptp(outlet) > 100
