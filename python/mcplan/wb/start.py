"""Where the search for a motion begins: postures along the plan by inverse kinematics, or the robot standing still."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample_at

from . import splines
from .contact_points import corners_S
from .knots import with_knots

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .motion_model import MotionModel
    from .nodes import Nodes

Array = NDArray[np.float64]

#: Steps between postures by inverse kinematics [s].
POSTURE_S = 0.1


def follow_plan(
    plan: Plan, motion_model: MotionModel, nodes: Nodes, in_time: Callable[[], None] = lambda: None
) -> Array:
    """(n + 3, nv) coefficients of splines through postures that follow the plan, not at all nodes."""
    coarse = coarse_times(nodes)
    found = follow(motion_model.complete, sample_at(plan, plan.scene, plan.robot, coarse), in_time=in_time)
    values = coordinates(motion_model, found.configurations)
    return with_knots(coarse, splines.interpolating(coarse, values), nodes.times_s)


def stand_still(
    plan: Plan, motion_model: MotionModel, nodes: Nodes, in_time: Callable[[], None] = lambda: None
) -> Array:
    """(n + 3, nv) coefficients of splines through the robot's posture, at the plan's first CoM throughout."""
    import pinocchio as pin  # type: ignore[import-untyped]

    in_time()
    complete = motion_model.complete
    q = complete.neutral.copy()
    q[:3] += nodes.samples.com_W[0] - pin.centerOfMass(complete.model, complete.model.createData(), q)
    return np.repeat(coordinates(motion_model, q[None]), nodes.count + 2, axis=0)


def posture(motion_model: MotionModel) -> Array:
    """(nv - 6,) the robot's posture, angles of the joints that move [rad]."""
    return coordinates(motion_model, motion_model.complete.neutral[None])[0, 6:]


def coarse_times(nodes: Nodes) -> Array:
    """Some of the nodes: where contacts change, and between those in equal numbers of steps of about POSTURE_S."""
    change = np.asarray((nodes.first | nodes.last).any(axis=1))
    change[[0, -1]] = True
    kept = [0]
    for k in np.flatnonzero(change)[1:]:
        parts = max(1, round((nodes.times_s[k] - nodes.times_s[kept[-1]]) / POSTURE_S))
        kept += np.unique(np.linspace(kept[-1], k, parts + 1).round().astype(int))[1:].tolist()
    while len(kept) <= splines.MIN_INTERVALS:
        kept = list(range(nodes.count))
    return nodes.times_s[kept]


def coordinates(motion_model: MotionModel, configurations: Array) -> Array:
    """(k, nv) base and moving joints of configurations (k, nq) of all joints, as the splines have them."""
    model, whole = motion_model.model, motion_model.complete.model
    values = np.zeros((len(configurations), model.nv))
    values[:, :3] = configurations[:, :3]
    values[:, 3:6] = _zyx(configurations[:, 3:7])
    for joint in range(2, model.njoints):
        at = whole.idx_qs[whole.getJointId(model.names[joint])]
        if model.nqs[joint] == 2:
            values[:, model.idx_vs[joint]] = np.unwrap(np.arctan2(configurations[:, at + 1], configurations[:, at]))
        else:
            values[:, model.idx_vs[joint]] = configurations[:, at]
    return values


def _zyx(quats_xyzw: Array) -> Array:
    """(n, 3) angles about z, y, x of R = Rz Ry Rx, without jumps [rad]."""
    x, y, z, w = quats_xyzw.T
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    pitch = np.arcsin(np.clip(2.0 * (w * y - x * z), -1.0, 1.0))
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    return np.unwrap(np.column_stack([yaw, pitch, roll]), axis=0)


def planned_forces_S(plan: Plan, nodes: Nodes, weight_N: float) -> Array:
    """(n + 1, 3 p) the weight, distributed to the points in contact at each node as the plan's forces are [N]."""
    points = [corners_S(end) for end in plan.robot.end_effectors]
    count = sum(len(own) for own in points)
    forces = np.zeros((nodes.count, count, 3))
    planned = np.linalg.norm(nodes.samples.forces_W, axis=2)
    for k in range(nodes.count):
        carrying = [end for end in range(len(points)) if nodes.carries(k, end)]
        shares = np.array([max(planned[k, end], 1.0) for end in carrying])
        first = 0
        for end, own in enumerate(points):
            if end in carrying:
                share = shares[carrying.index(end)] / shares.sum()
                forces[k, first : first + len(own), 2] = weight_N * share / len(own)
            first += len(own)
    return forces.reshape(nodes.count, 3 * count)
