"""What a kind of job defines: how it reads its requests, how it computes and stores, and the forms of its answer."""

import json
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from pydantic import BaseModel

from vocalis.server.exceptions import NotFinished, ResultGone, WrongKind
from vocalis.server.jobs.archive import ResultFormat
from vocalis.server.jobs.executor_slot import Call
from vocalis.server.jobs.model import ACTIVE, Job, Status
from vocalis.server.jobs.work import SingleWork, Work, WorkListener

if TYPE_CHECKING:
    from vocalis.server.jobs.storage import Storage
    from vocalis.server.settings import Settings

W = TypeVar("W")
R = TypeVar("R")
JSON, CSV, WAV = "application/json", "text/csv", "audio/wav"
NETCDF, BYTES = "application/x-netcdf", "application/octet-stream"
#: Files of an answer that every kind may offer, by the name of their link.
RESULT = {"result": "result"}
FILES = {"netcdf": "result.nc", "csv": "result.csv"}
WAVEFORMS = {"array": "arrays/{name}", "audio": "audio.wav"}
STALE = "An earlier version of Vocalis made this result under another address; the same request makes it again."


@dataclass(frozen=True)
class Answer:
    """An answer in one form, ready to be sent."""

    content: bytes | Iterable[str]
    media_type: str
    headers: dict[str, str] = field(default_factory=dict)


def strict_json(document: dict[str, Any]) -> bytes:
    """A document as compact JSON; ValueError for NaN and infinity, which JSON does not have."""
    return json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()


class Part(NamedTuple):
    """A part of the first axis of an array; ``stop`` None is its end."""

    start: int = 0
    stop: int | None = None
    stride: int = 1


class JobKind(ABC, Generic[W]):
    """A kind of job; W is its validated request. One stateless object for all jobs of the kind."""

    #: The value of ``kind`` in requests and jobs.
    name: str
    #: The request at the wire; it has the fields ``kind`` and ``fresh``.
    body: type[BaseModel]
    #: The answer at ``/result``, for the OpenAPI document.
    answer_model: type[BaseModel]
    #: The forms of the answer: name of the link to path below the job.
    forms: dict[str, str] = RESULT
    #: How whole results are kept; None when the kind keeps none.
    format: ResultFormat | None = None
    #: Whether ``check_cost`` solves a posture, which needs compiled kernels.
    check_needs_kernels = False

    @abstractmethod
    def read(self, body: Any) -> W:
        """The validated request of a body; ParameterError for what its schema cannot express."""

    @abstractmethod
    def parse(self, document: dict[str, Any]) -> W:
        """The validated request of a canonical document; ParameterError when this version does not take it."""

    @abstractmethod
    def canonical(self, wanted: W) -> dict[str, Any]:
        """The complete document of a request: equal requests are equal documents. It has the key ``kind``."""

    @abstractmethod
    def address(self, wanted: W) -> str:
        """The content address of the answer."""

    @abstractmethod
    def check_cost(self, wanted: W, settings: "Settings") -> None:
        """ParameterError when the request is more work than the settings allow."""

    @abstractmethod
    def work(self, job: Job, storage: "Storage", listener: WorkListener) -> Work:
        """The work that computes the answer of a job; it continues from what is stored."""

    @abstractmethod
    def result(
        self, job: Job, storage: "Storage", measures: Sequence[str] | None = None, partial: bool = False
    ) -> Answer:
        """The answer as JSON; ``measures`` chooses among measures, ``partial`` allows an unfinished job."""

    def n_total(self, wanted: W) -> int:
        """How many parts the work has."""
        return 1

    def brief(self, request: dict[str, Any]) -> dict[str, Any]:
        """A canonical document for lists and events: long lists in it are null."""
        return request

    def has_answer(self, wanted: W, storage: "Storage") -> bool:
        """Whether the answer of a finished job is still kept."""
        return True

    def take_answer(self, job: Job, storage: "Storage") -> bool:
        """Give a new job an answer that is stored already; False when there is none."""
        return False

    def is_answered(self, job: Job, storage: "Storage") -> bool:
        """Whether the answer of an unfinished job was stored just before the last server ended."""
        return False

    def job_of_result(self, content: str, storage: "Storage") -> Job | None:
        """A kept result without a job of its own, as a finished job; None when this kind has no such result."""
        return None

    def netcdf(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        """The answer as a netCDF-4 file."""
        raise self._no("netCDF file")

    def csv(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        """The answer as a table."""
        raise self._no("CSV table")

    def array(self, job: Job, storage: "Storage", name: str, part: Part = Part()) -> Answer:  # noqa: B008 - a value
        """One array, or a part of it, as little-endian float32."""
        raise self._no("arrays")

    def audio(self, job: Job, storage: "Storage", normalize: bool = True) -> Answer:
        """The sound as a WAV file."""
        raise self._no("sound")

    def checked(self, job: Job, partial: bool = False) -> W:
        """The request of a finished job, or with ``partial`` of an unfinished one.

        Raises NotFinished, and ResultGone when an earlier version made the answer.
        """
        if job.status is not Status.SUCCESSFUL and not (partial and job.status in ACTIVE):
            why = f": {job.problem['detail']}" if job.problem else "."
            raise NotFinished(f"The job is {job.status}{why}")
        wanted = self.parse(job.request)
        if self.address(wanted) != job.content:
            raise ResultGone(STALE)
        return wanted

    def _no(self, form: str) -> WrongKind:
        return WrongKind(f"A job of the kind {self.name!r} has no {form}; it has {', '.join(self.forms)}.")


class SingleKind(JobKind[W], Generic[W, R]):
    """A kind whose job is one call with one result, which the archive keeps under the address of the request."""

    format: ResultFormat
    #: Computes the result of a canonical document; see ``Call``.
    function: Callable[..., R]

    def work(self, job: Job, storage: "Storage", listener: WorkListener) -> Work:
        call = Call(type(self).function, (job.request,), (job.content,))
        return SingleWork(job.work_id, listener, call, partial(storage.results.store, job.content))

    def has_answer(self, wanted: W, storage: "Storage") -> bool:
        return storage.results.has(self.address(wanted))

    def take_answer(self, job: Job, storage: "Storage") -> bool:
        if (result := storage.results.get(job.content)) is None:
            return False
        if not storage.results.is_stored(job.content):
            storage.results.store(job.content, result)
        return True

    def is_answered(self, job: Job, storage: "Storage") -> bool:
        return not job.fresh and storage.results.is_stored(job.content)

    def load(self, job: Job, storage: "Storage") -> R:
        """The result of a finished job; NotFinished or ResultGone."""
        self.checked(job)
        if (result := storage.results.get(job.content)) is None:
            raise ResultGone("The result was removed to make room for newer ones; the same request makes it again.")
        return result

    def result(
        self, job: Job, storage: "Storage", measures: Sequence[str] | None = None, partial: bool = False
    ) -> Answer:
        return Answer(strict_json(self.document(self.load(job, storage))), JSON)

    def document(self, result: R) -> dict[str, Any]:
        """A result as a plain document."""
        if isinstance(result, dict):
            return result
        raise NotImplementedError


class UnknownKind(JobKind[Any]):
    """A kind that only another version of the server knows: its jobs are listed, and nothing else."""

    forms: dict[str, str] = {}

    def __init__(self, name: str):
        self.name = name

    def _unknown(self, *_: Any, **__: Any) -> Any:
        raise WrongKind(f"This version of Vocalis does not know jobs of the kind {self.name!r}.")

    read = parse = canonical = address = check_cost = work = result = netcdf = csv = array = audio = _unknown
