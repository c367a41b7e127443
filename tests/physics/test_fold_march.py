"""Marching in chunks: progress, cancellation, records and checkpoints, none of which may change the numbers."""

import threading
import time

import numpy as np
import pytest

import vfcore
import vfcore.fold.march
from tests.support.fold_harness import MODAL, advance, product_and_twin
from vfcore.errors import Cancelled
from vfcore.fold.form import RECORD
from vfcore.fold.march import TimeMarch
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S, Run, Simulation

COLUMN = {name: k for k, name in enumerate(RECORD)}


def modal_march(dt=DEFAULT_STEP_S, pressure_pa=1000.0):
    march = TimeMarch(product_and_twin(**MODAL)[0], dt, pressure_pa)
    march.start(0, None)
    return march


# ---- progress and cancel ----------------------------------------------------------------------------


def test_progress_rises_to_exactly_one_in_chunks_of_forty_milliseconds():
    fractions = []
    vfcore.simulate(Simulation(run=Run(duration_s=0.2)), progress=fractions.append)
    assert fractions[-1] == 1.0
    assert len(fractions) == 5
    assert np.diff([0.0, *fractions]) == pytest.approx(0.2, abs=0.001)


def test_a_fine_grid_at_a_short_step_has_shorter_chunks():
    fractions = []
    run = Run(duration_s=0.05, nx=80, ny=40, time_step_s=2e-6)  # a chunk of 40 ms would take 0.2 s
    with pytest.raises(Cancelled):
        vfcore.simulate(Simulation(run=run), progress=fractions.append, stop=lambda: len(fractions) > 2)
    assert np.diff([0.0, *fractions]) == pytest.approx(5e6 / (80 * 40) * 2e-6 / 0.05, rel=0.01)


def test_the_stop_flag_ends_the_run_before_the_next_chunk():
    asked, fractions = [], []

    def stop():
        asked.append(len(fractions))
        return len(asked) > 3

    with pytest.raises(Cancelled, match="stopped"):
        vfcore.simulate(Simulation(run=Run(duration_s=1.0)), progress=fractions.append, stop=stop)
    assert asked == [0, 1, 2, 3] and len(fractions) == 3


def test_a_run_stopped_from_another_thread_ends_within_a_few_chunks():
    """60 s of voice take seconds; a flag set after 0.1 s ends the run within a second."""
    flag, running = threading.Event(), threading.Event()
    timer = threading.Timer(0.1, flag.set)
    began = time.perf_counter()

    def progress(_):
        if not running.is_set():
            running.set()
            timer.start()

    with pytest.raises(Cancelled):
        vfcore.simulate(Simulation(run=Run(duration_s=60.0)), progress=progress, stop=flag.is_set)
    assert flag.is_set() and time.perf_counter() - began < 5.0


def test_the_loop_releases_the_gil():
    """Another thread runs during a long call of the kernel."""
    march = modal_march()
    advance(march, 10)
    done = threading.Event()

    def long_call():
        advance(march, 1_000_000)
        done.set()

    thread = threading.Thread(target=long_call)
    thread.start()
    began = last = time.perf_counter()
    longest = 0.0
    while not done.is_set():
        time.sleep(0.002)
        now = time.perf_counter()
        longest, last = max(longest, now - last), now
    thread.join()
    assert longest < 0.5 * (last - began)


# ---- records ----------------------------------------------------------------------------------------


def whole_run(samples=700, **kwargs):
    march = modal_march(**kwargs)
    return march.run(samples), march.buffer.copy()


@pytest.mark.parametrize("chunk_s", [DEFAULT_STEP_S, 1e-3, 7.7e-3, 1.0])
def test_the_result_does_not_depend_on_the_chunk_size(chunk_s, monkeypatch):
    record, buffer = whole_run()
    monkeypatch.setattr(vfcore.fold.march, "CHUNK_S", chunk_s)
    other_record, other_buffer = whole_run()
    assert np.array_equal(record, other_record, equal_nan=True)
    assert np.array_equal(buffer, other_buffer)


def test_two_runs_in_succession_equal_one_run():
    record, buffer = whole_run()
    march = modal_march()
    parts = np.concatenate([march.run(123), march.run(577)])
    assert np.array_equal(record, parts, equal_nan=True) and np.array_equal(buffer, march.buffer)


def test_a_sparse_record_has_every_twentieth_row_of_the_full_record():
    march = modal_march(PAPER_STEP_S)
    assert march.record_every == 20
    sparse = march.run(300)
    full = advance(modal_march(PAPER_STEP_S), 6000)
    assert np.array_equal(sparse, full[::20], equal_nan=True)


@pytest.mark.parametrize(("parts", "every"), [(1, 1), (2, 2), (3, 3), (4, 4), (16, 16)])
def test_the_record_has_twenty_eight_kilohertz_for_every_fraction_of_the_default_step(parts, every):
    assert modal_march(DEFAULT_STEP_S / parts).record_every == every


def test_with_a_step_longer_than_the_default_every_step_is_recorded():
    assert modal_march(1.5 * DEFAULT_STEP_S).record_every == 1


def test_the_same_run_twice_gives_the_same_bits():
    first, again = (vfcore.simulate(Simulation(run=Run(duration_s=0.1))) for _ in range(2))
    for name, values in first.arrays.items():
        assert np.array_equal(values, again.arrays[name], equal_nan=True), name


# ---- reading one cycle back ---------------------------------------------------------------------------


@pytest.mark.parametrize("dt", [DEFAULT_STEP_S, DEFAULT_STEP_S / 3])
def test_a_cycle_read_back_equals_the_recorded_motion(dt):
    march = modal_march(dt)
    record = march.run(2100)
    buffer = march.buffer.copy()
    cycle = march.cycle(1700, 1934, 234)
    assert np.array_equal(march.buffer, buffer) and march.steps == 2100 * march.record_every
    assert cycle["cycle_time_s"] == pytest.approx(np.arange(1700, 1934) * DEFAULT_STEP_S, rel=1e-12)
    [fold], lines = march.glottis.walls, record[1700:1934]
    G = fold.medial_plane_m.T
    gap = 2 * np.maximum(G - cycle["cycle_w_m"][0], 0).min(axis=2)
    area = np.trapezoid(gap, fold.x_m, axis=1)
    assert area == pytest.approx(lines[:, COLUMN["glottal_area_m2"]], rel=1e-12, abs=1e-20)
    assert area.max() > 1e-5 and area.min() == 0
    pushes = np.maximum(cycle["cycle_contact_pressure_pa"][:, 1:-1], 0).max(axis=(1, 2))
    assert pushes == pytest.approx(lines[:, COLUMN["contact_pressure_max_pa"]], rel=1e-9, abs=1e-9)
    assert pushes.max() > 1000


def test_the_pressures_of_a_cycle_use_the_lung_pressure_of_that_time():
    glottis, _ = product_and_twin(**MODAL)
    march = TimeMarch(glottis, DEFAULT_STEP_S, 1000.0, rise_s=0.02)
    march.start(0, None)
    march.run(1000)
    cycle = march.cycle(300, 400, 10)
    inlet = cycle["cycle_aerodynamic_pressure_pa"][:, :, -1].max(axis=1)
    rising = 1000.0 * np.arange(300, 400, 10) * DEFAULT_STEP_S / 0.02
    assert inlet == pytest.approx(rising, rel=1e-12)


def test_a_quarter_of_a_second_can_be_read_back():
    march = modal_march()
    march.run(14_000)
    oldest = march.oldest_sample
    assert 0.25 <= (14_000 - oldest) * DEFAULT_STEP_S <= 0.25 + vfcore.fold.march.CHUNK_S
    assert march.cycle(oldest, oldest + 100, 4)["cycle_w_m"].shape == (1, 4, 20, 10)
