"""One place for what tests leave on disk (compiled kernels, kept between runs under the pytest cache), and no timing
inside property tests: a first example may compile a kernel."""

import os
from pathlib import Path

from hypothesis import settings

os.environ.setdefault("VOCALIS_DATA", str(Path(__file__).resolve().parent.parent / ".pytest_cache" / "vocalis"))
settings.register_profile("vocalis", deadline=None)
settings.load_profile("vocalis")
