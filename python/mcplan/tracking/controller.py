"""Whole-body inverse dynamics as a quadratic program over joint accelerations and contact forces.

    min   sum_tasks w |J qdd + drift - a|^2  +  w_f |f - f_plan|^2  +  w_s s^2
    s.t.  the six rows of  M qdd + h = S' tau + sum J_c' f  that no joint drives
          |tau| <= limit,  f in friction pyramids,  joint positions within their limits but for a slack s

Without forces and slack the program has a solution at any state: some acceleration of the base balances any torques. Contacts
are tasks of great weight and not equations for the same reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import minimal_rotation, polygon_normal, rotation_vector
from mcplan.kinematics.urdf_model import UrdfModel

from .contact_forces import SIDES, ForcePoints, pyramid
from .contacts import Contact, Mode
from .options import Gains
from .quadratic_program import Problem, QuadraticProgram
from .references import References
from .rigid_body import EndMotion, RigidBody

if TYPE_CHECKING:
    from mcplan._core import Scene

Array = NDArray[np.float64]

#: Joints are kept from their limits by bounds of acceleration: -kp (q - limit) - kd v, at least this much [rad/s^2].
LIMIT_KP, LIMIT_KD, LIMIT_ROOM = 900.0, 60.0, 50.0
SLACK_WEIGHT = 10.0
#: Of the program's Hessian, for accelerations that no task asks for.
DAMPING = 1e-4


@dataclass(frozen=True)
class Command:
    """What the controller decided.

    Attributes:
        torques: (nj,) [N m], within their limits.
        solved: Whether the program was solved; if not, the torques are those of the last one that was.
    """

    torques: Array
    solved: bool


class Controller:
    """Tracks references with a robot. Call once a control step."""

    def __init__(self, loaded: UrdfModel, scene: Scene, references: References, posture: Array, gains: Gains) -> None:
        """
        Args:
            loaded: The robot.
            scene: Surfaces that the references name.
            references: What to do, at each control step.
            posture: (nq,) or (n, nq) configurations whose joints to stay near to.
            gains: Weights and gains.
        """
        self.loaded, self.references, self.gains = loaded, references, gains
        self.body = RigidBody(loaded)
        model = loaded.model
        self.nv, self.limits = model.nv, np.asarray(model.effortLimit[6:], float)
        self.lower, self.upper = model.lowerPositionLimit[7:].copy(), model.upperPositionLimit[7:].copy()
        self.posture = np.atleast_2d(posture)[:, 7:]
        self.normals = [polygon_normal(np.asarray(s.vertices_W)) for s in scene.surfaces]
        self.pyramids = [pyramid(n, s.friction) for n, s in zip(self.normals, scene.surfaces, strict=True)]
        ends = loaded.robot.end_effectors
        self.points = [ForcePoints.of(e.half_size) for e in ends]
        self.flat = [p.count > 1 for p in self.points]
        self.contacts = [Contact() for _ in ends]
        self.qp = QuadraticProgram()
        self.torques = np.zeros(self.nv - 6)
        self.surfaces = [np.asarray(s.vertices_W, float) for s in scene.surfaces]
        for end, contact in enumerate(self.contacts):
            if references.surfaces[0, end] >= 0:
                contact.mode = Mode.CONTACT
                self._stand(0, end, references.ends_W[0, end], references.soles_W[0, end])

    def step(self, n: int, configuration: Array, velocity: Array, touches: NDArray[np.bool_]) -> Command:
        """Torques for control step n.

        Args:
            n: Index into the references.
            configuration: (nq,) measured, Pinocchio's convention. velocity: (nv,) likewise.
            touches: (e,) whether each end-effector is felt to touch something.
        """
        self.body.update(configuration, velocity)
        ends = [self.body.end(i) for i in range(len(self.contacts))]
        for i, contact in enumerate(self.contacts):
            planned = bool(self.references.surfaces[n, i] >= 0)
            # What never lands again does not land early either: a hand that brushes a wall goes on.
            share = float(self.references.swing_share[n, i] * self.references.returns[n, i])
            if contact.update(planned, bool(touches[i]), share, self.references.dt_s):
                self._stand(n, i, ends[i].position_W, self._landed(n, i, ends[i]))
        problem, bearing, force_map = self._problem(n, ends)
        found = self.qp.solve(problem, tuple(bearing))
        if found is not None:
            acceleration, forces = found[: self.nv], found[self.nv : self.nv + force_map.shape[1]]
            tau = self.body.inertia[6:] @ acceleration + self.body.bias[6:] - force_map[6:] @ forces
            self.torques = np.clip(tau, -self.limits, self.limits)
        return Command(self.torques, found is not None)

    def _stand(self, n: int, end: int, position_W: Array, rotation_W: Array) -> None:
        """Take an end-effector's contact to be here, and work out where it bears force."""
        contact, surface = self.contacts[end], self._surface(n, end)
        contact.position_W, contact.rotation_W = position_W, rotation_W
        if self.flat[end] and surface >= 0:
            outline_F = (self.surfaces[surface] - position_W) @ rotation_W
            self.points[end] = ForcePoints.of(self.loaded.robot.end_effectors[end].half_size, outline_F[:, :2])

    def _landed(self, n: int, end: int, motion: EndMotion) -> Array:
        """Orientation to hold after touching down: flat on the surface, in the direction that the foot has."""
        surface = self._surface(n, end)
        if not self.flat[end] or surface < 0:
            return motion.rotation_W
        turn = minimal_rotation(motion.rotation_W[:, 2], self.normals[surface])
        return turn @ motion.rotation_W

    def _surface(self, n: int, end: int) -> int:
        """The surface on which an end-effector stands or will land next; -1: none."""
        ahead = self.references.surfaces[n:, end]
        on = np.flatnonzero(ahead >= 0)
        return int(ahead[on[0]]) if len(on) else -1

    def _problem(self, n: int, ends: list[EndMotion]) -> tuple[Problem, list[int], Array]:
        nv, gains = self.nv, self.gains
        bearing = [i for i, c in enumerate(self.contacts) if c.mode is Mode.CONTACT]
        sizes = [3 * self.points[i].count for i in bearing]
        nf = sum(sizes)
        size = nv + nf + 1
        rows, values = self._tasks(n, ends)
        hessian = np.zeros((size, size))
        gradient = np.zeros(size)
        hessian[:nv, :nv] = rows.T @ rows
        gradient[:nv] = -rows.T @ values
        diagonal = np.full(size, gains.force_weight)
        diagonal[:nv], diagonal[-1] = DAMPING, SLACK_WEIGHT
        diagonal[6:nv] += gains.posture_weight
        hessian[np.diag_indices(size)] += diagonal
        gradient[6:nv] -= gains.posture_weight * self._posture_acceleration(n)

        force_map = np.zeros((nv, nf))
        friction = np.zeros((SIDES * nf // 3, size))
        at = row = 0
        for i, width in zip(bearing, sizes, strict=True):
            points, motion = self.points[i], ends[i]
            force_map[:, at : at + width] = motion.jacobian.T @ points.map(motion.rotation_W)
            wanted = points.share(self._planned_force(n, i), self._pressure(n, i, motion))
            wanted += points.twist(float(self.references.moments_W[n, i] @ motion.rotation_W[:, 2]), motion.rotation_W)
            gradient[nv + at : nv + at + width] = -gains.force_weight * wanted
            cone = self.pyramids[max(self._surface(n, i), 0)]
            for p in range(points.count):
                friction[row : row + SIDES, nv + at + 3 * p : nv + at + 3 * p + 3] = cone
                row += SIDES
            at += width
        inertia, bias, nj = self.body.inertia, self.body.bias, nv - 6
        equality = np.zeros((6, size))
        equality[:, :nv], equality[:, nv:-1] = inertia[:6], -force_map[:6]
        torque = np.zeros((nj, size))
        torque[:, :nv], torque[:, nv:-1] = inertia[6:], -force_map[6:]
        low, high = self._joint_bounds()
        limits = np.zeros((2 * nj, size))
        limits[:nj, 6:nv] = limits[nj:, 6:nv] = np.eye(nj)
        limits[:nj, -1], limits[nj:, -1] = 1.0, -1.0
        far = np.full(nj, np.inf)
        problem = Problem(
            hessian,
            gradient,
            equality,
            -bias[:6],
            np.vstack([torque, friction, limits]),
            np.concatenate([-self.limits - bias[6:], np.zeros(len(friction)), low, -far]),
            np.concatenate([self.limits - bias[6:], np.full(len(friction), np.inf), far, high]),
        )
        return problem, bearing, force_map

    def _tasks(self, n: int, ends: list[EndMotion]) -> tuple[Array, Array]:
        """Rows sqrt(w) J and values sqrt(w) (a - drift), all tasks stacked; joints' posture apart."""
        body, ref, gains = self.body, self.references, self.gains
        jacobians, values = [], []

        def add(weight: float, jacobian: Array, drift: Array, wanted: Array) -> None:
            root = np.sqrt(weight)
            jacobians.append(root * jacobian)
            values.append(root * (wanted - drift))

        wanted = _follow(
            gains.com_kp,
            ref.com_W[n] - body.com_W,
            ref.com_velocity_W[n] - body.com_velocity_W,
            ref.com_acceleration_W[n],
        )
        add(gains.com_weight, body.com_jacobian, body.com_drift, wanted)
        turn = rotation_vector(ref.base_WB[n] @ body.base_WB.T)
        wanted = _follow(gains.base_kp, turn, ref.base_velocity_W[n] - body.base_velocity_W, 0.0)
        add(gains.base_weight, body.base_jacobian, body.base_drift, wanted)
        wanted = ref.momentum_rate_W[n] + gains.momentum_kp * (ref.momentum_W[n] - body.momentum_W)
        add(gains.momentum_weight, body.momentum_map, body.momentum_drift, wanted)
        for i, (contact, motion) in enumerate(zip(self.contacts, ends, strict=True)):
            rows = slice(0, 6) if self.flat[i] else slice(0, 3)
            if contact.mode is Mode.CONTACT:
                error = np.concatenate(
                    [
                        contact.position_W - motion.position_W,
                        rotation_vector(contact.rotation_W @ motion.rotation_W.T),
                    ]
                )
                wanted = _follow(gains.contact_kp, error, -motion.velocity_W, 0.0)
                weight = gains.contact_weight if self.flat[i] else gains.hand_weight
            elif contact.mode is Mode.SEARCH or ref.returns[n, i]:
                target = ref.ends_W[n, i]
                if contact.mode is Mode.SEARCH:
                    target = target - contact.search_depth_m * self.normals[self._surface(n, i)]
                error = np.concatenate(
                    [target - motion.position_W, rotation_vector(ref.soles_W[n, i] @ motion.rotation_W.T)]
                )
                rate = np.concatenate([ref.end_velocities_W[n, i], ref.sole_velocities_W[n, i]]) - motion.velocity_W
                feed = np.concatenate([ref.end_accelerations_W[n, i], np.zeros(3)])
                wanted = _follow(gains.swing_kp, error, rate, feed)
                weight = gains.swing_weight
                if self.flat[i]:
                    turning = weight * (_sole_matters(ref.swing_share[n, i]) if contact.mode is Mode.FREE else 1.0)
                    add(turning, motion.jacobian[3:], motion.drift[3:], wanted[3:])
                rows = slice(0, 3)
            else:
                continue  # it never touches anything again: the posture has it
            add(weight, motion.jacobian[rows], motion.drift[rows], wanted[rows])
        return np.vstack(jacobians), np.concatenate(values)

    def _planned_force(self, n: int, end: int) -> Array:
        return self.references.forces_W[n, end]

    def _pressure(self, n: int, end: int, motion: EndMotion) -> Array:
        """(2,) the planned centre of pressure in the contact frame [m]."""
        offset = self.references.pressure_W[n, end] - self.references.ends_W[n, end]
        return (motion.rotation_W.T @ offset)[:2]

    def _posture_acceleration(self, n: int) -> Array:
        posture = self.posture[min(n, len(self.posture) - 1)]
        error = posture - self.body.configuration[7:]
        return _follow(self.gains.posture_kp, error, -self.body.velocity[6:], 0.0)

    def _joint_bounds(self) -> tuple[Array, Array]:
        position, velocity = self.body.configuration[7:], self.body.velocity[6:]
        low = LIMIT_KP * (self.lower - position) - LIMIT_KD * velocity
        high = LIMIT_KP * (self.upper - position) - LIMIT_KD * velocity
        return np.minimum(low, LIMIT_ROOM), np.maximum(high, -LIMIT_ROOM)


def _sole_matters(swing_share: float) -> float:
    """How much the direction of a sole counts on its way through the air: little, until it is about to land.

    A foot kept level while it is high asks more of the ankle than it has, and the controller would lift the body instead.
    """
    return float(max(0.02, (2.0 * swing_share - 1.0) ** 4))


def _follow(kp: float, error: Array, rate: Array, feed: Array | float) -> Array:
    """Acceleration of a critically damped approach: a + kp e + 2 sqrt(kp) de/dt."""
    return np.asarray(feed + kp * error + 2.0 * np.sqrt(kp) * rate)
