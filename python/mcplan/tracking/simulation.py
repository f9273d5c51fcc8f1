"""A robot in MuJoCo: torques in, states and contact forces out, all in Pinocchio's conventions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .actuators import Lag
from .states import to_mujoco, to_pinocchio
from .touches import Touch

if TYPE_CHECKING:
    from .mujoco_model import SimulationModel

Array = NDArray[np.float64]

#: A speed that no robot has [m/s, rad/s]: the simulation has blown up.
FASTEST = 1e4


class Simulation:
    """A run of MuJoCo.

    e end-effectors, nj joints in Pinocchio's order. Contact forces are those of the last step taken; zero before the
    first.

    Args:
        model: What is simulated.
        delay_s, bandwidth_hz: Of the motors, see ``actuators.Lag``.

    Attributes:
        model: What is simulated.
        data: mujoco.MjData.
        broke: The state is not finite or beyond reason; the run is worth nothing from there on.
    """

    def __init__(self, model: SimulationModel, delay_s: float = 0.0, bandwidth_hz: float = 0.0) -> None:
        import mujoco

        if mujoco.get_mju_user_warning() is None:
            # They are counted; without this MuJoCo writes them to a file in the working folder.
            mujoco.set_mju_user_warning(lambda text: None)
        self.model, self._mj = model, model.mj
        self.data = mujoco.MjData(model.mj)
        self._step = mujoco.mj_step
        self.broke = False
        self._end_of_geom = np.full(model.mj.ngeom, -1)
        for number, geoms in enumerate(model.end_geoms):
            self._end_of_geom[list(geoms)] = number
        self._is_surface = np.zeros(model.mj.ngeom, dtype=bool)
        self._is_surface[list(model.surface_geoms)] = True
        self._lag_of = lambda: Lag(float(model.mj.opt.timestep), delay_s, bandwidth_hz)
        self._lag = self._lag_of()
        self._limited = np.isfinite(model.motors.velocity_limits)

    @property
    def time_s(self) -> float:
        """Since the last reset."""
        return float(self.data.time)

    @property
    def warnings(self) -> int:
        """Warnings of MuJoCo since the last reset, all kinds together."""
        return int(sum(warning.number for warning in self.data.warning))

    def reset(self, configuration: Array, velocity: Array | None = None) -> None:
        """Put the robot into a state at time 0.

        Args:
            configuration: (7 + nj,) as Pinocchio has it.
            velocity: (6 + nj,) as Pinocchio has it; None: at rest.
        """
        import mujoco

        velocity = np.zeros(self._mj.nv) if velocity is None else velocity
        mujoco.mj_resetData(self._mj, self.data)
        self.data.qpos[:], self.data.qvel[:] = to_mujoco(self.model, configuration, velocity)
        self.broke = False
        self._lag = self._lag_of()
        mujoco.mj_forward(self._mj, self.data)
        self.data.efc_force[:] = 0.0

    def state(self) -> tuple[Array, Array]:
        """Configuration (7 + nj,) and velocity (6 + nj,) as Pinocchio has them."""
        return to_pinocchio(self.model, self.data.qpos, self.data.qvel)

    def advance(self, torques: Array, base_wrench_W: Array | None = None, steps: int = 1) -> Array:
        """Tell the motors constant torques, and apply a wrench on the base, for some steps.

        Args:
            torques: (nj,) [N m]; what the motors have at a joint's speed cuts them off.
            base_wrench_W: (6,) force [N] through the base link's centre of mass, and moment [N m]; None: none.
            steps: Number of MuJoCo's steps.

        Returns:
            (nj,) mean torque that the motors gave [N m].
        """
        given = np.zeros(len(self.model.actuator_index))
        if self.broke:
            return given
        self.data.xfrc_applied[self.model.base_body] = 0.0 if base_wrench_W is None else base_wrench_W
        if not (self._lag.acts or self._limited.any()):
            self.data.ctrl[self.model.actuator_index] = torques
            self._step(self._mj, self.data, steps)
            given = self.data.actuator_force[self.model.actuator_index]
        else:
            for _ in range(steps):
                self._drive(self._lag.after(torques))
                self._step(self._mj, self.data)
                given = given + self.data.actuator_force[self.model.actuator_index] / steps
        fastest = np.abs(self.data.qvel).max()
        self.broke = not fastest < FASTEST  # also of NaN
        return np.array(given)

    def _drive(self, torques: Array) -> None:
        """Set the motors to torques (nj,), those that would be beyond what they have at this speed to full voltage.

        At full voltage the torque is that at rest less its slope times the speed. MuJoCo integrates the slope implicitly:
        worked out once a step, it would make light joints swing between both signs.
        """
        model, motors, index = self.model, self.model.motors, self.model.actuator_index
        low, high = motors.bounds(self.data.qvel[model.dof_index])
        above, below = (torques > high) & self._limited, (torques < low) & self._limited
        full = above | below
        some = bool(full.any())
        self.data.ctrl[index] = np.where(full, 0.0, torques) if some else torques
        if some or self._mj.actuator_biasprm[:, 2].any():  # now, or the last time
            self._mj.actuator_biasprm[index, 0] = np.where(full, np.where(above, 1.0, -1.0) * motors.stall_torques, 0.0)
            self._mj.actuator_biasprm[index, 2] = np.where(full, -motors.slopes, 0.0)

    def contact_forces_W(self) -> Array:
        """(e, 3) force [N] of the terrain on each end-effector."""
        end_effectors, forces, _, _ = self._contacts()
        out = np.zeros((len(self.model.end_geoms), 3))
        np.add.at(out, end_effectors, forces)
        return out

    def contact_wrenches_W(self) -> Array:
        """(e, 6) force [N] of the terrain on each end-effector, and its moment [N m] about the world's origin."""
        end_effectors, forces, _, points = self._contacts()
        out = np.zeros((len(self.model.end_geoms), 6))
        np.add.at(out, end_effectors, np.hstack([forces, np.cross(points, forces)]))
        return out

    def centres_of_pressure_W(self) -> Array:
        """(e, 3) mean of the contact points weighted by their normal forces [m]; NaN without contact."""
        end_effectors, _, normals, points = self._contacts()
        out, total = np.zeros((len(self.model.end_geoms), 3)), np.zeros(len(self.model.end_geoms))
        np.add.at(out, end_effectors, normals[:, None] * points)
        np.add.at(total, end_effectors, normals)
        with np.errstate(invalid="ignore"):
            return out / np.where(total > 0.0, total, np.nan)[:, None]

    def touches(self) -> list[Touch]:
        """Contacts of links with each other and, but for those of end-effectors, with the terrain; at this instant."""
        contact, model = self.data.contact, self.model
        found: dict[tuple[tuple[str, str], bool], Touch] = {}
        geoms_of = contact.geom
        unplanned = ~(self._is_surface[geoms_of].any(axis=1) & (self._end_of_geom[geoms_of] >= 0).any(axis=1))
        for i in np.flatnonzero(unplanned & (contact.efc_address >= 0) & (contact.dist < 0.0)):
            geoms = sorted(int(geom) for geom in geoms_of[i])
            on_terrain = [geom for geom in geoms if self._is_surface[geom]]
            first, second = [geom for geom in geoms if geom not in on_terrain] + on_terrain
            depth_m, force_N = -float(contact.dist[i]), float(self.data.efc_force[contact.efc_address[i]])
            links = (model.geom_names[first], model.geom_names[second])
            key, now = (links, bool(on_terrain)), self.time_s
            if key in found:  # shapes meet in several points
                depth_m, force_N = max(depth_m, found[key].depth_m), force_N + found[key].force_N
            found[key] = Touch(links, bool(on_terrain), now, now, depth_m, force_N)
        return list(found.values())

    def _contacts(self) -> tuple[NDArray[np.int64], Array, Array, Array]:
        """Of end-effectors' contacts with the terrain: end-effector, force on it (n, 3), normal force (n,), point (n, 3),
        world frame."""
        contact = self.data.contact
        geoms = contact.geom  # MuJoCo's arrays are made anew whenever they are asked for
        address, end_effectors = contact.efc_address, self._end_of_geom[geoms]
        used = (address >= 0) & (end_effectors >= 0).any(axis=1) & self._is_surface[geoms].any(axis=1)
        address, end_effectors = address[used], end_effectors[used]
        # With elliptic cones the constraint forces are the components along normal and tangents.
        local = self.data.efc_force[address[:, None] + np.arange(3)]
        axes = contact.frame[used].reshape(-1, 3, 3)  # rows; the normal points from the first geom to the second
        forces = np.einsum("ni,nij->nj", local, axes)
        first = end_effectors[:, 0] >= 0
        forces[first] *= -1.0
        return np.where(first, end_effectors[:, 0], end_effectors[:, 1]), forces, local[:, 0], contact.pos[used]
