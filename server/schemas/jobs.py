"""Jobs of any kind at the wire, made from the registry of kinds."""

from collections.abc import Mapping
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, Discriminator, Field, Tag

from vocalis.server.jobs.kinds.base import JobKind
from vocalis.server.jobs.kinds.registry import KINDS
from vocalis.server.schemas.answers import Problem

DEFAULT_KIND = "simulation"


def body_type(kinds: Mapping[str, JobKind]) -> Any:
    """The body of any of these kinds, distinguished by its ``kind``; without one it is a simulation."""

    def tag(body: Any) -> str:
        kind = body.get("kind") if isinstance(body, dict) else getattr(body, "kind", None)
        return kind if isinstance(kind, str) and kind in kinds else DEFAULT_KIND

    members = [Annotated[kind.body, Tag(name)] for name, kind in kinds.items()]
    return Annotated[reduce(or_, members), Discriminator(tag)] if len(members) > 1 else members[0]


if TYPE_CHECKING:
    KindName = str
    ResultAnswer = BaseModel

    class AnyJobBody(BaseModel):
        kind: str
        fresh: bool

else:
    KindName = Literal[tuple(sorted(KINDS))]
    ResultAnswer = reduce(or_, (kind.answer_model for kind in KINDS.values()))
    AnyJobBody = body_type(KINDS)


class JobAnswer(BaseModel):
    id: str
    kind: KindName
    status: Literal["accepted", "running", "successful", "failed", "dismissed"]
    progress: float = Field(ge=0, le=1)
    n_done: int
    n_total: int
    n_failed: int
    created: str
    started: str | None
    finished: str | None
    request: dict[str, Any]
    problem: Problem | None
    links: dict[str, str]


class JobList(BaseModel):
    jobs: list[JobAnswer]
    next_cursor: str | None = Field(description="cursor of the next page; null on the last one")
