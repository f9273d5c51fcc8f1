"""Start and goal of a scene on its page: footprints with the robot's stance, or flags without a robot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import about_z, pose
from mcplan.kinematics.samples import stance_samples
from mcplan.view.colours import GOAL, START, end_effector_colours
from mcplan.view.extent import scale_of
from mcplan.view.figure_choice import figure_of
from mcplan.view.plan_drawing import contact_plate, draw_standing
from mcplan.view.shapes import disc

from .annotations import Label, arrow, merged

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene, Stance
    from mcplan.view.stage import Stage

Array = NDArray[np.float64]


def draw_stances(stage: Stage, scene: Scene, robot: Robot | None, size_m: float) -> tuple[Array, list[Label]]:
    """Put start and goal onto a page, under "stances" and "marks"; points (n, 3) [m] to be seen, and their labels.

    Args:
        stage: The page's.
        scene: Whose start and goal.
        robot: Robot drawn in the stance; None: a disc with an arrow in its heading.
        size_m: Size of the scene.

    Raises:
        InvalidScene: The robot cannot take the scene's start or goal.
    """
    points, labels = [], []
    for name, stance, colour, opacity in (("start", scene.start, START, 1.0), ("goal", scene.goal, GOAL, 0.35)):
        if robot is None:
            radius = 0.15 if 2.0 <= size_m <= 15.0 else 0.03 * size_m
            seen = _flag(stage, name, stance, colour, radius)
        else:
            seen = _standing(stage, scene, robot, _Mark(name, stance, colour, opacity))
        points.append(seen)
        low, high = seen.min(axis=0), seen.max(axis=0)
        middle, lift = 0.5 * (low + high), 0.05 * float(np.linalg.norm(high - low))
        # Above it; else beside it on the ground.
        places = [[middle[0], middle[1], high[2] + lift]]
        places += [[x, y, low[2]] for x in (low[0], high[0], middle[0]) for y in (low[1] - lift, high[1] + lift)]
        labels.append(Label(name, np.array(places), name, colour))
    return np.vstack(points), labels


def _flag(stage: Stage, name: str, stance: Stance, colour: str, radius: float) -> Array:
    at = pose(about_z(np.array(float(stance.yaw))), np.asarray(stance.position_W, float))
    thick = 0.04 * radius
    heading = arrow(np.array([0.0, 0.0, 3.0 * thick]), np.array([2.2 * radius, 0.0, 3.0 * thick]), 0.1 * radius)
    stage.mesh(f"marks/{name}", merged([disc(radius, thick), heading]), colour, glow=0.4)
    stage.place(f"marks/{name}", at)
    return at[:3, 3] + radius * np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.4]])


@dataclass(frozen=True)
class _Mark:
    name: str
    stance: Stance
    colour: str
    opacity: float


def _standing(stage: Stage, scene: Scene, robot: Robot, mark: _Mark) -> Array:
    from mcplan._core import resolve_stance

    standing = stance_samples(scene, robot, resolve_stance(scene, robot, mark.stance, mark.name))
    draw_standing(stage, mark.name, standing, figure_of(standing, robot, end_effector_colours(robot)), mark.opacity)
    for end in np.flatnonzero(standing.surfaces[0] >= 0):
        path = f"marks/{mark.name}/{end}"
        stage.mesh(path, contact_plate(robot, int(end), margin=0.03), mark.colour, 0.9, glow=0.5)
        stage.place(path, pose(standing.rotations_W[0, end], standing.positions_W[0, end]))
    head = standing.com_W[0] + np.array([0.0, 0.0, 0.95 * float(robot.com_height)])
    margin = 0.1 * scale_of(robot) * np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    return np.vstack([head, standing.positions_W[0], standing.com_W + margin])
