"""Every script of benchmarks/ starts and says what it does, those that need more packages once these are there."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted(path.name for path in (ROOT / "benchmarks").glob("*.py"))
NEEDS = {"rhp_fatrop.py": "casadi"}


@pytest.mark.parametrize("script", SCRIPTS)
def test_help_is_printed(script):
    for name in ("mujoco", "pinocchio", NEEDS.get(script, "mcplan")):
        pytest.importorskip(name)
    command = [sys.executable, str(ROOT / "benchmarks" / script), "--help"]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.startswith("usage: ") and script in ended.stdout


def test_every_script_is_listed():
    listed = (ROOT / "benchmarks" / "README.md").read_text()
    assert [script for script in SCRIPTS if f"`{script}`" not in listed] == []
