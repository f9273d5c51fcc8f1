"""States of a robot in the conventions of Pinocchio and of MuJoCo.

    Pinocchio   configuration [base position, quaternion xyzw, joints], velocity [base linear and angular in the base's
                axes, joints], acceleration its derivative in these axes (spatial acceleration) MuJoCo      qpos [base
                position, quaternion wxyz, joints], qvel [base linear in the world's axes, angular in the base's,
                joints], qacc its derivative: the linear part is the acceleration of the base's origin in the world

The joints have an order of their own in each; they are matched by name when the model is built.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .mujoco_model import SimulationModel

Array = NDArray[np.float64]


def to_mujoco(model: SimulationModel, configuration: Array, velocity: Array) -> tuple[Array, Array]:
    """MuJoCo's qpos (7 + nj,) and qvel (6 + nj,) of Pinocchio's configuration and velocity."""
    qpos, qvel = np.empty(len(configuration)), np.empty(len(velocity))
    qpos[:3] = configuration[:3]
    qpos[3], qpos[4:7] = configuration[6], configuration[3:6]
    qpos[model.qpos_index] = configuration[7:]
    qvel[:3] = _rotation(configuration[3:7]) @ velocity[:3]
    qvel[3:6] = velocity[3:6]
    qvel[model.dof_index] = velocity[6:]
    return qpos, qvel


def to_pinocchio(model: SimulationModel, qpos: Array, qvel: Array) -> tuple[Array, Array]:
    """Pinocchio's configuration (7 + nj,) and velocity (6 + nj,) of MuJoCo's qpos and qvel."""
    configuration, velocity = np.empty(len(qpos)), np.empty(len(qvel))
    configuration[:3] = qpos[:3]
    configuration[3:6], configuration[6] = qpos[4:7], qpos[3]
    configuration[7:] = qpos[model.qpos_index]
    velocity[:3] = qvel[:3] @ _rotation(configuration[3:7])
    velocity[3:6] = qvel[3:6]
    velocity[6:] = qvel[model.dof_index]
    return configuration, velocity


def acceleration_to_mujoco(model: SimulationModel, configuration: Array, velocity: Array, acceleration: Array) -> Array:
    """MuJoCo's qacc (6 + nj,) of Pinocchio's configuration, velocity and acceleration."""
    qacc = np.empty(len(acceleration))
    transport = np.cross(velocity[3:6], velocity[:3])
    qacc[:3] = _rotation(configuration[3:7]) @ (acceleration[:3] + transport)
    qacc[3:6] = acceleration[3:6]
    qacc[model.dof_index] = acceleration[6:]
    return qacc


def acceleration_to_pinocchio(model: SimulationModel, configuration: Array, velocity: Array, qacc: Array) -> Array:
    """Pinocchio's acceleration (6 + nj,) of MuJoCo's qacc at Pinocchio's configuration and velocity."""
    acceleration = np.empty(len(qacc))
    acceleration[:3] = qacc[:3] @ _rotation(configuration[3:7]) - np.cross(velocity[3:6], velocity[:3])
    acceleration[3:6] = qacc[3:6]
    acceleration[6:] = qacc[model.dof_index]
    return acceleration


def force_to_mujoco(model: SimulationModel, configuration: Array, force: Array) -> Array:
    """MuJoCo's generalised force (6 + nj,) of Pinocchio's: what is dual to qvel."""
    out = np.empty(len(force))
    out[:3] = _rotation(configuration[3:7]) @ force[:3]
    out[3:6] = force[3:6]
    out[model.dof_index] = force[6:]
    return out


def _rotation(quat_xyzw: Array) -> Array:
    """Rotation matrix (3, 3) of a unit quaternion."""
    x, y, z, w = quat_xyzw
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
