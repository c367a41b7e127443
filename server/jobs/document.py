"""A job as its clients see it."""

from typing import Any

from vocalis_server.jobs.model import Job, Status

API = "/api/v1"


def job_document(job: Job) -> dict[str, Any]:
    """The job in the words of the API, with links to what there is."""
    here = f"{API}/jobs/{job.id}"
    links = {"self": here, "events": f"{here}/events"}
    if job.status is Status.SUCCESSFUL:
        links |= result_links(job.id)
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
        "request": job.request,
        "problem": job.problem,
        "links": links,
    }


def result_links(job_id: str) -> dict[str, str]:
    """Where the result of a job, or of a synchronous run, can be had; ``{name}`` is to be filled in."""
    here = f"{API}/jobs/{job_id}"
    return {
        "result": f"{here}/result",
        "array": f"{here}/arrays/{{name}}",
        "audio": f"{here}/audio.wav",
        "netcdf": f"{here}/result.nc",
        "csv": f"{here}/result.csv",
    }
