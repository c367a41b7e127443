"""Measurements that need a fresh process: start-up with and without compiled kernels, and memory."""

import json
import os
import subprocess
import sys
import tempfile

_FIRST_RESULT = """
import json, time
began = time.perf_counter()
import vfcore
loaded = time.perf_counter()
vfcore.simulate(vfcore.Simulation(run=vfcore.Run(duration_s=0.02)))
print(json.dumps({"load_s": loaded - began, "first_result_s": time.perf_counter() - loaded}))
"""

# Not ru_maxrss: that starts at the size of the parent process. Writing 5 to clear_refs resets the high-water mark to
# the present resident size.
_MEMORY = """
import json, re, vfcore
def peak_bytes():
    with open("/proc/self/status") as status:
        return 1024 * int(re.search(r"VmHWM:\\s+(\\d+) kB", status.read())[1])
vfcore.simulate(vfcore.Simulation(run=vfcore.Run(duration_s=0.02)))
with open("/proc/self/clear_refs", "w") as mark:
    mark.write("5")
before = peak_bytes()
vfcore.simulate(vfcore.Simulation())
print(json.dumps({"before_bytes": before, "after_bytes": peak_bytes()}))
"""


def first_results() -> tuple[dict[str, float], dict[str, float]]:
    """Seconds to import and to the first result: with an empty kernel cache, then in a new process with a full one."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {"VOCALIS_DATA": folder}
        return _run(_FIRST_RESULT, environment), _run(_FIRST_RESULT, environment)


def memory() -> dict[str, float] | None:
    """Resident bytes after a short run, and the peak during a run of 1 s after it; None except on Linux."""
    if sys.platform != "linux":
        return None
    return _run(_MEMORY, {})


def _run(script: str, environment: dict[str, str]) -> dict[str, float]:
    command = [sys.executable, "-c", script]
    # A cache directory set by the user would make the cold start warm.
    inherited = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    done = subprocess.run(command, env=inherited | environment, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)
