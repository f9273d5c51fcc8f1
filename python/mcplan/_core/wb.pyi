"""
Whole-body motions in space: the solver behind mcplan.motion.
"""

from __future__ import annotations
import collections.abc
import mcplan._core
import numpy
import numpy.typing
import typing

__all__: list[str] = ["Problem", "Solution", "Solver", "Weights"]

class Weights:
    """
    Of the cost of a motion; docs/theory/wb.md says what each is.
    """
    def __init__(self) -> None: ...
    @property
    def acceleration(self) -> float: ...
    @acceleration.setter
    def acceleration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def base(self) -> float: ...
    @base.setter
    def base(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def com(self) -> float: ...
    @com.setter
    def com(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def elastic(self) -> float: ...
    @elastic.setter
    def elastic(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force(self) -> float: ...
    @force.setter
    def force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def posture(self) -> float: ...
    @posture.setter
    def posture(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rate(self) -> float: ...
    @rate.setter
    def rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def swing(self) -> float: ...
    @swing.setter
    def swing(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def swing_rotation(self) -> float: ...
    @swing_rotation.setter
    def swing_rotation(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def torque(self) -> float: ...
    @torque.setter
    def torque(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def velocity(self) -> float: ...
    @velocity.setter
    def velocity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def wrench(self) -> float: ...
    @wrench.setter
    def wrench(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Problem:
    """
    What mcplan.wb hands to the solver: links, nodes, limits, weights.
    """

    weights: Weights
    def __init__(self) -> None: ...
    def add_capsule(
        self,
        link: typing.SupportsInt | typing.SupportsIndex,
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        end: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        radius: typing.SupportsFloat | typing.SupportsIndex,
    ) -> int: ...
    def add_contact(
        self,
        end_effector: typing.SupportsInt | typing.SupportsIndex,
        carries: bool,
        rests: bool,
        friction: typing.SupportsFloat | typing.SupportsIndex,
        position_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        rotation_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"],
        wrench_S: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[6, 1]"],
        points_S: typing.Any,
        load_max: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None:
        """
        To the node that was added last.
        """
    def add_end_effector(
        self,
        name: str,
        link: typing.SupportsInt | typing.SupportsIndex,
        rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"],
        position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        points_S: typing.Any,
    ) -> None: ...
    def add_link(
        self,
        joint: str,
        parent: typing.SupportsInt | typing.SupportsIndex,
        prismatic: bool,
        axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        rotation: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"],
        position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        mass: typing.SupportsFloat | typing.SupportsIndex,
        center_of_mass: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        limits: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"],
    ) -> None:
        """
        limits: position_min, position_max, velocity_max, torque_max.
        """
    def add_node(
        self,
        time_s: typing.SupportsFloat | typing.SupportsIndex,
        com_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        base_zyx: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        acceleration: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        torque: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None:
        """
        acceleration, torque: of their weights.
        """
    def add_pair(
        self,
        first: typing.SupportsInt | typing.SupportsIndex,
        second: typing.SupportsInt | typing.SupportsIndex,
        distance_min: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def add_swing(
        self,
        end_effector: typing.SupportsInt | typing.SupportsIndex,
        position_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        rotation_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"],
        weight: typing.SupportsFloat | typing.SupportsIndex,
        in_tube: bool,
        tube_min_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        tube_max_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
    ) -> None:
        """
        To the node that was added last.
        """
    @property
    def limit_ratio(self) -> float: ...
    @limit_ratio.setter
    def limit_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def point_load_min(self) -> float: ...
    @point_load_min.setter
    def point_load_min(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position_margin(self) -> float: ...
    @position_margin.setter
    def position_margin(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def posture(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @posture.setter
    def posture(self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None: ...
    @property
    def weight_N(self) -> float: ...
    @weight_N.setter
    def weight_N(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Solution:
    """
    How a motion was solved for.
    """
    @property
    def cost(self) -> float: ...
    @property
    def evaluation_s(self) -> float: ...
    @property
    def iterations(self) -> int: ...
    @property
    def linear_solver_s(self) -> float: ...
    @property
    def message(self) -> str: ...
    @property
    def penalty(self) -> float: ...
    @property
    def status(self) -> mcplan._core.Status: ...
    @property
    def time_s(self) -> float: ...
    @property
    def violation(self) -> float: ...
    @property
    def x(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...

class Solver:
    """
    A motion problem with dynamics from Python.
    """
    def __init__(self, problem: Problem, dynamics: collections.abc.Callable) -> None:
        """
        dynamics(derivatives) reads q, v, a, wrenches_S and fills tau, and dq, dv, da where derivatives is true.
        """
    def coefficients(
        self, x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    def forces(
        self, x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (n, 3 p) at the points of all end-effectors [N].
        """
    def slopes(
        self,
        x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        step: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    ) -> tuple[
        float,
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    ]:
        """
        Derivatives of the same along a step.
        """
    def solve(
        self,
        *,
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        max_iterations: typing.SupportsInt | typing.SupportsIndex,
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex,
        constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex,
        cost_tolerance: typing.SupportsFloat | typing.SupportsIndex,
        tolerance: typing.SupportsFloat | typing.SupportsIndex,
        initial_barrier: typing.SupportsFloat | typing.SupportsIndex,
        log: collections.abc.Callable[[str], None] | None,
    ) -> Solution:
        """
        Releases the GIL. `log` gets each line of the iteration table; None: nobody.
        """
    def unknowns(
        self,
        coefficients: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        forces_S: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    def usage(
        self, x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (n, rows) positions beyond their limits, velocities and torques over theirs, distances beyond theirs [m].
        """
    def values(
        self, x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
    ) -> tuple[
        float,
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    ]:
        """
        Cost, equalities, inequalities.
        """
    @property
    def a(self) -> numpy.ndarray: ...
    @property
    def da(self) -> numpy.ndarray: ...
    @property
    def dq(self) -> numpy.ndarray: ...
    @property
    def dv(self) -> numpy.ndarray: ...
    @property
    def equalities(self) -> int: ...
    @property
    def q(self) -> numpy.ndarray: ...
    @property
    def rows(self) -> int: ...
    @property
    def tau(self) -> numpy.ndarray: ...
    @property
    def v(self) -> numpy.ndarray: ...
    @property
    def variables(self) -> int: ...
    @property
    def wrenches_S(self) -> numpy.ndarray: ...
