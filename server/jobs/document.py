"""A job as its clients see it."""

from typing import Any

from vocalis.server.addresses import answer_links, job_links
from vocalis.server.jobs.kinds.registry import kind_named
from vocalis.server.jobs.model import Job, Status


def job_document(job: Job, brief: bool = False) -> dict[str, Any]:
    """The job in the words of the API, with its links; ``brief``: without long lists in the request."""
    kind = kind_named(job.kind)
    links = job_links(job.id)
    if job.status is Status.SUCCESSFUL:
        links |= answer_links(job.id, kind.forms)
    return {
        "id": job.id,
        "kind": job.kind,
        "status": job.status.value,
        "progress": job.progress,
        "n_done": job.n_done,
        "n_total": job.n_total,
        "n_failed": job.n_failed,
        "created": job.created,
        "started": job.started,
        "finished": job.finished,
        "request": kind.brief(job.request) if brief else job.request,
        "problem": job.problem,
        "links": links,
    }
