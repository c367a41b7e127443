"""Errors are pickled between processes: class, message and attributes survive."""

import copy
import importlib
import pickle
import pkgutil

import pytest

import vfcore
import vocalis.server
from vfcore.errors import Cancelled, DivergenceError, ParameterError, PostureError, StabilityError, VocalisError

MADE = [
    ParameterError("run.nx", "3 is too few", "6 to 200"),
    StabilityError("run.time_step_s", "0.001 s would grow", "up to 7e-5 s"),
    DivergenceError(0.012, 0.5, 0.25, "the displacement passed 20 mm", "Try a lower pressure."),
    Cancelled("the run was stopped"),
]


def _every_kind() -> list[type[VocalisError]]:
    for package in (vfcore, vocalis.server):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)
    found, waiting = [], [VocalisError]
    while waiting:
        kind = waiting.pop()
        found.append(kind)
        waiting += kind.__subclasses__()
    return sorted(set(found), key=lambda kind: kind.__name__)


def _same(one: VocalisError, other: VocalisError) -> bool:
    return (type(one), str(one), vars(one)) == (type(other), str(other), vars(other))


@pytest.mark.parametrize("error", MADE, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_an_error_survives_pickling(error, protocol):
    assert vars(error) or isinstance(error, Cancelled)
    assert _same(pickle.loads(pickle.dumps(error, protocol)), error)


def test_every_kind_of_error_keeps_its_attributes():
    kinds = _every_kind()
    assert len(kinds) > 8
    for kind in kinds:
        error = kind.__new__(kind)
        error.args = ("a sentence",)
        error.anything = {"of": "its own"}
        assert _same(pickle.loads(pickle.dumps(error)), error)
        assert _same(copy.copy(error), error)


@pytest.mark.parametrize("make", [lambda text: ParameterError(text, text, text), PostureError], ids=["field", "model"])
def test_every_sentence_can_be_written_as_utf_8(make):
    """JSON may hold half of a surrogate pair, which UTF-8 cannot."""
    error = make("a\ud800b ε")
    for text in (str(error), *vars(error).values()):
        assert "a\\ud800b ε" in text.encode().decode()
    assert _same(pickle.loads(pickle.dumps(error)), error)
