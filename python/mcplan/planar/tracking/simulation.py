"""A planar robot in MuJoCo: its state and contact forces, in the terms of the planar robot."""

from __future__ import annotations

import numpy as np

from mcplan._core import PlanarConfiguration

from .mjcf import PlanarModel, set_state
from .recording import Array


class PlanarSimulation:
    """One robot on its ground. Positions are (3 + j,): base x, y [m], angle [rad], joints [rad]; velocities the same."""

    def __init__(self, model: PlanarModel) -> None:
        import mujoco

        self._mujoco = mujoco
        self.model = model
        self._data = mujoco.MjData(model.mj)
        self._end_of = {geom: (e, i) for e, geoms in enumerate(model.point_geoms) for i, geom in enumerate(geoms)}
        self._max_points = max((len(geoms) for geoms in model.point_geoms), default=0)

    def reset(self, configuration: PlanarConfiguration) -> None:
        """Start from a configuration and its velocity, at time 0."""
        self._mujoco.mj_resetData(self.model.mj, self._data)
        set_state(self.model, self._data, configuration)
        self._data.qacc_warmstart[:] = self._data.qacc
        self._mujoco.mj_forward(self.model.mj, self._data)

    @property
    def time_s(self) -> float:
        return float(self._data.time)

    @property
    def positions(self) -> Array:
        return self._data.qpos[self.model.dofs]

    @property
    def velocities(self) -> Array:
        return self._data.qvel[self.model.dofs]

    @property
    def warnings(self) -> int:
        """Number of MuJoCo's warnings since the last reset."""
        return int(sum(warning.number for warning in self._data.warning))

    def apply(self, torques: Array, q: Array, velocity: Array) -> Array:
        """Let motors give these torques [N m] and pull joints towards q [rad], velocity [rad/s] from now on; all (j,).

        Returns:
            (j,) what the feedback adds at this instant, before motors clip the sum [N m].
        """
        stiffness, damping = self.model.stiffness, self.model.damping
        desired = stiffness * q + damping * velocity
        self._data.ctrl[:] = torques + desired
        self._mujoco.mj_forward(self.model.mj, self._data)  # forces read next are those under these torques
        return desired - stiffness * self.positions[3:] - damping * self.velocities[3:]

    def advance(self, steps: int) -> None:
        """Go on by so many steps."""
        for _ in range(steps):
            self._mujoco.mj_step(self.model.mj, self._data)

    def applied_torques(self) -> Array:
        """(j,) torques of the motors after clipping [N m]."""
        return self._data.actuator_force.copy()

    def points_W(self) -> Array:
        """(e, p, 2) places of the end-effectors' points [m]; NaN: there is no such point."""
        out = np.full((len(self.model.point_geoms), self._max_points, 2), np.nan)
        for geom, (e, i) in self._end_of.items():
            rotation = self._data.geom_xmat[geom].reshape(3, 3)
            radius = self.model.mj.geom_size[geom, 0]
            out[e, i] = (self._data.geom_xpos[geom] - radius * rotation[:, 2])[[0, 2]]
        return out

    def forces_W(self) -> Array:
        """(e, p, 2) contact forces on the robot at these points [N]; NaN: there is no such point."""
        out = np.full((len(self.model.point_geoms), self._max_points, 2), np.nan)
        for e, i in self._end_of.values():
            out[e, i] = 0.0
        wrench = np.zeros(6)
        for c in range(self._data.ncon):
            contact = self._data.contact[c]
            first, second = int(contact.geom1), int(contact.geom2)
            self._mujoco.mj_contactForce(self.model.mj, self._data, c, wrench)
            force = wrench[:3] @ contact.frame.reshape(3, 3)  # of the first geom on the second one
            at, sign = (self._end_of[second], 1.0) if second in self._end_of else (self._end_of[first], -1.0)
            out[at] += sign * force[[0, 2]]
        return out
