"""A solve of a stage problem, its result, and a check of the derivatives that it was given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from mcplan._core import Status
from mcplan._core.ipm import Solution
from mcplan._core.nlp import Solver
from mcplan.arguments import found, require, require_number
from mcplan.errors import Interrupted, InvalidArgument, InvalidInput, InvalidOptions
from mcplan.ipm.functions import Array, numbers
from mcplan.ipm.problem import Given, Problem, program_of


@dataclass(frozen=True, eq=False)
class Result:
    """How a solve ended, and where.

    Attributes:
        status: ``solved``: within the tolerances; ``acceptable``: feasible, and no further progress was made;
            ``infeasible``: the violation is locally least and not zero; ``iteration_limit``, ``time_limit``,
            ``interrupted`` or ``numerical_failure``.
        message: Why it ended, in a sentence.
        x: The variables by name, a row for each time the name was given to Problem.variables(): a row for each stage.
            The solution if it is solved, else the best point: feasible and cheap, or least violated.
        multipliers: Of the constraints by name, a row for each block of that name, in their order. At the solution the
            gradient of the cost, plus Jacobian' multipliers, plus the bounds' multipliers, vanishes; they are negative
            at a lower limit and positive at an upper one.
        bound_multipliers: Of the variables' bounds, as `x`; nan unless the status is solved or acceptable.
        objective: The cost at x.
        iterations: Of the kernel and Ipopt together.
        violation: Largest violation of a row or a bound at x.
        worst: Its row, such as "dynamics[2] at stage 7"; "" if there is none.
        violations: The rows that are violated by more than the tolerance, ten at most, worst first, and by how much.
        solver: That found x, "ipm" or "ipopt".
        time_s: Wall clock [s]; of which `evaluation_s` in the problem's functions and `linear_solver_s` in
            factorisations and back-substitutions.
        table: A line for each iteration, as Ipopt writes them.
    """

    status: Status
    message: str
    x: Mapping[str, Array]
    multipliers: Mapping[str, Array]
    bound_multipliers: Mapping[str, Array]
    objective: float
    iterations: int
    violation: float
    worst: str
    violations: tuple[tuple[str, float], ...]
    solver: str
    time_s: float
    evaluation_s: float
    linear_solver_s: float
    table: str = field(repr=False)

    def __reduce__(self) -> tuple[Callable[[dict[str, Any]], Result], tuple[dict[str, Any]]]:
        values = {one.name: getattr(self, one.name) for one in fields(self)}
        return _restored, ({name: dict(v) if isinstance(v, MappingProxyType) else v for name, v in values.items()},)

    def __str__(self) -> str:
        worst = f" ({self.worst})" if self.worst else ""
        return (
            f"{self.status} after {self.iterations} iterations and {self.time_s:.3f} s: objective {self.objective:.6g}, "
            f"violation {self.violation:.1e}{worst}. {self.message}"
        )


@dataclass(frozen=True)
class WrongDerivative:
    """A derivative that is not what central differences say.

    Attributes:
        block: Name and stage of the block; of least squares it is the residuals that are looked at.
        kind: "jacobian" or "hessian".
        row: Of the block's function; -1 for a Hessian, which is that of all rows together.
        variables: What it is a derivative with respect to; two for a Hessian.
        given: What the function returned.
        difference: The central difference.
    """

    block: str
    kind: str
    row: int
    variables: tuple[str, ...]
    given: float
    difference: float

    def __str__(self) -> str:
        row = f", row {self.row}" if self.row >= 0 else ""
        by = " ".join(f"d/d {name}" for name in self.variables)
        return f"{self.block}: {self.kind}{row}, {by}: {self.given:g}, central difference {self.difference:g}"


def solve(
    problem: Problem,
    start: Result | None = None,
    *,
    solver: Literal["ipm", "ipopt", "auto"] | Solver = "ipm",
    tolerance: float = 1e-5,
    constraint_tolerance: float = 1e-6,
    max_iterations: int = 400,
    time_limit_s: float | None = None,
    initial_barrier: float = 0.1,
    adaptive_barrier: bool = False,
    log: Callable[[str], None] | None = None,
) -> Result:
    """Solve a stage problem. It depends on `status` how good the result is: a solve that fails is no exception.

    Solves may run in several threads at once, and a function of a problem may solve another one (not with an Ipopt before
    3.14, where solves wait for each other). Ctrl-C ends a solve with Interrupted, which carries the best result so far.

    Args:
        problem: What to solve.
        start: Result of an earlier solve of the same problem, from which to begin; None: the variables' own starts.
        solver: "ipm", the kernel; "ipopt"; or "auto", the kernel, and where it does not converge, Ipopt.
        tolerance: On the scaled optimality error.
        constraint_tolerance: On rows and bounds.
        max_iterations: Of both solvers together.
        time_limit_s: Wall clock [s]; None: none.
        initial_barrier: Of the barrier parameter; smaller ones where the start is nearly a solution.
        adaptive_barrier: Whether the barrier parameter is chosen anew in each iteration.
        log: Called with each line of the iteration table, such as ``print``.

    Raises:
        InvalidArgument, InvalidOptions: An argument is of another type, or out of its range.
        InvalidInput: A function of the problem returned something else than numbers of the right shape; the message names
            block and stage. Or `start` is of another problem, or the problem has no variables.
        Interrupted: Ctrl-C.
        Exception: What a function of the problem raises, from Python 3.11 on with a note that says where.
    """
    require("problem", problem, Problem)
    require("start", start, Result, optional=True)
    if log is not None and not callable(log):
        raise InvalidArgument("log", "must be a function", found(log))
    limit = float("inf") if time_limit_s is None else require_number("time_limit_s", time_limit_s)
    given = Given.of(problem)
    program = program_of(given, None if start is None else _point(given, start))
    try:
        solution = program.solve(
            solver=_solver(solver),
            tolerance=require_number("tolerance", tolerance),
            constraint_tolerance=require_number("constraint_tolerance", constraint_tolerance),
            max_iterations=max_iterations,
            time_limit_s=limit,
            initial_barrier=require_number("initial_barrier", initial_barrier),
            adaptive_barrier=adaptive_barrier,
            log=log,  # type: ignore[arg-type]  # None is legal, which pybind11 does not say
        )
    except Interrupted as stop:
        if isinstance(stop.result, Solution):
            stop = Interrupted(_Names.of(given).result(stop.result))
        raise stop from None
    return _Names.of(given).result(solution)


def check_derivatives(
    problem: Problem, at: Result | Mapping[str, ArrayLike] | None = None, *, tolerance: float = 1e-5
) -> list[WrongDerivative]:
    """Compare each Jacobian and Hessian of a problem's functions with central differences.

    Args:
        problem: Whose functions to look at.
        at: The point: a result, or values by name as ``Result.x`` has them; None: the variables' starts.
        tolerance: What may differ, relative to max(1, |difference|).

    Returns:
        What differs by more, worst first among the blocks with and without a Hessian; nothing: all is well.

    Raises:
        InvalidArgument, InvalidInput, Exception: As for solve().
    """
    require("problem", problem, Problem)
    given = Given.of(problem)
    program = program_of(given)
    point = _start(given) if at is None else _point(given, at)
    wrong = program.check_derivatives(point, require_number("tolerance", tolerance))
    return [WrongDerivative(b, kind, row, (v, w) if w else (v,), g, d) for b, kind, row, v, w, g, d in wrong]


def _solver(solver: object) -> Solver:
    members = Solver.__members__
    if isinstance(solver, Solver):
        return solver
    if not isinstance(solver, str):
        raise InvalidArgument("solver", f"must be one of {', '.join(members)}", found(solver))
    if solver not in members:
        raise InvalidOptions("solver", f"must be one of {', '.join(members)}", found(solver))
    return members[solver]


def _start(problem: Given) -> Array:
    values = [values.start for _, values in problem.variables]
    return np.concatenate(values) if values else np.zeros(0)


def _point(problem: Given, given: Result | Mapping[str, ArrayLike]) -> Array:
    """All variables in their order from values by name."""
    by_name = given.x if isinstance(given, Result) else given
    require("at", by_name, Mapping)
    groups = problem.groups
    shapes: dict[str, tuple[int, int]] = {}
    for group in groups:
        shapes[group.name] = (shapes.get(group.name, (0, 0))[0] + 1, group.size)
    for name in shapes:
        if name not in by_name:
            raise InvalidInput("start" if given is not by_name else "at", f"must have variables {name!r}")
    arrays = {name: numbers(name, by_name[name], 2) for name in shapes}
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            found_shape = f"shape {' x '.join(map(str, arrays[name].shape)) or 'of one number'}"
            raise InvalidInput(name, f"must be an array of {shape[0]} x {shape[1]} numbers", found_shape)
    taken = dict.fromkeys(shapes, 0)
    parts = []
    for group in groups:
        parts.append(arrays[group.name][taken[group.name]])
        taken[group.name] += 1
    return np.concatenate(parts) if parts else np.zeros(0)


@dataclass(frozen=True)
class _Names:
    """Names and sizes of the variables of a problem, and of its rows."""

    variables: list[tuple[str, int]]
    rows: list[tuple[str, int]]

    @classmethod
    def of(cls, problem: Given) -> _Names:
        return cls([(group.name, group.size) for group in problem.groups], problem.rows)

    def result(self, solution: Solution) -> Result:
        return Result(
            status=solution.status,
            message=solution.message,
            x=_by_name(self.variables, solution.x),
            multipliers=_by_name(self.rows, solution.multipliers),
            bound_multipliers=_by_name(self.variables, solution.bound_multipliers),
            objective=solution.objective,
            iterations=solution.iterations,
            violation=solution.violation,
            worst=solution.worst,
            violations=tuple(solution.violations),
            solver=solution.solver.name,
            time_s=solution.time_s,
            evaluation_s=solution.evaluation_s,
            linear_solver_s=solution.linear_solver_s,
            table=solution.table,
        )


def _by_name(sizes: list[tuple[str, int]], values: Array) -> Mapping[str, Array]:
    """Values that follow each other as rows of arrays by name; they cannot be written to."""
    rows: dict[str, list[Array]] = {}
    at = 0
    for name, size in sizes:
        rows.setdefault(name, []).append(values[at : at + size])
        at += size
    return _read_only({name: np.array(parts) for name, parts in rows.items()})


def _read_only(arrays: dict[str, Array]) -> Mapping[str, Array]:
    for array in arrays.values():
        array.flags.writeable = False
    return MappingProxyType(arrays)


def _restored(values: dict[str, Any]) -> Result:
    """A result from its copied or pickled values."""
    kept: dict[str, Any] = {name: _read_only(v) if isinstance(v, dict) else v for name, v in values.items()}
    return Result(**kept)
