"""A new optional part, a new value of one fold and a new list of objects each need only one declaration."""

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
from vfcore.spec.fields import choice, part, parts, quantity, validate


@dataclass(frozen=True, slots=True)
class Patient:
    height_mm: float = quantity(0.5, "mm", "height", 0, 3, source="test")
    x: float = quantity(0.5, "1", "place", 0, 1, source="test")

    def __post_init__(self):
        validate(self, "patient.")


@dataclass(frozen=True, slots=True)
class Shim:
    depth_mm: float = quantity(0.0, "mm", "depth", 0, 5, source="test")

    def __post_init__(self):
        validate(self, "nerves.shim.")


@dataclass(frozen=True, slots=True)
class Nerves:
    rln: float = quantity(1.0, "1", "recurrent nerve", 0, 1, source="test")
    sln: float = quantity(1.0, "1", "superior nerve", 0, 1, source="test")
    seed: float = quantity(0.0, "1", "seed", 0, 1, source="test", common="there is one brain")
    shim: Shim | None = part(Shim, optional=True)

    def __post_init__(self):
        validate(self, "nerves.")


@dataclass(frozen=True, slots=True)
class Stitch:
    thread: str = choice("silk", "thread", ("silk", "gut"), source="test")
    tension_n: float = quantity(0.1, "N", "tension", 0, 1, source="test")

    def __post_init__(self):
        validate(self)


@dataclass(frozen=True, slots=True)
class Extended(simulation.Simulation):
    patient: Patient | None = part(Patient, optional=True)
    nerves: Nerves | None = part(Nerves, optional=True, per_side=True)
    process_mm: float | None = quantity(None, "mm", "vocal process", 0, 10, source="test", per_side=True)
    stitches: tuple[Stitch, ...] = parts(Stitch, "stitches", at_most=3)


simulation.Simulation = Extended

from vfcore.errors import ParameterError
from vfcore.spec.address import address, computation
from vfcore.spec.paths import NUMBERS, NUMBERS_BEYOND
from vfcore.spec.request import document_of, patch_of, patched, resolve, values_of
from vfcore.spec.schema import GROUPS, parameter_catalogue, parameter_schema
from vfcore.spec.sides import folds_of
from vocalis.server.schemas.requests import GestureBody, SimulationBody, gesture_of, simulation_of


def refused(document, path, by=resolve):
    try:
        by(document)
    except ParameterError as error:
        assert error.path == path, error.path
        return str(error)
    raise AssertionError(f"{document} was taken")


plain, given = resolve({}), resolve({"patient": {"height_mm": 1}})
assert plain.patient is None and given.patient == Patient(1.0)
assert "patient.height_mm" in NUMBERS and "patient" in GROUPS
rows = {row["key"]: row for row in parameter_schema()}
assert rows["patient.x"]["optional_part"] == "patient" and not rows["patient.x"]["per_side"]
assert document_of(plain)["patient"] is None and document_of(given)["patient"] == {"height_mm": 1.0, "x": 0.5}
assert patch_of(plain) == {} and resolve(patch_of(given)) == given == resolve(document_of(given))
assert address(plain) != address(given) == address(patched(plain, {"patient.height_mm": 1}))
assert computation(plain).with_numbers({"patient.height_mm": 1.0}) == computation(given)
assert values_of(plain)["patient"] is None and resolve({"patient": None}) == plain
assert simulation_of(SimulationBody.model_validate({"patient": {"height_mm": 1}})) == given
assert simulation_of(SimulationBody.model_validate({"patient": None})) == plain
refused({"patient": {"height_mm": 9}}, "patient.height_mm")
refused({"right": {"patient": {"x": 0.1}}}, "right.patient")

# A part of one fold, a part within it, and a value of one fold at the top.
palsy = resolve({"right": {"nerves": {"rln": 0}}})
left, right = folds_of(palsy)
assert left == plain and right.nerves == Nerves(rln=0.0) and right.right is None
assert resolve({"right.nerves.rln": 0}) == palsy == patched(plain, {"right.nerves.rln": 0.0})
assert document_of(palsy)["right"] == {"nerves": {"rln": 0.0}} and document_of(plain)["right"] is None
assert resolve(patch_of(palsy)) == palsy == resolve(document_of(palsy)) == resolve(values_of(palsy))
assert rows["nerves.rln"]["per_side"] and not rows["nerves.seed"]["per_side"]
fixed = patched(palsy, {"right.nerves.shim.depth_mm": 1.0, "right.process_mm": 3.0})
assert folds_of(fixed)[1].nerves == Nerves(0.0, shim=Shim(1.0)) and folds_of(fixed)[1].process_mm == 3
assert patched(patched(fixed, {"right.nerves.shim": None}), {"right": None}) == plain
assert folds_of(patched(fixed, {"right.nerves.shim": None}))[1].nerves == Nerves(0.0)
assert len({address(one) for one in (plain, palsy, fixed)}) == 3
both = {"nerves": {"rln": 0.0}}
assert address(resolve({"left": both, "right": both})) == address(resolve(both)) != address(palsy)
for numbers in ({"right.nerves.rln": 0.5}, {"left.nerves.rln": 0.0}, {"right.nerves.shim.depth_mm": 0.2},
                {"right.process_mm": 1.5}, {"nerves.rln": 0.3}, {"process_mm": 3.0}, {"stitches.0.tension_n": 0.2}):
    for request in (plain, palsy, fixed):
        assert computation(request).with_numbers(numbers) == computation(patched(request, numbers)), numbers
body = {"right": {"nerves": {"rln": 0, "shim": None}}}
assert folds_of(simulation_of(SimulationBody.model_validate(body))) == folds_of(palsy)
refused({"right": {"nerves": {"rln": 2}}}, "right.nerves.rln")
refused({"right": {"nerves": {"nerve": 1}}}, "right.nerves.nerve")
assert "there is one brain" in refused({"right": {"nerves": {"seed": 1}}}, "right.nerves.seed")
refused({"right": {"activation": None}}, "right.activation")

# A list of objects.
sewn = resolve({"stitches": [{"thread": "gut"}, {"tension_n": 0.5}]})
assert sewn.stitches == (Stitch("gut"), Stitch(tension_n=0.5))
assert resolve(patch_of(sewn)) == sewn == resolve(document_of(sewn)) == resolve(values_of(sewn))
assert patched(sewn, {"stitches.2.tension_n": 0.7}).stitches[2] == Stitch(tension_n=0.7)
assert patched(sewn, {"stitches.0.tension_n": 0.7}).stitches[0] == Stitch("gut", 0.7)
assert address(sewn) != address(plain) == address(patched(sewn, {"stitches": []}))
assert computation(sewn).with_numbers({"stitches.1.tension_n": 0.1}) == computation(
    patched(sewn, {"stitches.1.tension_n": 0.1}))
described = {one["key"]: one for one in parameter_catalogue()["lists"]}["stitches"]
assert described["at_most"] == 3 and [row["key"] for row in described["parameters"]] == ["thread", "tension_n"]
assert simulation_of(SimulationBody.model_validate({"stitches": [{"thread": "gut"}, {"tension_n": 0.5}]})) == sewn
refused({"stitches": [{}, {}, {}, {}]}, "stitches")
refused({"stitches": [{}, {"tension_n": 2}]}, "stitches.1.tension_n")
refused({"stitches": [{"needle": 2}]}, "stitches.0.needle")
refused({"stitches.1.tension_n": 0.2}, "stitches.1")
refused({"stitches": None}, "stitches")

# The forms beyond single runs.
from vfcore.runs.gesture.gesture import gesture_from_dict, gesture_to_dict
from vfcore.runs.gesture.slew import differences, slew_limited
from vfcore.runs.sweep.document import sweep_from_dict
from vocalis.cli.requests import request_patch

assert {"right.nerves.rln", "left.process_mm", "stitches.2.tension_n"} <= set(NUMBERS_BEYOND)
sweep = sweep_from_dict({"base": body, "axes": [{"parameter": "right.nerves.rln", "values": [0.0, 0.5]}]})
assert folds_of(sweep.request(0)) == folds_of(palsy) and sweep.address(0) != sweep.address(1)
asked = {"right": {"nerves": {"rln": [[0, 0], [1, 1]]}}, "stitches": [{"tension_n": [[0, 0], [1, 1]]}]}
for moving in (gesture_from_dict(asked), gesture_of(GestureBody.model_validate(asked))):
    half = moving.at(0.5)
    assert folds_of(half)[1].nerves.rln == 0.5 == half.stitches[0].tension_n
    assert gesture_from_dict(gesture_to_dict(moving)).at(0.5) == half
assert resolve(request_patch(None, None, {}, ["right.nerves.rln=0"])) == palsy
assert resolve(request_patch(None, None, {}, ["stitches.0.thread=gut", "stitches.1.tension_n=0.5"])) == sewn
half = patched(palsy, {"right.nerves.rln": 0.1})
moved = differences(palsy, half)
assert moved == ("right.nerves.rln",) and slew_limited(palsy, half, moved) == half
print("one declaration")
"""


def test_one_declaration_adds_a_part_and_a_list_to_every_form_of_a_request():
    ended = subprocess.run([sys.executable, "-c", DECLARE_AND_TRY], capture_output=True, text=True)
    assert ended.stdout == "one declaration\n", ended.stderr
