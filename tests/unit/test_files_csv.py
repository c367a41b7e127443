"""The CSV of a run: every measure once, exact numbers, reasons for missing values."""

import csv
import io

import pytest

from vfcore.io.csv import COLUMNS, csv_text
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.one import simulate
from vfcore.spec.simulation import Activation, Run, Simulation


@pytest.fixture(scope="module", params=[0.0, 1.0], ids=["modal", "silent"])
def result(request):
    pressure = 50.0 if request.param else 1000.0
    activation = Activation(pca=request.param)
    return simulate(Simulation(activation=activation, subglottal_pressure_pa=pressure, run=Run(duration_s=0.2)))


def test_it_reads_back_exactly(result):
    state, *rows = csv.DictReader(io.StringIO(csv_text(result)))
    assert (state["key"], state["value"]) == ("phonation_state", result.report.state)
    assert [row["key"] for row in rows] == list(CATALOGUE.keys())
    for row in rows:
        measure, spec = result.report.measures[row["key"]], CATALOGUE[row["key"]]
        assert (row["symbol"], row["name"], row["unit"]) == (spec.symbol, spec.name, measure.unit)
        if measure.value is None:
            assert row["value"] == "" and row["reason"] == measure.reason
        else:
            assert float(row["value"]) == measure.value and row["reason"] == ""


def test_the_header_is_the_documented_one(result):
    assert csv_text(result).splitlines()[0] == "key,symbol,name,value,unit,reason" == ",".join(COLUMNS)
