"""A whole-body plan sampled for drawing: links, joints, torques, contact points and their forces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mcplan._core import PlanarPlan, PlanarRobot, PlanarState

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PlanarSamples:
    """States of a whole-body plan at n times.

    b links, j joints, e end-effectors, at most p points of an end-effector; lengths in [m], angles in [rad], forces in
    [N], in the world's plane (x forward, y up). What belongs to a contact is NaN where the end-effector has none.
    """

    times_s: Array  # (n,)
    phases: NDArray[np.int64]  # (n,)
    base: Array  # (n, 3) x, y, angle
    q: Array  # (n, j)
    velocity: Array  # (n, j) [rad/s]
    torque: Array  # (n, j) [N m]
    com_W: Array  # (n, 2)
    positions_W: Array  # (n, b, 2) joints of the links
    angles: Array  # (n, b)
    soles_W: Array  # (n, e, 2) contact frames
    sole_angles: Array  # (n, e)
    surfaces: NDArray[np.int64]  # (n, e), -1: free
    points_W: Array  # (n, e, p, 2) where forces act
    forces_W: Array  # (n, e, p, 2)
    tangential: Array  # (n, e, p)
    normal: Array  # (n, e, p)
    friction: Array  # (n, e) coefficient of the surface in contact
    errors: Array  # (n, e, 3) actual minus expected x, y, angle

    @property
    def count(self) -> int:
        return len(self.times_s)


def sample_whole_body(plan: PlanarPlan, times_s: Array) -> PlanarSamples:
    """The plan at the given times [s]; at a boundary the phase that begins there."""
    last = float(plan.duration())
    return _samples(plan, [plan.at(min(float(t), last)) for t in times_s])


def sample_phases(plan: PlanarPlan, rate_hz: float) -> PlanarSamples:
    """Every phase at about `rate_hz`, its start and end included: boundaries come twice, once from either side."""
    states = []
    for k, duration in enumerate(plan.durations):
        count = max(2, round(float(duration) * rate_hz) + 1)
        states += [plan.at_phase(k, float(t)) for t in np.linspace(0.0, float(duration), count)]
    return _samples(plan, states)


def frame_times(duration_s: float, rate_hz: float) -> Array:
    """Equally spaced times [s] at about `rate_hz`, start and end included."""
    return np.linspace(0.0, duration_s, max(2, round(duration_s * rate_hz) + 1))


def body_frames(robot: PlanarRobot, base: Array, q: Array) -> tuple[Array, Array]:
    """Joints (n, b, 2) [m] and angles (n, b) [rad] of the links, for bases (n, 3) and joints (n, j)."""
    positions = np.empty((len(base), len(robot.bodies), 2))
    angles = np.empty(positions.shape[:2])
    for i, body in enumerate(robot.bodies):
        if i == 0:
            positions[:, 0], angles[:, 0] = base[:, :2], base[:, 2]
            continue
        parent = int(body.parent)
        positions[:, i] = positions[:, parent] + rotated(angles[:, parent], body.joint_P)
        angles[:, i] = angles[:, parent] + float(body.offset) + q[:, i - 1]
    return positions, angles


def rotated(angles: Array, vector: Array) -> Array:
    """A vector (2,), or one for each angle, rotated by angles (n,) [rad]: (n, 2)."""
    x, y = np.moveaxis(np.asarray(vector, float), -1, 0)
    cos, sin = np.cos(angles), np.sin(angles)
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def _samples(plan: PlanarPlan, states: list[PlanarState]) -> PlanarSamples:
    robot, task = plan.task.robot, plan.task
    end_effectors, n = robot.end_effectors, len(states)
    base = np.array([s.configuration.base for s in states], float)
    q = np.array([s.configuration.q for s in states], float).reshape(n, -1)
    positions, angles = body_frames(robot, base, q)
    of = [int(end.body) for end in end_effectors]
    soles = [positions[:, b] + rotated(angles[:, b], end.position_B) for b, end in zip(of, end_effectors, strict=True)]
    sole_angles = [angles[:, b] + float(end.angle_B) for b, end in zip(of, end_effectors, strict=True)]
    max_points = max((len(end.points) for end in end_effectors), default=0)
    points, forces = np.full((2, n, len(end_effectors), max_points, 2), np.nan)
    tangential, normal = np.full((2, n, len(end_effectors), max_points), np.nan)
    surfaces = np.full((n, len(end_effectors)), -1)
    friction = np.full((n, len(end_effectors)), np.nan)
    errors = np.full((n, len(end_effectors), 3), np.nan)
    for i, state in enumerate(states):
        for contact, error in zip(task.phases[state.phase].contacts, state.contact_error, strict=True):
            surfaces[i, contact.end_effector] = contact.surface
            friction[i, contact.end_effector] = task.surfaces[contact.surface].friction
            errors[i, contact.end_effector] = error
        for force in state.forces:
            at = (i, force.end_effector, force.point)
            points[at], forces[at] = force.position_W, force.force_W
            tangential[at], normal[at] = force.tangential, force.normal
    return PlanarSamples(
        times_s=np.array([s.time for s in states], float),
        phases=np.array([s.phase for s in states], int),
        base=base,
        q=q,
        velocity=np.array([s.configuration.velocity for s in states], float).reshape(n, -1),
        torque=np.array([s.torque for s in states], float).reshape(n, -1),
        com_W=np.array([s.com_W for s in states], float),
        positions_W=positions,
        angles=angles,
        soles_W=np.stack(soles, axis=1),
        sole_angles=np.stack(sole_angles, axis=1),
        surfaces=surfaces,
        points_W=points,
        forces_W=forces,
        tangential=tangential,
        normal=normal,
        friction=friction,
        errors=errors,
    )
