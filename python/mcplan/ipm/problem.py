"""A stage problem: variables, and blocks that are functions of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mcplan._core.ipm import Program
from mcplan.arguments import found, require
from mcplan.errors import InvalidArgument, InvalidInput, shown
from mcplan.ipm.functions import Array, Function, Linear, Quadratic, numbers, spread, squares

_INF = float("inf")
_GIVE = (
    "must be given: hessian(*v, weights), the n x n sum of weights[i] times the Hessian of value i. Zeros leave the "
    "curvature out; of costs that are sums of squares, least_squares() finds one from the Jacobian"
)


@dataclass(frozen=True, eq=False)
class Variables:
    """A few variables of a problem, which blocks are functions of; made by Problem.variables().

    Attributes:
        name: What messages and results call them.
        size: How many they are.
        stages: The first and the last stage at which they are in use.
        number: Place of the first one among all variables of the problem.
    """

    name: str
    size: int
    stages: tuple[int, int]
    number: int


@dataclass
class _Values:
    """What may change from one solve to the next."""

    lower: Array
    upper: Array
    start: Array


@dataclass(frozen=True)
class _Block:
    name: str
    variables: tuple[Variables, ...]
    function: Function | Linear | Quadratic
    rows: int  # of a constraint, 0: a cost
    lower: Array
    upper: Array
    weights: Array | None = None  # of least squares


class Problem:
    """min sum of costs such that equalities and inequalities hold, variables within their bounds.

    Add variables first, then blocks. The same problem may be solved several times, with other bounds and starts
    (``change``), and in several threads at once.
    """

    def __init__(self) -> None:
        self._groups: dict[Variables, _Values] = {}
        self._at: dict[tuple[str, int], Variables] = {}  # by name and first stage
        self._first: dict[str, Variables] = {}  # of each name
        self._rows: dict[str, int] = {}  # of the constraints of each name
        self._blocks: list[_Block] = []

    def variables(
        self,
        name: str,
        size: int,
        stage: int | tuple[int, int] = 0,
        *,
        lower: ArrayLike = -_INF,
        upper: ArrayLike = _INF,
        start: ArrayLike = 0.0,
    ) -> Variables:
        """Add variables. Those of one kind have the same name at every stage, and the same size.

        Args:
            name: What messages and results call them, such as "x".
            size: How many they are.
            stage: The stage at which they are in use, from 0; or the first and the last one for what lasts several
                stages, such as a final time.
            lower, upper: Bounds, a number each or one for all. Equal bounds fix a variable.
            start: Where the solve begins; it is moved into the bounds.

        Raises:
            InvalidArgument: An argument is of another type.
            InvalidInput: There are such variables at the stage already, or of another size; bounds that contradict each
                other; a start that is not finite.
        """
        _require_name("name", name)
        _require_whole(f"{name}: size", size, 1)
        if isinstance(stage, list | tuple) and len(stage) != 2 or isinstance(stage, str):
            raise InvalidArgument(f"{name}: stage", "must be a whole number, or a first and a last one", found(stage))
        first, last = stage if isinstance(stage, list | tuple) else (stage, stage)
        begin = _require_whole(f"{name}: stage", first, 0)
        _require_whole(f"{name}: stage", last, begin)
        where = f"{name} at stage {first}"
        if (name, first) in self._at:
            raise InvalidInput(where, "is there already: give other variables another name")
        others = self._first.get(name)
        if others is not None and others.size != size:
            rule = f"must be {others.size} as at stage {others.stages[0]}, or have another name"
            raise InvalidInput(f"{where}: size", rule, str(size))
        last_group = next(reversed(self._groups), None)
        number = 0 if last_group is None else last_group.number + last_group.size
        group = Variables(name, int(size), (int(first), int(last)), number)
        self._groups[group] = _values(where, group.size, lower, upper, start)
        self._at[name, int(first)] = group
        self._first.setdefault(name, group)
        return group

    def change(
        self,
        variables: Variables,
        *,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        start: ArrayLike | None = None,
    ) -> None:
        """Give variables other bounds or another start, such as the state that was measured.

        Args:
            variables: Of this problem.
            lower, upper, start: As for variables(); None: as they were.

        Raises:
            InvalidArgument, InvalidInput: As for variables().
        """
        old = self._values_of("variables", variables)
        where = f"{variables.name} at stage {variables.stages[0]}"
        given = [(lower, old.lower), (upper, old.upper), (start, old.start)]
        self._groups[variables] = _values(where, variables.size, *(b if a is None else a for a, b in given))

    def equality(self, name: str, variables: Sequence[Variables], function: Function | Linear) -> None:
        """Add that a function is zero, such as the dynamics from one stage to the next.

        Args:
            name: What messages and results call the block.
            variables: What it is a function of: those of one stage or two neighbours, and what lasts.
            function: Of them.

        Raises:
            InvalidArgument: An argument is of another type, or a Function has no Hessian.
            InvalidInput: Variables are those of another problem, or shapes do not fit.
            Exception: What `function.value` raises at the start, where it is called once to count its values.
        """
        self._constrain(name, variables, function, 0.0, 0.0)

    def inequality(
        self,
        name: str,
        variables: Sequence[Variables],
        function: Function | Linear,
        *,
        lower: ArrayLike = -_INF,
        upper: ArrayLike = _INF,
    ) -> None:
        """Add that a function lies within limits.

        Args:
            name, variables, function: As for equality().
            lower, upper: Limits, a number for each row or one for all.

        Raises:
            InvalidArgument, InvalidInput, Exception: As for equality(); limits that contradict each other.
        """
        self._constrain(name, variables, function, lower, upper)

    def cost(self, name: str, variables: Sequence[Variables], function: Function | Linear | Quadratic) -> None:
        """Add a function of one value to the cost.

        Args:
            name, variables: As for equality().
            function: Of one value.

        Raises:
            InvalidArgument, InvalidInput, Exception: As for equality(); more than one value.
        """
        chosen, rows = self._checked(name, variables, function, Function, Linear, Quadratic)
        _require_hessian(name, function)
        if rows != 1:
            raise InvalidInput(
                name, "must be one number: a cost. Sums of squares are least_squares()", f"{rows} numbers"
            )
        if isinstance(function, Linear):
            size = function.matrix.shape[1]
            constant = float(function.constant[0])
            function = Quadratic(np.zeros((size, size)), function.matrix[0])
            function.constant = constant
        self._blocks.append(_Block(name, chosen, function, 0, np.zeros(0), np.zeros(0)))

    def least_squares(
        self,
        name: str,
        variables: Sequence[Variables],
        function: Function | Linear,
        *,
        weights: ArrayLike = 1.0,
    ) -> None:
        """Add 1/2 sum of weights[i] times the square of value i of a function to the cost.

        Without a Hessian of the function the curvature of the cost is J' W J, Gauss and Newton's.

        Args:
            name, variables, function: As for equality(); a Function may have no Hessian.
            weights: Not negative, a number for each value or one for all.

        Raises:
            InvalidArgument, InvalidInput, Exception: As for equality().
        """
        chosen, rows = self._checked(name, variables, function, Function, Linear)
        field = f"{name}: weights"
        weighed = spread(field, numbers(field, weights, 1), rows)
        if (weighed < 0.0).any():
            raise InvalidInput(field, "must not be negative", str(weighed.min()))
        if isinstance(function, Linear):
            block = _Block(name, chosen, squares(name, function, weighed), 0, np.zeros(0), np.zeros(0))
        else:
            block = _Block(name, chosen, function, 0, np.zeros(0), np.zeros(0), weighed)
        self._blocks.append(block)

    def _values_of(self, field: str, variables: Any) -> _Values:
        if not isinstance(variables, Variables):
            raise InvalidArgument(field, "must be what Problem.variables() gave", found(variables))
        values = self._groups.get(variables)
        if values is None:
            raise InvalidInput(field, "must be variables of this problem", f"{variables.name} of another one")
        return values

    def _constrain(self, name: str, variables: Any, function: Any, lower: ArrayLike, upper: ArrayLike) -> None:
        chosen, rows = self._checked(name, variables, function, Function, Linear)
        _require_hessian(name, function)
        limits = [
            spread(f"{name}: {side}", numbers(f"{name}: {side}", value, 1, finite=False), rows)
            for side, value in (("lower", lower), ("upper", upper))
        ]
        _require_order(name, *limits)
        if self._rows.setdefault(name, rows) != rows:
            raise InvalidInput(name, f"must have {self._rows[name]} rows as before, or another name", str(rows))
        self._blocks.append(_Block(name, chosen, function, rows, *limits))

    def _checked(self, name: Any, variables: Any, function: Any, *kinds: type) -> tuple[tuple[Variables, ...], int]:
        """The variables of a block, and how many values its function has; the function is called for that."""
        _require_name("name", name)
        if isinstance(variables, Variables) or not isinstance(variables, Sequence) or not variables:
            raise InvalidArgument(f"{name}: variables", "must be a list of Variables", found(variables))
        starts = []
        for i, group in enumerate(variables):
            values = self._values_of(f"{name}: variables[{i}]", group)
            if group in variables[:i]:
                raise InvalidInput(f"{name}: variables[{i}]", "must be in the list once", f"{group.name} twice")
            starts.append(np.clip(values.start, values.lower, values.upper))
        require(f"{name}: function", function, *kinds)
        size = sum(group.size for group in variables)
        if isinstance(function, Function):
            rows = numbers(f"{name}: value", function.value(*starts), 2, finite=False).size
            if rows == 0:
                raise InvalidInput(f"{name}: value", "must return a number at least", "none")
        else:
            rows = 1 if isinstance(function, Quadratic) else function.matrix.shape[0]
            if function.matrix.shape[1] != size:
                rule = f"must have {size} columns, the size of its variables"
                raise InvalidInput(f"{name}: matrix", rule, str(function.matrix.shape[1]))
        return tuple(variables), rows


@dataclass(frozen=True)
class Given:
    """A problem as it is now: who solves it in another thread may add to it meanwhile.

    Attributes:
        variables: With their values, in their order.
        blocks: In their order.
    """

    variables: list[tuple[Variables, _Values]]
    blocks: list[_Block]

    @classmethod
    def of(cls, problem: Problem) -> Given:
        """The problem as it is now."""
        blocks = list(problem._blocks)  # first: their variables are there before them
        # Another thread may add to them while pairs are made, each of which may set off a collection of garbage; not so
        # while a dictionary is copied.
        return cls(list(problem._groups.copy().items()), blocks)

    @property
    def groups(self) -> list[Variables]:
        """All variables, in their order."""
        return [group for group, _ in self.variables]

    @property
    def rows(self) -> list[tuple[str, int]]:
        """Name and number of rows of each constraint, in their order."""
        return [(block.name, block.rows) for block in self.blocks if block.rows]


def program_of(given: Given, start: Array | None = None) -> Program:
    """The problem as the compiled module takes it.

    Args:
        given: To be solved.
        start: Of all variables, in their order; None: their own.
    """
    out = Program()
    for group, values in given.variables:
        begin = values.start if start is None else start[group.number : group.number + group.size]
        out.add_variables(group.name, values.lower, values.upper, begin, *group.stages)
    for block in given.blocks:
        places = [i for group in block.variables for i in range(group.number, group.number + group.size)]
        function = block.function
        if isinstance(function, Linear):
            out.add_linear(
                block.name, places, function.matrix, block.lower - function.constant, block.upper - function.constant
            )
        elif isinstance(function, Quadratic):
            out.add_quadratic(block.name, places, function.matrix, function.gradient, function.constant)
        else:
            called = (places, [group.size for group in block.variables], *_three(function))
            if block.rows:
                out.add_function(block.name, *called, block.lower, block.upper)
            elif block.weights is None:
                out.add_cost(block.name, *called)
            else:
                out.add_least_squares(block.name, *called, block.weights)
    return out


def _three(function: Function) -> tuple[Any, Any, Any]:
    return function.value, function.jacobian, function.hessian


def _values(where: str, size: int, lower: ArrayLike, upper: ArrayLike, start: ArrayLike) -> _Values:
    out = []
    for side, value in (("lower", lower), ("upper", upper), ("start", start)):
        field = f"{where}: {side}"
        out.append(spread(field, numbers(field, value, 1, finite=side == "start"), size))
    _require_order(where, out[0], out[1])
    return _Values(*out)


def _require_order(where: str, lower: Array, upper: Array) -> None:
    for side, values, never, rule in (
        ("lower", lower, _INF, "below infinity"),
        ("upper", upper, -_INF, "above minus infinity"),
    ):
        wrong = np.flatnonzero(values == never)
        if wrong.size:
            raise InvalidInput(f"{where}: {side}[{wrong[0]}]", f"must lie {rule}", f"{never}")
    crossed = np.flatnonzero(lower > upper)
    if crossed.size:
        i = crossed[0]
        raise InvalidInput(f"{where}: lower[{i}]", f"must not lie above upper[{i}] = {upper[i]:g}", f"{lower[i]:g}")


def _require_hessian(name: str, function: Any) -> None:
    if isinstance(function, Function) and function.hessian is None:
        raise InvalidArgument(f"{name}: hessian", _GIVE, "None")


def _require_name(field: str, name: Any) -> None:
    require(field, name, str)
    if not name or not name.isprintable():
        raise InvalidInput(field, "must be a name that can be printed", shown(name))


def _require_whole(field: str, value: Any, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise InvalidArgument(field, "must be a whole number", found(value))
    if not least <= value <= 10**6:
        raise InvalidInput(field, f"must lie in [{least}, {10**6}]", shown(value))
    return int(value)
