"""Rows of an interval of a planar whole-body motion as CasADi expressions, from the equations alone.

An interval's variables: four control points of each joint, five spacings of knots about it, and the log weights of its
phase's points. Torques, force cones, contact errors and heights of swinging points are taken at instants, sines and
cosines as they are: nothing is expanded.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

TANGENTIAL = 10.0  # weight of tangential forces in the least norm


@dataclass
class Interval:
    """Symbols and rows."""

    variables: Any  #: control points joint by joint, spacings, log weights
    places: Any  #: parameters: x, y, angle of each contact
    rows: Any
    torques: Any  #: joints x instants
    forces: Any  #: tangential and normal of each point, x instants
    cost: Any  #: integral of the squared torques, by quadrature over the instants


def basis(spacings: Any, t: Any) -> Any:
    """Values of the four cubic B-splines at t from the begin of the middle one of five spacings (Cox and de Boor)."""
    knots = [-spacings[0] - spacings[1], -spacings[1], 0.0, spacings[2]]
    knots += [knots[3] + spacings[3], knots[3] + spacings[3] + spacings[4]]
    knots = [None, *knots, None]  # the outermost two do not matter within the middle interval
    middle = 3
    values = {middle: 1.0}
    for degree in (1, 2, 3):
        wider = {}
        for i in range(middle - degree, middle + 1):
            value = 0.0
            if i in values:
                value += (t - knots[i]) / (knots[i + degree] - knots[i]) * values[i]
            if i + 1 in values:
                value += (knots[i + degree + 1] - t) / (knots[i + degree + 1] - knots[i + 1]) * values[i + 1]
            wider[i] = value
        values = wider
    return ca.vertcat(*[values[i] for i in range(middle - 3, middle + 1)])


def rotated(angle: Any, vector: Any) -> tuple[Any, Any]:
    """A vector of a frame in the world."""
    c, s = ca.cos(angle), ca.sin(angle)
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]


def cross(ax: Any, ay: Any, bx: Any, by: Any) -> Any:
    return ax * by - ay * bx


def instant(robot: Any, contacts: list[int], swinging: list[int], friction: float) -> ca.Function:
    """Rows at an instant as a function of joints, velocities, accelerations, log weights and places of contacts."""
    joints = len(robot.bodies) - 1
    q, v, a = (ca.SX.sym(name, joints) for name in "qva")
    ends = [robot.end_effectors[i] for i in contacts]
    points = [point for end in ends for point in end.points]
    logs = ca.SX.sym("log_weight", len(points))
    places = ca.SX.sym("place", 3, len(ends))

    def frames(x: Any, y: Any, angle: Any) -> list[tuple[Any, Any, Any]]:
        out = [(x, y, angle)]
        for j, body in enumerate(robot.bodies[1:]):
            px, py, pa = out[body.parent]
            dx, dy = rotated(pa, body.joint_P)
            out.append((px + dx, py + dy, pa + body.offset + q[j]))
        return out

    def pose(frame: tuple[Any, Any, Any], end: Any) -> tuple[Any, Any, Any]:
        dx, dy = rotated(frame[2], end.position_B)
        return frame[0] + dx, frame[1] + dy, frame[2] + end.angle_B

    still = frames(0.0, 0.0, 0.0)
    loose = [pose(still[end.body], end) for end in ends]
    turn = sum(places[2, i] - loose[i][2] for i in range(len(ends))) / len(ends)
    shifts = [rotated(turn, at[:2]) for at in loose]
    x = sum(places[0, i] - shifts[i][0] for i in range(len(ends))) / len(ends)
    y = sum(places[1, i] - shifts[i][1] for i in range(len(ends))) / len(ends)
    at = frames(x, y, turn)

    coms = []
    for body, frame in zip(robot.bodies, at, strict=True):
        dx, dy = rotated(frame[2], body.com_B)
        coms += [frame[0] + dx, frame[1] + dy, frame[2]]
    stacked = ca.vertcat(*coms)
    speeds = ca.jtimes(stacked, q, v)
    accelerations = ca.reshape(ca.jtimes(speeds, q, v) + ca.jtimes(speeds, v, a), 3, len(robot.bodies))

    sole = [(places[0, i], places[1, i], places[2, i], s) for i, end in enumerate(ends) for s in end.points]
    expected = [(px + s * ca.cos(pa), py + s * ca.sin(pa), pa) for px, py, pa, s in sole]
    mx, my = (sum(e[k] for e in expected) / len(expected) for k in (0, 1))
    need = ca.SX.zeros(3)
    wrench = []
    for b, body in enumerate(robot.bodies):
        fx, fy = body.mass * accelerations[0, b], body.mass * (accelerations[1, b] + robot.gravity)
        moment = body.inertia * accelerations[2, b]
        wrench.append((fx, fy, moment))
        need += ca.vertcat(fx, fy, moment + cross(coms[3 * b] - mx, coms[3 * b + 1] - my, fx, fy))
    columns, gains = [], []
    for (px, py, pa), log in zip(expected, ca.vertsplit(logs), strict=True):
        for weight, dx, dy in ((TANGENTIAL, ca.cos(pa), ca.sin(pa)), (1.0, -ca.sin(pa), ca.cos(pa))):
            columns.append(ca.vertcat(dx, dy, cross(px - mx, py - my, dx, dy)))
            gains.append(1.0 / (weight * ca.exp(log)))
    G = ca.horzcat(*columns)
    gamma = ca.diag(ca.vertcat(*gains))
    forces = gamma @ G.T @ ca.inv(G @ gamma @ G.T) @ need

    sums = [list(w[:2]) + [w[2]] for w in wrench]  # force, and moment about the joint of each body
    for b, frame in enumerate(at):
        sums[b][2] += cross(coms[3 * b] - frame[0], coms[3 * b + 1] - frame[1], wrench[b][0], wrench[b][1])
    actual = [pose(at[end.body], end) for end in ends]
    v_index = 0
    for end, place in zip(ends, actual, strict=True):
        for s in end.points:
            px, py = place[0] + s * ca.cos(place[2]), place[1] + s * ca.sin(place[2])
            f = forces[2 * v_index] * columns[2 * v_index][:2] + forces[2 * v_index + 1] * columns[2 * v_index + 1][:2]
            sums[end.body][0] -= f[0]
            sums[end.body][1] -= f[1]
            frame = at[end.body]
            sums[end.body][2] -= cross(px - frame[0], py - frame[1], f[0], f[1])
            v_index += 1
    for b in range(len(robot.bodies) - 1, 0, -1):
        parent = robot.bodies[b].parent
        dx, dy = at[b][0] - at[parent][0], at[b][1] - at[parent][1]
        sums[parent][0] += sums[b][0]
        sums[parent][1] += sums[b][1]
        sums[parent][2] += sums[b][2] + cross(dx, dy, sums[b][0], sums[b][1])
    torques = ca.vertcat(*[sums[b][2] for b in range(1, len(robot.bodies))])

    cones = [friction * forces[2 * i + 1] + sign * forces[2 * i] for i in range(len(points)) for sign in (-1.0, 1.0)]
    errors = [] if len(ends) == 1 else [actual[i][k] - places[k, i] for i in range(len(ends)) for k in range(3)]
    heights = []
    for end in (robot.end_effectors[i] for i in swinging):
        place = pose(at[end.body], end)
        heights += [place[1] + s * ca.sin(place[2]) for s in end.points]
    rows = ca.vertcat(torques, *cones, *errors, *heights)
    names = ["q", "v", "a", "log_weight", "place"]
    return ca.Function(
        "instant", [q, v, a, logs, places], [rows, torques, forces], names, ["rows", "torques", "forces"]
    )


def chained(robot: Any, contacts: list[int], swinging: list[int], friction: float) -> ca.Function:
    """Rows of an instant and their Jacobian, by hand in two steps: joints by parameters, rows by joints."""
    joints = len(robot.bodies) - 1
    at = instant(robot, contacts, swinging, friction)
    inputs = [ca.SX.sym(at.name_in(i), *at.size_in(i)) for i in range(5)]
    rows = at(*inputs)[0]
    by_joints = ca.Function("by_joints", inputs, [rows, ca.jacobian(rows, ca.vertcat(*inputs[:4]))])
    control, spacing, logs = ca.SX.sym("control", 4, joints), ca.SX.sym("spacing", 5), inputs[3]
    s, t = ca.SX.sym("s"), ca.SX.sym("t")
    values = basis(spacing, t)
    rates = ca.jacobian(values, t)
    bases = ca.Function("bases", [spacing, t], [values, rates, ca.jacobian(rates, t)])
    state = [(b.T @ control).T for b in bases(spacing, 0.5 * (s + 1.0) * spacing[2])]
    variables = ca.vertcat(ca.vec(control), spacing, logs)
    found, jacobian = by_joints(*state, logs, inputs[4])
    by_parameters = ca.jacobian(ca.vertcat(*state, logs), variables)
    return ca.Function("chained", [variables, inputs[4], s], [found, jacobian @ by_parameters])


def lobatto(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in [-1, 1], both ends among them, and weights of the quadrature that is exact to degree 2 count - 3."""
    legendre = np.polynomial.Legendre.basis(count - 1)
    places = np.concatenate([[-1.0], legendre.deriv().roots(), [1.0]])
    return places, 2.0 / (count * (count - 1) * legendre(places) ** 2)


def interval(robot: Any, contacts: list[int], swinging: list[int], friction: float, instants: int) -> Interval:
    """Rows of one interval: those of each instant, positions at 4 and velocities at 3 instants, as many as a hull has."""
    joints = len(robot.bodies) - 1
    at = instant(robot, contacts, swinging, friction)
    count = at.size1_in(3)
    control, spacing, logs = ca.SX.sym("control", 4, joints), ca.SX.sym("spacing", 5), ca.SX.sym("log_weight", count)
    places, t = ca.SX.sym("place", 3, len(contacts)), ca.SX.sym("t")
    values = basis(spacing, t)
    rates = ca.jacobian(values, t)
    bases = ca.Function("bases", [spacing, t], [values, rates, ca.jacobian(rates, t)])

    def motion(s: float) -> list[Any]:
        return [(b.T @ control).T for b in bases(spacing, 0.5 * (s + 1.0) * spacing[2])]

    rows, torques, forces, cost = [], [], [], 0.0
    for s, weight in zip(*lobatto(instants), strict=True):
        found = at(*motion(float(s)), logs, places)
        cost += 0.5 * spacing[2] * float(weight) * ca.sumsqr(found[1])
        rows.append(found[0])
        torques.append(found[1])
        forces.append(found[2])
    rows += [motion(float(s))[0] for s in np.linspace(-1.0, 1.0, 4)]
    rows += [motion(float(s))[1] for s in np.linspace(-1.0, 1.0, 3)]
    variables = ca.vertcat(ca.vec(control), spacing, logs)
    return Interval(variables, places, ca.vertcat(*rows), ca.horzcat(*torques), ca.horzcat(*forces), cost)
