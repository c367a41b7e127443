"""The kernel cache: separate for each set of sources and options, and shared between processes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

ASK = "import numba, vfcore.kernels.jit; print(numba.config.CACHE_DIR)"


def cache_folder(tmp_path, **settings):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    environment |= {"VOCALIS_DATA": str(tmp_path)} | settings
    answer = subprocess.run(
        [sys.executable, "-c", ASK], env=environment, capture_output=True, text=True, check=True, timeout=60
    )
    return answer.stdout.strip()


def test_a_bounds_checked_run_does_not_load_unchecked_code(tmp_path):
    plain, checked = cache_folder(tmp_path), cache_folder(tmp_path, NUMBA_BOUNDSCHECK="1")
    assert plain.startswith(str(tmp_path)) and checked.startswith(str(tmp_path))
    assert plain != checked
    assert cache_folder(tmp_path) == plain


def test_a_cache_folder_set_by_the_user_is_used(tmp_path):
    assert cache_folder(tmp_path, NUMBA_CACHE_DIR=str(tmp_path / "mine")) == str(tmp_path / "mine")


COMPILE = """
from tests.physics.test_kernel_glide import spec, test_a_glide_equals_its_stretches
from vfcore.fold.assembly import place_glottis, place_wall, wall_of
from vfcore.fold.equilibrium import equilibrium_with_contact
from vfcore.fold.form import StepForm
from vfcore.fold.statics import static_shapes_of
from vfcore.fold.step import step_kernel
from vfcore.runs.setup import glottis_of
test_a_glide_equals_its_stretches("walls")
static_shapes_of(glottis_of(*spec(0.1)))
kernels = [step_kernel(StepForm(8, 4, walls=2)), wall_of, place_wall, place_glottis, equilibrium_with_contact]
assert all(kernel.signatures for kernel in kernels)
print([sum(kernel.stats.cache_misses.values()) for kernel in kernels])
"""


@pytest.mark.skipif(os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled")
def test_a_second_process_loads_what_the_first_has_compiled():
    """A function among the closure variables of a kernel would give it another cache key in every process."""
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", COMPILE], capture_output=True, text=True, check=True, timeout=300, cwd=ROOT
        )
    assert done.stdout.strip() == "[0, 0, 0, 0, 0]"
