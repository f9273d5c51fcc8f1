"""
The compiled part of mcplan: the C++ classes under the same names. SI units, world frame W with z up.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
from . import ddp
from . import nlp
from . import rhp

__all__: list[str] = [
    "CheckResult",
    "Contact",
    "ContactRule",
    "EndEffector",
    "EndEffectorState",
    "EntireFunctions",
    "ForceLaw",
    "Iteration",
    "Knot",
    "LogLevel",
    "Phase",
    "Plan",
    "PlanResult",
    "PlanState",
    "Polygon",
    "Polytope",
    "Report",
    "ResolvedStance",
    "Robot",
    "Scene",
    "Stance",
    "Status",
    "Step",
    "Surface",
    "Swing",
    "Tolerances",
    "Violation",
    "addresses",
    "check",
    "ddp",
    "may_touch",
    "nlp",
    "quat_wxyz_from_rpy",
    "resolve_stance",
    "rhp",
    "rotation_derivative",
    "rotation_from_rpy",
]

class Status:
    """
    How a solve ended. `solved` is set after the independent checker has accepted the plan.

    Members:

      solved

      acceptable

      infeasible

      no_sequence

      iteration_limit

      time_limit

      interrupted

      numerical_failure
    """

    __members__: typing.ClassVar[dict[str, Status]]
    acceptable: typing.ClassVar[Status]
    infeasible: typing.ClassVar[Status]
    interrupted: typing.ClassVar[Status]
    iteration_limit: typing.ClassVar[Status]
    no_sequence: typing.ClassVar[Status]
    numerical_failure: typing.ClassVar[Status]
    solved: typing.ClassVar[Status]
    time_limit: typing.ClassVar[Status]
    @typing.overload
    def __eq__(self, other: Status) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Status) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @typing.overload
    def __str__(self) -> str: ...
    @typing.overload
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class LogLevel:
    """
    Importance of a line given to a logger.

    Members:

      debug

      info

      warning
    """

    __members__: typing.ClassVar[dict[str, LogLevel]]
    debug: typing.ClassVar[LogLevel]
    info: typing.ClassVar[LogLevel]
    warning: typing.ClassVar[LogLevel]
    @typing.overload
    def __eq__(self, other: LogLevel) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: LogLevel) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class EntireFunctions:
    """
    F_n(z) = sum_i z^i / (2i + n)!, z = stiffness [1/s^2] x duration^2 [s^2]: a linear pendulum from flight (z = 0) to stiff contact in one formula.
    """
    def __call__(self, n: typing.SupportsInt | typing.SupportsIndex) -> float:
        """
        F_n(z) [-], n = 0..4.
        """
    def __init__(self, z: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    def derivative(self, n: typing.SupportsInt | typing.SupportsIndex) -> float:
        """
        dF_n/dz, n = 0..2.
        """

class Polygon:
    """
    Convex planar polygon in the world, prepared for distance queries [m].
    """
    def __init__(self, vertices_W: typing.Any) -> None: ...
    def __repr__(self) -> str: ...
    def height(self, point_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> float:
        """
        Height of a point above the plane [m].
        """
    def nearest(
        self, point_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Nearest point of the polygon [m].
        """
    def outside(self, point_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> float:
        """
        Largest overshoot over the edges [m]: negative inside, the distance to the boundary near an edge.
        """
    def tangent_W(
        self, i: typing.SupportsInt | typing.SupportsIndex
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Unit tangents, i = 0, 1: tangent 0 x tangent 1 = normal.
        """
    @property
    def centroid_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    @property
    def normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Unit outward normal.
        """
    @property
    def vertices_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]: ...

class Surface:
    """
    A flat patch of the world that end-effectors may touch.
    """

    name: str
    def __copy__(self) -> Surface: ...
    def __deepcopy__(self, memo: dict) -> Surface: ...
    def __init__(
        self,
        *,
        name: str = "",
        vertices_W: typing.Any = (),
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.7,
        grasp: bool = False,
        end_effectors: collections.abc.Sequence[str] = [],
        thickness: typing.SupportsFloat | typing.SupportsIndex = 0.05,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def end_effectors(self) -> typing.Any:
        """
        Names or kinds that may touch it; empty: all.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[str]) -> None: ...
    @property
    def friction(self) -> float:
        """
        Coulomb coefficient [-].
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def grasp(self) -> bool:
        """
        May be held: no friction cone, the force cap of the end-effector only.
        """
    @grasp.setter
    def grasp(self, arg0: bool) -> None: ...
    @property
    def thickness(self) -> float:
        """
        Solid below the surface that swinging end-effectors must clear [m].
        """
    @thickness.setter
    def thickness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vertices_W(self) -> numpy.ndarray:
        """
        N x 3 [m], convex, coplanar, counter-clockwise about the outward normal.
        """
    @vertices_W.setter
    def vertices_W(self, arg1: typing.Any) -> None: ...

class Stance:
    """
    Where the robot is at the start or the goal; heights come from the robot.
    """
    def __copy__(self) -> Stance: ...
    def __deepcopy__(self, memo: dict) -> Stance: ...
    def __init__(
        self,
        *,
        position_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        yaw: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        contacts: collections.abc.Mapping[str, str] = {},
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def contacts(self) -> typing.Any:
        """
        End-effector or kind -> surface; a name beats its kind. Assign a dict to change it.
        """
    @contacts.setter
    def contacts(self, arg1: collections.abc.Mapping[str, str]) -> None: ...
    @property
    def position_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Point of the ground below the CoM [m].
        """
    @position_W.setter
    def position_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def yaw(self) -> float:
        """
        Heading [rad].
        """
    @yaw.setter
    def yaw(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ContactRule:
    """
    If none of `when_free` is in contact, all of `require` must be.
    """
    def __copy__(self) -> ContactRule: ...
    def __deepcopy__(self, memo: dict) -> ContactRule: ...
    def __init__(
        self, *, when_free: collections.abc.Sequence[str] = [], require: collections.abc.Sequence[str] = []
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def require(self) -> typing.Any:
        """
        Names or kinds of end-effectors.
        """
    @require.setter
    def require(self, arg1: collections.abc.Sequence[str]) -> None: ...
    @property
    def when_free(self) -> typing.Any:
        """
        Names or kinds of end-effectors.
        """
    @when_free.setter
    def when_free(self, arg1: collections.abc.Sequence[str]) -> None: ...

class Step:
    """
    One step of a walk: the foot that swings and the surface on which it lands.
    """
    def __copy__(self) -> Step: ...
    def __deepcopy__(self, memo: dict) -> Step: ...
    def __init__(self, *, end_effector: str = "", surface: str = "") -> None: ...
    def __repr__(self) -> str: ...
    @property
    def end_effector(self) -> str:
        """
        Name of the end-effector that swings.
        """
    @end_effector.setter
    def end_effector(self, arg0: str) -> None: ...
    @property
    def surface(self) -> str:
        """
        Name of the surface on which it lands.
        """
    @surface.setter
    def surface(self, arg0: str) -> None: ...

class Scene:
    """
    The world: surfaces, start and goal. World frame W with z up.
    """

    description: str
    name: str
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, memo: dict) -> Scene: ...
    def __init__(
        self,
        *,
        name: str = "",
        description: str = "",
        gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81,
        surfaces: collections.abc.Sequence[Surface] = [],
        start: Stance = ...,
        goal: Stance = ...,
        rules: collections.abc.Sequence[ContactRule] = [],
        steps: collections.abc.Sequence[Step] = [],
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def surface_index(self, surface_name: str) -> int:
        """
        Index into surfaces, or -1.
        """
    def validate(self) -> None:
        """
        Raise InvalidScene naming the first field out of its range.
        """
    @property
    def goal(self) -> Stance:
        """
        Stance at the goal.
        """
    @goal.setter
    def goal(self, arg1: Stance) -> None: ...
    @property
    def gravity(self) -> float:
        """
        [m/s^2]
        """
    @gravity.setter
    def gravity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rules(self) -> tuple:
        """
        Tuple of ContactRule; assign a list to add or remove.
        """
    @rules.setter
    def rules(self, arg1: collections.abc.Sequence[ContactRule]) -> None: ...
    @property
    def start(self) -> Stance:
        """
        Stance at the start.
        """
    @start.setter
    def start(self, arg1: Stance) -> None: ...
    @property
    def steps(self) -> tuple:
        """
        Contact sequence of a walk, for planners that want it given: tuple of Step; assign a list to change it.
        """
    @steps.setter
    def steps(self, arg1: collections.abc.Sequence[Step]) -> None: ...
    @property
    def surfaces(self) -> tuple:
        """
        Tuple of Surface; assign a list to add or remove.
        """
    @surfaces.setter
    def surfaces(self, arg1: collections.abc.Sequence[Surface]) -> None: ...

class Polytope:
    """
    Convex set {x : A x <= b} [m], rows of A of unit length. Without rows: not given.
    """
    def __copy__(self) -> Polytope: ...
    def __deepcopy__(self, memo: dict) -> Polytope: ...
    def __init__(self, *, A: typing.Any = (), b: typing.Any = ()) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def A(self) -> numpy.ndarray:
        """
        N x 3, rows of unit length.
        """
    @property
    def b(self) -> numpy.ndarray:
        """
        N [m].
        """
    @property
    def given(self) -> bool:
        """
        Whether it has rows.
        """

class EndEffector:
    """
    A contact link of the robot. Frame B sits at the CoM and turns with the base.
    """

    name: str
    def __copy__(self) -> EndEffector: ...
    def __deepcopy__(self, memo: dict) -> EndEffector: ...
    def __init__(
        self,
        *,
        name: str = "",
        kind: str = "foot",
        frame: str = "",
        half_size: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        nominal_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        reach_min_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        reach_max_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        max_force: typing.SupportsFloat | typing.SupportsIndex = ...,
        max_moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        com_reach: Polytope = ...,
        partner_reach: collections.abc.Mapping[str, Polytope] = {},
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def com_reach(self) -> Polytope:
        """
        Where the CoM may be relative to this end-effector while it is in contact; axes level, x along the heading.
        """
    @com_reach.setter
    def com_reach(self, arg1: Polytope) -> None: ...
    @property
    def frame(self) -> str:
        """
        URDF frame, empty for robots without a URDF.
        """
    @frame.setter
    def frame(self, arg0: str) -> None: ...
    @property
    def half_size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Half length and half width of the sole [m]; 0: point contact.
        """
    @half_size.setter
    def half_size(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def kind(self) -> str:
        """
        Group that scenes may address as a whole, e.g. 'foot', 'hand'.
        """
    @kind.setter
    def kind(self, arg0: str) -> None: ...
    @property
    def max_force(self) -> float:
        """
        Largest norm of the contact force [N].
        """
    @max_force.setter
    def max_force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_moment(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Largest contact moment about each world axis [N m].
        """
    @max_moment.setter
    def max_moment(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def nominal_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Nominal position relative to the CoM [m].
        """
    @nominal_B.setter
    def nominal_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def partner_reach(self) -> typing.Any:
        """
        Where other end-effectors may stand relative to it, by name; same axes. Assign a dict to change it.
        """
    @partner_reach.setter
    def partner_reach(self, arg1: collections.abc.Mapping[str, Polytope]) -> None: ...
    @property
    def reach_max_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Box of reachable positions relative to the CoM [m].
        """
    @reach_max_B.setter
    def reach_max_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def reach_min_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Box of reachable positions relative to the CoM [m].
        """
    @reach_min_B.setter
    def reach_min_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...

class Robot:
    """
    What a planner needs to know of a robot: lumped inertia and where its limbs reach.
    """

    description: str
    name: str
    def __copy__(self) -> Robot: ...
    def __deepcopy__(self, memo: dict) -> Robot: ...
    def __init__(
        self,
        *,
        name: str = "",
        description: str = "",
        mass: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        com_height: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        swing_height: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        end_effectors: collections.abc.Sequence[EndEffector] = [],
        urdf: str = "",
        posture: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {},
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def end_effector_index(self, end_effector_name: str) -> int:
        """
        Index, or -1.
        """
    def validate(self) -> None:
        """
        Raise InvalidRobot naming the first field out of its range.
        """
    @property
    def com_height(self) -> float:
        """
        Of the CoM above the ground in the nominal stance [m].
        """
    @com_height.setter
    def com_height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def end_effectors(self) -> tuple:
        """
        Tuple of EndEffector; assign a list to add or remove.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[EndEffector]) -> None: ...
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Diagonal, about the CoM, nominal posture [kg m^2].
        """
    @inertia.setter
    def inertia(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def mass(self) -> float:
        """
        [kg]
        """
    @mass.setter
    def mass(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def posture(self) -> typing.Any:
        """
        Nominal joint positions [rad] by URDF joint name. Assign a dict to change it.
        """
    @posture.setter
    def posture(self, arg1: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def swing_height(self) -> float:
        """
        Clearance of a swinging end-effector [m].
        """
    @swing_height.setter
    def swing_height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def urdf(self) -> str:
        """
        Path, or 'example-robot-data:NAME'; empty: none.
        """
    @urdf.setter
    def urdf(self, arg0: str) -> None: ...

class ResolvedStance:
    """
    A stance of a scene worked out for one robot.
    """
    def __copy__(self) -> ResolvedStance: ...
    def __deepcopy__(self, memo: dict) -> ResolvedStance: ...
    def __repr__(self) -> str: ...
    @property
    def com_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m]
        """
    @property
    def contacts(self) -> list[int]:
        """
        Surface index per end-effector, -1: free.
        """
    @property
    def end_effectors_W(self) -> numpy.ndarray:
        """
        Nominal positions, those in contact on their surface [m].
        """
    @end_effectors_W.setter
    def end_effectors_W(self, arg1: typing.Any) -> None: ...
    @property
    def yaw(self) -> float:
        """
        [rad]
        """

class ForceLaw:
    """
    How contact forces depend on time within a phase.

    Members:

      pendulum : f(t) = mass stiffness (com(t) - anchor): the multi-contact pendulum.

      held : Forces at points, constant over each of `intervals` equal intervals.

      linear : Forces at points, linear over each of `intervals` equal intervals.
    """

    __members__: typing.ClassVar[dict[str, ForceLaw]]
    held: typing.ClassVar[ForceLaw]
    linear: typing.ClassVar[ForceLaw]
    pendulum: typing.ClassVar[ForceLaw]
    @typing.overload
    def __eq__(self, other: ForceLaw) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ForceLaw) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    @typing.overload
    def __repr__(self) -> str: ...
    @typing.overload
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Contact:
    """
    What one end-effector does during one phase: f(t) = mass stiffness (com(t) - anchor), or forces at points where the phase's law says so.
    """
    def __copy__(self) -> Contact: ...
    def __deepcopy__(self, memo: dict) -> Contact: ...
    def __init__(
        self,
        *,
        surface: typing.SupportsInt | typing.SupportsIndex = -1,
        stiffness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        anchor_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        moment_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        points_W: typing.Any = (),
        point_forces_W: typing.Any = (),
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def anchor_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Point through which the line of force passes [m].
        """
    @anchor_W.setter
    def anchor_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def moment_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Contact moment, constant over the phase [N m].
        """
    @moment_W.setter
    def moment_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def point_forces_W(self) -> numpy.ndarray:
        """
        [N] node by node, a row for each point: (Phase.node_count() N) x 3.
        """
    @point_forces_W.setter
    def point_forces_W(self, arg1: typing.Any) -> None: ...
    @property
    def points_W(self) -> numpy.ndarray:
        """
        N x 3 [m], where forces act, e.g. the corners of the sole.
        """
    @points_W.setter
    def points_W(self, arg1: typing.Any) -> None: ...
    @property
    def stiffness(self) -> float:
        """
        mu [1/s^2], 0 when free.
        """
    @stiffness.setter
    def stiffness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def surface(self) -> int:
        """
        Index into scene.surfaces, -1: free.
        """
    @surface.setter
    def surface(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class Phase:
    """
    A stretch of time with constant contacts.
    """
    def __copy__(self) -> Phase: ...
    def __deepcopy__(self, memo: dict) -> Phase: ...
    def __init__(
        self,
        *,
        duration: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        contacts: collections.abc.Sequence[Contact] = [],
        law: ForceLaw = ...,
        intervals: typing.SupportsInt | typing.SupportsIndex = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def node_count(self) -> int:
        """
        Instants at which forces are given: `intervals` when held, one more when linear, 0 for the pendulum.
        """
    @property
    def contacts(self) -> tuple:
        """
        One Contact per end-effector.
        """
    @contacts.setter
    def contacts(self, arg1: collections.abc.Sequence[Contact]) -> None: ...
    @property
    def duration(self) -> float:
        """
        [s]
        """
    @duration.setter
    def duration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def intervals(self) -> int:
        """
        Of the forces at points, equally long; 0 for the pendulum.
        """
    @intervals.setter
    def intervals(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def law(self) -> ForceLaw:
        """
        How forces depend on time.
        """
    @law.setter
    def law(self, arg0: ForceLaw) -> None: ...

class Knot:
    """
    State at the instant between two phases.
    """
    def __copy__(self) -> Knot: ...
    def __deepcopy__(self, memo: dict) -> Knot: ...
    def __init__(
        self,
        *,
        com_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        com_velocity_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        base_rpy: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        base_rpy_rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        end_effectors_W: typing.Any = (),
        end_effector_velocities_W: typing.Any = (),
        angular_momentum_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def angular_momentum_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        About the CoM [kg m^2/s]; not looked at under ForceLaw.pendulum, whose base carries it.
        """
    @angular_momentum_W.setter
    def angular_momentum_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_rpy(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Roll, pitch, yaw of the base [rad].
        """
    @base_rpy.setter
    def base_rpy(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_rpy_rate(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [rad/s]
        """
    @base_rpy_rate.setter
    def base_rpy_rate(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def com_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m]
        """
    @com_W.setter
    def com_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def com_velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s]
        """
    @com_velocity_W.setter
    def com_velocity_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def end_effector_velocities_W(self) -> numpy.ndarray:
        """
        [m/s], zero at contacts.
        """
    @end_effector_velocities_W.setter
    def end_effector_velocities_W(self, arg1: typing.Any) -> None: ...
    @property
    def end_effectors_W(self) -> numpy.ndarray:
        """
        One row per end-effector [m].
        """
    @end_effectors_W.setter
    def end_effectors_W(self, arg1: typing.Any) -> None: ...

class Swing:
    """
    A stretch of phases, first_phase to end_phase - 1, in which an end-effector is free.
    """
    def __copy__(self) -> Swing: ...
    def __deepcopy__(self, memo: dict) -> Swing: ...
    def __init__(
        self,
        *,
        end_effector: typing.SupportsInt | typing.SupportsIndex = 0,
        first_phase: typing.SupportsInt | typing.SupportsIndex = 0,
        end_phase: typing.SupportsInt | typing.SupportsIndex = 0,
        height: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        lift_normal_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        land_normal_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def end_effector(self) -> int: ...
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def end_phase(self) -> int: ...
    @end_phase.setter
    def end_phase(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def first_phase(self) -> int: ...
    @first_phase.setter
    def first_phase(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def height(self) -> float:
        """
        [m]
        """
    @height.setter
    def height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def land_normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Unit normal of the surface it reaches.
        """
    @land_normal_W.setter
    def land_normal_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def lift_normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Unit normal of the surface it leaves.
        """
    @lift_normal_W.setter
    def lift_normal_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...

class EndEffectorState:
    """
    An end-effector at an instant.
    """
    def __copy__(self) -> EndEffectorState: ...
    def __deepcopy__(self, memo: dict) -> EndEffectorState: ...
    def __repr__(self) -> str: ...
    @property
    def force_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Contact force on the robot [N], zero when free.
        """
    @property
    def moment_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Contact moment on the robot [N m], zero when free.
        """
    @property
    def point_forces_W(self) -> numpy.ndarray:
        """
        N x 3, force on the robot at each point [N].
        """
    @property
    def points_W(self) -> numpy.ndarray:
        """
        N x 3 [m], where the law has forces at points.
        """
    @property
    def position_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m]
        """
    @property
    def surface(self) -> int:
        """
        Index into scene.surfaces, -1: free.
        """
    @property
    def velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s]
        """

class PlanState:
    """
    The robot at an instant.
    """
    def __copy__(self) -> PlanState: ...
    def __deepcopy__(self, memo: dict) -> PlanState: ...
    def __repr__(self) -> str: ...
    @property
    def angular_momentum_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        About the CoM [kg m^2/s].
        """
    @property
    def base_quat_wxyz(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        R_WB
        """
    @property
    def base_rpy(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [rad]
        """
    @property
    def base_rpy_rate(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [rad/s]
        """
    @property
    def com_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m]
        """
    @property
    def com_acceleration_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s^2]
        """
    @property
    def com_velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s]
        """
    @property
    def end_effectors(self) -> tuple:
        """
        One EndEffectorState per end-effector of the robot.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[EndEffectorState]) -> None: ...
    @property
    def phase(self) -> int: ...
    @property
    def time(self) -> float:
        """
        [s]
        """

class Plan:
    """
    A motion: phases with constant contacts between knots. Carries its scene and robot.
    """
    @staticmethod
    def load(path: typing.Any) -> Plan:
        """
        Read a plan written by save(). Raises InvalidPlan.
        """
    def __copy__(self) -> Plan: ...
    def __deepcopy__(self, memo: dict) -> Plan: ...
    def __init__(
        self,
        *,
        scene: Scene = ...,
        robot: Robot = ...,
        planner: str = "",
        knots: collections.abc.Sequence[Knot] = [],
        phases: collections.abc.Sequence[Phase] = [],
        final_contacts: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
        swings: collections.abc.Sequence[Swing] = [],
        measured_start: bool = False,
        open_end: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    @typing.overload
    def __repr__(self) -> str: ...
    @typing.overload
    def __repr__(self) -> str: ...
    def at(self, t: typing.SupportsFloat | typing.SupportsIndex) -> PlanState:
        """
        PlanState at time t [s] in [0, duration], in closed form. At a knot the phase that begins there is meant (the last one at the end). Raises InvalidInput outside.
        """
    def at_phase(
        self, k: typing.SupportsInt | typing.SupportsIndex, since_start: typing.SupportsFloat | typing.SupportsIndex
    ) -> PlanState:
        """
        PlanState `since_start` [s] after the start of phase k: says which side of a knot is meant.
        """
    def contact_sequence(self) -> list[list[int]]:
        """
        Surface index per phase and end-effector, -1: free.
        """
    def duration(self) -> float:
        """
        [s]
        """
    def end_effector_count(self) -> int: ...
    def knot_times(self) -> list[float]:
        """
        [s], phases + 1 entries, from 0.
        """
    def save(self, path: typing.Any) -> None:
        """
        Write the plan to an .npz file.
        """
    def validate(self) -> None:
        """
        Raise InvalidPlan when sizes or indices do not fit together or a number is not finite.
        """
    @property
    def final_contacts(self) -> typing.Any:
        """
        Surface index per end-effector after the last phase.
        """
    @final_contacts.setter
    def final_contacts(self, arg1: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> None: ...
    @property
    def knots(self) -> tuple:
        """
        Tuple of Knot, one more than phases.
        """
    @knots.setter
    def knots(self, arg1: collections.abc.Sequence[Knot]) -> None: ...
    @property
    def measured_start(self) -> bool:
        """
        Starts from a measured state, not from the scene's start.
        """
    @measured_start.setter
    def measured_start(self, arg0: bool) -> None: ...
    @property
    def open_end(self) -> bool:
        """
        Ends on the way, not at the scene's goal.
        """
    @open_end.setter
    def open_end(self, arg0: bool) -> None: ...
    @property
    def phases(self) -> tuple:
        """
        Tuple of Phase.
        """
    @phases.setter
    def phases(self, arg1: collections.abc.Sequence[Phase]) -> None: ...
    @property
    def planner(self) -> str:
        """
        E.g. 'ddp'.
        """
    @planner.setter
    def planner(self, arg0: str) -> None: ...
    @property
    def robot(self) -> Robot:
        """
        The robot it was made for.
        """
    @robot.setter
    def robot(self, arg1: Robot) -> None: ...
    @property
    def scene(self) -> Scene:
        """
        The scene it was made for.
        """
    @scene.setter
    def scene(self, arg1: Scene) -> None: ...
    @property
    def swings(self) -> tuple:
        """
        Tuple of Swing.
        """
    @swings.setter
    def swings(self, arg1: collections.abc.Sequence[Swing]) -> None: ...

class Violation:
    """
    A constraint and the place where a plan breaks it most.
    """

    unit: str
    def __copy__(self) -> Violation: ...
    def __deepcopy__(self, memo: dict) -> Violation: ...
    def __init__(
        self,
        *,
        name: str = "",
        phase: typing.SupportsInt | typing.SupportsIndex = -1,
        end_effector: str = "",
        time_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        unit: str = "",
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __str__(self) -> str: ...
    @property
    def end_effector(self) -> str:
        """
        Empty: not tied to one.
        """
    @end_effector.setter
    def end_effector(self, arg0: str) -> None: ...
    @property
    def name(self) -> str:
        """
        E.g. 'friction'.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def phase(self) -> int:
        """
        -1: not tied to a phase.
        """
    @phase.setter
    def phase(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def time_s(self) -> float: ...
    @time_s.setter
    def time_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        Largest value that is still accepted.
        """
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def value(self) -> float:
        """
        Amount beyond the limit, in `unit`; negative: margin left.
        """
    @value.setter
    def value(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Iteration:
    """
    One row of the iteration table.
    """
    def __copy__(self) -> Iteration: ...
    def __deepcopy__(self, memo: dict) -> Iteration: ...
    def __repr__(self) -> str: ...
    @property
    def contact_weight(self) -> float: ...
    @property
    def cost(self) -> float:
        """
        Total, at the weight of this iteration.
        """
    @property
    def defect(self) -> float:
        """
        Largest dynamics defect (non-dimensional).
        """
    @property
    def index(self) -> int: ...
    @property
    def merit(self) -> float:
        """
        What the line search lowers.
        """
    @property
    def neighbours(self) -> int:
        """
        Candidates priced.
        """
    @property
    def proximal_weight(self) -> float: ...
    @property
    def sequence(self) -> list[list[int]]:
        """
        Steps x end-effectors after this iteration, if history is recorded.
        """
    @property
    def step(self) -> float:
        """
        Accepted step length.
        """
    @property
    def switches(self) -> int:
        """
        Contact switches accepted in this iteration.
        """

class Report:
    """
    How a solve went; str() tells it in a few lines.
    """
    def __copy__(self) -> Report: ...
    def __deepcopy__(self, memo: dict) -> Report: ...
    def __repr__(self) -> str: ...
    def __str__(self) -> str: ...
    @property
    def cost(self) -> float: ...
    @property
    def cost_terms(self) -> dict[str, float]: ...
    @property
    def friction_use(self) -> dict[str, float]:
        """
        Largest tangential over normal force by end-effector, grasps included.
        """
    @property
    def history(self) -> tuple:
        """
        One Iteration a row.
        """
    @history.setter
    def history(self, arg1: collections.abc.Sequence[Iteration]) -> None: ...
    @property
    def iterations(self) -> int: ...
    @property
    def message(self) -> str: ...
    @property
    def seed(self) -> int: ...
    @property
    def status(self) -> Status: ...
    @property
    def switches(self) -> int: ...
    @property
    def threads(self) -> int: ...
    @property
    def time_s(self) -> float:
        """
        Wall clock of the whole solve.
        """
    @property
    def timing_s(self) -> dict[str, float]:
        """
        Wall clock by part.
        """
    @property
    def version(self) -> str: ...
    @property
    def worst_violation(self) -> Violation:
        """
        Largest value / tolerance over all constraints.
        """

class PlanResult:
    """
    A plan and how it was found.
    """
    def __copy__(self) -> PlanResult: ...
    def __deepcopy__(self, memo: dict) -> PlanResult: ...
    def __repr__(self) -> str: ...
    @property
    def plan(self) -> Plan: ...
    @property
    def report(self) -> Report: ...

class Tolerances:
    """
    Published tolerances of the checker.
    """
    def __copy__(self) -> Tolerances: ...
    def __deepcopy__(self, memo: dict) -> Tolerances: ...
    def __init__(
        self,
        *,
        dynamics: typing.SupportsFloat | typing.SupportsIndex = 1e-08,
        contact_distance: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        slip: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        force: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        force_cap: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        moment: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        reach: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.005,
        boundary: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        stance: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        switches: typing.SupportsInt | typing.SupportsIndex = 1,
        sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.001,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def boundary(self) -> float:
        """
        [m], [m/s], [rad] start and goal against the scene's.
        """
    @boundary.setter
    def boundary(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearance(self) -> float:
        """
        [m] swinging end-effector inside a solid.
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_distance(self) -> float:
        """
        [m] end-effector in contact off its plane or polygon.
        """
    @contact_distance.setter
    def contact_distance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def dynamics(self) -> float:
        """
        [m], [m/s], [rad], [rad/s] replayed state against the next knot.
        """
    @dynamics.setter
    def dynamics(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force(self) -> float:
        """
        [N] pull of a contact, or force of a free end-effector.
        """
    @force.setter
    def force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force_cap(self) -> float:
        """
        [-] relative excess over max_force.
        """
    @force_cap.setter
    def force_cap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> float:
        """
        [-] tangential over normal force, beyond the coefficient.
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def moment(self) -> float:
        """
        [N m] excess over max_moment or the torsion the contact can give.
        """
    @moment.setter
    def moment(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def reach(self) -> float:
        """
        [m] outside the reach box.
        """
    @reach.setter
    def reach(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sample_s(self) -> float:
        """
        [s] sampling of the constraints in time.
        """
    @sample_s.setter
    def sample_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def slip(self) -> float:
        """
        [m] travel of an end-effector while in contact.
        """
    @slip.setter
    def slip(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stance(self) -> float:
        """
        [m] end-effectors in contact at the start off the nominal stance.
        """
    @stance.setter
    def stance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def switches(self) -> int:
        """
        [-] contacts made or broken in one step; surface to surface counts two.
        """
    @switches.setter
    def switches(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class CheckResult:
    """
    The worst place of every constraint, violated or not.
    """
    def __repr__(self) -> str: ...
    def __str__(self) -> str: ...
    def ok(self) -> bool: ...
    def raise_if_violated(self) -> None:
        """
        Raise PlanViolated naming the worst violation, if there is one.
        """
    def violations(self) -> list[Violation]:
        """
        Those beyond their tolerance, worst first.
        """
    def worst(self) -> Violation:
        """
        Largest value / tolerance, violated or not.
        """
    @property
    def constraints(self) -> tuple:
        """
        Tuple of Violation, violated or not.
        """
    @constraints.setter
    def constraints(self, arg1: collections.abc.Sequence[Violation]) -> None: ...

def addresses(who: str, end_effector: EndEffector) -> bool:
    """
    Whether a name or kind addresses this end-effector.
    """

def check(plan: Plan, scene: Scene = None, robot: Robot = None, tolerances: Tolerances = ...) -> CheckResult:
    """
    Check a plan against a scene and a robot (None: those it carries), from its positions, forces and polygons alone. Raises InvalidPlan when its arrays do not fit together.
    """

def may_touch(surface: Surface, end_effector: EndEffector) -> bool:
    """
    Whether the surface lists the end-effector, by name or kind, or lists nobody.
    """

def quat_wxyz_from_rpy(
    rpy: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
    """
    Unit quaternion (w, x, y, z) of R_WB, w >= 0.
    """

def resolve_stance(scene: Scene, robot: Robot, stance: Stance, field: str = "stance") -> ResolvedStance:
    """
    Work out a stance for a robot. Raises InvalidScene when contacts name an end-effector that the robot does not have, or one that may not touch the surface.
    """

def rotation_derivative(
    rpy: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], i: typing.SupportsInt | typing.SupportsIndex
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    dR_WB/d(rpy[i]), i = 0 (roll), 1 (pitch), 2 (yaw); 3 x 3.
    """

def rotation_from_rpy(
    rpy: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    R_WB = Rz(yaw) Ry(pitch) Rx(roll), angles in [rad]; 3 x 3.
    """

__version__: str = "0.1.0"
