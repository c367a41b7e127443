"""The paths of the HTTP interface that documents and safeguards name. No web framework in here."""

API = "/api/v1"


def job_address(job_id: str) -> str:
    """The path of a job, or of a kept result under its content address."""
    return f"{API}/jobs/{job_id}"


def job_links(job_id: str) -> dict[str, str]:
    """The links that every job has."""
    here = job_address(job_id)
    return {"self": here, "events": f"{here}/events"}


def answer_links(job_id: str, forms: dict[str, str]) -> dict[str, str]:
    """The links to an answer; ``forms`` maps the name of each form to its path below the job. ``{name}`` is to be
    filled in.
    """
    return {name: f"{job_address(job_id)}/{path}" for name, path in forms.items()}


def gesture_links(gesture_id: str) -> dict[str, str]:
    """The links to the sound and the tables of a rendered gesture."""
    here = f"{API}/gestures/{gesture_id}"
    return {"audio": f"{here}/audio.wav", "contours": f"{here}/contours.csv", "netcdf": f"{here}/result.nc"}
