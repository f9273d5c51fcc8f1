"""When a run is over: its length, and falls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .steering import STEERED_S

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot
    from mcplan.tracking.options import Options
    from mcplan.tracking.robot_dynamics import RobotDynamics

    from .options import OnlineOptions

#: Fallen: ratio of the CoM's height over the lowest foot to the nominal one, or tilt of the base [rad].
FALLEN_RATIO, FALLEN_RAD = 0.6, 1.0
#: Duration of a run under a command, from when the last one begins [s].
COMMAND_S = 10.0
#: A run to a goal ends at the latest after this ratio of the first plan's duration, and this time more [s].
LONGEST_RATIO, LONGEST_S = 2.0, 5.0


def length_of(plan: Plan, options: Options, online: OnlineOptions, is_steered: bool = False) -> float:
    """The longest that the run may take [s]."""
    if not np.isnan(online.duration_s):
        return online.duration_s
    if is_steered:
        return STEERED_S
    planned_s = float(plan.duration()) + options.hold_s
    if online.goal and online.replanning:
        begins_s = max(row[0] for row in (*online.goal, *online.command))
        return begins_s + LONGEST_RATIO * planned_s + LONGEST_S
    if online.command:
        return online.command[-1][0] + COMMAND_S
    return LONGEST_RATIO * planned_s + LONGEST_S if online.replanning else planned_s


def fallen(dynamics: RobotDynamics, robot: Robot) -> bool:
    """Whether the robot lies, or is about to."""
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    lowest = min(dynamics.end_effector_position_W(i)[2] for i in feet or range(len(robot.end_effectors)))
    low = dynamics.com_W[2] - lowest < FALLEN_RATIO * robot.com_height
    return bool(low or dynamics.base_WB[2, 2] < np.cos(FALLEN_RAD))
