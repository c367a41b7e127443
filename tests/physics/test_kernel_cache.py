"""Compiled code is kept apart by what it was compiled from and how."""

import os
import subprocess
import sys

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


def test_a_cache_folder_given_by_the_user_is_kept(tmp_path):
    assert cache_folder(tmp_path, NUMBA_CACHE_DIR=str(tmp_path / "mine")) == str(tmp_path / "mine")
