"""Margins of a walk, worked out with NumPy from the plan's contact points and forces alone.

Nothing here is shared with the planner: motions are integrated from the forces anew, frames follow from the vertices of
the surfaces, reach comes from all faces of the robot's polytopes.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import mcplan as mp

VELOCITY_MAX, MOMENTUM_MAX, RATE_MAX = 1.5, 2.5, 3.5  # m/s, kg m^2/s, N m, each component
DURATIONS = {2: (0.1, 0.3), 1: (0.8, 1.2)}  # s, by the number of feet in contact
COM_HEIGHT = (0.87, 1.15)  # of the CoM over a foot, as shares of the robot's
SOLE_SHARE = 0.80  # of a sole, between the points of its forces
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(3)  # exact to degree 5


@dataclass
class Margins:
    """Least margin of each kind: negative is a violation, in the unit of the quantity. `defect`: largest difference between
    a knot of the plan and the motion integrated from the knot before it (of L in kg m^2/s)."""

    least: dict[str, float] = field(default_factory=dict)
    defect: dict[str, float] = field(default_factory=dict)

    def note(self, name: str, values: object) -> None:
        low = float(np.min(np.asarray(values, dtype=float)))
        self.least[name] = min(self.least.get(name, np.inf), low)

    def note_defect(self, name: str, difference: object) -> None:
        self.defect[name] = max(self.defect.get(name, 0.0), float(np.max(np.abs(np.asarray(difference)))))


def normal_of(vertices: np.ndarray) -> np.ndarray:
    n = np.cross(vertices[1] - vertices[0], vertices[2] - vertices[0])
    return n / np.linalg.norm(n)


def frame_of(vertices: np.ndarray) -> np.ndarray:
    """Rows t1 (world x along the surface), t2, n."""
    n = normal_of(vertices)
    t1 = np.array([1.0, 0.0, 0.0]) - n[0] * n
    t1 /= np.linalg.norm(t1)
    return np.array([t1, np.cross(n, t1), n])


def inside_margin(vertices: np.ndarray, point: np.ndarray) -> float:
    """Distance to the nearest edge, positive inside."""
    n = normal_of(vertices)
    edges = np.roll(vertices, -1, axis=0) - vertices
    inward = np.cross(n, edges / np.linalg.norm(edges, axis=1, keepdims=True))
    return float(np.min(np.sum(inward * (point - vertices), axis=1)))


def margins_of(plan: mp.Plan, *, paper: bool) -> Margins:
    """Every margin at every node of every phase. `paper`: pyramid around the friction cone and absolute CoM box."""
    out = Margins()
    scene, robot = plan.scene, plan.robot
    weight = np.array([0.0, 0.0, -robot.mass * scene.gravity])
    surfaces = [np.array(s.vertices_W) for s in scene.surfaces]
    for k, phase in enumerate(plan.phases):
        feet = [(e, c) for e, c in enumerate(phase.contacts) if c.surface >= 0]
        held = phase.law == mp.model.ForceLaw.held
        n = phase.intervals
        h = phase.duration / n
        low, high = DURATIONS[len(feet)]
        out.note("duration", [phase.duration - low, high - phase.duration])

        points = np.concatenate([np.array(c.points_W) for _, c in feet])
        forces = np.concatenate(  # node x point x 3
            [np.array(c.point_forces_W).reshape(-1, len(c.points_W), 3) for _, c in feet], axis=1
        )
        assert len(forces) == (n if held else n + 1)
        at = 0
        for e, contact in feet:
            end = robot.end_effectors[e]
            vertices = surfaces[contact.surface]
            frame = frame_of(vertices)
            corners = np.array(contact.points_W)
            centre = corners.mean(axis=0)
            out.note_defect("foothold", centre - np.array(plan.knots[k].end_effectors_W[e]))
            out.note_defect("plane", (corners - vertices[0]) @ frame[2])
            half = np.abs((corners - centre) @ frame.T)[:, :2]
            out.note_defect("sole", half - (1.0 if paper else SOLE_SHARE) * np.array(end.half_size))
            whole = centre + (corners - centre) * (1.0 if paper else 1.0 / SOLE_SHARE)
            out.note("foothold", [inside_margin(vertices, corner) for corner in whole])
            f_W = forces[:, at : at + len(corners)]
            f = f_W @ frame.T
            mu = scene.surfaces[contact.surface].friction
            sideways = np.abs(f[..., :2]).max(axis=-1) if paper else np.hypot(f[..., 0], f[..., 1])
            out.note("normal force", f[..., 2])
            out.note("friction", mu * f[..., 2] - sideways)
            out.note("force box", end.max_force / len(corners) - np.abs(f_W))
            at += len(corners)

        # The motion at the nodes, from the first knot on.
        c = np.array(plan.knots[k].com_W)
        v = np.array(plan.knots[k].com_velocity_W)
        L = np.array(plan.knots[k].angular_momentum_W)
        coms, velocities, momenta = [c], [v], [L]
        for i in range(n):
            f0 = forces[i]
            if held:  # forward Euler, as the paper has it
                a = (f0.sum(axis=0) + weight) / robot.mass
                rate = np.cross(points - c, f0).sum(axis=0)
                c, v, L = c + h * v, v + h * a, L + h * rate
            else:
                f1 = forces[i + 1]
                a0, a1 = ((f.sum(axis=0) + weight) / robot.mass for f in (f0, f1))
                jerk = (a1 - a0) / h
                for x, w in zip(0.5 * h * (GAUSS_X + 1.0), 0.5 * h * GAUSS_W, strict=True):
                    com = c + x * v + x**2 / 2 * a0 + x**3 / 6 * jerk
                    L = L + w * np.cross(points - com, f0 + (f1 - f0) * x / h).sum(axis=0)
                c = c + h * v + h**2 / 2 * a0 + h**3 / 6 * jerk
                v = v + h * (a0 + a1) / 2
            coms.append(c)
            velocities.append(v)
            momenta.append(L)
        end_knot = plan.knots[k + 1]
        out.note_defect("com", c - np.array(end_knot.com_W))
        out.note_defect("velocity", v - np.array(end_knot.com_velocity_W))
        out.note_defect("momentum", L - np.array(end_knot.angular_momentum_W))
        out.note("velocity", VELOCITY_MAX - np.abs(velocities))
        out.note("momentum", MOMENTUM_MAX - np.abs(momenta))
        rates = [np.cross(points - coms[i], forces[i]).sum(axis=0) for i in range(len(forces))]
        out.note("momentum rate", RATE_MAX - np.abs(rates))

        first = 1 if k == 0 else 0  # the start is given, not planned
        stands = {e: np.array(c.points_W).mean(axis=0) for e, c in feet}
        if paper:
            out.note("com height", [min(c[2] - 0.7, 0.8 - c[2]) for c in coms[first:]])
        for e, p in stands.items():
            reach = robot.end_effectors[e].com_reach
            for c in coms[first:]:
                out.note("com reach", reach.b - reach.A @ (c - p))
                if not paper:
                    height = (c[2] - p[2]) / robot.com_height
                    out.note("com height", [height - COM_HEIGHT[0], COM_HEIGHT[1] - height])
        if len(feet) == 2 and k > 0:
            for e, other in ((0, 1), (1, 0)):
                reach = robot.end_effectors[e].partner_reach[robot.end_effectors[other].name]
                out.note("foot reach", reach.b - reach.A @ (stands[other] - stands[e]))
    return out
