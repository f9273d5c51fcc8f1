"""The Python examples run to their end; the C++ ones are tests of CMake."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
#: What they show is in the Python package alone, and what it needs.
PYTHON_ALONE = {
    "06_track": ("mujoco", "pinocchio", "proxsuite", "example_robot_data", "scipy"),
    "09_hop": ("mujoco", "pinocchio", "proxsuite", "example_robot_data", "scipy", "coal"),
}
NO_PLANNER = not (ROOT / "cpp/src/ddp/switched_ddp.cpp").exists()


def test_every_example_has_its_twin():
    cpp = sorted(path.stem for path in (ROOT / "examples").glob("*.cpp"))
    assert cpp == [path.stem for path in EXAMPLES if path.stem not in PYTHON_ALONE] != []


@pytest.mark.skipif(NO_PLANNER, reason="there is no planner yet")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(path, tmp_path):
    for name in PYTHON_ALONE.get(path.stem, ()):
        if importlib.util.find_spec(name) is None:
            pytest.skip(f"needs {name}")
    subprocess.run([sys.executable, path], cwd=tmp_path, check=True)
