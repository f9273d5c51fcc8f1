"""Torques, CoM and end-effectors of a motion, by Pinocchio."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .motion_model import MotionModel

Array = NDArray[np.float64]


def states(
    model: MotionModel, trajectory: tuple[Array, Array, Array], points_S: Array, forces_S: Array
) -> dict[str, Array]:
    """What follows from a trajectory and forces, by the names of ``MotionSamples``.

    Args:
        model: The robot.
        trajectory: q (k, nq), v and a (k, nv).
        points_S: (L, 4, 3) where forces act.
        forces_S: (k, L, 4, 3) on the robot [N].
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    robot, data = model.model, model.model.createData()
    count, ends = len(trajectory[0]), len(model.frames)
    wrenches_S = np.concatenate([forces_S, np.cross(points_S[None], forces_S)], axis=3).sum(axis=2)
    tau, com_W = np.zeros((count, robot.nv)), np.zeros((count, 3))
    positions_W, rotations_W = np.zeros((count, ends, 3)), np.zeros((count, ends, 3, 3))
    placements = [robot.frames[frame].placement for frame in model.frames]
    parents = [robot.frames[frame].parentJoint for frame in model.frames]
    at_rest = [pin.Force.Zero() for _ in range(robot.njoints)]
    for k, (q, v, a) in enumerate(zip(*trajectory, strict=True)):
        external = pin.StdVec_Force()
        external.extend(at_rest)
        for end in range(ends):
            if wrenches_S[k, end].any():
                external[parents[end]] += placements[end].act(pin.Force(wrenches_S[k, end]))
        tau[k] = pin.rnea(robot, data, q, v, a, external)
        com_W[k] = pin.centerOfMass(robot, data, q)
        pin.updateFramePlacements(robot, data)
        for end, frame in enumerate(model.frames):
            positions_W[k, end] = data.oMf[frame].translation
            rotations_W[k, end] = data.oMf[frame].rotation
    halves = wrenches_S.reshape(count, ends, 2, 3)
    wrenches_W = np.einsum("kerc,kehc->kehr", rotations_W, halves).reshape(count, ends, 6)
    return {
        "tau": tau[:, 6:],
        "base_residual_B": tau[:, :6],
        "com_W": com_W,
        "end_effectors_W": positions_W,
        "rotations_W": rotations_W,
        "wrenches_W": wrenches_W,
    }
