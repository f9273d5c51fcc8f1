"""The Python examples run to their end; the C++ ones are tests of CMake."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("[0-9]*.py"))
NO_PLANNER = not (ROOT / "cpp/src/ddp/switched_ddp.cpp").exists()


def test_every_example_has_its_twin():
    cpp = sorted(path.stem for path in (ROOT / "examples").glob("[0-9]*.cpp"))
    assert cpp == [path.stem for path in EXAMPLES] != []


@pytest.mark.skipif(NO_PLANNER, reason="there is no planner yet")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(path, tmp_path):
    subprocess.run([sys.executable, path], cwd=tmp_path, check=True, timeout=120)
