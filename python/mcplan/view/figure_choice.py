"""Which robot is drawn: meshes, or sticks."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from mcplan.errors import SimplerDrawing
from mcplan.kinematics.samples import Samples

from .figure import Figure
from .robot_stick import stick_robot

if TYPE_CHECKING:
    from mcplan._core import Robot


def figure_of(samples: Samples, robot: Robot, colours: list[str]) -> Figure:
    """The robot over the samples: its URDF's meshes if it has one and they can follow, else a stick robot."""
    if not robot.urdf:
        return stick_robot(samples, robot, colours)
    from .robot_urdf import CannotFollow, urdf_robot

    try:
        return urdf_robot(samples, robot, colours)
    except CannotFollow as error:
        warnings.warn(f"{error}; drawing a stick robot instead", SimplerDrawing, stacklevel=3)
        return stick_robot(samples, robot, colours)
