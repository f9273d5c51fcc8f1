"""A run of a planar robot in words: what happened, and how near contact forces and motion are to the planned ones."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mcplan.tracking.options import Options
from mcplan.tracking.report import as_text, disturbances_text, length, nearest_to_torque_limit

from .measures import PlanarMeasures, nearest_to_velocity_limit
from .recording import PlanarRecording
from .suitability import suitability


class Reported(Protocol):
    """What a report reads of a PlanarResult, which lies above: it prints itself by this."""

    @property
    def recording(self) -> PlanarRecording: ...
    @property
    def measures(self) -> PlanarMeasures: ...
    @property
    def options(self) -> Options: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def followed(self) -> bool: ...


def report(result: Reported) -> str:
    """The headline, and below it a line for each measure."""
    return as_text(headline(result), rows_of(result))


def headline(result: Reported) -> str:
    """Task, robot, and how the run ended."""
    task, lasts = result.recording.plan.task, result.recording.plan.duration()
    return f"{task.name}  {task.robot.name}  {ending(result)} (plan of {lasts:.2f} s, unassisted)"


def ending(result: Reported) -> str:
    """How the run ended."""
    measures = result.measures
    if not measures.completed:
        return f"left its plan after {measures.completed_s:.2f} s"
    if result.interrupted:
        return f"interrupted after {measures.completed_s:.2f} s, until then on its plan"
    if not result.followed:
        return f"moved as planned to the end, {measures.completed_s:.2f} s, by other contact forces"
    return f"followed to the end: {measures.completed_s:.2f} s"


def rows_of(result: Reported) -> list[tuple[str, str]]:
    """What was measured, and its value."""
    m = result.measures
    joint, time_s = nearest_to_torque_limit(result.recording)
    fastest, fast_s = nearest_to_velocity_limit(result.recording)
    each = ", ".join(f"{name} {100.0 * ratio:.1f} %" for name, ratio in m.force_rms_end_effectors.items())
    rows = [
        ("contact forces off the plan", f"{100.0 * m.force_rms:.1f} % rms ({each})"),
        ("their sum off the plan", f"{100.0 * m.force_rms_robot:.1f} % rms"),
        ("drift of contacts", f"{length(m.drift_m)} at most, {length(m.slip_m)} of it along the surface"),
        ("base off the plan", f"{length(m.base_rms_m)} rms"),
        ("joints off the plan", f"{np.degrees(m.joint_rms_rad):.2g} deg rms"),
        ("torque by feedback", f"{100.0 * m.torque_feedback_ratio:.1f} % of the plan's, rms"),
        ("largest torque", f"{100.0 * m.torque_use:.0f} % of the limit of {joint}, at {time_s:.2f} s"),
        ("fastest joint", f"{100.0 * m.velocity_use:.0f} % of the speed limit of {fastest}, at {fast_s:.2f} s"),
    ]
    disturbed = disturbances_text(result.options)
    if disturbed:
        rows.append(("not known to the plan", disturbed))
    planned = suitability(result.recording.plan)
    if not planned.ok():
        rows.append(("to be followed", planned.verdict))
    warned = f"{m.simulator_warnings or 'no'} warning{'' if m.simulator_warnings == 1 else 's'}"
    return [*rows, ("simulator", f"{warned}, {m.realtime_factor:.2f} times real time")]
