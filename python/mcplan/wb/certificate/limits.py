"""Limits of joints: position, speed, torque, and how fast torques change."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .result import RATIO, MotionViolation, largest, worse
from .robot import CertifiedRobot
from .states import States
from .tolerances import MotionTolerances

#: Time to which steps of torques are stated [s].
STEP_S = 1e-3


def joint_limits(robot: CertifiedRobot, states: States, tolerances: MotionTolerances) -> list[MotionViolation]:
    """Worst position, speed, torque and change of torque of the moving joints; positions of the locked ones, too."""
    angles, rates = states.coordinates[:, 6:], states.rates[:, 6:]
    beyond = np.maximum(angles - robot.high, robot.low - angles)
    step = states.times[1] - states.times[0]
    changes = np.abs(np.diff(states.tau, axis=0)) / robot.effort * (STEP_S / step)
    columns = (
        ("position", beyond, tolerances.position, "rad", states.times),
        ("velocity", np.abs(rates) / robot.speed, tolerances.velocity_use, RATIO, states.times),
        ("torque", np.abs(states.tau) / robot.effort, tolerances.torque_use, RATIO, states.times),
        ("torque_step", changes, tolerances.torque_step, RATIO, states.times[1:]),
    )
    position, *others = (
        largest(MotionViolation(name, 0.0, limit, unit), values, times, robot.names)
        for name, values, limit, unit, times in columns
    )
    return [worse(position, _locked(robot, position)), *others]


def _locked(robot: CertifiedRobot, about: MotionViolation) -> MotionViolation:
    """The locked joint that is farthest beyond its limits, or nearest to them."""
    worst = about
    for name, angle in robot.locked.items():
        low, high = robot.bounds(name)
        beyond = replace(about, value=max(angle - high, low - angle), time_s=0.0, joint=name)
        worst = worse(worst, beyond)
    return worst


def at_rest(states: States, start: bool, end: bool, tolerances: MotionTolerances) -> MotionViolation:
    """Largest velocity of any coordinate at start and end, as far as the plan is at rest there."""
    asked = [i for i, rests in ((0, start), (-1, end)) if rests]
    about = MotionViolation("rest", 0.0, tolerances.rest, "rad/s")
    return largest(about, np.abs(states.rates[asked]), states.times[asked])
