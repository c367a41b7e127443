"""Where Vocalis keeps files of its own: compiled kernels, jobs and their results, the history of benchmarks."""

import os
from pathlib import Path

import platformdirs


def data_directory() -> Path:
    """``VOCALIS_DATA``, or the user's data folder."""
    return Path(os.environ.get("VOCALIS_DATA") or platformdirs.user_data_dir("vocalis", appauthor=False))


def jobs_directory() -> Path:
    """Where a server keeps its jobs and results, unless its settings name another folder."""
    return data_directory() / "jobs"
