"""The memory of a batch is reused by the next."""

import subprocess
import sys

import pytest

# In a separate process, because memory of other tests would count as well.
_SCRIPT = """
import resource
from vfcore.runs.many import run_points
from vfcore.runs.memory import keep_freed_memory
from vfcore.spec.simulation import Simulation
keep_freed_memory()
def faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    list(run_points([Simulation(subglottal_pressure_pa=900.0 + k) for k in range(32)], precision="float32"))
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before
faults(), faults()
print(faults())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="a matter of the GNU C library")
def test_batches_after_the_first_reuse_memory():
    """Two batches have records and flows of 13 MB, or 3,200 pages."""
    done = subprocess.run([sys.executable, "-c", _SCRIPT], check=True, capture_output=True, text=True)
    assert int(done.stdout) < 160
