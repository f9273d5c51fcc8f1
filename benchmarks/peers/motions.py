"""Crocoddyl's FDDP, and mcplan's whole-body stage, along the same plans."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

from environments import python_with, run

import mcplan as mp

#: Its wheel is compiled for this Pinocchio and crashes with the next.
PACKAGES = ("crocoddyl==3.2.1", "pin==4.0.0", "numpy")
CASES = (("flat", "talos"), ("stairs_broad", "talos"), ("flat", "g1"))
ITERATIONS = 100
HERE = Path(__file__).resolve().parent


def rows(folder: Path) -> list[dict[str, Any]]:
    """Two rows a case.

    Raises:
        Unavailable: Crocoddyl cannot be installed or fails.
    """
    python = python_with(folder / "venv", PACKAGES)
    found = []
    for scene, robot in CASES:
        plan = mp.plan(scene, robot).plan
        problem = folder / f"{scene}_{robot}.py"
        mp.export(plan, "crocoddyl", str(problem))
        peer = json.loads(run(python, HERE / "crocoddyl_inside.py", problem, str(ITERATIONS)))
        peer["answer"] = "converged" if peer.pop("converged") else "not converged"
        found.append({"case": f"{scene}/{robot}", "planner": "Crocoddyl 3.2.1, FDDP", **peer})
        found.append({"case": f"{scene}/{robot}", "planner": "mcplan motion", **ours(plan)})
    return found


def ours(plan: Any) -> dict[str, Any]:
    """mcplan's motion along the plan, start by inverse kinematics included, and what its certificate measures."""
    began = time.process_time()
    result = mp.motion(plan)
    found = time.process_time()
    result.motion.check()
    check = time.process_time() - found
    measures = result.certificate.measures if result.certificate else {}
    row = {name: measures.get(name) for name in ("torque_use", "velocity_use", "base_residual_N", "base_residual_Nm")}
    beyond: dict[str, float] = {}
    if result.certificate:
        kinds = {
            "drift_mm": ("drift", 1e3),
            "position_over_mrad": ("position", 1e3),
            "cone_N": ("friction", 1.0),
            "pressure_mm": ("center_of_pressure", 1e3),
        }
        beyond = {name: max(0.0, factor * result.certificate.of(of).value) for name, (of, factor) in kinds.items()}
    times = {"cpu_s": found - began - check, "certificate_s": check}  # the search ends with a certificate
    return {"answer": str(result.status), "iterations": result.iterations, **times, **row, **beyond}
