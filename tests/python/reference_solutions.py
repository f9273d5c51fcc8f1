"""Plans of Lengagne et al.'s motions that an earlier implementation found: tests/data/lengagne_reference.json.

Robots and tasks stand there as in the headers of plan files; a task names its robot. Of each joint's control points
only those that are free are written down: the first and the last one are there three times, which is rest.
"""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import PlanarPlan, PlanarTask, planar_task_from_plain

FILE = Path(__file__).resolve().parents[1] / "data/lengagne_reference.json"

#: Integral of the squared torques [N^2 m^2 s] of the optimised ones.
TORQUE_INTEGRALS = {
    ("cartwheel", "optimised_uniform"): 1405.2,
    ("cartwheel", "optimised_per_point"): 628.4,
    ("climbing", "optimised_per_point"): 808.5,
    ("walking", "optimised_uniform"): 1504.05,
    ("walking", "optimised_per_point"): 438.2,
}


@functools.cache
def _content() -> dict[str, Any]:
    return json.loads(FILE.read_text())


def reference_names() -> list[tuple[str, str]]:
    """Task and name of every solution, e.g. ("walking", "feasible_per_point")."""
    return [(entry["task"], entry["name"]) for entry in _content()["solutions"]]


def reference_task(name: str) -> PlanarTask:
    """One of cartwheel, climbing, climbing_steep and walking."""
    plain = _content()["tasks"][name]
    return planar_task_from_plain({**plain, "robot": _content()["robots"][plain["robot"]]})


def reference_plan(task: str, name: str) -> PlanarPlan:
    """A new plan of one of reference_names()."""
    entry = next(e for e in _content()["solutions"] if (e["task"], e["name"]) == (task, name))
    free = np.array(entry["free_control_points"])
    return PlanarPlan(
        task=reference_task(task),
        planner="reference",
        durations=entry["durations"],
        control_points=np.hstack([free[:, :1], free[:, :1], free, free[:, -1:], free[:, -1:]]),
        weights=[np.array(weights) for weights in entry["weights"]],
    )
