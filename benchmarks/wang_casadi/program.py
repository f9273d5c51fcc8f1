"""A nonlinear program put together variable by variable and row by row, for CasADi's Ipopt interface."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Hashable
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
    evaluation_s: float  # of the wall clock, in functions and derivatives
    evaluation_cpu_s: float  # of the process, the same


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
    terms: list[ca.SX] = field(default_factory=list)  # of the objective, one by one
    definitions: dict[Hashable, tuple[int, ca.SX]] = field(default_factory=dict)  # index in `rows`, what it equals
    solver: Any = None

    def variable(self, name: Hashable, size: int, low: Any = -math.inf, high: Any = math.inf) -> ca.SX:
        self.x[name] = ca.SX.sym(str(name), size)
        self.bounds[name] = (np.broadcast_to(low, size) * 1.0, np.broadcast_to(high, size) * 1.0)
        return self.x[name]

    def defined(self, name: Hashable, expression: ca.SX, low: Any = -math.inf, high: Any = math.inf) -> ca.SX:
        """A variable that equals an expression."""
        x = self.variable(name, expression.numel(), low, high)
        self.definitions[name] = (len(self.rows), expression)
        self.equal(expression, x)
        return x

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

    def cost(self, part: str, term: ca.SX) -> None:
        """Add a term of the objective to one of its parts."""
        self.parts[part] += term
        self.terms.append(term)

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
        arguments = {
            "x0": np.concatenate([np.ravel(guess[name]) for name in self.x]),
            "p": self.vector(parameters),
            "lbx": np.concatenate([bounds[name][0] for name in self.x]),
            "ubx": np.concatenate([bounds[name][1] for name in self.x]),
            "lbg": self.low,
            "ubg": self.high,
        }
        return solve_with(self, self.solver, arguments, lambda x: x)

    def vector(self, parameters: Values) -> Array:
        """The parameters in the program's order."""
        return np.concatenate([np.ravel(parameters[name], order="F") for name in self.p])

    def violation(self, values: Values, parameters: Values) -> float:
        """The largest violation of a row or bound, in the units of each; what is held fixed in a solve is not looked at."""
        x = np.concatenate([values[name] for name in self.x])
        g = self._rows(x, self.vector(parameters)).full().ravel()
        low, high = (np.concatenate([self.bounds[name][side] for name in self.x]) for side in (0, 1))
        return float(max(np.max(self.low - g), np.max(g - self.high), np.max(low - x), np.max(x - high)))


def solve_with(program: Program, solver: Any, arguments: dict[str, Any], original: Callable[[Array], Array]) -> Outcome:
    """Run a solver; `original` makes the program's variables of the solver's."""
    begin, cpu = time.perf_counter(), time.process_time()
    out = solver(**arguments)
    elapsed, cpu = time.perf_counter() - begin, time.process_time() - cpu
    stats = solver.stats()
    x = original(out["x"].full().ravel())
    sizes = np.cumsum([each.numel() for each in program.x.values()])[:-1]
    parts = program._parts(x, arguments["p"])
    return Outcome(
        values=dict(zip(program.x, np.split(x, sizes), strict=True)),
        objective=float(out["f"]),
        parts=dict(zip(program.parts, map(float, parts if isinstance(parts, tuple) else (parts,)), strict=True)),
        success=bool(stats["success"]),
        status=str(stats["return_status"]),
        iterations=int(stats["iter_count"]),
        time_s=elapsed,
        cpu_s=cpu,
        evaluation_s=sum(value for key, value in stats.items() if key.startswith("t_wall_nlp_")),
        evaluation_cpu_s=sum(value for key, value in stats.items() if key.startswith("t_proc_nlp_")),
    )
