"""Cycles of the receding horizon by CasADi with fatrop, by Ipopt and by our kernel: benchmarks/rhp_fatrop.py, run from here."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

from environments import Unavailable, run

CASADI = "casadi==3.8.2"
SCRIPT = Path(__file__).resolve().parents[1] / "rhp_fatrop.py"
CASES, TERRAIN, CYCLES = ("point", "single"), "up_and_down", 10
NAMES = {"kernel": "mcplan rhp, kernel", "ipopt": "mcplan rhp, Ipopt", "fatrop 0.001": "CasADi + fatrop"}


def rows(folder: Path) -> list[dict[str, Any]]:
    """A row for each fidelity and solver.

    Raises:
        Unavailable: CasADi cannot be installed, or the benchmark fails.
    """
    packages, out = folder / "packages", folder / "cycles.json"
    if not packages.exists():
        run(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", packages, CASADI)
    words = [sys.executable, SCRIPT, "--terrains", TERRAIN, "--cycles", str(CYCLES), "--cases", *CASES, "--out", out]
    path = os.pathsep.join(filter(None, (os.environ.get("PYTHONPATH"), str(packages))))
    done = subprocess.run(words, env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True)
    if done.returncode:
        raise Unavailable(f"{SCRIPT.name}: {done.stderr.strip().splitlines()[-1]}")
    found = []
    for walk in json.loads(out.read_text())["walks"]:
        for solver, shown in NAMES.items():
            cycles = [cycle[solver] for cycle in walk["cycles"]]
            solved = [cycle for cycle in cycles if cycle["success"]]
            times = [cycle["cpu_s"] for cycle in solved]
            found.append(
                {
                    "case": f"{walk['terrain']}, {walk['fidelity']}",
                    "planner": shown,
                    "solved": f"{len(solved)}/{len(cycles)}",
                    "median_ms": 1e3 * statistics.median(times) if times else None,
                    "max_ms": 1e3 * max(times) if times else None,
                    "iterations": statistics.median(cycle["iterations"] for cycle in solved) if solved else None,
                }
            )
    return found
