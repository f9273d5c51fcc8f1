"""Pinocchio's terms at one state, computed once a control step for all tasks."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: The axes that come after and before x, y and z.
AFTER, BEFORE = [1, 2, 0], [2, 0, 1]


class RobotDynamics:
    """Dynamics of the robot at a state; nv velocities, base first. All motions and Jacobians in the world's axes.

    Attributes:
        inertia: M (nv, nv), rotor inertias included. bias: h (nv,) = Coriolis, centrifugal and gravity forces.
        com_W, com_velocity_W: (3,). com_jacobian: (3, nv). com_drift: (3,) = d(com_jacobian)/dt v.
        momentum_W: (3,) angular, about the CoM. momentum_map: (3, nv). momentum_drift: (3,).
        base_WB: (3, 3). base_velocity_W: (3,) angular. base_jacobian: (3, nv). base_drift: (3,).
    """

    def __init__(self, urdf_model: UrdfModel) -> None:
        import pinocchio as pin  # type: ignore[import-untyped]

        self._pin = pin
        self.urdf_model, self.model = urdf_model, urdf_model.model
        self._data: Any = self.model.createData()
        self.base_drift = np.zeros(3)
        self.mass = float(pin.computeTotalMass(self.model))
        self._upper = np.triu(np.ones((self.model.nv, self.model.nv), dtype=bool))
        # Which velocities move a joint's link: its own and those of the joints before it.
        self._carried = np.zeros((self.model.njoints, self.model.nv))
        for joint, before in enumerate(self.model.supports):
            for mover in list(before)[1:]:
                at = self.model.idx_vs[mover]
                self._carried[joint, at : at + self.model.nvs[mover]] = 1.0

    def update(self, configuration: Array, velocity: Array) -> None:
        """Move to a state, given as Pinocchio has it."""
        pin, model, data = self._pin, self.model, self._data
        self.configuration, self.velocity = configuration, velocity
        # Computes Jacobians, their rates' effect and centroidal terms in one sweep each.
        pin.computeCentroidalMapTimeVariation(model, data, configuration, velocity)
        self.inertia = pin.crba(model, data, configuration)
        self.inertia = np.where(self._upper, self.inertia, self.inertia.T)  # Pinocchio fills one half
        self.bias = pin.nonLinearEffects(model, data, configuration, velocity)
        # A second pass with zero acceleration leaves each frame's drift in the data.
        pin.forwardKinematics(model, data, configuration, velocity, np.zeros(model.nv))
        pin.updateFramePlacements(model, data)
        momentum_map = data.Ag
        momentum_drift = data.dAg @ velocity
        self.com_W = data.com[0].copy()
        self.com_jacobian = momentum_map[:3] / self.mass
        self.com_velocity_W = self.com_jacobian @ velocity
        self.com_drift = momentum_drift[:3] / self.mass
        self.momentum_map = momentum_map[3:].copy()
        self.momentum_W = self.momentum_map @ velocity
        self.momentum_drift = momentum_drift[3:]
        self.base_WB = data.oMi[1].rotation.copy()
        self.base_velocity_W = self.base_WB @ velocity[3:6]
        self.base_jacobian = np.zeros((3, model.nv))
        self.base_jacobian[:, 3:6] = self.base_WB

    def end_effector_position_W(self, index: int) -> Array:
        """(3,) contact point of an end-effector [m]."""
        return np.asarray(self._data.oMf[self.urdf_model.frames[index]].translation)

    def distance_rows(self, joints: NDArray[np.int64], points_W: Array, normals_W: Array) -> Array:
        """Rates of distances per velocity, (n, nv): n (J_2 - J_1) for points that are fixed to the links of two joints.

        Args:
            joints: (n, 2) of each pair.
            points_W: (n, 2, 3) [m].
            normals_W: (n, 3) from the first point to the second one, of unit length.
        """
        # Columns of J are the motions, at the world's origin, of whatever a joint carries: all that lies beyond it.
        columns = np.asarray(self._data.J)
        linear, along_W = normals_W @ columns[:3], normals_W[:, None]
        # np.cross takes ten times as long for so few.
        moments_W = points_W[..., AFTER] * along_W[..., BEFORE] - points_W[..., BEFORE] * along_W[..., AFTER]
        first, second = (linear + moments_W[:, end] @ columns[3:] for end in (0, 1))
        return np.asarray(second * self._carried[joints[:, 1]] - first * self._carried[joints[:, 0]])

    def end_effector(self, index: int) -> EndEffectorMotion:
        """Motion of an end-effector's contact frame."""
        pin, data, frame = self._pin, self._data, self.urdf_model.frames[index]
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        placement = data.oMf[frame]
        drift = pin.getFrameClassicalAcceleration(self.model, data, frame, axes)
        return EndEffectorMotion(
            placement.translation.copy(),
            placement.rotation.copy(),
            pin.getFrameVelocity(self.model, data, frame, axes).vector.copy(),
            pin.getFrameJacobian(self.model, data, frame, axes),
            drift.vector.copy(),
        )


class EndEffectorMotion:
    """Motion of a contact frame.

    Attributes:
        position_W, rotation_W: (3,), (3, 3). velocity_W: (6,) linear, then angular. jacobian: (6, nv). drift: (6,).
    """

    __slots__ = ("drift", "jacobian", "position_W", "rotation_W", "velocity_W")

    def __init__(self, position_W: Array, rotation_W: Array, velocity_W: Array, jacobian: Array, drift: Array) -> None:
        self.position_W, self.rotation_W, self.velocity_W = position_W, rotation_W, velocity_W
        self.jacobian, self.drift = jacobian, drift
