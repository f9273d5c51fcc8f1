"""sl1m (Tonneau et al. 2020) on our scenes: surfaces and footholds of a given number of steps, without dynamics or times.

Its sources are cloned from GitHub at a fixed commit, or lie there already. The relaxation runs without Gurobi, which the
mixed-integer form needs. The robot is the one that it brings along, with its reach polytopes.
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import numpy as np
from environments import python_with, run, sources

import mcplan as mp

URL, COMMIT = "https://github.com/loco-3d/sl1m", "87a4af4"
#: Versions of its time: the LP method that it names left SciPy with 1.11.
PACKAGES = ("numpy<1.24", "scipy<1.11", "quadprog", "pycddlib<3", "cvxpy", "matplotlib")
SCENES = ("flat", "stairs_broad", "stepping_stones")
HERE = Path(__file__).resolve().parent


def rows(folder: Path, given: Path | None) -> list[dict[str, Any]]:
    """One row a scene.

    Raises:
        Unavailable: It cannot be installed.
    """
    tree = sources(folder, given, "sl1m", URL, COMMIT)
    python = python_with(folder / "venv", PACKAGES)
    found = []
    for name in SCENES:
        problem = folder / f"{name}.json"
        problem.write_text(json.dumps(problem_of(name)))
        answer = json.loads(run(python, HERE / "sl1m_inside.py", tree, problem))
        asked = json.loads(problem.read_text())
        said = "found" if answer["found"] else answer["error"] or "not found"
        found.append({"scene": name, "steps": asked["steps"], "mcplan_s": asked["mcplan_s"], "answer": said, **answer})
    return found


def problem_of(scene_name: str) -> dict[str, Any]:
    """Surfaces, start and as many steps as mcplan's plan for Talos takes."""
    scene, robot = mp.load_scene(scene_name), mp.load_robot("talos")
    cpu = time.process_time()
    result = mp.plan(scene, robot, threads=1)
    cpu = time.process_time() - cpu
    samples = result.plan.sample(np.arange(0.0, result.plan.duration(), 1e-3))
    feet = [e for e, each in enumerate(robot.end_effectors) if each.kind == "foot"]
    left_first = sorted(feet, key=lambda e: "left" not in robot.end_effectors[e].name)
    touchdowns = [
        int((np.diff(samples.surfaces[:, e] >= 0, prepend=True) & (samples.surfaces[:, e] >= 0)).sum()) for e in feet
    ]
    return {
        "surfaces": [np.array(surface.vertices_W).tolist() for surface in scene.surfaces],
        "last": len(scene.surfaces) - 1,
        "steps": sum(touchdowns),
        "feet": [samples.end_effectors_W[0, e].tolist() for e in left_first],
        "mcplan_s": cpu,
    }
