"""The checked-in type stubs are those of the compiled module."""

import importlib.metadata
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_stubs_are_those_of_the_installed_module(tmp_path):
    try:
        importlib.metadata.version("mcplan")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("mcplan is imported from the source tree, not installed")
    subprocess.run([ROOT / "scripts/stubs", tmp_path], check=True, env={**os.environ, "PYTHON": sys.executable})
    new = (tmp_path / "_core.pyi").read_text(encoding="utf-8")
    old = (ROOT / "python/mcplan/_core.pyi").read_text(encoding="utf-8")
    assert new == old, "run scripts/stubs and look at what has changed"
