"""A run laid out for rendering: robot, terrain, planned footholds, arrows, and where it is seen from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import contact_intervals
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Recording, TrackingResult

from .colours import FORCE_BRIGHT, PUSH, end_effector_colours
from .extent import Extent, extent_of
from .figure import Figure
from .plan_drawing import WEIGHT_ARROW
from .rendering import Arrow, Eye
from .robot_urdf import mesh_figure
from .run_samples import RunFrames, frames_of
from .scene_drawing import SurfaceDrawing, raised, surface_drawings
from .viewpoint import sun_direction

if TYPE_CHECKING:
    from mcplan import Robot

Array = NDArray[np.float64]

#: [m] of ground around the motion.
MARGIN = 4.0


@dataclass(frozen=True)
class RunScene:
    """What pictures of a run are made from.

    Attributes:
        robot: The robot.
        frames: Instants that may be drawn.
        figure: The robot's meshes at those instants.
        drawings: The terrain as simulated.
        footholds: Outlines of the planned contacts: segments (n, 2, 3) [m] and their colour.
        extent: Direction of travel.
        weight_N: Of the robot.
    """

    robot: Robot
    frames: RunFrames
    figure: Figure
    drawings: list[SurfaceDrawing]
    footholds: list[tuple[Array, str]]
    extent: Extent
    weight_N: float

    @property
    def sun_W(self) -> Array:
        """(3,) from the scene towards the light."""
        return sun_direction(self.extent)

    def arrows(self, n: int) -> list[Arrow]:
        """Contact forces, and the push, at an instant."""
        samples, height = self.frames.samples, float(self.robot.com_height)
        found = []
        for start, force in zip(samples.pressure_W[n], samples.forces_W[n], strict=True):
            if np.linalg.norm(force) > 0.01 * self.weight_N:
                tip = start + WEIGHT_ARROW * height * force / self.weight_N
                found.append(Arrow(start, tip, FORCE_BRIGHT, 0.012 * height))
        push = self.frames.pushes_W[n]
        if push.any():
            # Pushes are far smaller than the weight: their arrows have one length.
            away = 0.5 * height * push / np.linalg.norm(push)
            base = self.frames.base_W[n]
            found.append(Arrow(base - 1.25 * away, base - 0.25 * away, PUSH, 0.02 * height))
        return found

    def eye(self, target_W: Array, distance_m: float, ahead: float = 0.45) -> Eye:
        """From the right of the path; `ahead` 0: square to it, 1: by 45 degrees from ahead."""
        towards = self.extent.left - ahead * self.extent.forward
        azimuth = float(np.degrees(np.arctan2(towards[1], towards[0])))
        return Eye(np.asarray(target_W, float), distance_m, azimuth, -12.0)


def scene_of(run: Recording | TrackingResult, rate_hz: float) -> RunScene:
    """Lay out a run at a frame rate.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidRobot: The robot's URDF cannot be read.
    """
    recording = run.recording if isinstance(run, TrackingResult) else run
    shift = run.options.ground_shift_m if isinstance(run, TrackingResult) else 0.0
    plan = recording.plan
    scene, robot = plan.scene, recording.body
    colours = end_effector_colours(robot)
    loaded = load_model(robot)
    frames = frames_of(recording, loaded, rate_hz)
    extent = extent_of(scene, robot, frames.samples, length=MARGIN, width=MARGIN)
    footholds = []
    for interval in contact_intervals(plan, scene, robot):
        half = np.asarray(robot.end_effectors[interval.end_effector].half_size, float)
        half = half if half.all() else np.full(2, 0.04 * float(robot.com_height))
        signs = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
        corners = np.column_stack([signs * half, np.full(4, 0.004)])
        outline = interval.position_W + corners @ interval.rotation_W.T + np.array([0.0, 0.0, shift])
        footholds.append((np.stack([outline, np.roll(outline, -1, axis=0)], axis=1), colours[interval.end_effector]))
    return RunScene(
        robot=robot,
        frames=frames,
        figure=mesh_figure(loaded, frames.configurations, colours),
        drawings=[raised(drawing, shift) for drawing in surface_drawings(scene, extent)],
        footholds=footholds,
        extent=extent,
        weight_N=float(robot.mass) * float(scene.gravity),
    )
