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


#: Goals that are turned by more than this [rad], or behind and farther than the second over the height of the CoM, are
#: walked towards at a velocity, until they are nearer than both: the steps of a walk that leads elsewhere do not.
NEAR_RAD, NEAR_RATIO = 0.25, 0.2
#: Largest velocities ahead, to the left [m/s] and turning [rad/s] there, for a robot whose CoM is at HUMAN_M [m], and the
#: time in which what is left of the way would be made good [s].
FASTEST, HUMAN_M, MADE_GOOD_S = (0.12, 0.05, 0.3), 0.88, 2.0
#: Phases that are planned ahead meanwhile: those that are left when the goal is near are walked on the spot.
STEERED_PHASES = 6


def turn_to(goal: tuple[float, float, float], heading: float) -> float:
    """The angle from a heading to that of a goal [rad], the shorter way round."""
    return float(np.remainder(goal[2] - heading + np.pi, 2.0 * np.pi) - np.pi)


def _off_B(goal: tuple[float, float, float], place_W: NDArray[np.float64], heading: float) -> tuple[float, float]:
    """From a place of the CoM to the goal, ahead and to the left [m]."""
    x, y = goal[0] - float(place_W[0]), goal[1] - float(place_W[1])
    cosine, sine = float(np.cos(heading)), float(np.sin(heading))
    return cosine * x + sine * y, cosine * y - sine * x


def is_elsewhere(goal: tuple[float, float, float], place_W: NDArray[np.float64], heading: float, robot: Robot) -> bool:
    """Whether a goal [m, m, rad] is to be walked towards at a velocity first: it is turned, or lies behind."""
    ahead, left = _off_B(goal, place_W, heading)
    behind = ahead < 0.0 and np.hypot(ahead, left) > NEAR_RATIO * robot.com_height
    return bool(behind or abs(turn_to(goal, heading)) > NEAR_RAD)


def velocity_to(
    goal: tuple[float, float, float], place_W: NDArray[np.float64], heading: float, robot: Robot
) -> tuple[float, float, float] | None:
    """The velocity, ahead, to the left [m/s] and turning [rad/s], at which to walk towards a goal [m, m, rad].

    None: it is near enough in place and heading for a plan that ends there.
    """
    ahead, left = _off_B(goal, place_W, heading)
    turn = turn_to(goal, heading)
    if np.hypot(ahead, left) <= NEAR_RATIO * robot.com_height and abs(turn) <= NEAR_RAD:
        return None
    ratio = float(np.sqrt(robot.com_height / HUMAN_M))  # its times over those of one of human size
    limits = (FASTEST[0] * ratio, FASTEST[1] * ratio, FASTEST[2] / ratio)
    asked = [
        np.clip(x / (MADE_GOOD_S * ratio), -most, most) for x, most in zip((ahead, left, turn), limits, strict=True)
    ]
    return float(asked[0]), float(asked[1]), float(asked[2])


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
