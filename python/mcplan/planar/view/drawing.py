"""A whole-body plan on a page: the plane becomes x forward and z up, limbs are beside each other along y."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import pose
from mcplan.kinematics.samples import Interval
from mcplan.view.colours import COM, GROUND, OUTLINE, WALL
from mcplan.view.plan_drawing import ForceArrow, draw_arrow
from mcplan.view.shapes import Mesh, capsule, ellipsoid, prism, tube
from mcplan.view.stage import node

from .figure import Shape, limbs_of
from .ground import CONE, Slab, cone_outline
from .samples import PlanarSamples

if TYPE_CHECKING:
    from mcplan._core import PlanarContact, PlanarPlan, PlanarRobot
    from mcplan.view.stage import Stage

Array = NDArray[np.float64]

#: Ratio of half the distance between the outer limbs to the robot's size.
LANE = 0.12
#: Lateral extent of the ground beside the plane, likewise: to the right, where the camera is, just under the feet.
GROUND_RIGHT, GROUND_LEFT = -0.20, 0.42


def into_space(points: Array, lateral: float = 0.0) -> Array:
    """Points (..., 2) [m] of the plane as (..., 3), to the left of it by `lateral` [m]."""
    points = np.asarray(points, float)
    return np.stack([points[..., 0], np.full(points.shape[:-1], lateral), points[..., 1]], axis=-1)


def rotations(angles: Array) -> Array:
    """Rotations (n, 3, 3) by angles (n,) [rad], counter-clockwise in the plane as seen from the right."""
    cos, sin = np.cos(angles), np.sin(angles)
    result = np.zeros((*np.shape(angles), 3, 3))
    result[..., 0, 0] = result[..., 2, 2] = cos
    result[..., 0, 2], result[..., 2, 0] = -sin, sin
    result[..., 1, 1] = 1.0
    return result


def lanes_of(robot: PlanarRobot, size: float) -> list[float]:
    """Lateral positions of the end-effectors beside the plane [m], left is positive."""
    limbs = limbs_of(robot)
    return [LANE * size * next((m.lane for m in limbs if end.body in m.bodies), 0.0) for end in robot.end_effectors]


def draw_ground(stage: Stage, slabs: list[Slab], size: float) -> None:
    """Put surfaces onto a page as solid slabs, under "scene"."""
    for slab in slabs:
        path = f"scene/{node(slab.name)}"
        if not len(slab.outline_W):
            continue
        stage.mesh(f"{path}/solid", ground_solid(slab, size), WALL if slab.is_wall else GROUND)
        n = len(slab.outline_W)
        near, far = (into_space(slab.outline_W, side * size) for side in (GROUND_RIGHT, GROUND_LEFT))
        pairs = [(ring[i], ring[(i + 1) % n]) for ring in (near, far) for i in range(n)]
        pairs += [(near[i], far[i]) for i in range(n)]
        stage.lines(f"{path}/outline", np.array(pairs), OUTLINE, 0.9)


def ground_solid(slab: Slab, size: float) -> Mesh:
    """Solid of a slab in space."""
    return prism(into_space(slab.outline_W, GROUND_RIGHT * size), (GROUND_LEFT - GROUND_RIGHT) * size)


def draw_robot(stage: Stage, samples: PlanarSamples, robot: PlanarRobot, shapes: list[Shape], size: float) -> None:
    """Put the moving robot onto a page: a node "robot/LINK" for each link, its pieces below."""
    for i, body in enumerate(robot.bodies):
        own = [shape for shape in shapes if shape.body == i]
        for number, shape in enumerate(own):
            stage.mesh(f"robot/{node(body.name)}/{number}", limb_solid(shape, size), shape.colour)
        if own:
            stage.move(
                f"robot/{node(body.name)}",
                samples.times_s,
                pose(rotations(samples.angles[:, i]), into_space(samples.positions_W[:, i])),
            )


def draw_paths(stage: Stage, samples: PlanarSamples, robot: PlanarRobot, colours: list[str], size: float) -> None:
    """Put the CoM, its path and those of the contact frames onto a page."""
    # The CoM lies within the robot: its ball is seen through limbs, its path lies before them.
    ball = ellipsoid((0.03 * size,) * 3)
    stage.mesh("com/ball", ball, COM, glow=0.3, on_top=True)
    stage.move("com/ball", samples.times_s, pose(np.eye(3), into_space(samples.com_W)))
    stage.mesh("paths/com", tube(into_space(samples.com_W), 0.010 * size), COM, glow=0.25, on_top=True)
    for end, (colour, lane) in enumerate(zip(colours, lanes_of(robot, size), strict=True)):
        path = tube(into_space(samples.soles_W[:, end], lane), 0.005 * size, sides=6)
        stage.mesh(f"paths/{node(robot.end_effectors[end].name)}", path, colour, glow=0.25)


def draw_cones(stage: Stage, plan: PlanarPlan, intervals: list[Interval], colours: list[str], size: float) -> None:
    """Put friction cones onto a page while they bind: a wedge at every point of a contact."""
    robot, duration = plan.task.robot, float(plan.duration())
    lanes = lanes_of(robot, size)
    for number, interval in enumerate(intervals):
        end = robot.end_effectors[interval.end_effector]
        surface = plan.task.surfaces[interval.surface]
        middle = plan.at(0.5 * (interval.start_s + interval.end_s))
        lane = lanes[interval.end_effector] - 0.055 * size  # before the foot
        for force in middle.forces:
            if force.end_effector != interval.end_effector:
                continue
            wedge = cone_outline(float(surface.angle), float(surface.friction), CONE * size) + force.position_W
            path = f"cones/{node(end.name)}/{number}/{force.point}"
            stage.mesh(path, extruded(wedge, 0.004 * size, lane), colours[interval.end_effector], 0.28, glow=0.4)
            switches = np.unique([0.0, interval.start_s, min(interval.end_s, duration), duration])
            on = (switches >= interval.start_s) & ((switches < interval.end_s) | (interval.end_s >= duration - 1e-9))
            stage.move(path, switches, visible=on)


def draw_forces(stage: Stage, samples: PlanarSamples, robot: PlanarRobot, weight: float, size: float) -> None:
    """Put an arrow for the force at every contact point onto a page, where the point actually is."""
    lanes = lanes_of(robot, size)
    for end, effector in enumerate(robot.end_effectors):
        for point in range(len(effector.points)):
            at, force = samples.points_W[:, end, point].copy(), np.nan_to_num(samples.forces_W[:, end, point])
            finite = np.flatnonzero(np.isfinite(at[:, 0]))
            if not len(finite):
                continue
            # Between contacts the arrow has no length; it waits where it will be seen next.
            nearest = finite[np.argmin(np.abs(np.arange(samples.count)[:, None] - finite), axis=1)]
            lane = lanes[end] - 0.06 * size
            start = into_space(at[nearest], lane)
            arrow = ForceArrow(samples.times_s, start, into_space(force), weight, size)
            draw_arrow(stage, f"forces/{node(effector.name)}/{point}", arrow)


def contact_intervals(plan: PlanarPlan) -> list[Interval]:
    """Contacts of a plan by end-effector and time; phases in which one stays where it is are joined."""
    times = [float(t) for t in plan.knot_times()]
    intervals: list[Interval] = []
    for end in range(len(plan.task.robot.end_effectors)):
        previous = None
        for k, phase in enumerate(plan.task.phases):
            contact = next((c for c in phase.contacts if c.end_effector == end), None)
            key = contact and (contact.surface, *np.round(contact.position_W, 9), round(float(contact.angle), 9))
            if contact is not None and key == previous:
                before = intervals.pop()
                intervals.append(_interval(end, contact, before.start_s, times[k + 1]))
            elif contact is not None:
                intervals.append(_interval(end, contact, times[k], times[k + 1]))
            previous = key
    return intervals


def extruded(outline: Array, half_width: float, lateral: float = 0.0) -> Mesh:
    """Solid between two copies of a convex polygon (n, 2) [m], counter-clockwise, about a plane beside the motion's."""
    return prism(into_space(outline, lateral - half_width), 2.0 * half_width)


def limb_solid(shape: Shape, size: float) -> Mesh:
    """Solid of a piece of a link in space, in the link's frame."""
    lateral = LANE * size * shape.lane
    if len(shape.discs) == 2:
        (x0, y0, r0), (x1, y1, r1) = shape.discs
        length = float(np.hypot(x1 - x0, y1 - y0))
        z = np.array([x1 - x0, 0.0, y1 - y0]) / max(length, 1e-9) if length > 1e-9 else np.array([0.0, 0.0, 1.0])
        x = np.array([z[2], 0.0, -z[0]])
        rotation = np.column_stack([x, np.cross(z, x), z])
        return capsule(length, r0, r1).moved(pose(rotation, np.array([x0, lateral, y0])))
    return extruded(shape.outline_B(), (0.075 if shape.lane == 0.0 else 0.045) * size, lateral)


def side_direction() -> Array:
    """From the drawing towards the camera: from the right, a little ahead and above."""
    return np.array([0.10, -1.0, 0.16])


def _interval(end: int, contact: PlanarContact, start_s: float, end_s: float) -> Interval:
    position = into_space(contact.position_W)
    return Interval(end, int(contact.surface), start_s, end_s, position, rotations(np.array(contact.angle)))
