"""Whole-body motions of robots on scenes: iterations, time, what the certificate measures, certified or why not."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

#: Robot and scene of each row.
CASES = (
    ("talos", "flat"),
    ("talos", "stairs_broad"),
    ("talos", "stepping_stones"),
    ("talos", "ramp"),
    ("talos", "turn"),
    ("talos", "short_gap"),
    ("g1", "flat"),
    ("g1", "stairs"),
    ("g1", "stairs_broad"),
    ("go2", "flat"),
    ("anymal", "flat"),
    ("romeo", "flat"),
)
#: Robots that mcplan does not bring: Aldebaran's Romeo of example-robot-data, knees bent by 0.7 rad; its sole is a rectangle
#: inside of the foot's mesh.
OWN_ROBOTS = {"romeo": Path(__file__).with_name("romeo.toml")}
#: Of a search for a plan [s].
PLAN_LIMIT_S = 12.0
#: Measures of the certificate, as they are in the rows.
MEASURES = (
    "base_residual_N",
    "base_residual_Nm",
    "line_residual_Nm",
    "drift_m",
    "torque_use",
    "torque_step_use",
    "velocity_use",
    "self_distance_m",
    "clearance_m",
    "mid_swing_m",
    "com_rms_m",
    "com_max_m",
)

Progress = Callable[[str], None]


def motions(
    cases: Sequence[tuple[str, str]] = CASES, start: str = "follow", progress: Progress | None = None
) -> list[dict[str, Any]]:
    """A row for each robot and scene; `start` as in mcplan.motion. Times are CPU.

    That of a search contains its certificates, one or more where links came too near; one of them is measured apart.
    """
    rows = []
    for robot, scene in cases:
        rows.append(_row(robot, scene, start))
        if progress is not None:
            progress(text(rows[-1]))
    return rows


def _row(robot: str, scene: str, start: str) -> dict[str, Any]:
    import mcplan as mp

    planned = mp.plan(scene, OWN_ROBOTS.get(robot, robot), time_limit=PLAN_LIMIT_S)
    row: dict[str, Any] = {"robot": robot, "scene": scene, "plan": str(planned.report.status)}
    if not planned.plan.phases:
        return {**row, "status": "no plan", "certified": False, "reason": planned.report.message}
    began = time.process_time()
    result = mp.motion(planned.plan, start=start)
    cpu_s = time.process_time() - began
    certificate = result.certificate
    began = time.process_time()
    if certificate is not None:
        result.motion.check()
    certificate_s = time.process_time() - began
    certified = str(result.status) == "solved"
    measures = {} if certificate is None else certificate.measures
    return {
        **row,
        "duration_s": result.motion.duration(),
        "status": str(result.status),
        "certified": certified,
        "iterations": result.iterations,
        "cpu_per_s": cpu_s / result.motion.duration(),
        "certificate_cpu_per_s": certificate_s / result.motion.duration(),
        "cost": result.report.cost,
        **{name: measures.get(name) for name in MEASURES},
        "reason": "" if certified else str(result.shortfall or result.report.message),
    }


def text(row: dict[str, Any]) -> str:
    """A row in a line."""
    head = f"{row['robot']} {row['scene']}: "
    if "iterations" not in row:
        return f"{head}{row['status']}, {row['reason']}"
    out = f"{head}{row['duration_s']:.1f} s, {row['iterations']} iterations, {row['cpu_per_s']:.2f} CPU s per s "
    out += f"({row['certificate_cpu_per_s']:.2f} a certificate), "
    if row["base_residual_N"] is not None:
        out += f"residual {row['base_residual_N']:.2g} N {row['base_residual_Nm']:.2g} N m, "
        out += f"drift {1e3 * row['drift_m']:.2g} mm, torque {row['torque_use']:.2f}, speed {row['velocity_use']:.2f}, "
        out += f"links {1e3 * row['self_distance_m']:.0f} mm, CoM {1e3 * row['com_rms_m']:.1f} mm rms, "
    return out + ("certified" if row["certified"] else f"{row['status']}: {row['reason']}")
