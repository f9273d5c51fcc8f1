"""Whole-body plans in .npz files: arrays and a JSON header, no pickles. In .json files, which C++ reads and writes, they have
format 2.

The header (bytes of UTF-8 JSON) holds the kind "whole_body", the format's version, the units, the version of mcplan, the
planner, the force law, and the task with its robot: all members under their names, infinite numbers as the texts "inf" and
"-inf". F phases, I intervals and J joints give these
arrays:

    durations (F)  control_points (J, I+3)  base_control_points (3, I+3), or (0, 0) for a base that is computed
    weights (W)  force_polynomials (4, C)

Weights stand phase by phase, contact by contact, point by point, columns of the force polynomials interval by interval
(tangential and normal for each point). One of the two is empty.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import (
    Plan,
    PlanarForceLaw,
    PlanarPlan,
    PlanarTask,
    __version__,
    any_plan_from_json,
    planar_plan_from_json,
    planar_plan_to_json,
    planar_task_from_plain,
    planar_task_to_plain,
)
from mcplan.errors import InvalidInput, InvalidPlan, written
from mcplan.files import plans
from mcplan.files.archives import (
    archive_bytes,
    kind_text,
    read_arrays,
    read_header,
    require_kind,
    require_members,
)
from mcplan.files.plan_files import load_plan_file, write_plan_file

KIND = "whole_body"
#: Of files of runs (tracking/run_files.py), which carry a plan and are none.
RUN_KINDS = ("run", "planar_run")
FORMAT = 1
#: Of a plan in a file, in all phases together.
MAX_INTERVALS = 20_000
UNITS = "SI: m, kg, s, N, rad; _W: world frame, x forward, y up; _B: frame of a body; _P: frame of its parent"
_LAWS = dict(PlanarForceLaw.__members__)
#: The array that has a law's numbers; the other one is empty.
_ARRAY_OF_LAW = {PlanarForceLaw.least_norm: "weights", PlanarForceLaw.polynomial: "force_polynomials"}


def save_whole_body_plan(plan: PlanarPlan, path: str | Path) -> None:
    """Write a plan to a file, which is complete or not there at all.

    Args:
        plan: The plan.
        path: Where to; used as it stands, no ending is added, and one other than .npz or .json is refused.

    Raises:
        InvalidInput: The name promises another kind of file.
        InvalidPlan, InvalidPlanarTask, InvalidRobot: Its sizes do not fit together or a number is out of range.
    """
    write_plan_file(plan, path, planar_plan_to_json, plan_to_bytes)


def load_whole_body_plan(path: str | Path) -> PlanarPlan:
    """Read a plan written by save_whole_body_plan, or by PlanarPlan::save in C++.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    return load_plan_file(path, planar_plan_from_json, plan_from_bytes)


def load_any_plan(path: str | Path) -> Plan | PlanarPlan:
    """Read a plan file of either kind.

    Raises:
        InvalidPlan: No plan file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """

    def from_archive(data: bytes) -> Plan | PlanarPlan:
        kind = read_header(read_arrays(data)).get("kind")
        return plan_from_bytes(data) if kind == KIND else plans.plan_from_bytes(data)

    return load_plan_file(path, any_plan_from_json, from_archive)


def plan_to_bytes(plan: PlanarPlan) -> bytes:
    """The content of a plan file."""
    plan.validate()
    header = {
        "kind": KIND,
        "format": FORMAT,
        "units": UNITS,
        "mcplan": __version__,
        "planner": plan.planner,
        "force_law": plan.force_law.name,
        "task": planar_task_to_plain(plan.task),
    }
    own = _ARRAY_OF_LAW[plan.force_law]
    weights = plan.weights if own == "weights" else ()
    polynomials = plan.force_polynomials if own == "force_polynomials" else ()
    arrays = {
        "durations": np.array(plan.durations, dtype=float),
        "control_points": np.array(plan.control_points),
        "base_control_points": np.array(plan.base_control_points),
        "weights": np.concatenate([np.zeros(0), *weights]),
        "force_polynomials": np.concatenate([np.zeros((4, 0)), *polynomials], axis=1),
    }
    return archive_bytes(header, arrays)


def plan_from_bytes(data: bytes) -> PlanarPlan:
    """The plan of the content of a plan file.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together.
    """
    arrays = read_arrays(data)
    header = _checked_header(read_header(arrays))
    try:
        task = planar_task_from_plain(header["task"])
        task.validate()
    except InvalidInput as found:
        raise found.moved(InvalidPlan, prefix="header.task") from None
    _check_arrays(arrays)
    if task.interval_count() > MAX_INTERVALS:
        rule = f"may have {MAX_INTERVALS} intervals at most"
        raise InvalidPlan("header.task.phases", rule, str(task.interval_count()))
    law = _LAWS[header["force_law"]]
    points = _point_counts(task)
    intervals = [count for phase, count in zip(task.phases, points, strict=True) for _ in range(phase.intervals)]
    own = _ARRAY_OF_LAW[law]
    weights = _cut(arrays, "weights", points if own == "weights" else [])
    columns = [2 * count for count in intervals] if own == "force_polynomials" else []
    plan = PlanarPlan(
        task=task,
        planner=header["planner"],
        durations=arrays["durations"].tolist(),
        control_points=arrays["control_points"],
        base_control_points=arrays["base_control_points"],
        force_law=law,
        weights=weights,
        force_polynomials=_cut(arrays, "force_polynomials", columns),
    )
    plan.validate()
    return plan


def _point_counts(task: PlanarTask) -> list[int]:
    """Points in contact, phase by phase."""
    ends = task.robot.end_effectors
    return [sum(len(ends[contact.end_effector].points) for contact in phase.contacts) for phase in task.phases]


def _checked_header(header: dict[str, Any]) -> dict[str, Any]:
    if header.get("kind") != KIND:
        raise InvalidPlan("header.kind", f"must be {written(KIND)}: a plan of a planar robot", kind_text(header))
    version = header.get("format")
    if type(version) is not int or version != FORMAT:
        raise InvalidPlan("header.format", f"must be {FORMAT} for this version of mcplan", written(version))
    if "task" not in header and "motion" in header:  # as until 0.1
        header = {**header, "task": header["motion"]}
    require_members(header, planner=str, force_law=str, task=dict)
    if header["force_law"] not in _LAWS:
        raise InvalidPlan("header.force_law", f"must be one of {', '.join(_LAWS)}", written(header["force_law"]))
    return header


def _check_arrays(arrays: dict[str, np.ndarray]) -> None:
    """Their types and numbers of axes; what sizes they must have is known to the plan."""
    axes = {"durations": 1, "control_points": 2, "base_control_points": 2, "weights": 1, "force_polynomials": 2}
    for name, count in axes.items():
        require_kind(arrays, name)
        if arrays[name].ndim != count:
            raise InvalidPlan(name, f"must have {count} axes", str(arrays[name].ndim))


def _cut(arrays: dict[str, np.ndarray], name: str, sizes: list[int]) -> list[np.ndarray]:
    """Pieces of these sizes along the last axis."""
    array = arrays[name]
    if array.shape[-1] != sum(sizes) or (array.ndim == 2 and array.shape[0] != 4):
        wanted = (4, sum(sizes)) if array.ndim == 2 else (sum(sizes),)
        raise InvalidPlan(name, f"must have shape {wanted}", str(array.shape))
    return np.split(array, np.cumsum(sizes)[:-1], axis=-1) if sizes else []
