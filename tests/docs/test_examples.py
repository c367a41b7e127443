"""Every example runs as a reader would run it: as a saved file, in a separate folder, in a new process."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
#: For each example, text that it must print and files that it must write.
EXPECTED = {
    "commands.sh": (("periodic", "wrote high.wav"), ("high.wav", "high.nc", "bowed.json", "glide.wav", "map.nc")),
    "one_voice.py": (("CT 0.3: periodic", "fo_hz: 149.6 Hz", "flow: "), ()),
    "pitch_map.py": (("CT 0.5", "TA 0.1"), ("map.nc",)),
    "glide.py": (("CT 0.10, f_o", "CT 0.90, f_o"), ("glide.wav",)),
    "http_call.py": (("periodic", "fo_hz: "), ()),
}


def run(name: str, folder: Path, *arguments: str) -> str:
    """What a copy of the example prints; AssertionError with its errors when it fails."""
    copy = shutil.copy(EXAMPLES / name, folder)
    command = ["sh", copy] if name.endswith(".sh") else [sys.executable, copy]
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))  # where `vocalis` is
    done = subprocess.run(
        [*command, *arguments], cwd=folder, env=os.environ | {"PATH": path}, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr and "nan" not in done.stdout.lower().split()
    return done.stdout + done.stderr


def check(name: str, folder: Path, printed: str) -> None:
    words, files = EXPECTED[name]
    for word in words:
        assert word in printed
    for file in files:
        assert (folder / file).stat().st_size > 100, file


@pytest.mark.parametrize("name", [name for name in EXPECTED if name != "http_call.py"])
def test_an_example_runs_from_a_saved_file(name, tmp_path):
    check(name, tmp_path, run(name, tmp_path))


def test_the_http_example_talks_to_a_running_server(tmp_path):
    from tests.server.live_server import serving

    with serving() as server:
        check("http_call.py", tmp_path, run("http_call.py", tmp_path, server.url))


def test_every_example_is_run_and_listed():
    present = {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".sh")}
    assert present == set(EXPECTED)
    listed = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert all(f"[{name}]({name})" in listed for name in present)
