"""A run of a planar robot laid out for rendering."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.kinematics.rotations import pose
from mcplan.view.colours import GROUND, WALL
from mcplan.view.figure import Figure, Part
from mcplan.view.pictures.run_layout import RunScene, force_arrow
from mcplan.view.runs import ground_shift_of
from mcplan.view.scene_drawing import SurfaceDrawing, raised

from .drawing import ground_solid, into_space, lanes_of, limb_solid, rotations
from .figure import shapes_of, size_of
from .ground import Slab, slabs_of
from .run_samples import sample_planar_run
from .runs import PlanarRun, planar_recording_of
from .samples import rotated

if TYPE_CHECKING:
    pass


def planar_scene_of(run: PlanarRun, rate_hz: float) -> RunScene:
    """Lay out a run at a frame rate; the plane becomes x forward and z up.

    Args:
        run: A recording, or the result of tracking.
        rate_hz: Frames in a second.
    """
    recording, shift_m = planar_recording_of(run), ground_shift_of(run)
    task = recording.plan.task
    robot = task.robot
    size, shapes = size_of(robot), shapes_of(robot)
    weight = float(robot.mass()) * float(robot.gravity)
    samples = sample_planar_run(recording, rate_hz)
    rotation, place = rotations(samples.angles), into_space(samples.positions_W)
    parts = [
        Part(
            f"{robot.bodies[shape.body].name}/{number}",
            limb_solid(shape, size),
            shape.colour,
            pose(rotation[:, shape.body], place[:, shape.body]),
        )
        for number, shape in enumerate(shapes)
    ]
    middles = [
        samples.positions_W[:, s.body] + rotated(samples.angles[:, s.body], disc[:2])
        for s in shapes
        for disc in s.discs
    ]
    reached = np.stack(middles, axis=1)
    slabs = slabs_of(task, reached.reshape(-1, 2), 0.5 * size, 0.09 * size)
    lanes = lanes_of(robot, size)
    arrows = [
        [
            arrow
            for end, lane in enumerate(lanes)
            for at, force in zip(samples.points_W[n, end], samples.forces_W[n, end], strict=True)
            for arrow in force_arrow(into_space(at, lane), into_space(force), weight, size)
        ]
        for n in range(samples.count)
    ]
    return RunScene(
        times_s=samples.times_s,
        com_W=into_space(samples.com_W),
        reach_W=into_space(reached),
        figure=Figure("planar", parts),
        arrows=arrows,
        drawings=[raised(_drawing(slab, size), shift_m) for slab in slabs if len(slab.outline_W)],
        footholds=[],
        forward=np.array([1.0, 0.0]),
        sun_W=np.array([0.5, -0.8, 1.5]),
        height_m=size,
    )


def _drawing(slab: Slab, size: float) -> SurfaceDrawing:
    """The side towards the camera carries the outline that is drawn."""
    solid = ground_solid(slab, size)
    outline = solid.vertices[: len(slab.outline_W)]
    colour = WALL if slab.is_wall else GROUND
    return SurfaceDrawing(slab.name, outline, np.array([0.0, -1.0, 0.0]), solid, colour, 1.0, np.zeros((0, 2, 3)))
