"""Compiles one form of the step into the cache: ``python -m vocalis.server.warmup.form FIELDS``, a StepForm as JSON.

The voice process starts it, because a compiler in the process itself would hold Python's lock, each time for up to
0.7 s.
"""

import json
import os
import subprocess
import sys
from contextlib import suppress
from dataclasses import asdict

from vfcore.fold.form import StepForm
from vfcore.runs.gesture import forms

NICENESS = 5  # a user waits for it, but sound comes first
LONGEST_S = 120.0


def compile_outside(form: StepForm) -> bool:
    """Compile a form in another process of lower priority; whether that has worked. Returns when it has ended."""
    command = [sys.executable, "-m", __spec__.name, json.dumps(asdict(form))]
    try:
        ended = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=LONGEST_S, start_new_session=True
        )  # a session of its own: Ctrl-C is for the server
    except (OSError, subprocess.TimeoutExpired):
        return False
    return ended.returncode == 0


if __name__ == "__main__":
    with suppress(AttributeError):  # where the system has priorities; that of the voice process may be high
        os.setpriority(os.PRIO_PROCESS, 0, NICENESS)
    forms.load(StepForm(**json.loads(sys.argv[1])))
