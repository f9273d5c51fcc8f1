"""Where the search for a motion begins: postures along the plan by inverse kinematics, or the robot standing still."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.smooth_postures import smoothed

from . import splines

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .motion_model import MotionModel
    from .nodes import Nodes

Array = NDArray[np.float64]


def follow_plan(motion_model: MotionModel, nodes: Nodes) -> Array:
    """(n + 3, nv) coefficients of splines through postures that follow the plan."""
    complete = motion_model.complete
    found = smoothed(complete, nodes.samples, follow(complete, nodes.samples))
    return _coefficients(motion_model, nodes, found.configurations)


def stand_still(motion_model: MotionModel, nodes: Nodes) -> Array:
    """(n + 3, nv) coefficients of splines through the robot's posture, at the plan's first CoM throughout."""
    import pinocchio as pin  # type: ignore[import-untyped]

    complete = motion_model.complete
    q = complete.neutral.copy()
    q[:3] += nodes.samples.com_W[0] - pin.centerOfMass(complete.model, complete.model.createData(), q)
    return _coefficients(motion_model, nodes, np.repeat(q[None], nodes.count, axis=0))


def _coefficients(motion_model: MotionModel, nodes: Nodes, configurations: Array) -> Array:
    model, whole = motion_model.model, motion_model.complete.model
    values = np.zeros((nodes.count, model.nv))
    values[:, :3] = configurations[:, :3]
    values[:, 3:6] = _zyx(configurations[:, 3:7])
    for joint in range(2, model.njoints):
        at = whole.idx_qs[whole.getJointId(model.names[joint])]
        if model.nqs[joint] == 2:
            values[:, model.idx_vs[joint]] = np.unwrap(np.arctan2(configurations[:, at + 1], configurations[:, at]))
        else:
            values[:, model.idx_vs[joint]] = configurations[:, at]
    return splines.interpolating(nodes.times_s, values)


def _zyx(quats_xyzw: Array) -> Array:
    """(n, 3) angles about z, y, x of R = Rz Ry Rx, without jumps [rad]."""
    x, y, z, w = quats_xyzw.T
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    pitch = np.arcsin(np.clip(2.0 * (w * y - x * z), -1.0, 1.0))
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    return np.unwrap(np.column_stack([yaw, pitch, roll]), axis=0)


def planned_forces_S(plan: Plan, nodes: Nodes, points: list[Array], weight_N: float) -> Array:
    """(n + 1, 3 p) the weight, distributed to the points in contact at each node as the plan's forces are [N]."""
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
