"""A job as its clients see it."""

from typing import Any

from vocalis.server.jobs.model import Job, Status

API = "/api/v1"
LONGEST_LIST = 100  # entries of a request that lists and events repeat


def job_document(job: Job, brief: bool = False) -> dict[str, Any]:
    """The job in the words of the API, with links to what there is; ``brief``: without long lists in the request."""
    here = f"{API}/jobs/{job.id}"
    links = {"self": here, "events": f"{here}/events"}
    if job.status is Status.SUCCESSFUL:
        links |= result_links(job.id, job.kind)
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
        "request": _shortened(job.request) if brief else job.request,
        "problem": job.problem,
        "links": links,
    }


def result_links(job_id: str, kind: str = "simulation") -> dict[str, str]:
    """Where the result of a job, or of a synchronous run, can be had; ``{name}`` is to be filled in."""
    here = f"{API}/jobs/{job_id}"
    links = {"result": f"{here}/result", "netcdf": f"{here}/result.nc", "csv": f"{here}/result.csv"}
    if kind == "simulation":
        links |= {"array": f"{here}/arrays/{{name}}", "audio": f"{here}/audio.wav"}
    return links


def _shortened(request: dict[str, Any]) -> dict[str, Any]:
    """Lists of more than LONGEST_LIST entries are null; GET of the job itself has them."""
    if request["kind"] != "sweep":
        return request
    short = dict(request)
    if len(short.get("points") or ()) > LONGEST_LIST:
        short["points"] = None
    if short.get("axes"):
        short["axes"] = [
            axis | {"values": axis["values"] if len(axis["values"]) <= LONGEST_LIST else None} for axis in short["axes"]
        ]
    return short
