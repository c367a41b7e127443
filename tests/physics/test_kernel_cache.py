"""Compiled code is kept apart by what it was compiled from and how."""

import os
import subprocess
import sys

ASK = "import numba, vfcore.kernels.jit; print(numba.config.CACHE_DIR)"
STEP = """
from vfcore.march import March
from vfcore.params import Run, Simulation
from vfcore.simulate import prepare
march = March(prepare(Simulation(run=Run(nx=8, ny=4))).fold, 1e-5, 0.0)
march.start_flat()
march.run(1)
"""


def in_a_process(script, tmp_path, **settings):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    environment |= {"VOCALIS_DATA": str(tmp_path)} | settings
    answer = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    return answer.stdout.strip()


def cache_folder(tmp_path, **settings):
    return in_a_process(ASK, tmp_path, **settings)


def test_a_bounds_checked_run_does_not_load_unchecked_code(tmp_path):
    plain, checked = cache_folder(tmp_path), cache_folder(tmp_path, NUMBA_BOUNDSCHECK="1")
    assert plain.startswith(str(tmp_path)) and checked.startswith(str(tmp_path))
    assert plain != checked
    assert cache_folder(tmp_path) == plain


def test_a_cache_folder_given_by_the_user_is_kept(tmp_path):
    assert cache_folder(tmp_path, NUMBA_CACHE_DIR=str(tmp_path / "mine")) == str(tmp_path / "mine")


def test_what_one_process_has_compiled_the_next_one_loads(tmp_path):
    in_a_process(STEP, tmp_path)
    compiled = sorted(tmp_path.rglob("*.nbc"))
    in_a_process(STEP, tmp_path)
    assert any("step_kernel" in path.name for path in compiled)
    assert sorted(tmp_path.rglob("*.nbc")) == compiled
