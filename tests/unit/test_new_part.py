"""A new optional part of a request needs only one declaration."""

import subprocess
import sys

DECLARE_AND_TRY = """
import sys, types
from dataclasses import dataclass
from pathlib import Path

package = types.ModuleType("vfcore")  # without its __init__, which binds the present request class everywhere
package.__path__ = [str(Path("vfcore").resolve())]
package.CODE_VERSION = "test"
sys.modules["vfcore"] = package

import vfcore.spec.simulation as simulation
from vfcore.spec.fields import part, quantity, validate


@dataclass(frozen=True, slots=True)
class Lesion:
    height_mm: float = quantity(0.5, "mm", "height", 0, 3, source="test")
    x: float = quantity(0.5, "1", "place", 0, 1, source="test")

    def __post_init__(self):
        validate(self, "lesion.")


@dataclass(frozen=True, slots=True)
class Innervation:
    rln: float = quantity(1.0, "1", "recurrent nerve", 0, 1, source="test")
    sln: float = quantity(1.0, "1", "superior nerve", 0, 1, source="test")

    def __post_init__(self):
        validate(self, "right.innervation.")


@dataclass(frozen=True, slots=True)
class Right:
    process_mm: float | None = quantity(None, "mm", "vocal process", 0, 10, source="test")
    innervation: Innervation = part(Innervation)
    posture: simulation.PostureOverride | None = part(simulation.PostureOverride, optional=True)

    def __post_init__(self):
        validate(self, "right.")


@dataclass(frozen=True, slots=True)
class Extended(simulation.Simulation):
    lesion: Lesion | None = part(Lesion, optional=True)
    right: Right | None = part(Right, optional=True)


simulation.Simulation = Extended

from vfcore.errors import ParameterError
from vfcore.spec.address import address, computation
from vfcore.spec.paths import NUMBERS
from vfcore.spec.request import document_of, patch_of, patched, resolve, values_of
from vfcore.spec.schema import GROUPS, parameter_schema
from vocalis.server.schemas.requests import SimulationBody, simulation_of

plain, given = resolve({}), resolve({"lesion": {"height_mm": 1}})
assert plain.lesion is None and given.lesion == Lesion(1.0)
assert "lesion.height_mm" in NUMBERS and "lesion" in GROUPS
assert [row["optional_part"] for row in parameter_schema() if row["key"] == "lesion.x"] == ["lesion"]
assert document_of(plain)["lesion"] is None and document_of(given)["lesion"] == {"height_mm": 1.0, "x": 0.5}
assert patch_of(plain) == {} and resolve(patch_of(given)) == given == resolve(document_of(given))
assert address(plain) != address(given) == address(patched(plain, {"lesion.height_mm": 1}))
assert computation(plain).with_numbers({"lesion.height_mm": 1.0}) == computation(given)
assert values_of(plain)["lesion"] is None and resolve({"lesion": None}) == plain
assert simulation_of(SimulationBody.model_validate({"lesion": {"height_mm": 1}})) == given
assert simulation_of(SimulationBody.model_validate({"lesion": None})) == plain

# A part within a part, one of them optional on its own.
palsy = resolve({"right": {"innervation": {"rln": 0}}})
assert palsy.right == Right(innervation=Innervation(rln=0.0)) and resolve({"right": {}}).right == Right()
assert resolve({"right.innervation.rln": 0}) == palsy == patched(plain, {"right.innervation.rln": 0.0})
weak = {"innervation": {"rln": 0.0, "sln": 1.0}, "posture": None, "process_mm": None}
assert document_of(palsy)["right"] == weak and document_of(plain)["right"] is None
assert resolve(patch_of(palsy)) == palsy == resolve(document_of(palsy)) == resolve(values_of(palsy))
fixed = patched(palsy, {"right.posture.strain": 0.1})
assert fixed.right.posture.strain == 0.1 and fixed.right.innervation.rln == 0
assert patched(fixed, {"right.posture": None}) == palsy and patched(fixed, {"right": None}) == plain
assert len({address(one) for one in (plain, palsy, fixed)}) == 3
for numbers in ({"right.innervation.rln": 0.5}, {"right.posture.strain": 0.2}, {"right.process_mm": 1.5}):
    for request in (plain, palsy, fixed):
        assert computation(request).with_numbers(numbers) == computation(patched(request, numbers)), numbers
body = {"right": {"innervation": {"rln": 0}, "posture": None}}
assert simulation_of(SimulationBody.model_validate(body)) == palsy
rows = {row["key"]: row for row in parameter_schema()}
assert rows["right.innervation.rln"]["optional_part"] == "right" == rows["right.innervation.rln"]["group"]
refused = {
    "right.innervation.rln": {"right": {"innervation": {"rln": 2}}},
    "right.nerve": {"right": {"nerve": 1}},
    "right.innervation": {"right": {"innervation": None}},
}
for path, bad in refused.items():
    try:
        resolve(bad)
    except ParameterError as error:
        assert error.path == path, error.path
    else:
        raise AssertionError(path)

# The forms beyond single runs.
from vfcore.runs.gesture.gesture import gesture_from_dict, gesture_to_dict
from vfcore.runs.gesture.slew import differences, slew_limited
from vfcore.runs.sweep.document import sweep_from_dict
from vocalis.cli.requests import request_patch

sweep = sweep_from_dict({"base": body, "axes": [{"parameter": "right.innervation.rln", "values": [0.0, 0.5]}]})
assert sweep.request(0) == palsy and sweep.address(0) != sweep.address(1)
moving = gesture_from_dict({"right": {"innervation": {"rln": [[0, 0], [1, 1]]}}})
assert moving.at(0.5).right.innervation.rln == 0.5
assert gesture_from_dict(gesture_to_dict(moving)).at(0.5) == moving.at(0.5)
assert resolve(request_patch(None, None, {}, ["right.innervation.rln=0"])) == palsy
half = patched(palsy, {"right.innervation.rln": 0.1})
moved = differences(palsy, half)
assert moved == ("right.innervation.rln",) and slew_limited(palsy, half, moved) == half

try:
    resolve({"lesion": {"height_mm": 9}})
except ParameterError as error:
    assert error.path == "lesion.height_mm"
else:
    raise AssertionError("a value out of range was taken")
print("one declaration")
"""


def test_one_declaration_adds_an_optional_part_to_every_form_of_a_request():
    ended = subprocess.run([sys.executable, "-c", DECLARE_AND_TRY], capture_output=True, text=True)
    assert ended.stdout == "one declaration\n", ended.stderr
