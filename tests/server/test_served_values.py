"""What a server gives from its store is what a fresh run computes, whatever was asked before."""

import pytest

import vfcore
from tests.server.live_server import finish, run, serving
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.request import flat, nested, resolve
from vfcore.spec.variants import VARIANTS

SHORT = {"run": {"duration_s": 0.06}, "subglottal_pressure_pa": 800}
KEYS = ("mean_flow_ml_s", "length_mm", "strain")


@pytest.fixture(scope="module")
def client():
    with serving() as server, server.client() as client:
        yield client


def fresh(document: dict) -> dict[str, float]:
    measures = vfcore.simulate(resolve(document)).report.measures
    # Lanes of a batch and a run of its own round differently in the last digits.
    return {key: pytest.approx(measures[key].value, rel=1e-9) for key in KEYS}


def changed_constants(variant: str) -> list[str]:
    """Constants of the fold and airways that the variant changes; K_col where it changes none."""
    return [change.name for change in VARIANTS[variant].changes][:4] or ["K_col_pa_m"]


@pytest.mark.parametrize("variant", VARIANTS)
def test_points_single_runs_and_maps_never_answer_for_each_other(client, variant):
    """A constant at the paper's value, at the variant's, and not named at all: in both orders, each its own voice."""
    base = SHORT | {"model": {"variant": variant}}
    own = resolve(base).larynx
    for name in changed_constants(variant):
        path = f"constants.{name}"
        values = sorted({PAPER_LARYNX.value(name), own.value(name)})
        asked = [
            {"axes": [{"parameter": path, "values": values}], "keep_waveforms": True},
            {"axes": [{"parameter": "activation.ct", "values": [0.3]}]},
        ]
        for more in asked if name.startswith("C") else reversed(asked):
            job = finish(client, run(client, {"kind": "sweep", "base": base} | more))
            table = client.get(f"/jobs/{job['id']}/result").json()
            (axis,) = more["axes"]
            for k, value in enumerate(axis["values"]):
                served = {key: table["measures"][key]["values"][k] for key in KEYS}
                assert served == fresh(nested(flat(base) | {axis["parameter"]: value})), (axis, value)
    plain = client.post("/simulate", json=base).json()
    assert {key: plain["measures"][key]["value"] for key in KEYS} == fresh(base)
    assert plain["provenance"]["request"]["constants"] == {}
