"""A kind of job in one file, to show that nothing else needs to know it: counts words, one after the other."""

import time
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from vfcore.errors import ParameterError
from vfcore.spec.address import content_hash
from vocalis.server.jobs.archive import DocumentFormat
from vocalis.server.jobs.kinds.base import CSV, FILES, RESULT, Answer, SingleKind
from vocalis.server.jobs.kinds.registry import register


class WordsBody(BaseModel):
    """Words to be counted."""

    model_config = ConfigDict(extra="forbid", strict=True)
    kind: Literal["words"]
    text: str = Field(description="words, separated by spaces")
    seconds: float = Field(0.0, ge=0, description="for each word")
    fresh: bool = False


class WordsAnswer(BaseModel):
    counts: dict[str, int]


def count_words(request: dict[str, Any], progress=None, stop=None) -> dict[str, Any]:
    counts: dict[str, int] = {}
    words = request["text"].split()
    for k, word in enumerate(words):
        time.sleep(request["seconds"])
        counts[word] = counts.get(word, 0) + 1
        if progress is not None:
            progress((k + 1) / len(words))
    return {"counts": counts}


class WordsKind(SingleKind[dict[str, Any], dict[str, Any]]):
    name = "words"
    body = WordsBody
    answer_model = WordsAnswer
    forms = RESULT | {"csv": FILES["csv"]}
    format = DocumentFormat()
    function = staticmethod(count_words)

    def read(self, body):
        return self.parse(body.model_dump(exclude={"fresh"}))

    def parse(self, document):
        if not document["text"].strip():
            raise ParameterError("text", "has no words", "one word or more")
        return document

    def canonical(self, wanted):
        return wanted

    def address(self, wanted):
        return content_hash([wanted["kind"], wanted["text"].split()])

    def check_cost(self, wanted, settings):
        if len(wanted["text"]) > 1000:
            raise ParameterError("text", "is too long", "up to 1000 characters")

    def csv(self, job, storage, partial=False):
        rows = self.load(job, storage)["counts"].items()
        return Answer("".join(f"{word},{count}\n" for word, count in rows).encode(), CSV)


register(WordsKind())
