"""What can go wrong, as values with a sentence for a person.

Every error names the field or the place, the offending value and what would be
accepted or could be tried. The command line prints ``str(error)``; the server
maps the class to a status in one table.
"""


def writable(text: str) -> str:
    """``text`` with escapes for what UTF-8 cannot hold: JSON may hold half of a surrogate pair."""
    return text.encode(errors="backslashreplace").decode()


class VocalisError(Exception):
    """Base of every error this package raises on purpose.

    Errors cross process boundaries: each is rebuilt from its sentence and its attributes, not from its constructor.
    Its sentence can always be written as UTF-8.
    """

    def __init__(self, sentence: str = ""):
        super().__init__(writable(sentence))

    def __reduce__(self):
        return _rebuilt, (type(self), self.args), self.__dict__


class ParameterError(VocalisError, ValueError):
    """A request field that cannot be used.

    Attributes: ``path`` (dotted field name), ``message`` (what is wrong with the value),
    ``allowed`` (what would be accepted).
    """

    def __init__(self, path: str, message: str, allowed: str):
        super().__init__(f"{path}: {message}; allowed: {allowed}")
        self.path = writable(path)
        self.message = writable(message)
        self.allowed = writable(allowed)


class PostureError(VocalisError):
    """The posturing equations have no root that can be reached from rest."""


class StabilityError(ParameterError):
    """The time step is too long for the requested grid and constants."""


class DivergenceError(VocalisError):
    """A run left the range in which the equations mean anything.

    Attributes: ``time_s``, ``x_over_L``, ``y_over_b`` (where), ``remedy`` (what to try).
    """

    def __init__(self, time_s: float, x_over_L: float, y_over_b: float, what: str, remedy: str):
        super().__init__(
            f"the run diverged at t = {time_s * 1e3:.3f} ms, at x/L = {x_over_L:.2f}, "
            f"y/b = {y_over_b:.2f}: {what}. {remedy}"
        )
        self.time_s = time_s
        self.x_over_L = x_over_L
        self.y_over_b = y_over_b
        self.remedy = remedy


class StaticShapeError(VocalisError):
    """The static equilibrium could not be found."""


class Cancelled(VocalisError):
    """The caller raised the stop flag; nothing partial is returned."""


def _rebuilt(kind: type[VocalisError], args: tuple) -> VocalisError:
    error = kind.__new__(kind)
    error.args = args
    return error
