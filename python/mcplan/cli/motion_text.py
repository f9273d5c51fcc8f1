"""Motions and their certificates in words and as plain data."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from mcplan.wb.certificate.result import RATIO

if TYPE_CHECKING:
    from mcplan.wb import MotionCheckResult
    from mcplan.wb.result import MotionResult

#: Measures that ``mcplan motion --json`` says beside status, time and iterations.
MEASURES = (
    "base_residual_N",
    "base_residual_Nm",
    "drift_m",
    "torque_use",
    "velocity_use",
    "self_distance_m",
    "clearance_m",
    "com_rms_m",
)


def certificate_lines(name: str, result: MotionCheckResult) -> list[str]:
    """What the certificate found, in lines."""
    if result.ok():
        lines = [f"{name}: ok. Closest to its limit: {result.worst()}"]
    else:
        found = result.violations()
        lines = [f"{name}: {len(found)} constraint{'s' * (len(found) > 1)} violated"]
        lines += [f"  {violation}" for violation in found]
    return [*lines, *(f"note: {note}" for note in result.notes), measures_line(result)]


def certificate_rows(result: MotionCheckResult) -> list[list[str]]:
    """A row for each constraint: its name, the worst value, the limit, when and where, and what is to be said of it."""
    rows = []
    for constraint in result.constraints:
        unit = "" if constraint.unit == RATIO else constraint.unit
        limit = f"{'>=' if constraint.at_least else '<='} {constraint.limit:.3g} {unit}".rstrip()
        value = f"{constraint.value:.3g} {unit}".rstrip()
        when = f"{constraint.time_s:.3f} s" if constraint.where or constraint.time_s > 0.0 else ""
        verdict = "VIOLATED" if constraint.violated else "ok"
        rows.append([constraint.name, value, limit, verdict, when, constraint.where])
    return rows


def measures_line(result: MotionCheckResult) -> str:
    """The main measures in a line."""
    m = result.measures
    apart = f"{1e3 * m['self_distance_m']:.1f} mm" if math.isfinite(m["self_distance_m"]) else "not known"
    return (
        f"base residual {m['base_residual_N']:.2g} N, {m['base_residual_Nm']:.2g} N m; "
        f"drift {1e3 * m['drift_m']:.2g} mm; torques up to {100.0 * m['torque_use']:.0f} %, "
        f"speeds up to {100.0 * m['velocity_use']:.0f} % of their limits; links {apart} apart; "
        f"CoM off by {1e3 * m['com_rms_m']:.1f} mm rms"
    )


def report_lines(result: MotionResult) -> list[str]:
    """How a search for a motion ended, and what the certificate found, in lines."""
    motion = result.motion
    head = f"{motion.plan.scene.name}  {motion.plan.robot.name}  {result.report}"
    length = f"motion of {motion.duration():.2f} s, {len(motion.joints)} joints"
    return [head, *(certificate_lines(length, result.certificate) if result.certificate is not None else [])]


def summary(result: MotionResult) -> dict[str, Any]:
    """A search for a motion for JSON; what is not known is None."""
    report, motion, found = result.report, result.motion, result.certificate
    head = {
        "scene": motion.plan.scene.name,
        "robot": motion.plan.robot.name,
        "status": str(report.status),
        "message": report.message,
        "time_s": report.time_s,
        "iterations": report.iterations,
    }
    measures = {} if found is None else found.measures
    return {
        **head,
        **{name: _finite(measures.get(name)) for name in MEASURES},
        "worst": _worst(result),
        "certified": found is not None and found.ok(),
        "cost": _finite(report.cost),
        "duration_s": motion.duration(),
        "joints": list(motion.joints),
        "times_s": {
            "start": report.start_s,
            "evaluation": report.evaluation_s,
            "linear_solver": report.linear_solver_s,
            "certificate": None if found is None else found.time_s,
        },
    }


def _worst(result: MotionResult) -> dict[str, Any] | None:
    """What the robot lacks for the plan, else what is nearest to its limit at 1 kHz, or farthest beyond."""
    lack, found = result.shortfall, result.certificate
    if lack is not None:
        return {"name": lack.what, "joint": lack.joint, "time": lack.time_s, "factor": _finite(lack.factor)}
    if found is None:
        return None
    worst = found.worst()
    return {"name": worst.name, "joint": worst.where, "time": worst.time_s, "factor": _finite(worst.factor)}


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
