"""One task: made, planned, saved, loaded again and checked. The same task gives the same files, on any worker."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import platform
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from mcplan._core import Plan, Robot
from mcplan.errors import InvalidInput, SuspiciousGeometry, SuspiciousName, UnknownName
from mcplan.sweep.tasks import Task

#: Folders of a sweep's files.
PLANS, MOTIONS, EXPORTS, RECORDS, TIMES = "plans", "motions", "exports", "records", "times"
#: Endings of a task besides the statuses of a plan: the replay of the saved plan disagrees with `solved`; the task was
#: refused, such as a scene at whose start the robot cannot stand; it killed its workers.
REJECTED, REFUSED, CRASHED = "rejected", "refused", "crashed"
#: Measures of a motion's certificate that records have.
MEASURES = ("torque_use", "velocity_use", "self_distance_m", "base_residual_N", "drift_m", "com_rms_m")


@dataclass(frozen=True)
class Job:
    """A task and where its files go."""

    task: Task
    out: str


def work(job: Job) -> str:
    """Do a task and write its files, the record last: who finds it finds the others, too.

    Returns:
        The status.

    Raises:
        FileNotFoundError: This worker does not see a file that the task is made from, which is no property of the task.
    """
    out, task = Path(job.out), job.task
    begin, begin_cpu = time.time(), time.process_time()
    clock = time.perf_counter()
    _require_seen(task)
    try:
        with warnings.catch_warnings():
            for told in (SuspiciousGeometry, SuspiciousName):  # once for the sweep, not for each task
                warnings.simplefilter("ignore", told)
            record, times = _solve(task, out)
    except (InvalidInput, UnknownName) as refusal:
        record, times = {"status": REFUSED, "message": str(refusal).splitlines()[0]}, {}
    times |= {
        "wall_s": time.perf_counter() - clock,
        "cpu_s": time.process_time() - begin_cpu,
        "began": begin,
        "host": platform.node(),
    }
    write(out, task, TIMES, {"task": task.index, **times})
    write(out, task, RECORDS, head(task) | record)
    return str(record["status"])


def _require_seen(task: Task) -> None:
    for source in (task.source, task.robot_source):
        if os.path.isabs(source) and not os.path.isfile(source):
            raise FileNotFoundError(errno.ENOENT, f"{os.strerror(errno.ENOENT)} on {platform.node()}", source)


def head(task: Task) -> dict[str, Any]:
    """What a record says of the task itself."""
    return {
        "task": task.index,
        "entry": task.entry,
        "robot": task.robot,
        "engine": task.engine,
        "seed": task.seed,
        "parameters": dict(task.parameters),
        "options": dict(task.options),
    }


def write(out: Path, task: Task, kind: str, data: Any) -> None:
    """Write a task's record or times, complete or not at all."""
    from mcplan.files.outputs import write_whole

    path = path_of(out, task, kind, ".json")
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(json.dumps(data, allow_nan=False), path)


def files_of(record: Mapping[str, Any]) -> list[str]:
    """Fields of a record that are paths of files which it has; the digest of each is in FIELD_sha256."""
    return [name.removesuffix("_sha256") for name, value in record.items() if name.endswith("_sha256") and value]


def path_of(out: Path, task: Task, kind: str, suffix: str) -> Path:
    """Where a file of a task lies."""
    return out / kind / f"{task.stem}{suffix}"


def _solve(task: Task, out: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    from mcplan.files.sweep_terrains import make_scene

    robot = _robot(task.robot_source)
    scene = make_scene(task.generator, task.source, task.parameters, robot)
    begin = time.process_time()
    result = _engine(task, scene, robot)
    planned = time.process_time() - begin
    plan, report = result.plan, result.report
    worst = report.worst_violation
    record: dict[str, Any] = {
        "scene": scene.name,
        "status": str(report.status),
        "message": report.message,
        "cost": _finite(report.cost),
        "iterations": report.iterations,
        "switches": report.switches,
        "phases": len(plan.phases),
        "duration_s": plan.duration() if plan.phases else None,
        "worst_violation": worst.name or None,
        "worst_value": _finite(worst.value) if worst.name else None,
        "worst_tolerance": _finite(worst.tolerance) if worst.name else None,
        "worst_unit": worst.unit or None,
        "worst_time_s": _finite(worst.time_s) if worst.name else None,
        "contact_sequence": _sequence(plan),
        "durations_s": [phase.duration for phase in plan.phases],
    }
    times = {"plan_cpu_s": planned, "plan_wall_s": report.time_s}
    if plan.phases:
        record |= _saved(plan, record["status"], path_of(out, task, PLANS, ".npz"), out)
    if task.motion and record["status"] == "solved":
        begin = time.process_time()
        record |= _motion(plan, task.motion, path_of(out, task, MOTIONS, ".npz"), out)
        times["motion_cpu_s"] = time.process_time() - begin
    if task.exports and record.get("motion_status", record["status"]) == "solved":
        begin = time.process_time()
        source = out / record["motion" if task.motion else "plan"]
        record |= _exported(source, task.exports, out / EXPORTS / task.stem, out)
        times["export_cpu_s"] = time.process_time() - begin
    return record, times


def _saved(plan: Plan, status: str, path: Path, out: Path) -> dict[str, Any]:
    """Save a plan, load what was saved, and have the checker look at that: it alone says `solved`."""
    from mcplan.checking import check

    path.parent.mkdir(parents=True, exist_ok=True)
    plan.save(path)
    data = path.read_bytes()
    found = {"plan": path.relative_to(out).as_posix(), "plan_sha256": hashlib.sha256(data).hexdigest()}
    if status == "solved":
        again = check(type(plan).load(path))
        if not again.ok():
            found |= {"status": REJECTED, "message": f"called solved, but the saved plan: {again.worst()}"}
    return found


def _motion(plan: Plan, joints: str, path: Path, out: Path) -> dict[str, Any]:
    """Find a whole-body motion along a plan and save it; its certificate alone says `solved`."""
    from mcplan.files.outputs import write_whole
    from mcplan.wb.solve import motion

    try:
        result = motion(plan, joints=joints)
    except InvalidInput as refusal:  # a robot without URDF, or a plan out of the reach of its joints
        return {"motion_status": REFUSED, "motion_message": str(refusal).splitlines()[0]}
    path.parent.mkdir(parents=True, exist_ok=True)
    data = result.motion.to_bytes()
    write_whole(data, path)
    measures = {} if result.certificate is None else result.certificate.measures
    return {
        "motion_status": str(result.status),
        "motion_message": str(result.shortfall or result.report.message),
        "motion_iterations": result.iterations,
        **{f"motion_{name}": _finite(measures[name]) if name in measures else None for name in MEASURES},
        "motion": path.relative_to(out).as_posix(),
        "motion_sha256": hashlib.sha256(data).hexdigest(),
    }


def _exported(source: Path, formats: tuple[str, ...], stem: Path, out: Path) -> dict[str, Any]:
    """Write what was saved in other tools' formats; a posture that the robot cannot take up is a refusal by name."""
    from mcplan.export import FORMATS, export

    stem.parent.mkdir(parents=True, exist_ok=True)
    found: dict[str, Any] = {}
    refused = []
    for name in formats:
        path = stem.with_name(f"{stem.name}.{name}{FORMATS[name].suffix[0]}")
        try:
            export(source, name, path)
        except InvalidInput as refusal:
            refused.append(f"{name}: {str(refusal).splitlines()[0]}")
            continue
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        found |= {f"export_{name}": path.relative_to(out).as_posix(), f"export_{name}_sha256": digest}
    return {"export_message": "; ".join(refused) or None} | found


def _engine(task: Task, scene: Any, robot: Robot) -> Any:
    """The planner's result."""
    named: dict[str, Any] = {}
    for name, value in task.options.items():
        group, _, part = name.partition(".")
        if part:
            named.setdefault(group, {})[part] = value
        else:
            named[name] = value
    if task.engine == "rhp":
        from mcplan.walking import receding_horizon

        return receding_horizon(scene, robot, None, named, None).walk()
    from mcplan.solve import plan

    # Sweeps use processes, not threads, and the plan does not depend on the number of threads.
    return plan(scene, robot, {"threads": 1, **named, "seed": task.seed})


@lru_cache(maxsize=8)
def _robot(source: str) -> Robot:
    from mcplan.files.robots import load_robot

    return load_robot(source)


def _sequence(plan: Plan) -> list[str]:
    """A text for each phase: "left_foot=ground right_foot=tread_1"; "" in flight."""
    ends = [end.name for end in plan.robot.end_effectors]
    names = [surface.name for surface in plan.scene.surfaces]
    return [
        " ".join(f"{end}={names[surface]}" for end, surface in zip(ends, row, strict=True) if surface >= 0)
        for row in plan.contact_sequence()
    ]


def _finite(value: float) -> float | None:
    return float(value) if abs(value) < float("inf") else None
