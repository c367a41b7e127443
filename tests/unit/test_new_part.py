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
class Extended(simulation.Simulation):
    lesion: Lesion | None = part(Lesion, optional=True)


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
