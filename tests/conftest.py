"""One place for what tests leave on disk: compiled kernels, kept between runs under the pytest cache."""

import os
from pathlib import Path

os.environ.setdefault("VOCALIS_DATA", str(Path(__file__).resolve().parent.parent / ".pytest_cache" / "vocalis"))
