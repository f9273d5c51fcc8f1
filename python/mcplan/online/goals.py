"""Goals that change while a robot walks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

#: Length of a step over the height of the CoM, and turn of a step [rad], by which steps to a new goal are counted.
STEP_RATIO, STEP_RAD = 0.2, 0.25
#: Phases more than those of the steps, and the most that are asked for.
MORE_PHASES, MOST_PHASES = 4, 60


def with_goal(scene: Scene, goal: tuple[float, float, float]) -> Scene:
    """The scene with its goal at a place x, y [m] and heading [rad], at the height and on the surfaces of its own goal.

    Raises:
        InvalidScene: The scene cannot have such a goal.
    """
    moved, stance = scene.__copy__(), scene.goal.__copy__()
    stance.position_W = [goal[0], goal[1], float(scene.goal.position_W[2])]
    stance.yaw = goal[2]
    moved.goal = stance
    moved.validate()
    return moved


def phases_to(goal: tuple[float, float, float], place_W: NDArray[np.float64], heading: float, robot: Robot) -> int:
    """How many phases to plan with to a goal [m, m, rad] from a place of the CoM and a heading [rad]: two for each step."""
    far_m = float(np.hypot(goal[0] - place_W[0], goal[1] - place_W[1]))
    steps = np.ceil(far_m / (STEP_RATIO * robot.com_height)) + np.ceil(abs(goal[2] - heading) / STEP_RAD)
    return int(min(2 * steps + MORE_PHASES, MOST_PHASES))
