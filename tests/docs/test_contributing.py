"""The examples of CONTRIBUTING.md: each change touches one folder, applies to the sources as they are, and works."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
SECTION = TEXT[TEXT.index("### Add a force") : TEXT.index("### Add a route")]
CHANGES = re.findall(r"```diff\n(.*?)```", SECTION, re.DOTALL)
(EXAMPLE,) = re.findall(r"```python\n(.*?)```", SECTION, re.DOTALL)
#: Prints the peak area without drag, with drag on one side, on both, and with more of it in one place.
TRY = f"""
{EXAMPLE}
def peak(**more):
    request = resolve({{"run": {{"duration_s": 0.2}}}} | more)
    return 1e6 * vfcore.simulate(request).arrays["glottal_area_m2"][3000:].max()
drag = {{"drag_pa_s_m": 30}}
print(peak(), peak_mm2, peak(constants=drag), peak(constants=drag, lesions=[{{"viscosity_ratio": 5, "length_mm": 8}}]))
"""


@pytest.fixture(scope="module")
def changed(tmp_path_factory) -> Path:
    """The sources of the core with both changes."""
    root = tmp_path_factory.mktemp("contribution")
    shutil.copytree(ROOT / "vfcore", root / "vfcore", ignore=shutil.ignore_patterns("__pycache__"))
    for change in CHANGES:
        subprocess.run(["git", "apply", "-p0", "-"], input=change, text=True, cwd=root, check=True)
    return root


def test_each_change_touches_one_folder():
    assert len(CHANGES) == 2
    for change in CHANGES:
        touched = re.findall(r"^\+\+\+ (\S+)", change, re.MULTILINE)
        assert touched and all(name.startswith("vfcore/fold/") for name in touched)


def test_the_changed_core_has_the_force_on_one_side_on_both_and_as_a_field(changed):
    environment = os.environ | {"PYTHONPATH": str(changed)}
    done = subprocess.run(
        [sys.executable, "-c", TRY], env=environment, cwd=changed, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    without, one_side, both, more = map(float, done.stdout.split())
    assert without > 1.05 * one_side > 1.1 * both > 1.2 * more
