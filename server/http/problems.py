"""Problems as RFC 9457 writes them, and the one table from exception to status. No web in here."""

from typing import Any, NamedTuple

from vfcore.errors import (
    Cancelled,
    DivergenceError,
    ParameterError,
    PostureError,
    StaticShapeError,
    VocalisError,
)
from vfcore.runs.sweep.task import WrongModel
from vocalis.server.jobs import model
from vocalis.server.jobs.database import StorageFull, StorageUnusable
from vocalis.server.jobs.interactive import ClientLeft, Overtaken

MEDIA_TYPE = "application/problem+json"


class Kind(NamedTuple):
    """``slug`` names the problem type, ``title`` says it in words."""

    status: int
    slug: str
    title: str


class Refused(VocalisError):
    """A request this server will not take; ``retry_after_s`` when asking again later makes sense."""

    retry_after_s: int | None = None


class NotAuthorised(Refused):
    """No token, or a wrong one."""


class WrongOrigin(Refused):
    """A page of another site tried to change something."""


class WrongHost(Refused):
    """The Host header names no address of this server."""


class BodyTooLarge(Refused):
    """The request body is longer than the limit."""


class TooMany(Refused):
    """A limit on how much at a time is reached."""

    retry_after_s = 1


class NotReady(Refused):
    """The server cannot answer this yet."""

    retry_after_s = 2


#: From the exception's class (or its nearest listed base) to what the client is told.
TABLE: dict[type[Exception], Kind] = {
    ParameterError: Kind(422, "invalid-request", "The request cannot be used"),
    PostureError: Kind(422, "no-posture", "The larynx finds no posture"),
    StaticShapeError: Kind(422, "no-static-shape", "The fold finds no shape at rest"),
    DivergenceError: Kind(422, "diverged", "The run diverged"),
    Cancelled: Kind(503, "stopped", "The run was stopped"),
    NotAuthorised: Kind(401, "token-needed", "A token is needed"),
    WrongOrigin: Kind(403, "wrong-origin", "Not from this site"),
    WrongHost: Kind(421, "wrong-host", "Not an address of this server"),
    BodyTooLarge: Kind(413, "body-too-large", "The body is too large"),
    TooMany: Kind(429, "limit-reached", "A limit is reached"),
    NotReady: Kind(503, "not-ready", "Not ready yet"),
    model.NoSuchJob: Kind(404, "no-such-job", "No such job"),
    model.WrongKind: Kind(404, "no-such-part", "No such part"),
    model.NotFinished: Kind(409, "no-result", "There is no result"),
    model.ResultGone: Kind(410, "result-gone", "The result is no longer kept"),
    model.QueueFull: Kind(429, "limit-reached", "A limit is reached"),
    model.WorkerDied: Kind(500, "worker-died", "The worker process died"),
    WrongModel: Kind(503, "wrong-model", "A worker has another version of the model"),
    StorageFull: Kind(507, "storage-full", "There is no room left"),
    StorageUnusable: Kind(500, "storage-unusable", "The folder of jobs cannot be used"),
    Overtaken: Kind(429, "overtaken", "Newer calls came first"),
    ClientLeft: Kind(503, "client-left", "Nobody waits for the answer"),
}
OTHER = Kind(500, "internal", "Something went wrong in Vocalis")


def kind_of(error: Exception) -> Kind:
    """The row for an exception; OTHER when nobody foresaw it."""
    return next((TABLE[cls] for cls in type(error).__mro__ if cls in TABLE), OTHER)


def is_about_model(problem: dict[str, Any]) -> bool:
    """Whether a problem document says that a worker has another version of the model."""
    return problem["type"] == document(TABLE[WrongModel], "")["type"]


def document(kind: Kind, detail: str, errors: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    """A problem document; ``errors`` lists bad fields as {path, message, allowed}."""
    body: dict[str, Any] = {
        "type": f"urn:vocalis:problem:{kind.slug}",
        "title": kind.title,
        "status": kind.status,
        "detail": detail,
    }
    return body | ({"errors": errors} if errors is not None else {})


def problem_of(error: Exception) -> dict[str, Any]:
    """The problem document of any exception; what was not foreseen is not described to the client."""
    kind = kind_of(error)
    if kind is OTHER:
        return document(kind, f"An error nobody foresaw ({type(error).__name__}); the server's log has the rest.")
    if isinstance(error, ParameterError):
        field = {"path": error.path, "message": error.message, "allowed": error.allowed}
        return document(kind, str(error), [field])
    return document(kind, str(error))
