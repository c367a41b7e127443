"""A netCDF file holds the whole result with units, for any netCDF reader, and is written atomically."""

import io
import json

import numpy as np
import pytest
import xarray

from vfcore.io.hdf5 import Variable, write_variables
from vfcore.io.netcdf import netcdf_bytes, request_of, write_netcdf
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.one import simulate
from vfcore.runs.result import ARRAYS, OF_TWO_WALLS
from vfcore.spec.request import resolve
from vfcore.spec.simulation import Activation, Run, Simulation


@pytest.fixture(scope="module")
def result():
    return simulate(Simulation(activation=Activation(ct=0.31), run=Run(duration_s=0.2, nx=14, ny=6)))


@pytest.fixture(scope="module")
def dataset(result, tmp_path_factory):
    path = tmp_path_factory.mktemp("netcdf") / "result.nc"
    write_netcdf(result, path)
    with xarray.open_dataset(path, engine="h5netcdf") as opened:
        yield opened.load()


def test_error_bars_are_attributes_of_their_measures_where_the_request_has_them(dataset):
    assert "error_half_width" not in dataset["measure_fo_hz"].attrs
    barred = simulate(Simulation(run=Run(duration_s=0.2, error_estimate=True)))
    with xarray.open_dataset(io.BytesIO(netcdf_bytes(barred)), engine="h5netcdf") as opened:
        for key, bar in barred.error_estimate.bars.items():
            found = opened[f"measure_{key}"].attrs
            if bar.half_width is None:
                assert np.isnan(found["error_half_width"]) and found["error_reason"] == bar.reason
            else:
                assert (found["error_half_width"], found["error_limit"]) == (bar.half_width, bar.limit)
        assert opened["measure_fo_hz"].attrs["error_half_width"] > 0.0


def test_every_array_comes_back_exactly_with_dimensions_and_units(dataset, result):
    assert set(result.arrays) == set(ARRAYS).difference(OF_TWO_WALLS)
    for name in result.arrays:
        spec = ARRAYS[name]
        assert dataset[name].dims == spec.dims
        assert np.array_equal(dataset[name].values, result.arrays[name], equal_nan=True)
        assert dataset[name].values.dtype == np.float64
        assert (dataset[name].attrs["units"], dataset[name].attrs["long_name"]) == (spec.unit, spec.label)
    assert dict(dataset.sizes) == {"time": len(result.arrays["time_s"]), "x": 14, "y": 6, "phase": 100, "side": 2}


def test_two_different_folds_are_told_apart_by_the_coordinate_side(tmp_path):
    found = simulate(resolve({"right": {"activation": {"ta": 0.1}}, "run": {"duration_s": 0.05, "nx": 14, "ny": 6}}))
    write_netcdf(found, tmp_path / "two.nc")
    with xarray.open_dataset(tmp_path / "two.nc", engine="h5netcdf") as opened:
        assert list(opened["side"].values) == ["left", "right"]
        assert opened["cycle_w_m"].dims == ("side", "phase", "x", "y")
        for name, array in found.arrays.items():
            assert np.array_equal(opened[name].values, array, equal_nan=True)
        for place, side in enumerate(("left", "right")):
            one = opened.sel(side=side)
            assert float(one["side_posture_strain"]) == found.postures[place].strain
            tension = found.wall_coefficients[place].membrane_tension_n_m
            assert float(one["side_coefficient_membrane_tension_n_m"]) == tension
        assert float(opened["posture_strain"]) == found.posture.strain


def test_every_measure_is_there_with_unit_or_reason(dataset, result):
    missing = 0
    for spec in CATALOGUE:
        measure, variable = result.report.measures[spec.key], dataset[f"measure_{spec.key}"]
        assert variable.attrs["units"] == measure.unit and variable.attrs["long_name"] == spec.name
        if measure.value is None:
            missing += 1
            assert np.isnan(variable) and variable.attrs["reason"] == measure.reason
        else:
            assert float(variable) == measure.value and "reason" not in variable.attrs
    assert missing > 0


def test_posture_and_coefficients_carry_their_units(dataset, result):
    assert float(dataset["posture_strain"]) == result.posture.strain
    assert float(dataset["coefficient_prestress_moment_n_m"]) == result.coefficients.prestress_moment_n_m
    assert dataset["coefficient_prestress_moment_n_m"].attrs["units"] == "N m"
    assert dataset["coefficient_membrane_tension_n_m"].attrs["units"] == "N m-1"


def test_the_file_describes_itself_and_can_be_reproduced(dataset, result):
    assert resolve(request_of(dataset.attrs)) == result.request
    assert dataset.attrs["phonation_state"] == result.report.state
    for name in ("model_version", "code_version", "numba_version", "created", "time_step_s", "sample_rate_hz"):
        assert dataset.attrs[name] == getattr(result.provenance, name)
    assert "Serry" in dataset.attrs["references"]


def test_the_bytes_are_the_same_file(dataset, result):
    with xarray.open_dataset(io.BytesIO(netcdf_bytes(result)), engine="h5netcdf") as opened:
        assert opened.equals(dataset) and opened.attrs == dataset.attrs


def test_a_run_without_phonation_can_be_written(tmp_path):
    silent = simulate(Simulation(activation=Activation(pca=1.0), subglottal_pressure_pa=50.0, run=Run(duration_s=0.05)))
    write_netcdf(silent, tmp_path / "silent.nc")
    with xarray.open_dataset(tmp_path / "silent.nc", engine="h5netcdf") as opened:
        assert opened.attrs["phonation_state"] == "none" and np.isnan(opened.attrs["periodicity"])
        assert np.isnan(opened["measure_fo_hz"]) and opened["measure_fo_hz"].attrs["reason"]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(result, tmp_path, monkeypatch):
    path = tmp_path / "result.nc"
    path.write_text("old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("vfcore.io.netcdf.write_variables", full)
    with pytest.raises(OSError, match="No space"):
        write_netcdf(result, path)
    assert path.read_text() == "old" and [item.name for item in tmp_path.iterdir()] == ["result.nc"]


def test_a_written_file_has_ordinary_permissions(result, tmp_path):
    (tmp_path / "plain").write_text("")
    write_netcdf(result, tmp_path / "result.nc")
    assert (tmp_path / "result.nc").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_variables_that_disagree_are_refused():
    one, two = Variable(("time",), np.zeros(3), {}), Variable(("time",), np.zeros(4), {})
    with pytest.raises(ValueError, match="time has 4 values, elsewhere 3"):
        write_variables(io.BytesIO(), {"a": one, "b": two}, {})
    with pytest.raises(ValueError, match="named like a dimension: time"):
        write_variables(io.BytesIO(), {"a": one, "time": Variable(("x",), np.zeros(3), {})}, {})


def test_the_request_attribute_is_json(dataset):
    assert json.loads(dataset.attrs["request"])["activation"]["ct"] == 0.31
