"""A plan and a robot as the solver of motions takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import wb as _core
from mcplan.kinematics.inverse_kinematics import has_sole
from mcplan.kinematics.rotations import polygon_normal

from .dynamics import SplineModel, add_links

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .nodes import Nodes

Array = NDArray[np.float64]

#: Forces act at the corners of this part of a sole.
SOLE_RATIO = 0.9
#: Of the friction that the scene has.
FRICTION_RATIO = 0.98
#: How far points of an end-effector in the air may be below the plan's, above, and beside them [m].
DOWN_M, UP_M, ASIDE_M = 0.004, 0.1, 0.02


def corner_points_S(plan: Plan) -> list[Array]:
    """Of each end-effector where forces act on it, in the frame of its sole [m]: four corners, or one point."""
    found = []
    for end in plan.robot.end_effectors:
        if has_sole(end):
            x, y = SOLE_RATIO * np.asarray(end.half_size, float)
            found.append(np.array([[x, y, 0.0], [x, -y, 0.0], [-x, -y, 0.0], [-x, y, 0.0]]))
        else:
            found.append(np.zeros((1, 3)))
    return found


def build_problem(plan: Plan, spline: SplineModel, nodes: Nodes, posture: Array) -> _core.Problem:
    """The problem of a motion along a plan: rows, limits and costs at all nodes."""
    problem = _core.Problem()
    add_links(problem, spline)
    points = corner_points_S(plan)
    for end, joint, placement, own in zip(
        plan.robot.end_effectors, spline.joints, spline.placements, points, strict=True
    ):
        problem.add_end_effector(end.name, joint - 1, placement.rotation, placement.translation, own)
    problem.posture = posture
    mass = sum(inertia.mass for inertia in spline.model.inertias)
    problem.weight_N = mass * plan.scene.gravity
    wrenches = planned_wrenches_S(nodes) * (mass / plan.robot.mass)
    samples = nodes.samples
    touches = (nodes.contacts >= 0).any(axis=0)
    for k in range(nodes.count):
        problem.add_node(float(samples.times_s[k]), samples.com_W[k], nodes.base_zyx[k])
        for end, interval in enumerate(nodes.intervals[k]):
            if interval is not None:
                friction = FRICTION_RATIO * plan.scene.surfaces[interval.surface].friction
                rests = bool(nodes.first[k, end] or nodes.last[k, end])
                pose = (interval.position_W, interval.rotation_W)
                problem.add_contact(end, nodes.carries(k, end), rests, friction, *pose, wrenches[k, end])
            elif touches[end]:
                foot = plan.robot.end_effectors[end].kind == "foot"
                low, high = tube_W(plan, nodes, k, end)
                in_tube = foot and not nodes.flies(k)
                problem.add_swing(end, samples.positions_W[k, end], samples.rotations_W[k, end], in_tube, low, high)
    return problem


def planned_wrenches_S(nodes: Nodes) -> Array:
    """(n + 1, e, 6) the plan's force and moment about each end-effector in contact, in the frame of its sole."""
    samples = nodes.samples
    arms = samples.pressure_W - samples.positions_W
    moments = samples.moments_W + np.cross(arms, samples.forces_W)
    turned = [np.einsum("neji,nej->nei", samples.rotations_W, part) for part in (samples.forces_W, moments)]
    return np.concatenate(turned, axis=2)


def tube_W(plan: Plan, nodes: Nodes, k: int, end: int) -> tuple[Array, Array]:
    """How far the points of an end-effector in the air may be from where the plan has them, at least and at most [m].

    Near the ground that it leaves or comes to, less far down: half of its height above that.
    """
    position = nodes.samples.positions_W[k, end]
    before = [nodes.intervals[i][end] for i in range(k) if nodes.intervals[i][end] is not None][-1:]
    after = next((nodes.intervals[i][end] for i in range(k, nodes.count) if nodes.intervals[i][end] is not None), None)
    heights = []
    for interval in (*before, after):
        if interval is not None:
            normal = polygon_normal(np.asarray(plan.scene.surfaces[interval.surface].vertices_W))
            heights.append(abs(float(normal @ (position - interval.position_W))))
    down = min(DOWN_M, 0.5 * min(heights, default=2.0 * DOWN_M))
    return np.array([-ASIDE_M, -ASIDE_M, -down]), np.array([ASIDE_M, ASIDE_M, UP_M])
