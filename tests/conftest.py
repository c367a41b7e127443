"""One place for what tests leave on disk (compiled kernels, kept between runs under the pytest cache), and no timing
inside property tests: a first example may compile a kernel."""

import os
import tempfile
from pathlib import Path

from hypothesis import settings

os.environ.setdefault("VOCALIS_DATA", str(Path(__file__).resolve().parent.parent / ".pytest_cache" / "vocalis"))
# Servers of the tests leave no jobs to those of the next run.
_JOBS = tempfile.TemporaryDirectory(prefix="vocalis-jobs-")
os.environ["VOCALIS_JOBS_DIRECTORY"] = str(Path(_JOBS.name) / "jobs")
# Nor do their workers start before there is work: most of these servers never get any.
os.environ["VOCALIS_WARM_WORKERS"] = "0"
settings.register_profile("vocalis", deadline=None)
settings.load_profile("vocalis")


def pytest_collection_modifyitems(items):
    """What takes longest comes first, so that it is not what everybody waits for at the end."""
    items.sort(key=lambda item: item.get_closest_marker("first") is None)
