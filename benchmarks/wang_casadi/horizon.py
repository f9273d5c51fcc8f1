"""One horizon of docs/theory/rhp.md as a CasADi program, written from the equations alone.

Two forms: `same` is the program that mcplan solves; `plain` is the paper's way of writing it: all faces of the polytopes,
psi as variables, footholds as points with a plane each and four corners, forces in world axes, accelerations inserted.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
import numpy as np
from faces import COM_HEIGHT, FOOT_HEIGHT, force_axes, pruned
from program import Program
from walker import Walker

N = 7  # intervals of a phase
FORCE_UNIT = 100.0  # [N]
LEVER = 1.5  # [m]
PHASES = ("pre-swing", "swing", "landing")

DOUBLE_SUPPORT, SINGLE_SUPPORT = (0.1, 0.3), (0.8, 1.2)  # [s] limits of free durations
PREDICTED = (0.2, 0.6, 0.2)  # [s] fixed durations
VELOCITY, MOMENTUM, MOMENTUM_RATE = 1.5, 2.5, 3.5  # [m/s], [kg m^2/s], [N m]
HEIGHT = (0.87, 1.07)  # of the CoM over each foot, by the robot's
PAPER_BOX = ((0.0, -1.0, 0.7), (30.0, 1.0, 0.8))  # [m] of the CoM
PSI_MAX, GOAL_WEIGHT = 0.55, 10.0


@dataclass(frozen=True)
class Settings:
    """Which program."""

    fidelity: str = "point"  # single, com, rectangle, point
    lookahead: int = 3
    transcription: str = "trapezoidal"  # or euler
    paper: bool = False
    form: str = "same"  # or plain
    turned: bool = False  # the pyramid inside the friction cone has its edges where mcplan's variables have them
    tolerance: float = 1e-5
    max_iterations: int = 400

    def __post_init__(self) -> None:
        if self.form == "plain" and (self.transcription != "euler" or not self.paper):
            raise ValueError("form: plain needs transcription euler and paper")

    @property
    def ipopt(self) -> dict[str, float]:
        ordering = {} if self.form == "plain" else {"mumps_pivot_order": 0}
        return {"tol": self.tolerance, "constr_viol_tol": 1e-6, "max_iter": self.max_iterations} | ordering


class Horizon:
    """The program of `lookahead` steps of which the first swings `first_foot` (0 left, 1 right).

    Contacts are numbered: 0 the foot that swings first, where it stands; 1 the other; 2 + i the foothold of step i. Step i
    moves contact i to contact i + 2 while i + 1 stands.

    Parameters: ("frame", j), ("friction", j) of every contact's patch, ("p", 0), ("p", 1); of footholds ("o", j), from
    which they are counted, ("E", j), ("e", j) edges of the patch and their offsets; "goal".
    """

    def __init__(self, walker: Walker, settings: Settings, first_foot: int) -> None:
        self.walker, self.settings, self.first_foot = walker, settings, first_foot
        self.plain = settings.form == "plain"
        self.euler = settings.transcription == "euler"
        self.program = Program()
        for name in ("acc_executed", "momentum_executed", "acc_predicted", "momentum_predicted", "psi", "terminal"):
            self.program.parts[name] = ca.SX(0)
        self._check_force_bounds()
        self._contacts()
        self._states()
        for s in range(settings.lookahead):
            for q in range(3):
                self._phase(s, q)
        self._reach()
        error = self.c[-1] - self.program.parameter("goal", 3)
        self.program.cost("terminal", GOAL_WEIGHT * ca.sumsqr(error))
        self.program.build(tuple(self.program.parts), settings.ipopt)

    # What is where

    def model(self, s: int) -> str:
        """Of step s: single (centroidal), com, rectangle or point."""
        return "single" if s == 0 else self.settings.fidelity

    def points(self, s: int) -> list[tuple[float, float]]:
        """Contact points of a foot from its centre [m] along t1 and t2."""
        x, y = self.walker.half_size
        return [(0.0, 0.0)] if self.model(s) == "point" else [(x, y), (x, -y), (-x, -y), (-x, y)]

    @staticmethod
    def standing(s: int, q: int) -> tuple[int, ...]:
        """Contacts in phase q of step s."""
        return ((s, s + 1), (s + 1,), (s + 1, s + 2))[q]

    def controls(self) -> int:
        """Control nodes of a phase."""
        return N if self.euler else N + 1

    def control_nodes(self) -> Iterator[tuple[int, int, int]]:
        """Every (s, q, k)."""
        for s in range(self.settings.lookahead):
            for q in range(3):
                for k in range(self.controls()):
                    yield s, q, k

    def foot(self, contact: int) -> int:
        return (self.first_foot + contact) % 2

    # Variables and their rows

    def _check_force_bounds(self) -> None:
        sides, outer = self._pyramid()
        patches = {id(p): p for p in (*self.walker.start_patches, *(step[1] for step in self.walker.steps))}
        for patch in patches.values():
            if force_axes(patch.frame, patch.friction, sides, outer):
                raise ValueError("a patch so steep that horizontal force bounds matter, which form `same` leaves out")

    def _pyramid(self) -> tuple[int, bool]:
        return (4, True) if self.settings.paper else (8, False)

    def _contacts(self) -> None:
        program, half = self.program, self.walker.half_size
        self.frame: list[ca.SX] = []
        self.p: list[ca.SX] = []
        for j in range(self.settings.lookahead + 2):
            self.frame.append(program.parameter(("frame", j), 3, 3))
            program.parameter(("friction", j), 1)
            if j < 2:
                self.p.append(program.parameter(("p", j), 3))
                continue
            tangents, normal = self.frame[j][:, :2], self.frame[j][:, 2]
            o, E, e = program.parameter(("o", j), 3), program.parameter(("E", j), 4, 3), program.parameter(("e", j), 4)
            if self.plain:
                p = program.variable(("w", j), 3, (-1.0, -1.0, -5.0), (30.0, 1.0, 5.0))
                program.equal(ca.dot(normal, p), ca.dot(normal, o))
                for x, y in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
                    program.at_most(E @ (p + tangents @ ca.SX([x * half[0], y * half[1]])) - e)
            else:
                p = o + tangents @ program.variable(("w", j), 2)
                program.at_most(E @ p - e + ca.fabs(E @ tangents) @ ca.SX(list(half)))
            self.p.append(p)

    def _states(self) -> None:
        program, paper = self.program, self.settings.paper
        nodes = 3 * N * self.settings.lookahead + 1
        with_momentum = nodes if self.settings.fidelity == "single" else 3 * N + 1
        box = PAPER_BOX if paper else ((-math.inf,) * 3, (math.inf,) * 3)
        self.c, self.v, self.L = [], [], []
        for g in range(nodes):
            self.c.append(program.variable(("c", g), 3, *box))
            self.v.append(program.variable(("v", g), 3, -VELOCITY, VELOCITY))
            if g < with_momentum:
                self.L.append(program.variable(("L", g), 3, -MOMENTUM, MOMENTUM))

    def duration(self, s: int, q: int) -> ca.SX | float:
        if s > 0 and self.settings.fidelity != "single":
            return PREDICTED[q]
        return self.program.variable(("T", s, q), 1, *(SINGLE_SUPPORT if q == 1 else DOUBLE_SUPPORT))

    def _phase(self, s: int, q: int) -> None:
        h = self.duration(s, q) / N
        first = 3 * N * s + N * q
        controls = [self._control(s, q, k, first + k) for k in range(self.controls())]
        cost, when = self.program.cost, "executed" if s == 0 else "predicted"
        centroidal = self.model(s) == "single"
        for k in range(N):
            here, there = controls[k], controls[k if self.euler else k + 1]
            g = first + k
            (self._euler_step if self.euler else self._linear_force_step)(g, h, here, there, centroidal)
            a0, a1 = here["a"], there["a"]
            if self.euler:
                cost(f"acc_{when}", h * ca.sumsqr(a0))
                cost("psi", h * here["psi"])
            else:
                cost(f"acc_{when}", h / 3 * (ca.sumsqr(a0) + ca.dot(a0, a1) + ca.sumsqr(a1)))
                cost("psi", h / 2 * here["psi"])
                cost("psi", h / 2 * there["psi"])
            if centroidal and self.euler:
                cost(f"momentum_{when}", h * ca.sumsqr(self.L[g]))
            elif centroidal:
                rate = self._rate_between(g, h, here, there)
                cost(f"momentum_{when}", self._square_of_momentum(g, h, rate))
                for inner in (rate[0] + rate[1] / 3, rate[0] + (2 * rate[1] + rate[2]) / 3):  # Bernstein's
                    self.program.add(inner, -MOMENTUM_RATE, MOMENTUM_RATE)

    def _control(self, s: int, q: int, k: int, g: int) -> dict[str, ca.SX]:
        """Forces of control node k, with acceleration a, momentum rate R and sum of psi^2, and all their rows."""
        program, walker = self.program, self.walker
        corner = self.model(s) != "point"
        total, torque, psi = ca.SX.zeros(3), ca.SX.zeros(3), ca.SX(0)
        most = walker.max_force / (4 if corner else 1)
        for j in self.standing(s, q):
            for i, (x, y) in enumerate(self.points(s)):
                f = self._force(("f", j, i, s, q, k), j, most)
                lever = self.p[j] + self.frame[j][:, :2] @ ca.SX([x, y]) - self.c[g]
                total += f
                torque += ca.cross(lever, f)
                if self.model(s) in ("rectangle", "point"):
                    psi += self._relaxation(("psi", j, i, s, q, k), lever / LEVER, f / most)
        a = total / walker.mass - ca.SX([0, 0, walker.gravity])
        if not self.plain:
            a = program.defined(("a", s, q, k), a)
        out = {"a": a, "psi": psi}
        if self.model(s) == "single":
            out["R"] = program.defined(("R", s, q, k), torque, -MOMENTUM_RATE, MOMENTUM_RATE)
        return out

    def _force(self, name: tuple, j: int, most: float) -> ca.SX:
        """Force [N] in world axes of one contact point, with friction and bounds."""
        program, mu, (sides, outer) = self.program, self.program.p["friction", j], self._pyramid()
        most = most / FORCE_UNIT
        if self.plain:
            world = program.variable(name, 3, -most, most)
            local = self.frame[j].T @ world
            program.add(local[2], 0.0, math.inf)
        else:
            local = program.variable(name, 3, (-math.inf, -math.inf, 0.0))
            world = self.frame[j] @ local
            program.at_most(world[2], most)  # the other bounds are implied
        slope = mu if outer else mu * math.cos(math.pi / sides)
        for side in range(sides):
            phi = 2 * math.pi * (side + 0.5 * (self.settings.turned and not outer)) / sides
            along = [round(math.cos(phi), 12), round(math.sin(phi), 12)]
            program.at_most(along[0] * local[0] + along[1] * local[1] - slope * local[2])
        return FORCE_UNIT * world

    def _relaxation(self, name: tuple, lever: ca.SX, force: ca.SX) -> ca.SX:
        """Sum of psi^2 of one contact point."""
        bounds = relaxation(lever, force)
        if not self.plain:
            for bound in bounds:
                self.program.at_most(bound, PSI_MAX)
            return sum(bound**2 for bound in bounds)
        psi = self.program.variable(name, 6, 0.0, PSI_MAX)
        self.program.at_most(ca.vertcat(*bounds) - psi)
        return ca.sumsqr(psi)

    # Dynamics

    def _euler_step(self, g: int, h: ca.SX, here: dict, _: dict, centroidal: bool) -> None:
        self.program.equal(self.c[g + 1], self.c[g] + h * self.v[g])
        self.program.equal(self.v[g + 1], self.v[g] + h * here["a"])
        if centroidal:
            self.program.equal(self.L[g + 1], self.L[g] + h * here["R"])

    def _rate_between(self, g: int, h: ca.SX, here: dict, there: dict) -> list[ca.SX]:
        """Coefficients of s^0..s^3, s = 0..1, of the momentum's rate between two nodes with linear forces: a cubic, through
        what moments about the first node's CoM and the way of the CoM from there give at four places."""
        a0, a1, v0 = here["a"], there["a"], self.v[g]
        weight = ca.SX([0, 0, self.walker.gravity])

        def way(s: float) -> ca.SX:
            return h * s * v0 + h**2 * (s**2 / 2 * a0 + s**3 / 6 * (a1 - a0))

        def force(s: float) -> ca.SX:
            return self.walker.mass * ((1 - s) * a0 + s * a1 + weight)

        def rate(s: float) -> ca.SX:
            moment = (1 - s) * here["R"] + s * (there["R"] + ca.cross(way(1.0), force(1.0)))
            return moment - ca.cross(way(s), force(s))

        places = np.linspace(0.0, 1.0, 4)
        inverse = np.linalg.inv(np.vander(places, increasing=True))
        values = [rate(s) for s in places]
        return [sum(float(inverse[k, i]) * values[i] for i in range(4)) for k in range(4)]

    def _square_of_momentum(self, g: int, h: ca.SX, rate: list[ca.SX]) -> ca.SX:
        """The integral of |L|^2 between two nodes; a polynomial of degree 8, so five points are enough."""
        total = ca.SX(0)
        for place, share in zip(*np.polynomial.legendre.leggauss(5), strict=True):
            s = 0.5 * (1.0 + place)
            momentum = self.L[g] + h * sum(s ** (k + 1) / (k + 1) * rate[k] for k in range(4))
            total += 0.5 * share * h * ca.sumsqr(momentum)
        return total

    def _linear_force_step(self, g: int, h: ca.SX, here: dict, there: dict, centroidal: bool) -> None:
        a0, a1, v0 = here["a"], there["a"], self.v[g]
        m, gravity = self.walker.mass, self.walker.gravity
        self.program.equal(self.v[g + 1], v0 + h / 2 * (a0 + a1))
        self.program.equal(self.c[g + 1], self.c[g] + h * v0 + h**2 / 6 * (2 * a0 + a1))
        if centroidal:
            up = ca.SX([0, 0, 1])
            self.program.equal(
                self.L[g + 1],
                self.L[g]
                + h / 2 * (here["R"] + there["R"])
                - m * h**2 / 6 * ca.cross(v0, a0 - a1)
                + m * h**3 / 12 * ca.cross(a0, a1)
                + m * gravity * h**3 / 24 * ca.cross(a0 + a1, up),
            )

    # Kinematics

    def _reach(self) -> None:
        keep = (lambda A, b, height: (A, b)) if self.plain else pruned
        com = [keep(*each, COM_HEIGHT) for each in self.walker.com_reach]
        feet = [keep(*each, FOOT_HEIGHT) for each in self.walker.foot_reach]
        done = set()
        for s in range(self.settings.lookahead):
            for q in range(3):
                for g in range(3 * N * s + N * q, 3 * N * s + N * (q + 1) + 1):
                    for j in self.standing(s, q):
                        if g > 0 and (g, j) not in done:  # node 0 is given
                            done.add((g, j))
                            self._over(self.c[g], self.p[j], *com[self.foot(j)])
            stance, new = s + 1, s + 2
            for one, other in ((stance, new), (new, stance)):
                A, b = feet[self.foot(one)]
                self.program.at_most(ca.SX(A) @ (self.p[other] - self.p[one]) - ca.SX(b))

    def _over(self, c: ca.SX, p: ca.SX, A, b) -> None:  # noqa: ANN001
        self.program.at_most(ca.SX(A) @ (c - p) - ca.SX(b))
        if not self.settings.paper:
            self.program.add(c[2] - p[2], *(r * self.walker.com_height for r in HEIGHT))


def relaxation(l, d) -> list:  # noqa: ANN001, E741
    """The six |alpha +- delta|^2 of a normalised lever and force: x+, x-, y+, y-, z+, z-."""
    pairs = (((-l[2], l[1]), (d[1], d[2])), ((l[2], -l[0]), (d[0], d[2])), ((-l[1], l[0]), (d[0], d[1])))
    return [
        sum((a + sign * b) ** 2 for a, b in zip(alpha, delta, strict=True))
        for alpha, delta in pairs
        for sign in (1, -1)
    ]
