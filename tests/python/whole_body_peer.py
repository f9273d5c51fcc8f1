"""Whole-body plans of planar robots once more, by other means: plain data, NumPy, SciPy's splines, Pinocchio.

Nothing of mcplan's core is used. Every function works on arrays over time, of one phase. Angles of bodies in the world are
sums of joint angles, places of bodies sums of turned vectors, and both are differentiated term by term; forces are the
pseudo-inverse of a weighted grasp matrix; torques follow from virtual work, and from Pinocchio where asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import BSpline

ALPHA = 10.0  #: the paper's weight of tangential forces


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def turned(angle: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A constant vector, turned by angles: (times, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * v[0] - s * v[1], s * v[0] + c * v[1]], axis=-1)


def left(v: np.ndarray) -> np.ndarray:
    return np.stack([-v[..., 1], v[..., 0]], axis=-1)


@dataclass
class Samples:
    """Of one phase: arrays over its times."""

    times: np.ndarray  #: since the start of the phase [s]
    q: np.ndarray  #: (times, joints), and its derivatives
    velocity: np.ndarray
    acceleration: np.ndarray
    base: np.ndarray  #: (times, 3), and its derivatives
    base_velocity: np.ndarray
    base_acceleration: np.ndarray
    bodies: list[np.ndarray]  #: joint of each body in the world (times, 2)
    angles: list[np.ndarray]  #: of each body
    error: np.ndarray  #: of each contact (times, contacts, 3)
    points: np.ndarray  #: places of the points (times, points, 2)
    forces: np.ndarray  #: tangential and normal (times, points, 2)
    torques: np.ndarray  #: (times, joints)
    residual: np.ndarray  #: force that nothing carries (times, 2)


class Peer:
    """A plan from plain data: `task` and `robot` as in plan files, free control points, durations, weights."""

    def __init__(
        self, robot: dict[str, Any], task: dict[str, Any], durations: Any, points: np.ndarray, weights: Any
    ) -> None:
        self.robot, self.task = robot, task
        self.bodies = robot["bodies"]
        self.durations = np.asarray(durations, dtype=float)
        self.weights = [np.asarray(w, dtype=float) for w in weights]
        counts = [phase["intervals"] for phase in task["phases"]]
        lengths = np.repeat(self.durations / counts, counts)
        lengths = np.concatenate([np.repeat(lengths[0], 3), lengths, np.repeat(lengths[-1], 3)])
        knots = np.concatenate([[0.0], np.cumsum(lengths)]) - lengths[:3].sum()
        self.spline = BSpline(knots, np.asarray(points).T, 3)

    def limit(self, name: str) -> np.ndarray:
        """Of every joint; text stands for infinity."""
        return np.array([float(body[name]) for body in self.bodies[1:]])

    def weight(self) -> float:
        return sum(body["mass"] for body in self.bodies) * self.robot["gravity"]

    def chain(self, body: int) -> list[int]:
        """Bodies from the base's child to this one."""
        out = []
        while body > 0:
            out.insert(0, body)
            body = self.bodies[body]["parent"]
        return out

    def contacts(self, phase: int) -> list[tuple[dict[str, Any], dict[str, Any], float]]:
        """Contact, end-effector and friction coefficient."""
        return [
            (c, self.robot["end_effectors"][c["end_effector"]], self.task["surfaces"][c["surface"]]["friction"])
            for c in self.task["phases"][phase]["contacts"]
        ]

    def sample(self, phase: int, times: np.ndarray) -> Samples:
        """The phase at these times since its start."""
        t = np.minimum(self.durations[:phase].sum() + times, np.nextafter(self.durations.sum(), 0.0))
        q, dq, ddq = (self.spline.derivative(n)(t) if n else self.spline(t) for n in range(3))
        contacts = self.contacts(phase)

        # World angles: base, plus offsets and joints along the chain.
        def along(body: int, joints: np.ndarray, offsets: bool) -> np.ndarray:
            return sum(
                (joints[:, b - 1] + (self.bodies[b]["offset"] if offsets else 0.0) for b in self.chain(body)),
                start=np.zeros(len(t)),
            )

        base_angle = np.mean([c["angle"] - e["angle_B"] - along(e["body"], q, True) for c, e, _ in contacts], axis=0)
        base_rate, base_turn = (
            np.mean([-along(e["body"], x, False) for _, e, _ in contacts], axis=0) for x in (dq, ddq)
        )
        count = len(self.bodies)
        angle = [base_angle + along(b, q, True) for b in range(count)]
        rate = [base_rate + along(b, dq, False) for b in range(count)]
        turn = [base_turn + along(b, ddq, False) for b in range(count)]

        def arm(body: int, point: Any) -> np.ndarray:
            """From the body's joint to a point of it, with velocity and acceleration: (3, times, 2)."""
            r = turned(angle[body], np.asarray(point))
            return np.stack(
                [r, rate[body][:, None] * left(r), turn[body][:, None] * left(r) - rate[body][:, None] ** 2 * r]
            )

        relative = [np.zeros((3, len(t), 2))]  # joints of the bodies, from the base
        for body in self.bodies[1:]:
            relative.append(relative[body["parent"]] + arm(body["parent"], body["joint_P"]))
        soles = [relative[e["body"]] + arm(e["body"], e["position_B"]) for _, e, _ in contacts]
        base = -np.mean(soles, axis=0)
        base[0] += np.mean([c["position_W"] for c, _, _ in contacts], axis=0)
        joints = [base + r for r in relative]
        coms = [joints[b] + arm(b, self.bodies[b]["com_B"]) for b in range(count)]

        # What moves the bodies: forces, and moments about a point of the world.
        inertial = [
            self.bodies[b]["mass"] * (coms[b][2] + np.array([0.0, self.robot["gravity"]])) for b in range(count)
        ]

        def demand(chosen: list[int], about: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            force = sum((inertial[b] for b in chosen), start=np.zeros((len(t), 2)))
            moment = sum(
                (self.bodies[b]["inertia"] * turn[b] + cross(coms[b][0] - about, inertial[b]) for b in chosen),
                start=np.zeros(len(t)),
            )
            return force, moment

        # Least-norm forces at the expected points, about their mean.
        places, tangents, owners, levers = [], [], [], []
        for i, (c, e, _) in enumerate(contacts):
            tangent = np.array([np.cos(c["angle"]), np.sin(c["angle"])])
            for along_sole in e["points"]:
                places.append(np.asarray(c["position_W"]) + along_sole * tangent)
                tangents.append(tangent)
                owners.append(i)
                levers.append(along_sole)
        middle = np.mean(places, axis=0)
        columns, costs = [], []
        for place, tangent, w in zip(places, tangents, self.weights[phase], strict=True):
            for direction, alpha in ((tangent, ALPHA), (left(tangent), 1.0)):
                columns.append([*direction, cross(place - middle, direction)])
                costs.append(alpha * w)
        scale = 1.0 / np.sqrt(costs)
        gain = scale[:, None] * np.linalg.pinv(np.array(columns).T * scale)
        force, moment = demand(list(range(count)), np.broadcast_to(middle, (len(t), 2)))
        forces = (np.column_stack([force, moment]) @ gain.T).reshape(len(t), len(places), 2)
        forces_W = np.stack(
            [
                f[:, :1] * tangent + f[:, 1:] * left(tangent)
                for f, tangent in zip(forces.swapaxes(0, 1), tangents, strict=True)
            ],
            axis=1,
        )
        points = np.stack(
            [
                base[0]
                + soles[i][0]
                + turned(angle[contacts[i][1]["body"]] + contacts[i][1]["angle_B"], np.array([d, 0.0]))
                for i, d in zip(owners, levers, strict=True)
            ],
            axis=1,
        )

        # Torque of a joint: what its subtree demands about it, less what contacts there give.
        torques = np.empty((len(t), count - 1))
        for j in range(1, count):
            below = [b for b in range(count) if j in self.chain(b)]
            torques[:, j - 1] = demand(below, joints[j][0])[1]
            for v, i in enumerate(owners):
                if contacts[i][1]["body"] in below:
                    torques[:, j - 1] -= cross(points[:, v] - joints[j][0], forces_W[:, v])

        error = np.empty((len(t), len(contacts), 3))
        for i, (c, e, _) in enumerate(contacts):
            error[:, i, :2] = base[0] + soles[i][0] - c["position_W"]
            error[:, i, 2] = angle[e["body"]] + e["angle_B"] - c["angle"]
        return Samples(
            times=times,
            q=q,
            velocity=dq,
            acceleration=ddq,
            base=np.column_stack([base[0], base_angle]),
            base_velocity=np.column_stack([base[1], base_rate]),
            base_acceleration=np.column_stack([base[2], base_turn]),
            bodies=[j[0] for j in joints],
            angles=angle,
            error=error,
            points=points,
            forces=forces,
            torques=torques,
            residual=force - forces_W.sum(axis=1),
        )

    def torque_integral(self, nodes: int = 14) -> float:
        """Of the squared torques [N^2 m^2 s], by Gauss-Legendre quadrature over each interval."""
        s, w = np.polynomial.legendre.leggauss(nodes)
        total = 0.0
        for k, phase in enumerate(self.task["phases"]):
            length = self.durations[k] / phase["intervals"]
            for i in range(phase["intervals"]):
                torques = self.sample(k, length * (i + (s + 1.0) / 2.0)).torques
                total += length / 2.0 * w @ (torques**2).sum(axis=1)
        return float(total)

    def at_one_kilohertz(self, phase: int) -> Samples:
        duration = self.durations[phase]
        return self.sample(phase, np.linspace(0.0, duration, max(2, int(np.ceil(1e3 * duration)) + 1)))

    def pinocchio_torques(self, phase: int, samples: Samples) -> tuple[np.ndarray, np.ndarray]:
        """Torques, and what is left over at the base: force, and moment about its origin."""
        import pinocchio as pin

        model = pin.Model()
        model.gravity.linear[:] = [0.0, -self.robot["gravity"], 0.0]
        # Two sliders and a hinge: velocities of the base are the world's.
        slide_x = model.addJoint(0, pin.JointModelPX(), pin.SE3.Identity(), "slide_x")
        slide_y = model.addJoint(slide_x, pin.JointModelPY(), pin.SE3.Identity(), "slide_y")
        joints: list[int] = []
        for body in self.bodies:
            parent, place = slide_y, pin.SE3.Identity()
            if body["parent"] >= 0:
                parent = joints[body["parent"]]
                place = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, body["offset"]), np.array([*body["joint_P"], 0.0]))
            joint = model.addJoint(parent, pin.JointModelRZ(), place, body["name"])
            inertia = pin.Inertia(body["mass"], np.array([*body["com_B"], 0.0]), np.diag([0.0, 0.0, body["inertia"]]))
            model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
            joints.append(joint)
        order = [model.idx_vs[joint] for joint in joints[1:]]
        data = model.createData()

        torques, residuals = [], []
        for n in range(len(samples.times)):
            x = [np.zeros(model.nv) for _ in range(3)]
            pairs = (
                (samples.base, samples.q),
                (samples.base_velocity, samples.velocity),
                (samples.base_acceleration, samples.acceleration),
            )
            for vector, (base, moving) in zip(x, pairs, strict=True):
                vector[:3], vector[order] = base[n], moving[n]
            pin.forwardKinematics(model, data, x[0])
            outside = [pin.Force.Zero() for _ in range(model.njoints)]
            v = 0
            for contact, end, _ in self.contacts(phase):
                tangent = np.array([np.cos(contact["angle"]), np.sin(contact["angle"])])
                for _ in end["points"]:
                    along, normal = samples.forces[n, v]
                    force = np.array([*(along * tangent + normal * left(tangent)), 0.0])
                    wrench = pin.Force(force, np.cross([*samples.points[n, v], 0.0], force))
                    outside[joints[end["body"]]] += data.oMi[joints[end["body"]]].actInv(wrench)
                    v += 1
            tau = pin.rnea(model, data, *x, outside)
            torques.append(tau[order])
            residuals.append(tau[:3])
        return np.array(torques), np.array(residuals)
