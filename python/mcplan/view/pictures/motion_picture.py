"""One still picture of a motion: scene, paths and the robot's postures at several instants. Needs no browser."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.extras import require
from mcplan.view.colours import end_effector_colours
from mcplan.view.motion_samples import motion_frames
from mcplan.view.robot_urdf import mesh_figure

from .picture import coarse_figure, paint

if TYPE_CHECKING:
    from mcplan.wb import Motion


def motion_picture(motion: Motion, path: str | Path = "motion.png", poses: int | None = None) -> Path:
    """Write a picture of a motion (.png, .pdf, .svg).

    Args:
        motion: The motion.
        path: File to write.
        poses: Number of postures drawn, at equal displacements of the CoM; None: as many as there is space for.

    Raises:
        MissingExtra: matplotlib or Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    require("mcplan.view.motion_picture", "view", "matplotlib", "pinocchio")
    samples, configurations = motion_frames(motion, 60.0)
    robot = motion.plan.robot
    figure = mesh_figure(motion.model.complete, configurations, end_effector_colours(robot))
    return paint(motion.plan.scene, robot, samples, coarse_figure(figure, robot), path, poses)
