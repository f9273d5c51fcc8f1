"""From configurations, velocities and contact forces of a whole body to the states that the planner takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Knot, Robot
from mcplan.arguments import require
from mcplan.errors import InvalidInput
from mcplan.kinematics.urdf_model import UrdfModel, load_model

from .planner import MeasuredState

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mcplan._core import Plan, Scene

Array = NDArray[np.float64]

#: An axis of a sole heads somewhere if at least this much of it is level.
LEVEL = 0.5
#: Height of a sole over a surface at which it may be on it [m].
NEAR_M = 0.1
#: Velocities of a configuration that are the base's; joints follow.
BASE_SPEEDS = 6


class StateReader:
    """Reads planner's states from a whole body's.

    Args:
        robot: A robot with a URDF.
        urdf_model: That URDF, read; None: it is read here.
        of_joints: The angular momentum of read() is that of the whole robot, as in knot() and for rhp.
    """

    def __init__(self, robot: Robot, urdf_model: UrdfModel | None = None, *, of_joints: bool = False) -> None:
        import pinocchio as pin  # type: ignore[import-untyped]

        require("robot", robot, Robot)
        self._pin = pin
        self.urdf_model = urdf_model or load_model(robot)
        self.robot = robot
        self.of_joints = of_joints
        self._data = self.urdf_model.model.createData()
        self.mass = float(pin.computeTotalMass(self.urdf_model.model))

    def _momentum_of_base_W(self, configuration: Array, velocity: Array) -> Array:
        """(3,) angular momentum about the CoM of a robot that turns as its base does, with joints that are still [kg m^2/s]."""
        still = np.array(velocity, float)
        still[BASE_SPEEDS:] = 0.0
        momentum = self._pin.computeCentroidalMomentum(
            self.urdf_model.model, self._data, np.asarray(configuration, float), still
        )
        return np.asarray(momentum.angular) * self.robot.mass / self.mass

    def knot(self, configuration: Array, velocity: Array, standing: Sequence[bool]) -> Knot:
        """The state that the planner takes, world frame W.

        Args:
            configuration: (nq,) base position, quaternion xyzw, joints: Pinocchio's convention.
            velocity: (nv,) base linear and angular in the base's axes, joints.
            standing: (e,) end-effectors in contact: they have no velocity.

        Raises:
            InvalidInput: One of them has another length.
        """
        pin, data, model = self._pin, self._data, self.urdf_model.model
        configuration, velocity = np.asarray(configuration, float), np.asarray(velocity, float)
        _require_count("configuration", configuration, model.nq)
        _require_count("velocity", velocity, model.nv)
        _require_count("standing", standing, len(self.urdf_model.frames))
        pin.computeCentroidalMomentum(model, data, configuration, velocity)
        pin.updateFramePlacements(model, data)
        base_WB = np.asarray(data.oMi[1].rotation)
        rpy = rpy_of(base_WB)
        positions, velocities, yaws = [], [], []
        for frame, stands in zip(self.urdf_model.frames, standing, strict=True):
            placement = data.oMf[frame]
            motion = pin.getFrameVelocity(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
            positions.append(np.array(placement.translation))
            velocities.append(np.zeros(3) if stands else np.array(motion.linear))
            x = np.asarray(placement.rotation)[:2, 0]
            yaw = float(np.arctan2(x[1], x[0])) if np.hypot(*x) > LEVEL else float(rpy[2])
            yaws.append(float(rpy[2] + np.remainder(yaw - rpy[2] + np.pi, 2.0 * np.pi) - np.pi))
        return Knot(
            com_W=np.array(data.com[0]),
            com_velocity_W=np.asarray(data.hg.linear) / self.mass,
            base_rpy=rpy,
            base_rpy_rate=rpy_rate(rpy, base_WB @ velocity[3:6]),
            end_effectors_W=positions,
            end_effector_velocities_W=velocities,
            angular_momentum_W=np.asarray(data.hg.angular) * self.robot.mass / self.mass,
            end_effector_yaw=yaws,
        )

    def read(
        self,
        time_s: float,
        configuration: Array,
        velocity: Array,
        in_contact: Sequence[bool],
        plan: Plan,
        plan_time_s: float,
    ) -> MeasuredState:
        """The state at a time, with the surfaces of the plan's scene that are touched.

        The angular momentum is that of a robot which turns as its base does, unless the reader is `of_joints`: plans of ddp
        turn the base with all of it, while legs and arms that swing give theirs back.

        Args:
            time_s: On the controller's clock.
            configuration, velocity, in_contact: As for knot().
            plan: The plan under way, and `plan_time_s`, the time in it [s]: an end-effector in contact is on the surface
                where the plan has it, now or next, if it is near to it, else on the one below. Hands that the plan never
                uses are where the plan has them against the base, as no controller takes them there.
        """
        knot = self.knot(configuration, velocity, in_contact)
        if not self.of_joints:
            knot.angular_momentum_W = self._momentum_of_base_W(configuration, velocity)
        t = min(max(plan_time_s, 0.0), float(plan.duration()))
        now = plan.at(t)
        sequence, phase = plan.contact_sequence(), int(now.phase)
        positions, velocities = np.array(knot.end_effectors_W), np.array(knot.end_effector_velocities_W)
        yaws, contacts = list(knot.end_effector_yaw), []
        turn = float(knot.base_rpy[2] - now.base_rpy[2])
        turn_W = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1.0]])
        for end, touches in enumerate(in_contact):
            ahead = [contacts_then[end] for contacts_then in [*sequence[phase:], plan.final_contacts]]
            used = [surface for surface in ahead if surface >= 0]
            if touches:
                contacts.append(surface_below(plan.scene, positions[end], used))
            else:
                contacts.append(-1)
            if not used and not touches:
                planned = now.end_effectors[end]
                positions[end] = knot.com_W + turn_W @ (np.asarray(planned.position_W) - now.com_W)
                velocities[end] = turn_W @ np.asarray(planned.velocity_W) - turn_W @ now.com_velocity_W
                velocities[end] += knot.com_velocity_W
                yaws[end] = float(planned.yaw + turn)
        knot.end_effectors_W, knot.end_effector_velocities_W, knot.end_effector_yaw = positions, velocities, yaws
        return MeasuredState(time_s, knot, tuple(contacts))


def surface_below(scene: Scene, position_W: Array, planned: Sequence[int]) -> int:
    """The surface that an end-effector in contact touches: the first planned one that is near, else the nearest; -1: none."""
    distances = [_distance(np.asarray(s.vertices_W, float), position_W) for s in scene.surfaces]
    for surface in planned:
        if distances[surface] < NEAR_M:
            return int(surface)
    nearest = int(np.argmin(distances))
    return nearest if distances[nearest] < NEAR_M else -1


def _distance(outline_W: Array, point_W: Array) -> float:
    """Of a point from a convex polygon [m]; inside of its outline, from its plane."""
    from mcplan.kinematics.rotations import polygon_normal

    normal = polygon_normal(outline_W)
    height = float(normal @ (point_W - outline_W[0]))
    edges = np.roll(outline_W, -1, axis=0) - outline_W
    inward = np.cross(normal, edges)
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    outside = float(np.max(-np.einsum("ij,ij->i", inward, point_W - outline_W), initial=0.0))
    return float(np.hypot(height, max(outside, 0.0)))


def _require_count(name: str, values: Array | Sequence[bool], count: int) -> None:
    if np.shape(values) != (count,):
        raise InvalidInput(name, f"must be {count} numbers", f"an array of shape {np.shape(values)}")


def rpy_of(rotation: Array) -> Array:
    """Roll, pitch, yaw [rad] of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0]))
    return np.array([np.arctan2(rotation[2, 1], rotation[2, 2]), pitch, np.arctan2(rotation[1, 0], rotation[0, 0])])


def rpy_rate(rpy: Array, omega_W: Array) -> Array:
    """Rates of roll, pitch, yaw of an angular velocity in the world frame: omega = Rz(yaw) (Ry(pitch) x r' + y p') + z y'."""
    cp, sp = np.cos(rpy[1]), np.sin(rpy[1])
    cy, sy = np.cos(rpy[2]), np.sin(rpy[2])
    ahead = cy * omega_W[0] + sy * omega_W[1]
    roll_rate = ahead / max(cp, 1e-6)
    return np.array([roll_rate, -sy * omega_W[0] + cy * omega_W[1], omega_W[2] + sp * roll_rate])
