"""The checked-in type stubs are those of the compiled module."""

import importlib.metadata
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def stubs(folder):
    """Text of the stubs by path: _core.pyi, or a folder _core with one for each submodule."""
    texts = {path.relative_to(folder): path.read_text(encoding="utf-8") for path in folder.glob("_core*/**/*.pyi")}
    texts |= {path.relative_to(folder): path.read_text(encoding="utf-8") for path in folder.glob("_core.pyi")}
    assert texts, f"no stubs in {folder}"
    return texts


def test_stubs_are_those_of_the_installed_module(tmp_path):
    try:
        importlib.metadata.version("mcplan")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("mcplan is imported from the source tree, not installed")
    subprocess.run([ROOT / "scripts/stubs", tmp_path], check=True, env={**os.environ, "PYTHON": sys.executable})
    assert stubs(ROOT / "python/mcplan") == stubs(tmp_path), "run scripts/stubs and look at what has changed"
