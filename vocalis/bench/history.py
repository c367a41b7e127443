"""Results of earlier benchmark runs, and whether the kernel has become slower since.

Seconds depend on the machine and its load. Ratios of the quickest turns of two tasks timed in the same interleaved
rounds depend on them far less. So only ratios to the plain loop are compared, with the median of earlier runs on the
same processor.
"""

import json
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median

from vfcore.directories import data_directory

#: Ratios watched for regressions; each is plain loop / kernel, higher is better.
WATCHED = ("reference_ratio", "paper_step_ratio", "batch_ratio", "single_precision_ratio")
TOLERANCE = 0.15


def history_file() -> Path:
    return data_directory() / "bench-history.jsonl"


def earlier(file: Path, processor: str | None) -> list[dict]:
    """The runs stored in ``file`` for this processor, oldest first."""
    if not file.exists():
        return []
    runs = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    return [run for run in runs if run["processor"] == processor]


def keep(file: Path, processor: str | None, values: Mapping[str, float]) -> None:
    """Append the values of a run to the file."""
    file.parent.mkdir(parents=True, exist_ok=True)
    run = {"time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "processor": processor, "values": dict(values)}
    with file.open("a", encoding="utf-8") as lines:
        lines.write(json.dumps(run) + "\n")


def regressions(values: Mapping[str, float], runs: Sequence[Mapping]) -> list[str]:
    """A sentence for each watched ratio that is more than TOLERANCE below the median of ``runs``."""
    found = []
    for key in WATCHED:
        before = [run["values"][key] for run in runs if key in run["values"]]
        if before and values[key] < (1.0 - TOLERANCE) * median(before):
            fall = 100.0 * (1.0 - values[key] / median(before))
            found.append(
                f"{key}: {values[key]:.3g}, {fall:.0f} % below {median(before):.3g}, the median of {len(before)}"
            )
    return found
