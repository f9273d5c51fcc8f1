"""Goals that change while a robot walks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Polygon, require_ground
from mcplan.errors import InvalidOptions, InvalidScene, apart, shown

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

    from .options import OnlineOptions

Goal = tuple[float, float, float]

#: Length of a step over the height of the CoM, and turn of a step [rad], by which steps to a new goal are counted.
STEP_RATIO, STEP_RAD = 0.2, 0.25
#: Phases more than those of the steps, and the most that are asked for.
MORE_PHASES, MOST_PHASES = 4, 60


#: Goals that are turned by more than this [rad], or behind and farther than the near ones, are walked towards at a
#: velocity. Measured on TALOS and the G1, 8 goals turned by 0.5 to 0.7: at a velocity they take 2 to 5 s longer than by
#: steps that are looked for at once, but for one.
TURNED_RAD = 0.8
#: Until they are nearer than this [rad], and this over the height of the CoM.
NEAR_RAD, NEAR_RATIO = 0.25, 0.2
#: Largest velocities ahead, to the left [m/s] and turning [rad/s] there, for a robot whose CoM is at HUMAN_M [m], and the
#: time in which what is left of the way would be made good [s].
FASTEST, HUMAN_M, MADE_GOOD_S = (0.12, 0.05, 0.3), 0.88, 2.0
#: Phases that are planned ahead meanwhile: those that are left when the goal is near are walked on the spot.
STEERED_PHASES = 6
#: For so long after a stand has begun steps to the goal are looked for, before it is walked towards at a velocity [s].
LOOKED_FOR_S = 2.0
#: Where that brings it no nearer, by so much over the height of the CoM, nor turns it by so much [rad] towards the goal,
#: for so long, steps are looked for again [s].
NEARER_RATIO, NEARER_RAD, NO_NEARER_S = 0.05, 0.1, 4.0
#: What is asked of goals: they are at the height of the scene's goal, on its surfaces.
OVER_GROUND = "must lie over a surface of the scene's goal, at its height, or so near that a foot reaches it"


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
    return bool(behind or abs(turn_to(goal, heading)) > TURNED_RAD)


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


def require_goals(scene: Scene, robot: Robot, online: OnlineOptions) -> None:
    """Raise InvalidOptions naming the first goal that lies over no ground that the scene's goal is on.

    Scene files refuse such goals as far as they can without a robot: here its feet reach that ground from the goal.

    Args:
        scene: Where to walk.
        robot: Who walks.
        online: What is asked for.
    """
    for i, (_, x, y, yaw) in enumerate(online.goal):
        moved = with_goal(scene, (x, y, yaw))
        try:
            require_ground(moved)
        except InvalidScene as error:
            for found in apart(error):
                if found.field.startswith("goal"):
                    raise InvalidOptions(f"goal[{i}]", OVER_GROUND, found.value) from None
        beside_m, name = _beside(moved)
        if beside_m > _reach_m(robot):
            raise InvalidOptions(
                f"goal[{i}]", OVER_GROUND, f"[{x:.4g}, {y:.4g}], {beside_m:.3g} m beside {shown(name)}"
            )


def _beside(scene: Scene) -> tuple[float, str]:
    """From the goal to the nearest surface that it is on, on the level [m], and the name of that."""
    place_W = np.asarray(scene.goal.position_W)
    names = set(dict(scene.goal.contacts).values())
    away_m = {
        surface.name: float(np.hypot(*(Polygon(surface.vertices_W).nearest(place_W) - place_W)[:2]))
        for surface in scene.surfaces
        if surface.name in names
    }
    name = min(away_m, key=lambda known: away_m[known])
    return away_m[name], name


def _reach_m(robot: Robot) -> float:
    """How far a foot reaches from the CoM, on the level [m]."""
    feet = [end for end in robot.end_effectors if end.kind == "foot"] or robot.end_effectors
    return max(float(np.hypot(*np.maximum(np.abs(end.reach_min_B), np.abs(end.reach_max_B))[:2])) for end in feet)


def phases_to(goal: tuple[float, float, float], place_W: NDArray[np.float64], heading: float, robot: Robot) -> int:
    """How many phases to plan with to a goal [m, m, rad] from a place of the CoM and a heading [rad]: two for each step."""
    far_m = float(np.hypot(goal[0] - place_W[0], goal[1] - place_W[1]))
    steps = np.ceil(far_m / (STEP_RATIO * robot.com_height)) + np.ceil(abs(goal[2] - heading) / STEP_RAD)
    return int(min(2 * steps + MORE_PHASES, MOST_PHASES))


class Aim:
    """Where a robot walks to: the scene's goal, or one that is asked for instead.

    Args:
        scene: The scene of the plan that is under way at first, which leads to its goal.
        robot: Who walks.

    Attributes:
        goal: The goal that holds instead of the scene's [m, m, rad], its heading counted as the robot's is once it is near.
        open: No plan leads there yet, or none does any more.
        steering: It is walked towards at a velocity first.
    """

    def __init__(self, scene: Scene, robot: Robot) -> None:
        x, y, _ = scene.goal.position_W
        self._of_scene: Goal = (float(x), float(y), float(scene.goal.yaw))
        self._robot = robot
        self._asked: Goal | None = None
        self._stands_s = np.inf  # since when no plan leads to the goal
        # To the goal, while it is walked towards at a velocity.
        self._nearest_m, self._nearest_rad, self._nearest_s = np.inf, np.inf, np.inf
        self._blocked_s = -np.inf  # since when that is known to bring it no nearer
        self.goal: Goal | None = None
        self.open = self.steering = False

    def ask(self, goal: Goal | None, place_W: NDArray[np.float64], heading: float) -> bool:
        """Aim at a goal [m, m, rad] from a place of the CoM and a heading [rad]; whether it is another than before."""
        if goal is None or goal == self._asked:
            return False
        self._asked, self.goal, self.open, self._blocked_s = goal, goal, True, -np.inf
        self._begin_to_steer()
        self.steering = is_elsewhere(goal, place_W, heading, self._robot)
        return True

    def stopped(self, now_s: float, place_W: NDArray[np.float64], heading: float) -> None:
        """The plan under way is a stand: what led to the goal is lost, and steps there have to be found anew.

        Where none have been found for long, or steps do not lead there, it is walked towards at a velocity.
        """
        self.goal, self.open = self.goal or self._of_scene, True
        self._stands_s = min(self._stands_s, now_s)
        in_vain = now_s - self._stands_s > LOOKED_FOR_S
        if not self.steering:
            self._begin_to_steer()
        blocked = now_s - self._blocked_s <= LOOKED_FOR_S
        self.steering = in_vain or (is_elsewhere(self.goal, place_W, heading, self._robot) and not blocked)

    def led_to(self) -> None:
        """The plan under way leads to the goal."""
        self.open, self._stands_s = False, np.inf

    def velocity(self, now_s: float, place_W: NDArray[np.float64], heading: float) -> tuple[float, float, float] | None:
        """The velocity, ahead, to the left [m/s] and turning [rad/s], to walk at now; None: to the goal itself.

        From a goal that is near on `steering` is off, and the heading of the goal counted as the robot's is. It is off, too,
        where the robot has come no nearer for long: another place or another foot in front may have steps that lead there.
        """
        if not self.steering or self.goal is None:
            return None
        if self._comes_nearer(place_W, heading):
            self._nearest_s = now_s
        if now_s - self._nearest_s > NO_NEARER_S:
            self.steering, self._stands_s, self._blocked_s = False, now_s, now_s
            return None
        velocity = velocity_to(self.goal, place_W, heading, self._robot)
        if velocity is None:
            self.steering = False
            self.goal = (*self.goal[:2], heading + turn_to(self.goal, heading))
        return velocity

    def _begin_to_steer(self) -> None:
        self._nearest_m, self._nearest_rad = np.inf, np.inf

    def _comes_nearer(self, place_W: NDArray[np.float64], heading: float) -> bool:
        """Whether it is nearer to the goal than ever since it has been walked towards, or turned less from it."""
        off_m, turned_rad = self.off_m(place_W), abs(self.turned_rad(heading))
        nearer = off_m < self._nearest_m - NEARER_RATIO * self._robot.com_height
        less_turned = turned_rad < self._nearest_rad - NEARER_RAD
        if nearer:
            self._nearest_m = off_m
        if less_turned:
            self._nearest_rad = turned_rad
        return nearer or less_turned

    def phases(self, place_W: NDArray[np.float64], heading: float) -> dict[str, Any]:
        """Options of a replan by name: how many phases lead there, where no plan does yet."""
        if self.steering:
            return {"horizon": STEERED_PHASES}
        if self.open and self.goal is not None:
            return {"phases_min": phases_to(self.goal, place_W, heading, self._robot)}
        return {}

    def on(self, scene: Scene) -> Scene:
        """A scene with the goal that holds."""
        return scene if self.goal is None else with_goal(scene, self.goal)

    def off_m(self, place_W: NDArray[np.float64]) -> float:
        """From a place of the CoM to the goal, on the level [m]."""
        goal = self.goal or self._of_scene
        return float(np.hypot(goal[0] - place_W[0], goal[1] - place_W[1]))

    def turned_rad(self, heading: float) -> float:
        """From a heading to that of the goal, the shorter way round [rad]."""
        return turn_to(self.goal or self._of_scene, heading)
