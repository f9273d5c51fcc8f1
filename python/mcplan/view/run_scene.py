"""A run laid out for rendering: robot, terrain, planned footholds, arrows, and where it is seen from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import contact_intervals
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Recording
from mcplan.tracking.planar import PlanarRecording

from .colours import FORCE_BRIGHT, PUSH, end_effector_colours
from .extent import extent_of
from .figure import Figure
from .plan_drawing import WEIGHT_ARROW
from .rendering import Arrow, Eye
from .robot_urdf import mesh_figure
from .run_samples import RunFrames, frames_of
from .runs import Run, ground_shift_of, recording_of
from .scene_drawing import SurfaceDrawing, raised, surface_drawings
from .viewpoint import sun_direction

if TYPE_CHECKING:
    from mcplan import Robot

Array = NDArray[np.float64]

#: [m] of ground around the motion.
MARGIN = 4.0


@dataclass(frozen=True)
class RunScene:
    """What pictures of a run are made from: n instants that may be drawn.

    Attributes:
        times_s: (n,).
        com_W: (n, 3) [m].
        reach_W: (n, k, 3) [m] points that a picture of an instant should hold.
        figure: The robot at those instants.
        arrows: For each instant: contact forces, and the push.
        drawings: The terrain as simulated.
        footholds: Outlines of the planned contacts: segments (m, 2, 3) [m] and their colour.
        forward: (2,) unit vector of travel.
        sun_W: (3,) from the scene towards the light.
        height_m: Of the CoM when the robot stands: what distances are scaled by.
    """

    times_s: Array
    com_W: Array
    reach_W: Array
    figure: Figure
    arrows: list[list[Arrow]]
    drawings: list[SurfaceDrawing]
    footholds: list[tuple[Array, str]]
    forward: Array
    sun_W: Array
    height_m: float

    def nearest(self, time_s: float) -> int:
        """Index of the instant nearest to a time."""
        return int(np.argmin(np.abs(self.times_s - time_s)))

    def eye(self, target_W: Array, distance_m: float, ahead: float = 0.45) -> Eye:
        """From the right of the path; `ahead` 0: square to it, 1: by 45 degrees from ahead."""
        left = np.array([-self.forward[1], self.forward[0]])
        towards = left - ahead * self.forward
        azimuth = float(np.degrees(np.arctan2(towards[1], towards[0])))
        return Eye(np.asarray(target_W, float), distance_m, azimuth, -12.0)


def scene_of(run: Run, rate_hz: float) -> RunScene:
    """Lay out a run at a frame rate.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    recording, shift = recording_of(run), ground_shift_of(run)
    if isinstance(recording, PlanarRecording):
        from .planar_run_scene import planar_scene_of

        return planar_scene_of(recording, rate_hz, shift)
    scene, robot = recording.plan.scene, recording.body
    colours = end_effector_colours(robot)
    loaded = load_model(robot)
    frames = frames_of(recording, loaded, rate_hz)
    samples = frames.samples
    extent = extent_of(scene, robot, samples, length=MARGIN, width=MARGIN)
    height = float(robot.com_height)
    head = samples.com_W + np.array([0.0, 0.0, height])
    weight = float(robot.mass) * float(scene.gravity)
    return RunScene(
        times_s=samples.times_s,
        com_W=samples.com_W,
        reach_W=np.concatenate([head[:, None], samples.positions_W], axis=1),
        figure=mesh_figure(loaded, frames.configurations, colours),
        arrows=[_arrows(frames, n, weight, height) for n in range(samples.count)],
        drawings=[raised(drawing, shift) for drawing in surface_drawings(scene, extent)],
        footholds=_footholds(recording, robot, colours, shift),
        forward=extent.forward,
        sun_W=sun_direction(extent),
        height_m=height,
    )


def force_arrow(start_W: Array, force_W: Array, weight_N: float, height_m: float) -> list[Arrow]:
    """The arrow of a contact force; none for one of less than a hundredth of the weight."""
    if not np.linalg.norm(force_W) > 0.01 * weight_N:  # NaN: no contact
        return []
    tip = start_W + WEIGHT_ARROW * height_m * force_W / weight_N
    return [Arrow(start_W, tip, FORCE_BRIGHT, 0.012 * height_m)]


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


def _footholds(recording: Recording, robot: Robot, colours: list[str], shift: float) -> list[tuple[Array, str]]:
    outlines = []
    signs = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    for interval in contact_intervals(recording.plan, recording.plan.scene, robot):
        half = np.asarray(robot.end_effectors[interval.end_effector].half_size, float)
        half = half if half.all() else np.full(2, 0.04 * float(robot.com_height))
        corners = np.column_stack([signs * half, np.full(4, 0.004)])
        outline = interval.position_W + corners @ interval.rotation_W.T + np.array([0.0, 0.0, shift])
        outlines.append((np.stack([outline, np.roll(outline, -1, axis=0)], axis=1), colours[interval.end_effector]))
    return outlines
