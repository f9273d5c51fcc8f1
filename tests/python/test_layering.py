"""Includes and imports run one way: docs/architecture.md, "Who may use whom"."""

import ast
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# What each room may include; a new room needs an entry.
CPP_ROOMS = {
    "base": set(),
    "scene": {"base"},
    "robot": {"base", "scene"},
    "plan": {"base", "scene", "robot"},
    "ddp": {"base", "scene", "robot", "plan"},
}
# What each package must not import.
PYTHON_FORBIDDEN = {
    "files": {"view", "reproduce", "cli"},
    "view": {"reproduce", "cli"},
    "reproduce": {"cli"},
}
HEAVY = {"meshcat", "matplotlib", "pinocchio", "example_robot_data", "mujoco", "scipy"}


def test_each_cpp_room_includes_only_those_below_it():
    wrong, seen = [], set()
    for folder in (ROOT / "cpp/include/mcplan", ROOT / "cpp/src"):
        for path in sorted(folder.glob("*/*.?pp")):
            room = path.parent.name
            if room == "bindings":
                continue
            seen.add(room)
            used = set(re.findall(r'#include [<"](?:mcplan/)?(\w+)/', path.read_text(encoding="utf-8")))
            used &= set(CPP_ROOMS) | {"bindings"}
            wrong += [f"{path.relative_to(ROOT)} includes {name}" for name in used - CPP_ROOMS[room] - {room}]
    assert wrong == []
    assert seen >= {"base", "scene", "robot", "plan"}


def imported_packages(path):
    """First part of every `mcplan.<part>` that a file imports, lazily or not."""
    parts = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        parts |= {name.split(".")[1] for name in names if name.startswith("mcplan.")}
    return parts


def test_each_python_package_imports_only_those_below_it():
    wrong = []
    for package, forbidden in PYTHON_FORBIDDEN.items():
        for path in sorted((ROOT / "python/mcplan" / package).rglob("*.py")):
            wrong += [f"{path.relative_to(ROOT)} imports {name}" for name in imported_packages(path) & forbidden]
    assert wrong == []


def test_importing_mcplan_loads_no_heavy_package():
    code = "import sys, mcplan; print(*sorted({name.split('.')[0] for name in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "numpy" in loaded
    assert HEAVY & set(loaded) == set()
