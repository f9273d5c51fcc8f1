"""A run laid out for rendering: robot, terrain, planned footholds, arrows, and where it is seen from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import Interval, contact_intervals
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Recording
from mcplan.view.colours import PUSH, end_effector_colours
from mcplan.view.extent import extent_of
from mcplan.view.robot_urdf import mesh_figure
from mcplan.view.run_samples import RunFrames, frames_of
from mcplan.view.runs import Run, ground_shift_of, recording_of, was_replanned
from mcplan.view.scene_drawing import raised, surface_drawings
from mcplan.view.viewpoint import sun_direction

from .rendering import Arrow
from .run_layout import RunScene, force_arrow

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]

#: [m] of ground around the motion.
MARGIN = 4.0


def scene_of(run: Run, rate_hz: float) -> RunScene:
    """Lay out a run at a frame rate.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    recording, shift = recording_of(run), ground_shift_of(run)
    scene, robot = recording.scene, recording.simulated_robot
    colours = end_effector_colours(robot)
    urdf_model = load_model(robot)
    frames = frames_of(recording, urdf_model, rate_hz)
    samples = frames.samples
    extent = extent_of(scene, robot, samples, length=MARGIN, width=MARGIN)
    height = float(robot.com_height)
    head = samples.com_W + np.array([0.0, 0.0, height])
    weight = float(robot.mass) * float(scene.gravity)
    return RunScene(
        times_s=samples.times_s,
        com_W=samples.com_W,
        reach_W=np.concatenate([head[:, None], samples.positions_W], axis=1),
        figure=mesh_figure(urdf_model, frames.configurations, colours),
        arrows=[_arrows(frames, n, weight, height) for n in range(samples.count)],
        drawings=[raised(drawing, shift) for drawing in surface_drawings(scene, extent)],
        footholds=_made(samples.intervals, robot, colours)
        if was_replanned(run)
        else _planned(recording, colours, shift),
        forward=extent.forward,
        sun_W=sun_direction(extent),
        height_m=height,
    )


def _arrows(frames: RunFrames, n: int, weight_N: float, height_m: float) -> list[Arrow]:
    samples = frames.samples
    found: list[Arrow] = []
    for start, force in zip(samples.pressure_W[n], samples.forces_W[n], strict=True):
        found += force_arrow(start, force, weight_N, height_m)
    push = frames.pushes_W[n]
    if push.any():
        # Pushes are far smaller than the weight: their arrows have one length.
        away = 0.5 * height_m * push / np.linalg.norm(push)
        base = frames.base_W[n]
        found.append(Arrow(base - 1.25 * away, base - 0.25 * away, PUSH, 0.02 * height_m))
    return found


def _planned(recording: Recording, colours: list[str], shift: float) -> list[tuple[Array, str]]:
    """Outlines of the footholds of the plan, on the ground that is simulated so much higher."""
    robot = recording.simulated_robot
    intervals = contact_intervals(recording.plan, recording.plan.scene, robot)
    return [(outline + [0.0, 0.0, shift], colour) for outline, colour in _made(intervals, robot, colours)]


def _made(intervals: list[Interval], robot: Robot, colours: list[str]) -> list[tuple[Array, str]]:
    """Outlines (4, 2, 3) of soles in contact."""
    outlines = []
    signs = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    for interval in intervals:
        half = np.asarray(robot.end_effectors[interval.end_effector].half_size, float)
        half = half if half.all() else np.full(2, 0.04 * float(robot.com_height))
        corners = np.column_stack([signs * half, np.full(4, 0.004)])
        outline = interval.position_W + corners @ interval.rotation_W.T
        outlines.append((np.stack([outline, np.roll(outline, -1, axis=0)], axis=1), colours[interval.end_effector]))
    return outlines
