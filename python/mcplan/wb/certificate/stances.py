"""Stances on a line: two point feet, or the edges of feet, about whose line no contact force gives a moment.

Joints that move as the motion says and points that stay leave one coordinate: the angle phi by which the robot as a whole is
rotated about the line, away from the motion. Of the angular momentum about the line

    (H phi')' = -r + m e . (((exp(phi e) - 1) (c - p)) x g),    phi = phi' = 0 where the stance begins,

with the unit vector e along the line through p, inertia H about it, CoM c, mass m, gravity g, and the moment r about the line
that inverse dynamics of the motion ask for. H, and the motion's angular momentum about e, do not depend on phi. The motion is
integrated as flights are, and what a moment that is missing does is looked at where the stance ends.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .inputs import CertifiedMotion
from .result import MotionViolation, worse
from .robot import CertifiedRobot
from .states import States, states_of

Array = NDArray[np.float64]

#: Step of the integration [s], at most.
STEP_S = 1e-3
#: Points so near to each other, or to a line, are one, or on it [m].
SAME_M = 1e-4


@dataclass(frozen=True)
class Stance:
    """A stretch in which all points in contact are on a line.

    Attributes:
        first, last: Nodes at which it begins and ends.
        points: (L, 4) which corners of end-effectors are in contact.
    """

    first: int
    last: int
    points: NDArray[np.bool_]

    def line(self, corners_W: Array) -> tuple[Array, Array]:
        """(k, 3) points on the line and (k, 3) directions along it, of corners (k, L, 4, 3)."""
        points = corners_W[:, self.points]
        middle = points.mean(axis=1)
        directions = np.linalg.svd(points - middle[:, None])[2][:, 0]
        return middle, directions


def stances(motion: CertifiedMotion, robot: CertifiedRobot) -> list[Stance]:
    """The stances on a line; with the same contacts they are one."""
    changes = np.flatnonzero((np.diff(motion.contacts, axis=0) != 0).any(axis=1)) + 1
    edges = [0, *changes.tolist(), len(motion.contacts)]
    found = []
    for first, last in zip(edges[:-1], edges[1:], strict=True):
        points = np.repeat((motion.contacts[first] >= 0)[:, None], motion.corner_points_S.shape[1], axis=1)
        if not points.any() or _areas(motion)[points.any(axis=1)].any():
            continue
        corners = states_of(motion, robot, motion.times_s[first : first + 1]).corners_W[0][points]
        sizes = np.linalg.svd(corners - corners.mean(axis=0), compute_uv=False)
        if sizes[1] < SAME_M < sizes[0]:
            found.append(Stance(first, last, points))
    return found


def _areas(motion: CertifiedMotion) -> NDArray[np.bool_]:
    """(L,) whether the corners of an end-effector are not on a line."""
    corners = motion.corner_points_S - motion.corner_points_S.mean(axis=1, keepdims=True)
    return np.asarray(np.linalg.svd(corners, compute_uv=False)[:, 1] >= SAME_M)


def about_lines(motion: CertifiedMotion, states: States, found: list[Stance]) -> Array:
    """(N, 6) the part of what is missing on the base that is a moment about the line of a stance."""
    out = np.zeros_like(states.residual_W)
    for stance in found:
        start, end = motion.times_s[stance.first], motion.times_s[stance.last]
        inside = np.flatnonzero((states.times >= start) & (states.times < end))
        points, along = stance.line(states.corners_W[inside])
        out[inside, 3:] = missing_moments(states, inside, points, along)[:, None] * along
    return out


def missing_moments(states: States, at: NDArray[np.int64], points: Array, along: Array) -> Array:
    """(k,) moment about lines that is missing: contact forces on them give none."""
    forces, moments = states.residual_W[at, :3], states.residual_W[at, 3:]
    return np.asarray(np.einsum("ki,ki->k", along, moments + np.cross(states.base_W[at] - points, forces)))


def rotations_at_ends(
    motion: CertifiedMotion, robot: CertifiedRobot, found: list[Stance], about: list[MotionViolation]
) -> list[MotionViolation]:
    """The worse of landings (distance, angle, speed) and of where stances end: how far base and landing feet are."""
    off, angle, speed = about
    ends = motion.plan.robot.end_effectors
    for stance in found:
        rotation, rate, line, states = _rotated(motion, robot, stance)
        point, along = line
        time, base = float(states.times[-1]), states.base_W[-1]
        turn = np.degrees(np.linalg.norm(rotation))
        angle = worse(angle, replace(angle, value=float(turn), time_s=time, end_effector=""))
        matrix = _exponential(rotation * along)
        to_base = matrix @ (base - point)
        change = rate * np.cross(along, to_base) + matrix @ states.rates[-1, :3] - states.rates[-1, :3]
        speed = worse(speed, replace(speed, value=float(np.linalg.norm(change)), time_s=time, end_effector=""))
        places = {
            "": base,
            **{ends[e].name: states.positions_W[-1, e] for e in np.flatnonzero(states.contacts[-1] >= 0)},
        }
        for name, place in places.items():
            missed = float(np.linalg.norm(point + matrix @ (place - point) - place))
            off = worse(off, replace(off, value=missed, time_s=time, end_effector=name))
    return [off, angle, speed]


def _rotated(
    motion: CertifiedMotion, robot: CertifiedRobot, stance: Stance
) -> tuple[float, float, tuple[Array, Array], States]:
    """Angle and its rate at the end of a stance by Runge and Kutta's method, the line, and what the motion says."""
    start, end = motion.times_s[stance.first], motion.times_s[stance.last]
    steps = max(1, int(np.ceil((end - start) / STEP_S)))
    times = np.linspace(start, end, 2 * steps + 1)  # with the middles
    states = states_of(motion, robot, times)
    lines = stance.line(states.corners_W)
    along = lines[1] * np.sign(lines[1] @ lines[1][0])[:, None]
    missing = missing_moments(states, np.arange(len(times)), lines[0], along)
    inertias, arms, mass = _inertias(robot, states, lines[0], along)
    gravity_W = np.array([0.0, 0.0, -float(motion.plan.scene.gravity)])

    def slope(k: int, y: Array) -> Array:
        """Of the angle and of H times its rate."""
        fallen = _exponential(y[0] * along[k]) @ arms[k] - arms[k]
        return np.array([y[1] / inertias[k], mass * along[k] @ np.cross(fallen, gravity_W) - missing[k]])

    y = np.zeros(2)
    for i in range(steps):
        k, h = 2 * i, times[2 * i + 2] - times[2 * i]
        first = slope(k, y)
        second = slope(k + 1, y + 0.5 * h * first)
        third = slope(k + 1, y + 0.5 * h * second)
        y = y + h / 6.0 * (first + 2.0 * (second + third) + slope(k + 2, y + h * third))
    return float(y[0]), float(y[1] / inertias[-1]), (lines[0][-1], along[-1]), states


def _inertias(robot: CertifiedRobot, states: States, points: Array, along: Array) -> tuple[Array, Array, float]:
    """(k,) inertias about lines, (k, 3) the CoM from their points, and the mass."""
    import pinocchio as pin  # type: ignore[import-untyped]

    model, data = robot.model, robot.model.createData()
    mass = float(pin.computeTotalMass(model))
    inertias, arms = np.zeros(len(states.times)), states.com_W - points
    for k in range(len(states.times)):
        pin.ccrba(model, data, states.q[k], states.v[k])
        inertias[k] = along[k] @ data.Ig.inertia @ along[k] + mass * np.sum(np.cross(along[k], arms[k]) ** 2)
    return inertias, arms, mass


def _exponential(rotation: Array) -> Array:
    import pinocchio as pin

    return np.asarray(pin.exp3(rotation))
