"""Problem documents as in RFC 9457, and the one table from exception to status. No web framework in here."""

from typing import Any, NamedTuple

from vfcore.errors import (
    Cancelled,
    DivergenceError,
    ParameterError,
    PostureError,
    StaticShapeError,
    writable,
)
from vfcore.runs.sweep.task import WrongModel
from vocalis.server import exceptions as server

MEDIA_TYPE = "application/problem+json"


class Kind(NamedTuple):
    """``slug`` names the problem type, ``title`` is for people."""

    status: int
    slug: str
    title: str


#: From the exception's class (or its nearest listed base) to the problem that the client gets.
TABLE: dict[type[Exception], Kind] = {
    ParameterError: Kind(422, "invalid-request", "The request cannot be used"),
    PostureError: Kind(422, "no-posture", "The larynx finds no posture"),
    StaticShapeError: Kind(422, "no-static-shape", "The fold finds no shape at rest"),
    DivergenceError: Kind(422, "diverged", "The run diverged"),
    Cancelled: Kind(503, "stopped", "The run was stopped"),
    server.NotAuthorised: Kind(401, "token-needed", "A token is needed"),
    server.WrongOrigin: Kind(403, "wrong-origin", "Not from this site"),
    server.WrongHost: Kind(421, "wrong-host", "Not an address of this server"),
    server.BodyTooLarge: Kind(413, "body-too-large", "The body is too large"),
    server.TooMany: Kind(429, "limit-reached", "A limit is reached"),
    server.NotReady: Kind(503, "not-ready", "Not ready yet"),
    server.NoSuchJob: Kind(404, "no-such-job", "No such job"),
    server.WrongKind: Kind(404, "no-such-part", "No such part"),
    server.NotFinished: Kind(409, "no-result", "There is no result"),
    server.ResultGone: Kind(410, "result-gone", "The result is no longer kept"),
    server.QueueFull: Kind(429, "limit-reached", "A limit is reached"),
    server.WorkerDied: Kind(500, "worker-died", "The worker process died"),
    WrongModel: Kind(503, "wrong-model", "A worker has another version of the model"),
    server.StorageFull: Kind(507, "storage-full", "There is no room left"),
    server.StorageUnusable: Kind(500, "storage-unusable", "The folder of jobs cannot be used"),
    server.Superseded: Kind(429, "overtaken", "Newer calls came first"),
    server.ClientLeft: Kind(503, "client-left", "The client left before the answer"),
}
OTHER = Kind(500, "internal", "Something went wrong in Vocalis")


def kind_of(error: Exception) -> Kind:
    """The row for an exception; OTHER for one that is not in the table."""
    return next((TABLE[cls] for cls in type(error).__mro__ if cls in TABLE), OTHER)


def is_about_model(problem: dict[str, Any]) -> bool:
    """Whether a problem document says that a worker has another version of the model."""
    return problem["type"] == document(TABLE[WrongModel], "")["type"]


def document(kind: Kind, detail: str, errors: list[dict[str, str]] | None = None) -> dict[str, Any]:
    """A problem document; ``errors`` lists bad fields as {path, message, allowed}."""
    body: dict[str, Any] = {
        "type": f"urn:vocalis:problem:{kind.slug}",
        "title": kind.title,
        "status": kind.status,
        "detail": writable(detail),
    }
    if errors is None:
        return body
    return body | {"errors": [{name: writable(text) for name, text in error.items()} for error in errors]}


def problem_of(error: Exception) -> dict[str, Any]:
    """The problem document of any exception; an unexpected one is described in the log, not to the client."""
    kind = kind_of(error)
    if kind is OTHER:
        return document(kind, f"An unexpected error ({type(error).__name__}); the server's log has the details.")
    if isinstance(error, ParameterError):
        field = {"path": error.path, "message": error.message, "allowed": error.allowed}
        return document(kind, str(error), [field])
    return document(kind, str(error))
