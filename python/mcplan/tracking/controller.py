"""Whole-body inverse dynamics as a quadratic program over joint accelerations and contact forces.

    min   sum_tasks w |J qdd + drift - a|^2  +  w_f |f - f_plan|^2  +  w_s s^2
    s.t.  the six rows of  M qdd + h = S' tau + sum J_c' f  that no joint drives
          tau within what motors have at this speed,  f in friction pyramids,
          joint positions and speeds within their limits but for a slack s

Without forces and slack the program has a solution at any state, where some acceleration of the base balances any torques:
contacts are tasks of great weight and not equations for that reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import whole_outlines
from mcplan.kinematics.rotations import minimal_rotation, polygon_normal, rotation_vector
from mcplan.kinematics.urdf_model import UrdfModel, leg_velocities

from .actuators import TorqueSpeed
from .contact_forces import SIDES, ForcePoints, corners, pyramid
from .contacts import Contact, LateLandings, Mode
from .joint_references import JointReferences
from .live_references import LiveReferences
from .options import Gains
from .quadratic_program import Problem, QuadraticProgram
from .references import References
from .robot_dynamics import EndEffectorMotion, RobotDynamics
from .separation import Separation
from .unknown_forces import UnknownForces

if TYPE_CHECKING:
    from mcplan._core import Plan, Scene

Array = NDArray[np.float64]

#: Joints are kept from their limits by bounds of acceleration: -kp (q - limit) - kd v, at least this much [rad/s^2].
LIMIT_KP, LIMIT_KD, LIMIT_MARGIN = 900.0, 60.0, 50.0
#: Joints are kept from their largest speed so that none is beyond it after this time [s]: |v + a t| <= v_max.
SPEED_HORIZON_S = 0.02
SLACK_WEIGHT = 10.0
#: Damping in the program's Hessian, for accelerations that no task asks for.
DAMPING = 1e-4


@dataclass(frozen=True)
class Command:
    """What the controller decided.

    Attributes:
        torques: (nj,) [N m], within what motors have at the measured speeds.
        solved: Whether the program was solved; if not, the torques are those of the last one that was.
    """

    torques: Array
    solved: bool


@dataclass(frozen=True)
class Restraints:
    """What accelerations and torques are kept within.

    Attributes:
        motors: Torques that the motors have at a speed, and the largest speeds.
        separation: Links that are to be kept apart; None: none are.
    """

    motors: TorqueSpeed
    separation: Separation | None = None


class Controller:
    """Tracks references with a robot. Call once a control step."""

    def __init__(
        self,
        urdf_model: UrdfModel,
        scene: Scene,
        references: References,
        posture: Array | JointReferences,
        gains: Gains,
        restraints: Restraints | None = None,
    ) -> None:
        """
        Args:
            urdf_model: The robot's model.
            scene: Surfaces that the references name.
            references: Desired motion and forces at each control step, until set_plan gives others.
            posture: (nq,) or (n, nq) configurations near to which the joints stay, or how all joints move.
            gains: Weights and gains.
            restraints: What motors have, and links to be kept apart; None: the URDF's limits of torque and speed alone.
        """
        self.urdf_model, self.references, self.gains = urdf_model, references, gains
        self._live: LiveReferences | None = None  # of a plan that was taken over
        self._last = -1
        self.dynamics = RobotDynamics(urdf_model)
        model = urdf_model.model
        self.nv, self.limits = model.nv, np.asarray(model.effortLimit[6:], float)
        restraints = restraints or Restraints(TorqueSpeed.of(self.limits, model.velocityLimit[6:]))
        self.motors, self.separation = restraints.motors, restraints.separation
        self.lower, self.upper = model.lowerPositionLimit[7:].copy(), model.upperPositionLimit[7:].copy()
        self.joints = posture if isinstance(posture, JointReferences) else JointReferences.of_posture(posture)
        self.legs = leg_velocities(urdf_model)
        self.normals = [polygon_normal(np.asarray(s.vertices_W)) for s in scene.surfaces]
        self.pyramids = [pyramid(n, s.friction) for n, s in zip(self.normals, scene.surfaces, strict=True)]
        self.points = [ForcePoints.of(end.half_size) for end in urdf_model.robot.end_effectors]
        self.flat, ends = [p.count > 1 for p in self.points], urdf_model.robot.end_effectors
        self.soles, self.feet = [corners(end.half_size) for end in ends], [end.kind == "foot" for end in ends]
        self.contacts, self._late = [Contact() for _ in self.points], LateLandings()
        self.qp, self.unknown = QuadraticProgram(), UnknownForces(references.dt_s)
        self.torques = np.zeros(self.nv - 6)
        self.surfaces = whole_outlines(scene)  # soles stand across the seams of tiles
        for end, contact in enumerate(self.contacts):
            if references.surfaces[0, end] >= 0:
                contact.mode = Mode.CONTACT
                self._set_contact(0, end, references.end_effectors_W[0, end], references.soles_W[0, end])

    def step(self, n: int, configuration: Array, velocity: Array, in_contact: NDArray[np.bool_]) -> Command:
        """Torques for control step n.

        Args:
            n: Index into the references.
            configuration: (nq,) measured, Pinocchio's convention. velocity: (nv,) likewise.
            in_contact: (e,) whether each end-effector is in contact, by the measured forces.
        """
        self._last = n
        if self._live is not None:
            self.references, n = self._live.window(n)
        self.dynamics.update(configuration, velocity)
        pressing = [contact.mode is Mode.CONTACT for contact in self.contacts]
        self.unknown.update(self.dynamics.com_velocity_W, any(pressing) and np.array_equal(pressing, in_contact))
        motions = [self.dynamics.end_effector(i) for i in range(len(self.contacts))]
        on_ground = self._late.update(self.contacts, list(self.references.surfaces[n] >= 0), self.references.dt_s)
        for i, (contact, planned) in enumerate(zip(self.contacts, on_ground, strict=True)):
            # An end-effector that never lands again does not land early either: a hand that brushes a wall goes on.
            fraction = float(self.references.swing_fraction[n, i] * self.references.returns[n, i])
            searched = contact.mode is Mode.SEARCH
            if contact.update(planned, bool(in_contact[i]), fraction, self.references.dt_s):
                self._set_contact(n, i, motions[i].position_W, self._landed(n, i, motions[i]))
            elif contact.mode is Mode.SEARCH and not searched:
                contact.position_W = motions[i].position_W
        problem, supporting, force_map = self._problem(n, motions)
        found = self.qp.solve(problem, (*supporting, len(problem.lower)))
        if found is not None:
            acceleration, forces = found[: self.nv], found[self.nv : self.nv + force_map.shape[1]]
            tau = self.dynamics.inertia[6:] @ acceleration + self.dynamics.bias[6:] - force_map[6:] @ forces
            self.torques = np.clip(tau, *self.motors.bounds(velocity[6:]))
            self.unknown.predict(self.dynamics.com_jacobian @ acceleration + self.dynamics.com_drift)
        return Command(self.torques, found is not None)

    def set_plan(self, plan: Plan, t0: float, com_shift_W: Array | None = None) -> None:
        """Follow another plan from the next control step on.

        Contacts, force points and the last torques stay. References go on without a jump of position or velocity; what the
        two plans differ by then decays as the controller makes errors decay, so that the accelerations asked for are those
        of the new plan followed from the state that the robot is in.

        Args:
            plan: The plan, of the same scene's surfaces and the same end-effectors.
            t0: Time of control step 0 plus this is the plan's start [s]: step n is at n dt - t0 of the plan.
            com_shift_W: (3,) by which the plan's CoM is beside the robot's [m]; None: it is not.
        """
        if self.joints.timed:  # joints of a motion, which the plan does not go on with
            self.joints = JointReferences(np.atleast_2d(self.joints.at(max(self._last, 0))[0]))
        before = self._live or LiveReferences.of(self.references)
        live = LiveReferences(plan, self.urdf_model.robot, before.dt_s, t0, com_shift_W)
        self._live = live.taken_over(before, self._last + 1, self.gains)

    def set_friction(self, surface: int, friction: float) -> None:
        """Keep forces on a surface, by index, within another friction coefficient; feet that slip stay where they are."""
        self.pyramids[surface] = pyramid(self.normals[surface], friction)
        for contact, on, end in zip(self.contacts, self.surfaces_now(), range(len(self.contacts)), strict=True):
            if on == surface:
                contact.position_W = self.dynamics.end_effector_position_W(end)

    def surfaces_now(self) -> list[int]:
        """(e,) index of the surface with which each end-effector is in contact; -1: none."""
        _, n = self.row(max(self._last, 0))
        return [self._surface(n, end) if c.mode is Mode.CONTACT else -1 for end, c in enumerate(self.contacts)]

    def velocities_W(self) -> list[Array]:
        """(e,) velocities (3,) of the end-effectors at the last control step [m/s]."""
        return [self.dynamics.end_effector(end).velocity_W[:3] for end in range(len(self.contacts))]

    def sole_velocities_W(self) -> list[Array]:
        """(e,) velocities (p, 3) of the corners of soles, and of what has none itself, at the last control step [m/s]."""
        found = []
        for end, sides in enumerate(self.soles):
            motion = self.dynamics.end_effector(end)
            arms_W = sides @ motion.rotation_W.T
            found.append(motion.velocity_W[:3] + np.cross(motion.velocity_W[3:], arms_W))
        return found

    def speeds_m_s(self) -> list[float]:
        """(e,) of the end-effectors at the last control step."""
        return [float(np.linalg.norm(velocity_W)) for velocity_W in self.velocities_W()]

    def row(self, n: int) -> tuple[References, int]:
        """References that contain control step n, and its index there."""
        return (self.references, n) if self._live is None else self._live.window(n)

    def _set_contact(self, n: int, end: int, position_W: Array, rotation_W: Array) -> None:
        """Set the place of an end-effector's contact, and the points at which forces act there."""
        contact, surface = self.contacts[end], self._surface(n, end)
        contact.position_W, contact.rotation_W = position_W, rotation_W
        if self.flat[end] and surface >= 0:
            outline_F = (self.surfaces[surface] - position_W) @ rotation_W
            self.points[end] = ForcePoints.of(self.urdf_model.robot.end_effectors[end].half_size, outline_F[:, :2])

    def _landed(self, n: int, end: int, motion: EndEffectorMotion) -> Array:
        """Desired orientation after touch-down: flat on the surface, in the direction that the foot has."""
        surface = self._surface(n, end)
        if not self.flat[end] or surface < 0:
            return motion.rotation_W
        rotation = minimal_rotation(motion.rotation_W[:, 2], self.normals[surface])
        return rotation @ motion.rotation_W

    def _surface(self, n: int, end: int) -> int:
        """The surface with which an end-effector is in contact or will be next; -1: none."""
        if self.references.next_surfaces is not None:
            return int(self.references.next_surfaces[n, end])
        ahead = self.references.surfaces[n:, end]
        on = np.flatnonzero(ahead >= 0)
        return int(ahead[on[0]]) if len(on) else -1

    def _problem(self, n: int, motions: list[EndEffectorMotion]) -> tuple[Problem, list[int], Array]:
        nv, gains = self.nv, self.gains
        supporting = [i for i, c in enumerate(self.contacts) if c.mode is Mode.CONTACT]
        sizes = [3 * self.points[i].count for i in supporting]
        nf = sum(sizes)
        size = nv + nf + 1
        rows, values = self._tasks(n, motions)
        hessian = np.zeros((size, size))
        gradient = np.zeros(size)
        hessian[:nv, :nv] = rows.T @ rows
        gradient[:nv] = -rows.T @ values
        diagonal = np.full(size, gains.force_weight)
        diagonal[:nv], diagonal[-1] = DAMPING, SLACK_WEIGHT
        posture_weights = self._joint_weights()
        diagonal[6:nv] += posture_weights
        hessian[np.diag_indices(size)] += diagonal
        gradient[6:nv] -= posture_weights * self._posture_acceleration(n)

        force_map = np.zeros((nv, nf))
        friction = np.zeros((SIDES * nf // 3, size))
        at = row = 0
        for i, width in zip(supporting, sizes, strict=True):
            points, motion = self.points[i], motions[i]
            force_map[:, at : at + width] = motion.jacobian.T @ points.map(motion.rotation_W)
            desired = points.distribute(self.references.forces_W[n, i], self._pressure(n, i, motion))
            desired += points.twist(float(self.references.moments_W[n, i] @ motion.rotation_W[:, 2]), motion.rotation_W)
            gradient[nv + at : nv + at + width] = -gains.force_weight * desired
            cone = self.pyramids[max(self._surface(n, i), 0)]
            for p in range(points.count):
                friction[row : row + SIDES, nv + at + 3 * p : nv + at + 3 * p + 3] = cone
                row += SIDES
            at += width
        inertia, bias = self.dynamics.inertia, self.dynamics.bias
        equality = np.zeros((6, size))
        equality[:, :nv], equality[:, nv:-1] = inertia[:6], -force_map[:6]
        torque = np.zeros((nv - 6, size))
        torque[:, :nv], torque[:, nv:-1] = inertia[6:], -force_map[6:]
        weakest, strongest = self.motors.bounds(self.dynamics.velocity[6:])
        limits, low, high = self._limits(n, size)
        problem = Problem(
            hessian,
            gradient,
            equality,
            -bias[:6],
            np.vstack([torque, friction, limits]),
            np.concatenate([weakest - bias[6:], np.zeros(len(friction)), low]),
            np.concatenate([strongest - bias[6:], np.full(len(friction), np.inf), high]),
        )
        return problem, supporting, force_map

    def _limits(self, n: int, size: int) -> tuple[Array, Array, Array]:
        """Rows of what holds but for the slack, and their bounds: positions and speeds of joints, links kept apart."""
        nj, nv = self.nv - 6, self.nv
        (low, high), far = self._joint_bounds(), np.full(nj, np.inf)
        apart, least = np.zeros((0, nv)), np.zeros(0)
        if self.separation is not None:
            free = ~self.references.returns[n] & [contact.mode is Mode.FREE for contact in self.contacts]
            apart, least = self.separation.rows(self.dynamics, free)
        limits = np.zeros((2 * nj + len(apart), size))
        joints = np.arange(nj)
        limits[joints, 6 + joints] = limits[nj + joints, 6 + joints] = 1.0
        limits[2 * nj :, :nv] = apart
        limits[:, -1] = 1.0
        limits[nj : 2 * nj, -1] = -1.0
        return (
            limits,
            np.concatenate([low, -far, least]),
            np.concatenate([far, high, np.full(len(apart), np.inf)]),
        )

    def _tasks(self, n: int, motions: list[EndEffectorMotion]) -> tuple[Array, Array]:
        """Rows sqrt(w) J and values sqrt(w) (a - drift), all tasks stacked; joints' posture apart."""
        dynamics, ref, gains = self.dynamics, self.references, self.gains
        jacobians, values = [], []

        def add(weight: float, jacobian: Array, drift: Array, desired: Array) -> None:
            root = np.sqrt(weight)
            jacobians.append(root * jacobian)
            values.append(root * (desired - drift))

        desired = _follow(
            gains.com_kp,
            ref.com_W[n] - dynamics.com_W,
            ref.com_velocity_W[n] - dynamics.com_velocity_W,
            ref.com_acceleration_W[n] - self.unknown.acceleration_W,
        )
        add(gains.com_weight, dynamics.com_jacobian, dynamics.com_drift, desired)
        rotation = rotation_vector(ref.base_WB[n] @ dynamics.base_WB.T)
        feed = 0.0 if ref.base_acceleration_W is None else ref.base_acceleration_W[n]
        desired = _follow(gains.base_kp, rotation, ref.base_velocity_W[n] - dynamics.base_velocity_W, feed)
        add(gains.base_weight, dynamics.base_jacobian, dynamics.base_drift, desired)
        desired = ref.momentum_rate_W[n] + gains.momentum_kp * (ref.momentum_W[n] - dynamics.momentum_W)
        add(gains.momentum_weight, dynamics.momentum_map, dynamics.momentum_drift, desired)
        for i, (contact, motion) in enumerate(zip(self.contacts, motions, strict=True)):
            rows = slice(0, 6) if self.flat[i] else slice(0, 3)
            if contact.mode is Mode.CONTACT:
                error = np.concatenate(
                    [
                        contact.position_W - motion.position_W,
                        rotation_vector(contact.rotation_W @ motion.rotation_W.T),
                    ]
                )
                desired = _follow(gains.contact_kp, error, -motion.velocity_W, 0.0)
                weight = gains.contact_weight if self.flat[i] or self.feet[i] else gains.hand_weight
            elif contact.mode is Mode.SEARCH or ref.returns[n, i]:
                target_W, velocity_W = ref.end_effectors_W[n, i], ref.end_effector_velocities_W[n, i]
                if contact.mode is Mode.SEARCH:
                    # Down from where the foot is: the reference stays at the height at which the ground was to be.
                    normal = self.normals[self._surface(n, i)]
                    above_m = normal @ (target_W - contact.position_W)
                    target_W = target_W - (max(above_m, 0.0) + contact.search_depth_m) * normal
                    velocity_W = velocity_W - (normal @ velocity_W + contact.search_speed) * normal
                error = np.concatenate(
                    [target_W - motion.position_W, rotation_vector(ref.soles_W[n, i] @ motion.rotation_W.T)]
                )
                rate = np.concatenate([velocity_W, ref.sole_velocities_W[n, i]]) - motion.velocity_W
                turning = np.zeros(3) if ref.sole_accelerations_W is None else ref.sole_accelerations_W[n, i]
                feed = np.concatenate([ref.end_effector_accelerations_W[n, i], turning])
                desired = _follow(gains.swing_kp, error, rate, feed)
                weight = gains.swing_weight
                if self.flat[i]:
                    sole_weight = weight * (
                        _sole_weight(ref.swing_fraction[n, i]) if contact.mode is Mode.FREE else 1.0
                    )
                    add(sole_weight, motion.jacobian[3:], motion.drift[3:], desired[3:])
                rows = slice(0, 3)
            else:
                continue  # it is never in contact again: the posture task moves it
            add(weight, motion.jacobian[rows], motion.drift[rows], desired[rows])
        return np.vstack(jacobians), np.concatenate(values)

    def _pressure(self, n: int, end: int, motion: EndEffectorMotion) -> Array:
        """(2,) the planned centre of pressure in the contact frame [m]."""
        offset = self.references.pressure_W[n, end] - self.references.end_effectors_W[n, end]
        return (motion.rotation_W.T @ offset)[:2]

    def _joint_weights(self) -> Array:
        gains = self.gains
        if self.joints.timed:
            return np.full(self.nv - 6, gains.joint_weight)
        return np.where(self.legs, gains.leg_posture_weight, gains.posture_weight)

    def _posture_acceleration(self, n: int) -> Array:
        position, velocity, acceleration = self.joints.at(n)
        kp = self.gains.joint_kp if self.joints.timed else self.gains.posture_kp
        error, rate = position - self.dynamics.configuration[7:], velocity - self.dynamics.velocity[6:]
        return _follow(kp, error, rate, acceleration)

    def _joint_bounds(self) -> tuple[Array, Array]:
        """Least and largest acceleration (nj,) that keep positions and speeds within their limits."""
        position, velocity = self.dynamics.configuration[7:], self.dynamics.velocity[6:]
        low = LIMIT_KP * (self.lower - position) - LIMIT_KD * velocity
        high = LIMIT_KP * (self.upper - position) - LIMIT_KD * velocity
        fastest = self.motors.velocity_limits
        low = np.maximum(low, (-fastest - velocity) / SPEED_HORIZON_S)
        high = np.minimum(high, (fastest - velocity) / SPEED_HORIZON_S)
        return np.minimum(low, LIMIT_MARGIN), np.maximum(high, -LIMIT_MARGIN)


def _sole_weight(swing_fraction: float) -> float:
    """Weight of the direction of a sole during a swing: small, until it is about to land.

    A foot kept level while it is high asks more of the ankle than it has, and the controller would lift the trunk
    instead.
    """
    return float(max(0.02, (2.0 * swing_fraction - 1.0) ** 4))


def _follow(kp: float, error: Array, rate: Array, feed: Array | float) -> Array:
    """Acceleration of a critically damped approach: a + kp e + 2 sqrt(kp) de/dt."""
    return np.asarray(feed + kp * error + 2.0 * np.sqrt(kp) * rate)
