"""Motions and their certificates in words and as plain data."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mcplan.wb import Motion, MotionCheckResult

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


def motion_summary(motion: Motion, result: MotionCheckResult) -> dict[str, Any]:
    """Measures of a motion and its worst place, for JSON; what is not known is None."""
    worst = result.worst()
    found = {name: _finite(result.measures[name]) for name in MEASURES}
    place = {"name": worst.name, "joint": worst.joint, "end_effector": worst.end_effector, "links": list(worst.links)}
    return {
        **found,
        "worst": {**place, "time": worst.time_s, "factor": _finite(worst.factor)},
        "certified": result.ok(),
        "duration_s": motion.duration(),
        "joints": list(motion.joints),
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
