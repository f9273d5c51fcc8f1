"""Postures of planar robots that stand still on their contacts: kinematics of its own, SciPy for the rest.

A posture is base x, y [m], angle [rad] and the joints [rad], in one vector.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import OptimizeResult, least_squares, linprog

import mcplan as mp

RANGE_MARGIN = 0.02  # of a joint's range, kept at both ends
BALANCE = 0.2  # weight of CoM over contacts [1], against 1 per [m] and [rad] of a contact
COMFORT = 0.02  # weight of joints at rest


@dataclass
class Standing:
    """A posture with its contact error [m, rad] and the smallest possible largest share of a torque limit."""

    posture: np.ndarray
    error: float
    load: float


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]])


def frames(robot: mp.PlanarRobot, posture: np.ndarray) -> tuple[list[np.ndarray], list[float]]:
    """Origin [m] and angle [rad] of each body."""
    origins, angles = [posture[:2].copy()], [float(posture[2])]
    for number, body in enumerate(robot.bodies[1:]):
        origins.append(origins[body.parent] + turned(body.joint_P, angles[body.parent]))
        angles.append(angles[body.parent] + body.offset + posture[3 + number])
    return origins, angles


def jacobian(robot: mp.PlanarRobot, body: int, point_W: np.ndarray, origins: list[np.ndarray]) -> np.ndarray:
    """How a point of a body moves with the posture: 2 x (3 + joints)."""
    out = np.zeros((2, 2 + len(robot.bodies)))
    out[:, :2] = np.eye(2)
    out[:, 2] = turned(point_W - origins[0], np.pi / 2)
    while body > 0:
        out[:, 2 + body] = turned(point_W - origins[body], np.pi / 2)
        body = robot.bodies[body].parent
    return out


def contact_error(task: mp.PlanarTask, phase: int, posture: np.ndarray) -> np.ndarray:
    """x, y [m] and angle [rad] of each contact, actual minus expected."""
    origins, angles = frames(task.robot, posture)
    out = []
    for contact in task.phases[phase].contacts:
        end = task.robot.end_effectors[contact.end_effector]
        out += [*(origins[end.body] + turned(end.position_B, angles[end.body]) - contact.position_W)]
        out.append(angles[end.body] + end.angle_B - contact.angle)
    return np.array(out)


def stand(task: mp.PlanarTask, phase: int, posture: np.ndarray, rest: np.ndarray) -> Standing:
    """The posture of a phase near a given one, joints near `rest`, CoM over the contacts where it can be."""
    robot = task.robot
    low = np.array([body.position_min for body in robot.bodies[1:]])
    high = np.array([body.position_max for body in robot.bodies[1:]])
    inset = RANGE_MARGIN * (high - low)
    free = [np.inf] * 3
    bounds = np.r_[np.negative(free), low + inset], np.r_[free, high - inset]
    middle = np.mean([contact.position_W[0] for contact in task.phases[phase].contacts])

    def residual(x: np.ndarray) -> np.ndarray:
        balance = BALANCE * (com(robot, x)[0] - middle)
        return np.r_[contact_error(task, phase, x), balance, COMFORT * (x[3:] - rest)]

    def exact(x: np.ndarray) -> np.ndarray:
        return np.r_[contact_error(task, phase, x), 1e-4 * residual(x)[-1 - rest.size :]]

    start = np.clip(posture, bounds[0], bounds[1])
    near: OptimizeResult = least_squares(residual, start, bounds=bounds)
    found = least_squares(exact, np.clip(near.x, bounds[0], bounds[1]), bounds=bounds, xtol=1e-12, ftol=1e-12)
    error = float(np.abs(contact_error(task, phase, found.x)).max())
    return Standing(found.x, error, least_load(task, phase, found.x))


def com(robot: mp.PlanarRobot, posture: np.ndarray) -> np.ndarray:
    """Centre of mass [m]."""
    origins, angles = frames(robot, posture)
    moments = [
        body.mass * (origin + turned(body.com_B, angle))
        for body, origin, angle in zip(robot.bodies, origins, angles, strict=True)
    ]
    return np.sum(moments, axis=0) / robot.mass()


def least_load(task: mp.PlanarTask, phase: int, posture: np.ndarray) -> float:
    """Smallest largest |torque| / limit of all forces in their cones that hold the posture still; infinity: none do.

    A linear program over tangential and normal forces (share of the weight) and the load.
    """
    robot = task.robot
    origins, angles = frames(robot, posture)
    weight = robot.mass() * robot.gravity
    gravity = np.zeros(posture.size)
    for number, body in enumerate(robot.bodies):
        point_W = origins[number] + turned(body.com_B, angles[number])
        gravity += body.mass * robot.gravity * jacobian(robot, number, point_W, origins)[1]
    columns, cones = [], []
    for contact in task.phases[phase].contacts:
        surface, end = task.surfaces[contact.surface], robot.end_effectors[contact.end_effector]
        for point in end.points:
            lever = jacobian(robot, end.body, contact.position_W + point * surface.tangent_W, origins)
            columns += [lever.T @ surface.tangent_W, lever.T @ surface.normal_W]
            cones.append(surface.friction)
    lift = weight * np.array(columns).T
    limits = np.array([body.torque_max for body in robot.bodies[1:]])
    share, still = lift[3:] / limits[:, None], gravity[3:] / limits
    ones = np.ones((limits.size, 1))
    rows = [np.hstack([-share, -ones]), np.hstack([share, -ones])]
    for number, friction in enumerate(cones):
        cone = np.zeros((2, lift.shape[1] + 1))
        cone[:, 2 * number], cone[:, 2 * number + 1] = (1.0, -1.0), -friction
        rows.append(cone)
    found = linprog(
        np.r_[np.zeros(lift.shape[1]), 1.0],
        A_ub=np.vstack(rows),
        b_ub=np.r_[-still, still, np.zeros(2 * len(cones))],
        A_eq=np.hstack([lift[:3], np.zeros((3, 1))]) / weight,
        b_eq=gravity[:3] / weight,
        bounds=[(None, None)] * lift.shape[1] + [(0.0, None)],
    )
    return float(found.x[-1]) if found.success else float("inf")
