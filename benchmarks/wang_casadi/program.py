"""A nonlinear program put together variable by variable and row by row, for CasADi's Ipopt interface."""

from __future__ import annotations

import math
import time
from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
from walker import Array

Values = dict[Hashable, Array]


@dataclass
class Outcome:
    """One solve."""

    values: Values
    objective: float
    parts: dict[str, float]  # of the objective, and others that were declared
    success: bool
    status: str
    iterations: int
    time_s: float  # wall clock, of the call to the solver
    cpu_s: float  # of the process, the same call
    evaluation_s: float  # of which in functions and derivatives


@dataclass
class Program:
    """Variables and parameters have names (any hashable), so that guesses and solutions are dictionaries."""

    x: dict[Hashable, ca.SX] = field(default_factory=dict)
    p: dict[Hashable, ca.SX] = field(default_factory=dict)
    bounds: dict[Hashable, tuple[Array, Array]] = field(default_factory=dict)
    rows: list[ca.SX] = field(default_factory=list)
    low: list[float] = field(default_factory=list)
    high: list[float] = field(default_factory=list)
    parts: dict[str, ca.SX] = field(default_factory=dict)
    solver: Any = None

    def variable(self, name: Hashable, size: int, low: Any = -math.inf, high: Any = math.inf) -> ca.SX:
        self.x[name] = ca.SX.sym(str(name), size)
        self.bounds[name] = (np.broadcast_to(low, size) * 1.0, np.broadcast_to(high, size) * 1.0)
        return self.x[name]

    def parameter(self, name: Hashable, rows: int, columns: int = 1) -> ca.SX:
        self.p[name] = ca.SX.sym(str(name), rows, columns)
        return self.p[name]

    def add(self, expression: ca.SX, low: float, high: float) -> None:
        """low <= expression <= high, entry by entry."""
        self.rows.append(expression)
        self.low += [low] * expression.numel()
        self.high += [high] * expression.numel()

    def equal(self, left: ca.SX, right: ca.SX) -> None:
        self.add(left - right, 0.0, 0.0)

    def at_most(self, expression: ca.SX, most: float = 0.0) -> None:
        self.add(expression, -math.inf, most)

    def build(self, objective: tuple[str, ...], ipopt: dict[str, Any]) -> None:
        """Prepare the solver; the objective is the sum of the named parts."""
        x = ca.vertcat(*self.x.values())
        p = ca.vertcat(*(ca.vec(each) for each in self.p.values()))
        f = sum(self.parts[name] for name in objective)
        g = ca.vertcat(*self.rows)
        quiet = {"print_level": 0, "sb": "yes"} | ipopt
        self.solver = ca.nlpsol(
            "program",
            "ipopt",
            {"x": x, "p": p, "f": f, "g": g},
            {"ipopt": quiet, "print_time": False, "error_on_fail": False},
        )
        self._parts = ca.Function("parts", [x, p], list(self.parts.values()))
        self._rows = ca.Function("rows", [x, p], [g])
        multipliers = ca.SX.sym("multipliers", g.numel())
        self.sizes = {
            "variables": x.numel(),
            "rows": g.numel(),
            "equalities": int(np.sum(np.array(self.low) == np.array(self.high))),
            "nnz_jacobian": ca.jacobian_sparsity(g, x).nnz(),
            "nnz_hessian": ca.triu(ca.hessian(f + ca.dot(multipliers, g), x)[0]).nnz(),
        }

    def solve(self, guess: Values, parameters: Values, fixed: Values) -> Outcome:
        """Solve from a guess; variables in `fixed` are held at the given values."""
        if set(guess) != set(self.x) or set(parameters) != set(self.p):
            raise KeyError(
                f"names that differ: {sorted(map(str, set(guess) ^ set(self.x)))}, "
                f"{sorted(map(str, set(parameters) ^ set(self.p)))}"
            )
        bounds = self.bounds | {name: (value, value) for name, value in fixed.items()}
        p = np.concatenate([np.ravel(parameters[name], order="F") for name in self.p])
        begin, cpu = time.perf_counter(), time.process_time()
        out = self.solver(
            x0=np.concatenate([np.ravel(guess[name]) for name in self.x]),
            p=p,
            lbx=np.concatenate([bounds[name][0] for name in self.x]),
            ubx=np.concatenate([bounds[name][1] for name in self.x]),
            lbg=self.low,
            ubg=self.high,
        )
        elapsed, cpu = time.perf_counter() - begin, time.process_time() - cpu
        stats = self.solver.stats()
        x = out["x"].full().ravel()
        sizes = np.cumsum([each.numel() for each in self.x.values()])[:-1]
        parts = self._parts(x, p)
        return Outcome(
            values=dict(zip(self.x, np.split(x, sizes), strict=True)),
            objective=float(out["f"]),
            parts=dict(zip(self.parts, map(float, parts if isinstance(parts, tuple) else (parts,)), strict=True)),
            success=bool(stats["success"]),
            status=str(stats["return_status"]),
            iterations=int(stats["iter_count"]),
            time_s=elapsed,
            cpu_s=cpu,
            evaluation_s=sum(value for key, value in stats.items() if key.startswith("t_wall_nlp_")),
        )
