"""What the server refuses or cannot do, as exceptions; ``problems.TABLE`` gives each its HTTP status."""

from vfcore.errors import VocalisError


class Refused(VocalisError):
    """A request this server will not take; ``retry_after_s`` when a later attempt makes sense."""

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
    """A limit on concurrent use is reached."""

    retry_after_s = 1


class NotReady(Refused):
    """The server cannot answer this yet."""

    retry_after_s = 2


class ClientLeft(VocalisError):
    """The client closed the connection before its call was computed."""


class Superseded(VocalisError):
    """Newer calls took all the places in the queue."""

    retry_after_s = 1


class NoSuchJob(VocalisError):
    """No job has this id."""


class WrongKind(VocalisError):
    """A job of this kind has no such part."""


class NotFinished(VocalisError):
    """The job has no result to give (yet, or ever)."""


class ResultGone(VocalisError):
    """The job succeeded, but its result was removed to make room for newer ones."""


class QueueFull(VocalisError):
    """No more jobs are accepted for the moment."""

    retry_after_s = 5


class WorkerDied(VocalisError):
    """The worker process ended unexpectedly, twice."""


class StorageFull(VocalisError):
    """There is no room to keep jobs or results."""


class StorageUnusable(VocalisError):
    """The folder of jobs cannot be used."""
