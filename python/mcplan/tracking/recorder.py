"""Collects a recording step by step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import quat_xyzw
from mcplan.kinematics.urdf_model import UrdfModel

from .recording import Recording
from .robot_dynamics import RobotDynamics
from .touches import Touch, TouchLog

if TYPE_CHECKING:
    from mcplan._core import Plan

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Acting:
    """What acts on a robot in a control step: e end-effectors, nj joints.

    Attributes:
        torques: (nj,) of the motors [N m].
        forces_W: (e, 3) of the terrain on each end-effector [N].
        in_contact: (e,) whether they are taken as contacts.
        assist: (6,) wrench of the assistance.
        push_W: (3,) [N].
        touches: Contacts that are not planned.
    """

    torques: Array
    forces_W: Array
    in_contact: NDArray[np.bool_]
    assist: Array
    push_W: Array
    touches: Sequence[Touch] = ()


class Desired(Protocol):
    """What is recorded of references, and for how many control steps there is room at most."""

    @property
    def count(self) -> int: ...
    @property
    def dt_s(self) -> float: ...
    @property
    def com_W(self) -> Array: ...
    @property
    def momentum_W(self) -> Array: ...
    @property
    def base_WB(self) -> Array: ...
    @property
    def end_effectors_W(self) -> Array: ...
    @property
    def forces_W(self) -> Array: ...
    @property
    def surfaces(self) -> NDArray[np.int64]: ...


class Recorder:
    """Arrays for a whole run, filled one control step after the other."""

    def __init__(self, plan: Plan, urdf_model: UrdfModel, joints: tuple[str, ...], desired: Desired) -> None:
        n, e, nj = desired.count, len(urdf_model.robot.end_effectors), len(joints)
        self.plan, self.urdf_model, self.joints, self.desired = plan, urdf_model, joints, desired
        self.count = self.dropped = 0
        self.configurations, self.velocities = np.zeros((n, 7 + nj)), np.zeros((n, 6 + nj))
        self.torques, self.com_W, self.momentum_W = np.zeros((n, nj)), np.zeros((n, 3)), np.zeros((n, 3))
        self.end_effectors_W, self.forces_W = np.zeros((n, e, 3)), np.zeros((n, e, 3))
        self.contacts = np.zeros((n, e), dtype=bool)
        self.assist, self.pushes_W = np.zeros((n, 6)), np.zeros((n, 3))
        self.touches = TouchLog()

    def add(self, dynamics: RobotDynamics, acting: Acting) -> None:
        """Append a step: state of the robot, and what acts on it."""
        n = self.count
        self.configurations[n], self.velocities[n] = dynamics.configuration, dynamics.velocity
        self.torques[n], self.com_W[n], self.momentum_W[n] = acting.torques, dynamics.com_W, dynamics.momentum_W
        for end in range(self.end_effectors_W.shape[1]):
            self.end_effectors_W[n, end] = dynamics.end_effector_position_W(end)
        self.forces_W[n], self.contacts[n] = acting.forces_W, acting.in_contact
        self.assist[n], self.pushes_W[n] = acting.assist, acting.push_W
        self.touches.add((self.dropped + n) * self.desired.dt_s, acting.touches)
        self.count = n + 1

    def drop(self, steps: int) -> None:
        """Forget the first control steps."""
        for rows in (
            *(self.configurations, self.velocities, self.torques, self.com_W, self.momentum_W, self.end_effectors_W),
            *(self.forces_W, self.contacts, self.assist, self.pushes_W),
        ):
            rows[:-steps] = rows[steps:].copy()
        self.count -= steps
        self.dropped += steps
        self.touches.drop(self.dropped * self.desired.dt_s)

    def finish(self, fell_at_s: float) -> Recording:
        """The recording of the steps added."""
        n, desired = self.count, self.desired
        return Recording(
            plan=self.plan,
            joints=self.joints,
            times_s=np.asarray((self.dropped + np.arange(n)) * desired.dt_s, float),
            configurations=self.configurations[:n],
            velocities=self.velocities[:n],
            torques=self.torques[:n],
            torque_limits=np.asarray(self.urdf_model.model.effortLimit[6:], float),
            com_W=self.com_W[:n],
            com_plan_W=desired.com_W[:n],
            angular_momentum_W=self.momentum_W[:n],
            angular_momentum_plan_W=desired.momentum_W[:n],
            base_quat_xyzw_plan=quat_xyzw(desired.base_WB[:n]),
            end_effectors_W=self.end_effectors_W[:n],
            end_effectors_plan_W=desired.end_effectors_W[:n],
            forces_W=self.forces_W[:n],
            forces_plan_W=desired.forces_W[:n],
            contacts=self.contacts[:n],
            contacts_plan=desired.surfaces[:n],
            assist=self.assist[:n],
            pushes_W=self.pushes_W[:n],
            fell_at_s=fell_at_s,
            robot=self.urdf_model.robot,
            velocity_limits=np.asarray(self.urdf_model.model.velocityLimit[6:], float),
            touches=self.touches.touches(),
        )
