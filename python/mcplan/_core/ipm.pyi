"""
The interior-point kernel for problems of one's own.
"""

from __future__ import annotations
import collections.abc
import mcplan._core
import mcplan._core.nlp
import numpy
import numpy.typing
import typing

__all__: list[str] = ["Program", "Solution"]

class Solution:
    """
    How a Program was solved; mcplan.ipm.Result has it by name.
    """
    @property
    def bound_multipliers(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def evaluation_s(self) -> float: ...
    @property
    def iterations(self) -> int: ...
    @property
    def linear_solver_s(self) -> float: ...
    @property
    def message(self) -> str: ...
    @property
    def multipliers(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def objective(self) -> float: ...
    @property
    def solver(self) -> mcplan._core.nlp.Solver: ...
    @property
    def status(self) -> mcplan._core.Status: ...
    @property
    def table(self) -> str: ...
    @property
    def time_s(self) -> float: ...
    @property
    def violation(self) -> float: ...
    @property
    def violations(self) -> list[tuple[str, float]]: ...
    @property
    def worst(self) -> str: ...
    @property
    def x(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...

class Program:
    """
    A stage problem as mcplan.ipm hands it over: variables by number, blocks by arrays and functions. Use mcplan.ipm.Problem.
    """
    def __init__(self) -> None: ...
    def add_cost(
        self,
        name: str,
        variables: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        sizes: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        value: collections.abc.Callable,
        jacobian: collections.abc.Callable,
        hessian: typing.Any,
    ) -> None:
        """
        The cost f(v), one number.
        """
    def add_function(
        self,
        name: str,
        variables: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        sizes: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        value: collections.abc.Callable,
        jacobian: collections.abc.Callable,
        hessian: typing.Any,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    ) -> None:
        """
        lower <= f(v) <= upper.
        """
    def add_least_squares(
        self,
        name: str,
        variables: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        sizes: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        value: collections.abc.Callable,
        jacobian: collections.abc.Callable,
        hessian: typing.Any,
        weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    ) -> None:
        """
        The cost 1/2 sum w r(v)^2.
        """
    def add_linear(
        self,
        name: str,
        variables: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        matrix: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    ) -> None:
        """
        lower <= A v <= upper.
        """
    def add_quadratic(
        self,
        name: str,
        variables: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        matrix: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        gradient: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        constant: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        The cost 1/2 v' H v + g' v + c.
        """
    def add_variables(
        self,
        name: str,
        lower: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        upper: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        first_stage: typing.SupportsInt | typing.SupportsIndex,
        last_stage: typing.SupportsInt | typing.SupportsIndex,
    ) -> int:
        """
        The number of the first one.
        """
    def check_derivatives(
        self,
        x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        tolerance: typing.SupportsFloat | typing.SupportsIndex,
    ) -> list:
        """
        Block, kind, row, one or two variables, given and difference of each derivative that is wrong.
        """
    def solve(
        self,
        *,
        solver: mcplan._core.nlp.Solver,
        tolerance: typing.SupportsFloat | typing.SupportsIndex,
        constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex,
        max_iterations: typing.SupportsInt | typing.SupportsIndex,
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex,
        initial_barrier: typing.SupportsFloat | typing.SupportsIndex,
        adaptive_barrier: bool,
        log: collections.abc.Callable[[str], None],
    ) -> Solution:
        """
        Releases the GIL. `log` gets each line of the iteration table; None: nobody.
        """
