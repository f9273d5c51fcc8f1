"""
The compiled part of mcplan: the C++ classes under the same names. SI units, world frame W with z up.
"""

from __future__ import annotations
import collections.abc
import mcplan.samples
import numpy
import numpy.typing
import pathlib
import typing
from . import ddp
from . import nlp
from . import ipm
from . import rhp
from . import sip
from . import wb
from . import online

__all__: list[str] = [
    "Capsule",
    "CheckResult",
    "Contact",
    "ContactLoad",
    "ContactRule",
    "Drift",
    "EndEffector",
    "EndEffectorState",
    "EntireFunctions",
    "ForceLaw",
    "Iteration",
    "Knot",
    "LimbLimits",
    "LogLevel",
    "Phase",
    "Plan",
    "PlanFrom",
    "PlanLoads",
    "PlanResult",
    "PlanState",
    "PlanarBody",
    "PlanarClearance",
    "PlanarConfiguration",
    "PlanarContact",
    "PlanarEndEffector",
    "PlanarForce",
    "PlanarForceLaw",
    "PlanarInverseDynamics",
    "PlanarMotion",
    "PlanarMotionOfFrame",
    "PlanarNoClearance",
    "PlanarPhase",
    "PlanarPlan",
    "PlanarPointForce",
    "PlanarPose",
    "PlanarRobot",
    "PlanarState",
    "PlanarSurface",
    "PlanarTask",
    "PlanarTolerances",
    "Polygon",
    "Polytope",
    "Report",
    "ResolvedStance",
    "Robot",
    "Scene",
    "SolidDepth",
    "Stance",
    "Status",
    "Step",
    "Surface",
    "Swing",
    "Tolerances",
    "TrunkPart",
    "Violation",
    "WholeBodyPlan",
    "WholeBodyState",
    "WholeBodyTolerances",
    "addresses",
    "any_plan_from_json",
    "built_in",
    "check",
    "compiled_with",
    "data_folder",
    "ddp",
    "file_kind",
    "ipm",
    "join_surfaces",
    "largest_drift",
    "least_norm_gain",
    "load_planar_robot",
    "load_planar_task",
    "load_robot",
    "load_scene",
    "may_touch",
    "moment_point_W",
    "nlp",
    "online",
    "plan_from_json",
    "plan_loads",
    "plan_samples",
    "plan_to_json",
    "planar_inverse_dynamics",
    "planar_kinematics",
    "planar_plan_from_json",
    "planar_plan_to_json",
    "planar_point",
    "planar_robot_from_dict",
    "planar_robot_to_dict",
    "planar_task_from_dict",
    "planar_task_from_plain",
    "planar_task_to_dict",
    "planar_task_to_plain",
    "quat_wxyz_from_rpy",
    "read_planar_robot",
    "read_planar_task",
    "read_robot",
    "read_scene",
    "require_ground",
    "require_standing",
    "resolve_stance",
    "rhp",
    "robot_from_dict",
    "robot_to_dict",
    "rotation_derivative",
    "rotation_from_rpy",
    "scene_from_dict",
    "scene_to_dict",
    "schema_text",
    "sip",
    "solid_depths",
    "suspicious_geometry",
    "toml_from",
    "toml_text",
    "wb",
    "whole_outlines",
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

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Surface: ...
    def __deepcopy__(self, memo: dict) -> Surface: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        vertices_W: typing.Any = (),
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.7,
        grasp: bool = False,
        thickness: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        end_effectors: collections.abc.Sequence[str] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def end_effectors(self) -> typing.Any:
        """
        Names or kinds of those that may touch it; empty: all.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[str]) -> None: ...
    @property
    def friction(self) -> float:
        """
        [-] Coulomb coefficient.
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def grasp(self) -> bool:
        """
        May be held: no friction cone, only the end-effector's force cap.
        """
    @grasp.setter
    def grasp(self, arg0: bool) -> None: ...
    @property
    def name(self) -> str:
        """
        Unique name.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def thickness(self) -> float:
        """
        [m] Solid below the surface that swings must clear.
        """
    @thickness.setter
    def thickness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vertices_W(self) -> numpy.ndarray:
        """
        N x 3 [m] Corners of a convex polygon, world frame, counter-clockwise about the outward normal.
        """
    @vertices_W.setter
    def vertices_W(self, arg1: typing.Any) -> None: ...

class Stance:
    """
    Where the robot is at the start or the goal. Heights come from the robot.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Stance: ...
    def __deepcopy__(self, memo: dict) -> Stance: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        position_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        yaw: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        contacts: collections.abc.Mapping[str, str] = {},
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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
        [m] Point of the ground below the CoM, world frame.
        """
    @position_W.setter
    def position_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def yaw(self) -> float:
        """
        [rad] Heading.
        """
    @yaw.setter
    def yaw(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ContactRule:
    """
    If none of `when_free` is in contact, all of `require` must be.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> ContactRule: ...
    def __deepcopy__(self, memo: dict) -> ContactRule: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self, *, when_free: collections.abc.Sequence[str] = [], require: collections.abc.Sequence[str] = []
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Step: ...
    def __deepcopy__(self, memo: dict) -> Step: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(self, *, end_effector: str = "", surface: str = "") -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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
    The world: surfaces, start and goal. World frame W with z up, SI units.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, memo: dict) -> Scene: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
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
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def save(self, path: str | pathlib.Path) -> None:
        """
        Write a TOML file, which is complete or not there at all; mcplan.load_scene and load_robot, and C++, read it.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name has another ending, is empty or that of a folder.
            InvalidScene, InvalidRobot: A field is out of its range; the message names it.
            OSError: The file cannot be written.
        """
    def surface_index(self, surface_name: str) -> int:
        """
        Index into surfaces, or -1.
        """
    def validate(self) -> None:
        """
        Raise InvalidScene naming all that is out of its range.
        """
    @property
    def description(self) -> str:
        """
        One line.
        """
    @description.setter
    def description(self, arg0: str) -> None: ...
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
        [m/s^2] Acceleration, downwards.
        """
    @gravity.setter
    def gravity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Name; of a file that says none, the file's.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def rules(self) -> tuple:
        """
        Tuple: Rules of contacts; assign a list to add or remove.
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
        Tuple: Contact sequence of a walk, for planners that want it given; assign a list to change it.
        """
    @steps.setter
    def steps(self, arg1: collections.abc.Sequence[Step]) -> None: ...
    @property
    def surfaces(self) -> tuple:
        """
        Tuple: Surfaces; assign a list to add or remove.
        """
    @surfaces.setter
    def surfaces(self, arg1: collections.abc.Sequence[Surface]) -> None: ...

class Polytope:
    """
    Convex set {x : A x <= b} [m], rows of A of unit length. Without rows: not given.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Polytope: ...
    def __deepcopy__(self, memo: dict) -> Polytope: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(self, *, A: typing.Any = (), b: typing.Any = ()) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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

class LimbLimits:
    """
    What the main joints of a leg can do, and how thick it is: a virtual leg of two links between hip and ankle that bend in the plane in which the sole heads.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> LimbLimits: ...
    def __deepcopy__(self, memo: dict) -> LimbLimits: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        hip_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        hip_shift: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        upper: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        lower: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        ankle: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        bends_backward: bool = False,
        margin: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        radius: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        beside: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        knee_torque: typing.SupportsFloat | typing.SupportsIndex = ...,
        knee_speed: typing.SupportsFloat | typing.SupportsIndex = ...,
        hip_torque: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        ankle_torque: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def ankle(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] From the end-effector to the ankle, axes of the sole.
        """
    @ankle.setter
    def ankle(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def ankle_torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [N m] Largest torque of the ankle, likewise.
        """
    @ankle_torque.setter
    def ankle_torque(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def bends_backward(self) -> bool:
        """
        Whether the knee is behind the line from hip to ankle.
        """
    @bends_backward.setter
    def bends_backward(self, arg0: bool) -> None: ...
    @property
    def beside(self) -> float:
        """
        [m] By how much the capsules' lines lie to the left of the joints, along the axis of the knee.
        """
    @beside.setter
    def beside(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def given(self) -> bool:
        """
        Whether limits are given.
        """
    @property
    def hip_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Hip relative to the CoM in the nominal stance, axes of the base.
        """
    @hip_B.setter
    def hip_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def hip_shift(self) -> float:
        """
        [-] Motion of the hip against the CoM over that of each end-effector with limits against it.
        """
    @hip_shift.setter
    def hip_shift(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def hip_torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [N m] Largest torque of the hip about its roll and pitch axes.
        """
    @hip_torque.setter
    def hip_torque(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def knee_speed(self) -> float:
        """
        [rad/s] Largest speed of the knee.
        """
    @knee_speed.setter
    def knee_speed(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def knee_torque(self) -> float:
        """
        [N m] Largest torque of the knee.
        """
    @knee_torque.setter
    def knee_torque(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def lower(self) -> float:
        """
        [m] Length from knee to ankle.
        """
    @lower.setter
    def lower(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def margin(self) -> float:
        """
        [m] By how much the hip may be elsewhere: levers are those of the worse leg.
        """
    @margin.setter
    def margin(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def radius(self) -> float:
        """
        [m] Of capsules from hip to knee and on to the middle of the lower link that keep out of solids; 0: none.
        """
    @radius.setter
    def radius(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def upper(self) -> float:
        """
        [m] Length from hip to knee; 0 in memory: no limits.
        """
    @upper.setter
    def upper(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class EndEffector:
    """
    A contact link. Positions relative to the CoM, in axes that turn with the base (x forward, y left, z up).
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> EndEffector: ...
    def __deepcopy__(self, memo: dict) -> EndEffector: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        kind: str = "foot",
        frame: str = "",
        frame_offset: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        half_size: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        nominal_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        reach_min_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        reach_max_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        usual_reach: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        reach_cut: Polytope = ...,
        max_force: typing.SupportsFloat | typing.SupportsIndex = ...,
        max_moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        yaw_range: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        com_reach: Polytope = ...,
        partner_reach: collections.abc.Mapping[str, Polytope] = {},
        limb: LimbLimits = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def usual_box(
        self,
    ) -> tuple[
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"],
    ]:
        """
        The reach box within usual_reach: its lower and upper corner [m].
        """
    @property
    def com_reach(self) -> Polytope:
        """
        [m] Where the CoM may be relative to the sole's centre. Axes: level, x along the heading.
        """
    @com_reach.setter
    def com_reach(self, arg1: Polytope) -> None: ...
    @property
    def frame(self) -> str:
        """
        URDF frame; empty for robots without a URDF.
        """
    @frame.setter
    def frame(self, arg0: str) -> None: ...
    @property
    def frame_offset(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Contact point in the axes of the URDF frame.
        """
    @frame_offset.setter
    def frame_offset(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def half_size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] Half length and half width of the sole; zero: point contact.
        """
    @half_size.setter
    def half_size(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def kind(self) -> str:
        """
        Group that scenes may address as a whole, e.g. foot, hand.
        """
    @kind.setter
    def kind(self, arg0: str) -> None: ...
    @property
    def limb(self) -> LimbLimits:
        """
        Joint limits of the leg that carries it, where given.
        """
    @limb.setter
    def limb(self, arg1: LimbLimits) -> None: ...
    @property
    def max_force(self) -> float:
        """
        [N] Largest norm of the contact force.
        """
    @max_force.setter
    def max_force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_moment(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [N m] Largest contact moment about each world axis; under ForceLaw.wrench the third about the surface's normal.
        """
    @max_moment.setter
    def max_moment(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def name(self) -> str:
        """
        Unique name.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def nominal_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Position in the nominal stance.
        """
    @nominal_B.setter
    def nominal_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def partner_reach(self) -> typing.Any:
        """
        [m] Where other end-effectors may stand relative to it, by name. Same axes. Assign a dict to change it.
        """
    @partner_reach.setter
    def partner_reach(self, arg1: collections.abc.Mapping[str, Polytope]) -> None: ...
    @property
    def reach_cut(self) -> Polytope:
        """
        [m] Faces that cut the box, four at most: a sole is lifted higher ahead than behind. Not beside com_reach.
        """
    @reach_cut.setter
    def reach_cut(self, arg1: Polytope) -> None: ...
    @property
    def reach_max_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Upper corner of the box of reachable positions.
        """
    @reach_max_B.setter
    def reach_max_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def reach_min_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Lower corner of the box of reachable positions.
        """
    @reach_min_B.setter
    def reach_min_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def usual_reach(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] What of the box's length plans keep to where steps within it make an easy walk, back and ahead; left out: all of it.
        """
    @usual_reach.setter
    def usual_reach(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def yaw_range(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [rad] How far the sole may be turned against the base, right and left; left out: any way.
        """
    @yaw_range.setter
    def yaw_range(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...

class TrunkPart:
    """
    A capsule that turns with the base, about as large as what it stands for: all points within a radius of a line.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> TrunkPart: ...
    def __deepcopy__(self, memo: dict) -> TrunkPart: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        from_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        to_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        radius: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def from_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Lower, rear or right end of the line, relative to the CoM, axes of the base.
        """
    @from_B.setter
    def from_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def radius(self) -> float:
        """
        [m] Distance from the line.
        """
    @radius.setter
    def radius(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def to_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] The other end, likewise.
        """
    @to_B.setter
    def to_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...

class Robot:
    """
    What a planner needs to know of a robot: lumped inertia and where its limbs reach. SI units.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Robot: ...
    def __deepcopy__(self, memo: dict) -> Robot: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        description: str = "",
        mass: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        inertia: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        com_height: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        max_com_speed: typing.SupportsFloat | typing.SupportsIndex = ...,
        swing_height: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        phase_duration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        sole_support: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        pressure_ratio: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        tracked: bool = False,
        trunk: collections.abc.Sequence[TrunkPart] = [],
        urdf: str = "",
        end_effectors: collections.abc.Sequence[EndEffector] = [],
        posture: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {},
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def end_effector_index(self, end_effector_name: str) -> int:
        """
        Index, or -1.
        """
    def save(self, path: str | pathlib.Path) -> None:
        """
        Write a TOML file, which is complete or not there at all; mcplan.load_scene and load_robot, and C++, read it.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name has another ending, is empty or that of a folder.
            InvalidScene, InvalidRobot: A field is out of its range; the message names it.
            OSError: The file cannot be written.
        """
    def validate(self) -> None:
        """
        Raise InvalidRobot naming all that is out of its range.
        """
    @property
    def com_height(self) -> float:
        """
        [m] Of the CoM above the ground in the nominal stance.
        """
    @com_height.setter
    def com_height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def description(self) -> str:
        """
        One line.
        """
    @description.setter
    def description(self, arg0: str) -> None: ...
    @property
    def end_effectors(self) -> tuple:
        """
        Tuple: End-effectors; assign a list to add or remove.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[EndEffector]) -> None: ...
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [kg m^2] Diagonal, about the CoM, in the nominal posture.
        """
    @inertia.setter
    def inertia(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def mass(self) -> float:
        """
        [kg] Total mass.
        """
    @mass.setter
    def mass(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_com_speed(self) -> float:
        """
        [m/s] Largest speed of the CoM: with it a gap can be too wide for any jump.
        """
    @max_com_speed.setter
    def max_com_speed(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Name; of a file that says none, the file's.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def phase_duration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [s] Shortest and longest phase of a contact sequence. The default goes with the robot's size.
        """
    @phase_duration.setter
    def phase_duration(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def posture(self) -> typing.Any:
        """
        [rad] Nominal joint positions by URDF joint name. Assign a dict to change it.
        """
    @posture.setter
    def posture(self, arg1: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def pressure_ratio(self) -> float:
        """
        [-] Ratio of a sole's half size within which a plan keeps the centre of pressure.
        """
    @pressure_ratio.setter
    def pressure_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def pressure_share(self) -> typing.Any:
        """
        Earlier name of ``pressure_ratio``, for one release.
        """
    @pressure_share.setter
    def pressure_share(self, value: typing.Any) -> None: ...
    @property
    def sole_support(self) -> float:
        """
        [-] Ratio of a sole that a contact sequence keeps on its surface; 0: its centre.
        """
    @sole_support.setter
    def sole_support(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def swing_height(self) -> float:
        """
        [m] Clearance of a swinging end-effector. The default goes with the robot's size.
        """
    @swing_height.setter
    def swing_height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tracked(self) -> bool:
        """
        Whether a controller follows the plans with limbs whose momentum they do not know of: contact sequences keep the base upright and the centre of pressure near the middle of the sole.
        """
    @tracked.setter
    def tracked(self, arg0: bool) -> None: ...
    @property
    def trunk(self) -> tuple:
        """
        Tuple: What keeps out of solids beside the ball about the CoM: spine and head, shoulders. Assign a list to add or remove.
        """
    @trunk.setter
    def trunk(self, arg1: collections.abc.Sequence[TrunkPart]) -> None: ...
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
    def base_rpy(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Roll, pitch and yaw [rad]: upright, on three feet and more parallel to the ground below them.
        """
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

      wrench : f(t) = mass stiffness (com(t) - anchor), acting at center_of_pressure, with a moment about the normal.
    """

    __members__: typing.ClassVar[dict[str, ForceLaw]]
    held: typing.ClassVar[ForceLaw]
    linear: typing.ClassVar[ForceLaw]
    pendulum: typing.ClassVar[ForceLaw]
    wrench: typing.ClassVar[ForceLaw]
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
    What one end-effector does during one phase: f(t) = mass stiffness (com(t) - anchor), acting at the anchor or, under ForceLaw.wrench, at center_of_pressure, or forces at points where the phase's law says so.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Contact: ...
    def __deepcopy__(self, memo: dict) -> Contact: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        surface: typing.SupportsInt | typing.SupportsIndex = -1,
        stiffness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        anchor_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        moment_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        points_W: typing.Any = (),
        point_forces_W: typing.Any = (),
        center_of_pressure_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def anchor_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Point through which the line of force passes.
        """
    @anchor_W.setter
    def anchor_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def center_of_pressure_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Where the force acts under ForceLaw.wrench.
        """
    @center_of_pressure_W.setter
    def center_of_pressure_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def moment_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [N m] Contact moment, constant over the phase.
        """
    @moment_W.setter
    def moment_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def point_forces_W(self) -> numpy.ndarray:
        """
        N x 3 [N] Node by node, a row for each point: (Phase.node_count() N) x 3.
        """
    @point_forces_W.setter
    def point_forces_W(self, arg1: typing.Any) -> None: ...
    @property
    def points_W(self) -> numpy.ndarray:
        """
        N x 3 [m] Where forces act, e.g. the corners of the sole.
        """
    @points_W.setter
    def points_W(self, arg1: typing.Any) -> None: ...
    @property
    def stiffness(self) -> float:
        """
        [1/s^2] mu, 0 when free.
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

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Phase: ...
    def __deepcopy__(self, memo: dict) -> Phase: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        duration: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        contacts: collections.abc.Sequence[Contact] = [],
        law: ForceLaw = ...,
        intervals: typing.SupportsInt | typing.SupportsIndex = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def node_count(self) -> int:
        """
        Instants at which forces are given: `intervals` when held, one more when linear, 0 without such.
        """
    @property
    def contacts(self) -> tuple:
        """
        Tuple: One Contact per end-effector.
        """
    @contacts.setter
    def contacts(self, arg1: collections.abc.Sequence[Contact]) -> None: ...
    @property
    def duration(self) -> float:
        """
        [s] How long it lasts.
        """
    @duration.setter
    def duration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def has_momentum(self) -> bool:
        """
        Whether the angular momentum is a state of knots, not what the base has by its rates.
        """
    @property
    def has_points(self) -> bool:
        """
        Whether forces act at points, not as one force that follows the CoM.
        """
    @property
    def has_wrenches(self) -> bool:
        """
        Whether contacts have a centre of pressure and a moment that turn the base.
        """
    @property
    def intervals(self) -> int:
        """
        Of the forces at points, equally long; 0 where there are none.
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

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Knot: ...
    def __deepcopy__(self, memo: dict) -> Knot: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
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
        end_effector_yaw: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def angular_momentum_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [kg m^2/s] About the CoM; not looked at under ForceLaw.pendulum, whose base carries it.
        """
    @angular_momentum_W.setter
    def angular_momentum_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_rpy(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [rad] Roll, pitch, yaw of the base.
        """
    @base_rpy.setter
    def base_rpy(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_rpy_rate(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [rad/s] Their rates.
        """
    @base_rpy_rate.setter
    def base_rpy_rate(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def com_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] Position of the CoM.
        """
    @com_W.setter
    def com_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def com_velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s] Velocity of the CoM.
        """
    @com_velocity_W.setter
    def com_velocity_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def end_effector_velocities_W(self) -> numpy.ndarray:
        """
        N x 3 [m/s] Velocities, zero at contacts.
        """
    @end_effector_velocities_W.setter
    def end_effector_velocities_W(self, arg1: typing.Any) -> None: ...
    @property
    def end_effector_yaw(self) -> typing.Any:
        """
        [rad] Heading of each sole; empty: all head where the base does.
        """
    @end_effector_yaw.setter
    def end_effector_yaw(self, arg1: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def end_effectors_W(self) -> numpy.ndarray:
        """
        N x 3 [m] Positions, one row per end-effector.
        """
    @end_effectors_W.setter
    def end_effectors_W(self, arg1: typing.Any) -> None: ...

class Swing:
    """
    A stretch of phases, first_phase to end_phase - 1, in which an end-effector is free.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Swing: ...
    def __deepcopy__(self, memo: dict) -> Swing: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        end_effector: typing.SupportsInt | typing.SupportsIndex = 0,
        first_phase: typing.SupportsInt | typing.SupportsIndex = 0,
        end_phase: typing.SupportsInt | typing.SupportsIndex = 0,
        height: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        lift_normal_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        land_normal_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        elapsed_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def elapsed_s(self) -> float:
        """
        [s] Time since lift-off at the plan's start, of a swing that is under way there; 0: it begins in the plan.
        """
    @elapsed_s.setter
    def elapsed_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def end_effector(self) -> int:
        """
        Index of the end-effector.
        """
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def end_phase(self) -> int:
        """
        Index of the phase after the last of them.
        """
    @end_phase.setter
    def end_phase(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def first_phase(self) -> int:
        """
        Index of the first of the phases.
        """
    @first_phase.setter
    def first_phase(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def height(self) -> float:
        """
        [m] How far it is lifted off the straight path.
        """
    @height.setter
    def height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def land_normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [-] Unit normal of the surface it reaches.
        """
    @land_normal_W.setter
    def land_normal_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def lift_normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [-] Unit normal of the surface it leaves; of a sole in the air at the plan's start the sole's.
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
    def center_of_pressure_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Where the force acts [m]; position_W when free.
        """
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
    @property
    def yaw(self) -> float:
        """
        Heading of the sole [rad].
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

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def _repr_html_(plan: typing.Any) -> str:
        """
        The picture of a plan of either kind in HTML, or its repr where nothing can be drawn.

            Args:
                plan: A Plan or a PlanarPlan.

        """
    @staticmethod
    def load(path: str | pathlib.Path) -> Plan:
        """
        Read a plan that was written by save(), or by save in C++.

        Raises:
            InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
            FileNotFoundError: There is no such file.
            InvalidArgument: It is no path.
        """
    def __copy__(self) -> Plan: ...
    def __deepcopy__(self, memo: dict) -> Plan: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        planner: str = "",
        measured_start: bool = False,
        open_end: bool = False,
        start_slack_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        momentum_max: typing.SupportsFloat | typing.SupportsIndex = ...,
        momentum_rate_max: typing.SupportsFloat | typing.SupportsIndex = ...,
        scene: Scene = ...,
        robot: Robot = ...,
        knots: collections.abc.Sequence[Knot] = [],
        phases: collections.abc.Sequence[Phase] = [],
        final_contacts: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
        swings: collections.abc.Sequence[Swing] = [],
    ) -> None: ...
    @typing.overload
    def __repr__(self) -> str: ...
    @typing.overload
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def at(self, t: typing.SupportsFloat | typing.SupportsIndex) -> PlanState:
        """
        PlanState at time t [s] in [0, duration], in closed form. At a knot the phase that begins there is meant (the last one at the end). Raises InvalidInput outside, InvalidPlan where an edited plan does not fit together.
        """
    def at_phase(
        self, k: typing.SupportsInt | typing.SupportsIndex, since_start: typing.SupportsFloat | typing.SupportsIndex
    ) -> PlanState:
        """
        PlanState `since_start` [s], 0 to its duration, after the start of phase k: says which side of a knot is meant. Raises as at() does.
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
    def sample(self, times: typing.Any) -> mcplan.samples.PlanSamples:
        """
        States at many times, as arrays: what ``at`` says of each, in closed form.

            Args:
                times: One-dimensional [s], each in 0 to duration(), in any order.

            Raises:
                InvalidInput: A time is no number or lies outside; it is named by its index.
                InvalidPlan: The plan's arrays do not fit together.

        """
    def save(self, path: str | pathlib.Path) -> None:
        """
        Write the plan to an .npz or a .json file, which is complete or not there at all; C++ reads the latter.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name promises another kind of file, is empty or that of a folder.
            OSError: The file cannot be written.
            InvalidPlan: Its sizes do not fit together or a number is not finite.
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
        Tuple: Knots, one more than phases.
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
    def momentum_max(self) -> float:
        """
        [kg m^2/s] Largest component of the angular momentum about the CoM that it claims to keep, in the axes of the start's heading; left out: no claim.
        """
    @momentum_max.setter
    def momentum_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def momentum_rate_max(self) -> float:
        """
        [N m] The same of its rate.
        """
    @momentum_rate_max.setter
    def momentum_rate_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
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
        Tuple: Phases.
        """
    @phases.setter
    def phases(self, arg1: collections.abc.Sequence[Phase]) -> None: ...
    @property
    def planner(self) -> str:
        """
        Which planner made it, e.g. ddp.
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
    def start_slack_s(self) -> float:
        """
        [s] Time within which what the measured start violates by itself has to be made good; above zero with measured_start alone.
        """
    @start_slack_s.setter
    def start_slack_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def swings(self) -> tuple:
        """
        Tuple: Swings.
        """
    @swings.setter
    def swings(self, arg1: collections.abc.Sequence[Swing]) -> None: ...

class Violation:
    """
    A constraint and the place where a plan breaks it most.
    """

    __hash__: typing.ClassVar[None] = None
    unit: str
    def __copy__(self) -> Violation: ...
    def __deepcopy__(self, memo: dict) -> Violation: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
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
        surface: str = "",
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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
    def surface(self) -> str:
        """
        Whose solid a warning is about; empty: not tied to one.
        """
    @surface.setter
    def surface(self, arg0: str) -> None: ...
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

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Iteration: ...
    def __deepcopy__(self, memo: dict) -> Iteration: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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

class PlanFrom:
    """
    Where the plan of a replan comes from.

    Members:

      search : It is no replan.

      same_sequence : The contacts of the plan under way, with what was added at its end.

      other_sequence : Another step was put in.

      recovery : Steps that catch a push, and a stand wherever that is.

      stop : A stand as soon as may be: nothing that leads on can be followed.

      previous_plan : What is left of the plan under way, as it was planned: nothing better was found in time.
    """

    __members__: typing.ClassVar[dict[str, PlanFrom]]
    other_sequence: typing.ClassVar[PlanFrom]
    previous_plan: typing.ClassVar[PlanFrom]
    recovery: typing.ClassVar[PlanFrom]
    same_sequence: typing.ClassVar[PlanFrom]
    search: typing.ClassVar[PlanFrom]
    stop: typing.ClassVar[PlanFrom]
    @typing.overload
    def __eq__(self, other: PlanFrom) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: PlanFrom) -> bool: ...
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

class Report:
    """
    How a solve went; str() tells it in a few lines.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Report: ...
    def __deepcopy__(self, memo: dict) -> Report: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def __str__(self) -> str: ...
    @property
    def checked_until_s(self) -> float:
        """
        Of a replan: time [s] until which the checker looked at its plan. What comes later is kept of the plan before as it was accepted (previous_accepted).
        """
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
    def kept_until_s(self) -> float:
        """
        Of a replan: time [s] until which its plan keeps all limits.
        """
    @property
    def message(self) -> str: ...
    @property
    def paper_cost(self) -> float:
        """
        Of the paper's method: its objective at its last iterate, before contacts are made exact.
        """
    @property
    def paper_verdict(self) -> str:
        """
        Of the paper's method: how it ended by its own measures; else empty.
        """
    @property
    def parallel_loops(self) -> int:
        """
        Loops over neighbours that were shared out over threads.
        """
    @property
    def plan_from(self) -> PlanFrom:
        """
        Of a replan: where its plan comes from.
        """
    @property
    def seed(self) -> int: ...
    @property
    def start_violations(self) -> tuple:
        """
        Tuple of Violation: of a replan, what the measured state violates by itself, worst first.
        """
    @start_violations.setter
    def start_violations(self, arg1: collections.abc.Sequence[Violation]) -> None: ...
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
    def warnings(self) -> tuple:
        """
        Tuple of Violation: warnings of the checker about the plan.
        """
    @warnings.setter
    def warnings(self, arg1: collections.abc.Sequence[Violation]) -> None: ...
    @property
    def worst_violation(self) -> Violation:
        """
        Largest value / tolerance over all constraints.
        """

class PlanResult:
    """
    A plan and how it was found.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def _repr_html_(result: typing.Any) -> str:
        """
        The report of a result and its plan in HTML.

            Args:
                result: What an engine returns: it has a plan and a report.

        """
    def __copy__(self) -> PlanResult: ...
    def __deepcopy__(self, memo: dict) -> PlanResult: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def plan(self) -> Plan: ...
    @property
    def report(self) -> Report: ...

class Tolerances:
    """
    Published tolerances of the checker, for robots of human size; for others times a factor of each unit.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Tolerances: ...
    def __deepcopy__(self, memo: dict) -> Tolerances: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        dynamics: typing.SupportsFloat | typing.SupportsIndex = 1e-08,
        orientation: typing.SupportsFloat | typing.SupportsIndex = 0.017453292519943295,
        center_of_pressure: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        contact_distance: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        slip: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        force: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        force_cap: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        joint: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        moment: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        reach: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        yaw: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.005,
        boundary: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        stance: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        switches: typing.SupportsInt | typing.SupportsIndex = 1,
        sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        scaled: bool = True,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is no number or out of its range.
        """
    @property
    def boundary(self) -> float:
        """
        [m, m/s, rad, rad/s] Start and goal against the scene's.
        """
    @boundary.setter
    def boundary(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def center_of_pressure(self) -> float:
        """
        [m] Centre of pressure off the sole or off the surface.
        """
    @center_of_pressure.setter
    def center_of_pressure(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearance(self) -> float:
        """
        [m] End-effector, limb or trunk inside a solid.
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_distance(self) -> float:
        """
        [m] End-effector in contact off its plane or beyond its polygon.
        """
    @contact_distance.setter
    def contact_distance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def dynamics(self) -> float:
        """
        [m, m/s, rad, rad/s, kg m^2/s] Replayed state against the next knot.
        """
    @dynamics.setter
    def dynamics(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force(self) -> float:
        """
        [N] Pull of a contact, or force of a free end-effector.
        """
    @force.setter
    def force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force_cap(self) -> float:
        """
        [-] Relative excess over max_force, or over a claimed momentum_max.
        """
    @force_cap.setter
    def force_cap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> float:
        """
        [-] Tangential over normal force, beyond the coefficient.
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def joint(self) -> float:
        """
        [-] Relative excess over torque and speed limits of joints.
        """
    @joint.setter
    def joint(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def moment(self) -> float:
        """
        [N m] Excess over max_moment or the torsion the contact can give.
        """
    @moment.setter
    def moment(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def orientation(self) -> float:
        """
        [rad] Replayed orientation of the base.
        """
    @orientation.setter
    def orientation(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def reach(self) -> float:
        """
        [m] Outside the reach box.
        """
    @reach.setter
    def reach(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sample_s(self) -> float:
        """
        [s] Sampling of the constraints in time.
        """
    @sample_s.setter
    def sample_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def scaled(self) -> bool:
        """
        Times the factors of the robot's size, which are 1 for CoM heights of 0.4 to 1.6 m, 20 to 160 kg and earth's gravity; False: as they stand.
        """
    @scaled.setter
    def scaled(self, arg0: bool) -> None: ...
    @property
    def slip(self) -> float:
        """
        [m] Travel of an end-effector while in contact.
        """
    @slip.setter
    def slip(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stance(self) -> float:
        """
        [m] End-effectors in contact at the start off the nominal stance.
        """
    @stance.setter
    def stance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def switches(self) -> int:
        """
        [-] Contacts made or broken in one step; surface to surface counts two.
        """
    @switches.setter
    def switches(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def yaw(self) -> float:
        """
        [rad] Heading of a sole outside its range.
        """
    @yaw.setter
    def yaw(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class CheckResult:
    """
    The worst place of every constraint, violated or not.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
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
    def checked_until_s(self) -> float:
        """
        How far the plan was looked at [s].
        """
    @property
    def complete(self) -> bool:
        """
        False: interrupted; what was found by then is listed.
        """
    @property
    def constraints(self) -> tuple:
        """
        Tuple of Violation, violated or not.
        """
    @constraints.setter
    def constraints(self, arg1: collections.abc.Sequence[Violation]) -> None: ...
    @property
    def kept_until_s(self) -> float:
        """
        Time of the earliest violation [s]; checked_until_s where there is none, 0 where the plan could not be evaluated.
        """
    @property
    def start(self) -> tuple:
        """
        Tuple of Violation: what the measured start violates by itself, of which ok() does not ask; worst first.
        """
    @start.setter
    def start(self, arg1: collections.abc.Sequence[Violation]) -> None: ...
    @property
    def start_slack_s(self) -> float:
        """
        The plan's [s].
        """
    @property
    def warnings(self) -> tuple:
        """
        Tuple of Violation that ok() does not ask for.
        """
    @warnings.setter
    def warnings(self, arg1: collections.abc.Sequence[Violation]) -> None: ...

class ContactLoad:
    """
    Largest contact force of an end-effector over a plan.
    """
    def __copy__(self) -> ContactLoad: ...
    def __deepcopy__(self, memo: dict) -> ContactLoad: ...
    def __repr__(self) -> str: ...
    @property
    def end_effector(self) -> int: ...
    @property
    def force(self) -> float:
        """
        [weights of the robot]
        """
    @property
    def friction(self) -> float:
        """
        [-] tangential over normal force, infinite for a pull.
        """

class PlanLoads:
    """
    Largest loads over a plan.
    """
    def __copy__(self) -> PlanLoads: ...
    def __deepcopy__(self, memo: dict) -> PlanLoads: ...
    def __repr__(self) -> str: ...
    @property
    def angular_momentum(self) -> float:
        """
        About the CoM [kg m^2/s].
        """
    @property
    def contacts(self) -> tuple:
        """
        Tuple of ContactLoad, the first to touch something first.
        """
    @contacts.setter
    def contacts(self, arg1: collections.abc.Sequence[ContactLoad]) -> None: ...

class Capsule:
    """
    Segment with a radius, in a body's frame: its looks, and what it collides with.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Capsule: ...
    def __deepcopy__(self, memo: dict) -> Capsule: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        from_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        to_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        radius: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def from_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] One end of the segment.
        """
    @from_B.setter
    def from_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def radius(self) -> float:
        """
        [m] Half of its thickness.
        """
    @radius.setter
    def radius(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def to_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] The other end; the same: a disc.
        """
    @to_B.setter
    def to_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...

class PlanarBody:
    """
    A rigid body of a planar robot and the revolute joint that carries it. Its frame B has its origin at the joint, turned by offset + q against its parent's.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarBody: ...
    def __deepcopy__(self, memo: dict) -> PlanarBody: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        parent: typing.SupportsInt | typing.SupportsIndex = -1,
        joint_P: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        offset: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        mass: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        com_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        inertia: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        position_min: typing.SupportsFloat | typing.SupportsIndex = ...,
        position_max: typing.SupportsFloat | typing.SupportsIndex = ...,
        velocity_max: typing.SupportsFloat | typing.SupportsIndex = ...,
        torque_max: typing.SupportsFloat | typing.SupportsIndex = ...,
        capsules: collections.abc.Sequence[Capsule] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def capsules(self) -> tuple:
        """
        Tuple: Shape, for drawing and self-collision; assign a list to change it.
        """
    @capsules.setter
    def capsules(self, arg1: collections.abc.Sequence[Capsule]) -> None: ...
    @property
    def com_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] Centre of mass.
        """
    @com_B.setter
    def com_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def inertia(self) -> float:
        """
        [kg m^2] Moment of inertia about the centre of mass.
        """
    @inertia.setter
    def inertia(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def joint_P(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] Position of the joint in the parent's frame.
        """
    @joint_P.setter
    def joint_P(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def mass(self) -> float:
        """
        [kg] Mass.
        """
    @mass.setter
    def mass(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Unique name.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def offset(self) -> float:
        """
        [rad] Angle against the parent at joint position 0.
        """
    @offset.setter
    def offset(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parent(self) -> int:
        """
        Index of an earlier body; -1 for the base alone.
        """
    @parent.setter
    def parent(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def position_max(self) -> float:
        """
        [rad] Upper limit of the joint; left out: none.
        """
    @position_max.setter
    def position_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position_min(self) -> float:
        """
        [rad] Lower limit of the joint; left out: none.
        """
    @position_min.setter
    def position_min(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def torque_max(self) -> float:
        """
        [N m] Limit of the joint, both ways; left out: none.
        """
    @torque_max.setter
    def torque_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def velocity_max(self) -> float:
        """
        [rad/s] Limit of the joint, both ways; left out: none.
        """
    @velocity_max.setter
    def velocity_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PlanarEndEffector:
    """
    A contact frame of a body: x axis in the sole, y axis from the ground into the robot. Forces act at points of the sole.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarEndEffector: ...
    def __deepcopy__(self, memo: dict) -> PlanarEndEffector: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        body: typing.SupportsInt | typing.SupportsIndex = 0,
        position_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        angle_B: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        points: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def angle_B(self) -> float:
        """
        [rad] Of the frame's x axis in the body's frame.
        """
    @angle_B.setter
    def angle_B(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def body(self) -> int:
        """
        Body that carries it.
        """
    @body.setter
    def body(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Unique name.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def points(self) -> typing.Any:
        """
        [m] Where forces act, along the x axis.
        """
    @points.setter
    def points(self, arg1: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def position_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] Origin of the frame, in the body's frame.
        """
    @position_B.setter
    def position_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...

class PlanarRobot:
    """
    A tree of rigid bodies in a vertical plane (x forward, y up) on a free base. Joint j moves body j + 1. SI units.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarRobot: ...
    def __deepcopy__(self, memo: dict) -> PlanarRobot: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        description: str = "",
        gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81,
        bodies: collections.abc.Sequence[PlanarBody] = [],
        end_effectors: collections.abc.Sequence[PlanarEndEffector] = [],
        collision_pairs: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
        ] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def body_index(self, name: str) -> int:
        """
        Index of a body, or -1.
        """
    def end_effector_index(self, who: str) -> int:
        """
        Index of an end-effector, or -1.
        """
    def joint_count(self) -> int: ...
    def joints_to(self, body: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
        """
        Joints between the base and a body, base first.
        """
    def mass(self) -> float:
        """
        [kg]
        """
    def validate(self) -> None:
        """
        Raise InvalidRobot naming all that is out of its range.
        """
    @property
    def bodies(self) -> tuple:
        """
        Tuple: The base first, each one after its parent; assign a list to change it.
        """
    @bodies.setter
    def bodies(self, arg1: collections.abc.Sequence[PlanarBody]) -> None: ...
    @property
    def collision_pairs(self) -> typing.Any:
        """
        Pairs of bodies whose capsules may not touch.
        """
    @collision_pairs.setter
    def collision_pairs(
        self,
        arg1: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
        ],
    ) -> None: ...
    @property
    def description(self) -> str:
        """
        One line.
        """
    @description.setter
    def description(self, arg0: str) -> None: ...
    @property
    def end_effectors(self) -> tuple:
        """
        Tuple: End-effectors; assign a list to add or remove.
        """
    @end_effectors.setter
    def end_effectors(self, arg1: collections.abc.Sequence[PlanarEndEffector]) -> None: ...
    @property
    def gravity(self) -> float:
        """
        [m/s^2] Acceleration along -y.
        """
    @gravity.setter
    def gravity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Name; of a file that says none, the file's.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...

class PlanarConfiguration:
    """
    Position, velocity, acceleration of base and joints.
    """
    def __copy__(self) -> PlanarConfiguration: ...
    def __deepcopy__(self, memo: dict) -> PlanarConfiguration: ...
    def __init__(
        self,
        *,
        base: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        base_velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        base_acceleration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ...,
        velocity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ...,
        acceleration: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def acceleration(self) -> typing.Any:
        """
        [rad/s^2]
        """
    @acceleration.setter
    def acceleration(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None: ...
    @property
    def base(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        x, y [m], angle [rad] in the world.
        """
    @base.setter
    def base(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_acceleration(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s^2], [rad/s^2]
        """
    @base_acceleration.setter
    def base_acceleration(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def base_velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s], [rad/s]
        """
    @base_velocity.setter
    def base_velocity(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def q(self) -> typing.Any:
        """
        Joint positions [rad].
        """
    @q.setter
    def q(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None: ...
    @property
    def velocity(self) -> typing.Any:
        """
        [rad/s]
        """
    @velocity.setter
    def velocity(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]) -> None: ...

class PlanarMotionOfFrame:
    """
    Where a frame is and how it moves.
    """
    def __copy__(self) -> PlanarMotionOfFrame: ...
    def __deepcopy__(self, memo: dict) -> PlanarMotionOfFrame: ...
    def __repr__(self) -> str: ...
    @property
    def acceleration_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m/s^2]
        """
    @property
    def angle(self) -> float:
        """
        [rad]
        """
    @property
    def angular_acceleration(self) -> float:
        """
        [rad/s^2]
        """
    @property
    def position_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m]
        """
    @property
    def rate(self) -> float:
        """
        [rad/s]
        """
    @property
    def velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m/s]
        """

class PlanarForce:
    """
    A force of the environment on the robot at a point of a body.
    """
    def __copy__(self) -> PlanarForce: ...
    def __deepcopy__(self, memo: dict) -> PlanarForce: ...
    def __init__(
        self,
        *,
        body: typing.SupportsInt | typing.SupportsIndex,
        point_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"],
        force_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"],
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def body(self) -> int:
        """
        Index of the body.
        """
    @body.setter
    def body(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def force_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [N]
        """
    @force_W.setter
    def force_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def point_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m]
        """
    @point_W.setter
    def point_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...

class PlanarInverseDynamics:
    """
    Torques, and what is left over at the base.
    """
    def __copy__(self) -> PlanarInverseDynamics: ...
    def __deepcopy__(self, memo: dict) -> PlanarInverseDynamics: ...
    def __repr__(self) -> str: ...
    @property
    def base_residual(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Force x, y [N] and moment about the base's origin [N m] that nothing carries.
        """
    @property
    def torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Of the joints [N m].
        """

class PlanarSurface:
    """
    A straight piece of the ground or of a wall. Its outward normal is 90 degrees to the left of its tangent; what lies behind is solid.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarSurface: ...
    def __deepcopy__(self, memo: dict) -> PlanarSurface: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        origin_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        angle: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        from_: typing.SupportsFloat | typing.SupportsIndex = ...,
        to: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def angle(self) -> float:
        """
        [rad] Of its tangent; its outward normal is 90 degrees to the left of that.
        """
    @angle.setter
    def angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> float:
        """
        [-] Coulomb coefficient.
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def from_(self) -> float:
        """
        [m] Begin of its extent along the tangent, from the origin.
        """
    @from_.setter
    def from_(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def name(self) -> str:
        """
        Unique name.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def normal_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Unit vector, outward.
        """
    @property
    def origin_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] A point of it, from which distances along it count.
        """
    @origin_W.setter
    def origin_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def tangent_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Unit vector.
        """
    @property
    def to(self) -> float:
        """
        [m] End of its extent.
        """
    @to.setter
    def to(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PlanarContact:
    """
    An end-effector that stands still on a surface for a phase.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarContact: ...
    def __deepcopy__(self, memo: dict) -> PlanarContact: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        end_effector: typing.SupportsInt | typing.SupportsIndex = 0,
        surface: typing.SupportsInt | typing.SupportsIndex = 0,
        position_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        angle: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def angle(self) -> float:
        """
        [rad] Of its x axis; whole turns count.
        """
    @angle.setter
    def angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def end_effector(self) -> int:
        """
        End-effector.
        """
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def position_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m] Of the end-effector's frame.
        """
    @position_W.setter
    def position_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def surface(self) -> int:
        """
        Surface.
        """
    @surface.setter
    def surface(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class PlanarNoClearance:
    """
    An end-effector that may be inside a surface's solid.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarNoClearance: ...
    def __deepcopy__(self, memo: dict) -> PlanarNoClearance: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        end_effector: typing.SupportsInt | typing.SupportsIndex = 0,
        surface: typing.SupportsInt | typing.SupportsIndex = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def end_effector(self) -> int:
        """
        End-effector.
        """
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def surface(self) -> int:
        """
        Surface.
        """
    @surface.setter
    def surface(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class PlanarClearance:
    """
    Points of a swinging end-effector stay in front of a surface, which counts as endless.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarClearance: ...
    def __deepcopy__(self, memo: dict) -> PlanarClearance: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        end_effector: typing.SupportsInt | typing.SupportsIndex = 0,
        surface: typing.SupportsInt | typing.SupportsIndex = 0,
        first_interval: typing.SupportsInt | typing.SupportsIndex = 0,
        end_interval: typing.SupportsInt | typing.SupportsIndex = -1,
        middle_height: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def end_effector(self) -> int:
        """
        End-effector.
        """
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def end_interval(self) -> int:
        """
        [-] First interval that no longer counts; -1: to the end of the phase.
        """
    @end_interval.setter
    def end_interval(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def first_interval(self) -> int:
        """
        [-] First interval of the phase that counts.
        """
    @first_interval.setter
    def first_interval(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def middle_height(self) -> float:
        """
        [m] Least height when interval n / 2 of the phase's n begins; left out: none.
        """
    @middle_height.setter
    def middle_height(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def surface(self) -> int:
        """
        Surface.
        """
    @surface.setter
    def surface(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class PlanarPose:
    """
    Bounds on where a body is at an instant of a phase.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarPose: ...
    def __deepcopy__(self, memo: dict) -> PlanarPose: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        body: typing.SupportsInt | typing.SupportsIndex = 0,
        fraction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        min: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        max: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def body(self) -> int:
        """
        Body.
        """
    @body.setter
    def body(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def fraction(self) -> float:
        """
        [-] Of the phase, 0 to 1.
        """
    @fraction.setter
    def fraction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        x, y [m], angle [rad] at most.
        """
    @max.setter
    def max(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
    @property
    def min(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        x, y [m], angle [rad] of the body's frame at least.
        """
    @min.setter
    def min(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...

class PlanarPhase:
    """
    A stretch of time with constant contacts.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarPhase: ...
    def __deepcopy__(self, memo: dict) -> PlanarPhase: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        intervals: typing.SupportsInt | typing.SupportsIndex = 4,
        min_duration: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        max_duration: typing.SupportsFloat | typing.SupportsIndex = ...,
        contacts: collections.abc.Sequence[PlanarContact] = [],
        clearances: collections.abc.Sequence[PlanarClearance] = [],
        poses: collections.abc.Sequence[PlanarPose] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def clearances(self) -> tuple:
        """
        Tuple: In front of which surfaces swinging end-effectors stay, and when.
        """
    @clearances.setter
    def clearances(self, arg1: collections.abc.Sequence[PlanarClearance]) -> None: ...
    @property
    def contacts(self) -> tuple:
        """
        Tuple: All contacts; assign a list to add or remove.
        """
    @contacts.setter
    def contacts(self, arg1: collections.abc.Sequence[PlanarContact]) -> None: ...
    @property
    def intervals(self) -> int:
        """
        [-] Pieces of the joints' splines.
        """
    @intervals.setter
    def intervals(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_duration(self) -> float:
        """
        [s] Largest duration; left out: no limit.
        """
    @max_duration.setter
    def max_duration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_duration(self) -> float:
        """
        [s] Least duration.
        """
    @min_duration.setter
    def min_duration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def poses(self) -> tuple:
        """
        Tuple: Where a body has to be at an instant.
        """
    @poses.setter
    def poses(self, arg1: collections.abc.Sequence[PlanarPose]) -> None: ...

class PlanarTask:
    """
    A task for whole-body planning: planar robot, ground, and the sequence of contact stances. SI units.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarTask: ...
    def __deepcopy__(self, memo: dict) -> PlanarTask: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        name: str = "",
        description: str = "",
        robot: PlanarRobot = ...,
        surfaces: collections.abc.Sequence[PlanarSurface] = [],
        no_clearance: collections.abc.Sequence[PlanarNoClearance] = [],
        phases: collections.abc.Sequence[PlanarPhase] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def first_interval(self, phase: typing.SupportsInt | typing.SupportsIndex) -> int:
        """
        Index of the first interval of a phase.
        """
    def interval_count(self) -> int:
        """
        Of all phases.
        """
    def phase_of(self, interval: typing.SupportsInt | typing.SupportsIndex) -> int:
        """
        Phase that an interval belongs to.
        """
    def validate(self) -> None:
        """
        Raise InvalidPlanarTask (InvalidRobot for the robot) naming all that is out of its range.
        """
    @property
    def description(self) -> str:
        """
        One line.
        """
    @description.setter
    def description(self, arg0: str) -> None: ...
    @property
    def name(self) -> str:
        """
        Name; of a file that says none, the file's.
        """
    @name.setter
    def name(self, arg0: str) -> None: ...
    @property
    def no_clearance(self) -> tuple:
        """
        Tuple: Pairs of end-effector and surface that need not keep clear of each other; all others do.
        """
    @no_clearance.setter
    def no_clearance(self, arg1: collections.abc.Sequence[PlanarNoClearance]) -> None: ...
    @property
    def phases(self) -> tuple:
        """
        Tuple: Phases; assign a list to add or remove.
        """
    @phases.setter
    def phases(self, arg1: collections.abc.Sequence[PlanarPhase]) -> None: ...
    @property
    def robot(self) -> PlanarRobot:
        """
        The planar robot.
        """
    @robot.setter
    def robot(self, arg1: PlanarRobot) -> None: ...
    @property
    def surfaces(self) -> tuple:
        """
        Tuple: The ground; assign a list to add or remove.
        """
    @surfaces.setter
    def surfaces(self, arg1: collections.abc.Sequence[PlanarSurface]) -> None: ...

class PlanarPointForce:
    """
    Contact force at one point of an end-effector.
    """
    def __copy__(self) -> PlanarPointForce: ...
    def __deepcopy__(self, memo: dict) -> PlanarPointForce: ...
    def __repr__(self) -> str: ...
    @property
    def contact(self) -> int:
        """
        Index into the phase's contacts.
        """
    @property
    def end_effector(self) -> int:
        """
        Index into robot.end_effectors.
        """
    @property
    def force_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        On the robot [N].
        """
    @property
    def normal(self) -> float:
        """
        Away from the surface [N].
        """
    @property
    def point(self) -> int:
        """
        Index into the end-effector's points.
        """
    @property
    def position_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Actual place of the point [m].
        """
    @property
    def surface(self) -> int:
        """
        Index into task.surfaces.
        """
    @property
    def tangential(self) -> float:
        """
        Along the surface [N].
        """

class PlanarState:
    """
    A planar robot at an instant.
    """
    def __copy__(self) -> PlanarState: ...
    def __deepcopy__(self, memo: dict) -> PlanarState: ...
    def __repr__(self) -> str: ...
    @property
    def angular_momentum(self) -> float:
        """
        About the CoM [kg m^2/s].
        """
    @property
    def base_residual(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Force x, y [N] and moment [N m] at the base that nothing carries.
        """
    @property
    def com_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m]
        """
    @property
    def com_velocity_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m/s]
        """
    @property
    def configuration(self) -> PlanarConfiguration:
        """
        PlanarConfiguration: position, velocity, acceleration of base and joints.
        """
    @property
    def contact_error(self) -> numpy.ndarray:
        """
        A row for each contact: actual minus expected x, y [m], angle [rad].
        """
    @property
    def forces(self) -> tuple:
        """
        Tuple of PlanarPointForce.
        """
    @forces.setter
    def forces(self, arg1: collections.abc.Sequence[PlanarPointForce]) -> None: ...
    @property
    def phase(self) -> int: ...
    @property
    def time(self) -> float:
        """
        [s]
        """
    @property
    def torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Of the joints [N m].
        """

class PlanarForceLaw:
    """
    Where the contact forces of a planar plan come from.

    Members:

      least_norm : Weighted least norm that balances the motion.

      polynomial : Cubic in time over each interval, given.
    """

    __members__: typing.ClassVar[dict[str, PlanarForceLaw]]
    least_norm: typing.ClassVar[PlanarForceLaw]
    polynomial: typing.ClassVar[PlanarForceLaw]
    @typing.overload
    def __eq__(self, other: PlanarForceLaw) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: PlanarForceLaw) -> bool: ...
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

class PlanarPlan:
    """
    A motion of a planar robot: joint splines, durations of the phases, and what fixes the contact forces. Carries the planar task it was made for.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def _repr_html_(plan: typing.Any) -> str:
        """
        The picture of a plan of either kind in HTML, or its repr where nothing can be drawn.

            Args:
                plan: A Plan or a PlanarPlan.

        """
    @staticmethod
    def load(path: str | pathlib.Path) -> PlanarPlan:
        """
        Read a plan that was written by save(), or by save in C++.

        Raises:
            InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
            FileNotFoundError: There is no such file.
            InvalidArgument: It is no path.
        """
    def __copy__(self) -> PlanarPlan: ...
    def __deepcopy__(self, memo: dict) -> PlanarPlan: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        task: PlanarTask = ...,
        planner: str = "",
        durations: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [],
        control_points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] = ...,
        base_control_points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] = ...,
        force_law: PlanarForceLaw = ...,
        weights: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]] = [],
        force_polynomials: collections.abc.Sequence[
            typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]
        ] = [],
    ) -> None: ...
    @typing.overload
    def __repr__(self) -> str: ...
    @typing.overload
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def at(self, t: typing.SupportsFloat | typing.SupportsIndex) -> PlanarState:
        """
        PlanarState at time t [s] in [0, duration], in closed form. At a boundary the phase that begins there is meant (the last one at the end). Raises InvalidInput outside.
        """
    def at_phase(
        self, k: typing.SupportsInt | typing.SupportsIndex, since_start: typing.SupportsFloat | typing.SupportsIndex
    ) -> PlanarState:
        """
        PlanarState `since_start` [s] after the start of phase k: says which side of a boundary is meant.
        """
    def duration(self) -> float:
        """
        [s]
        """
    def interval_lengths(self) -> list[float]:
        """
        [s] Raises InvalidPlanarTask for phases of no or too many intervals.
        """
    def knot_times(self) -> list[float]:
        """
        [s] phase boundaries, phases + 1 entries, from 0.
        """
    def save(self, path: str | pathlib.Path) -> None:
        """
        Write the plan to an .npz or a .json file, which is complete or not there at all; C++ reads the latter.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name promises another kind of file, is empty or that of a folder.
            OSError: The file cannot be written.
            InvalidPlan: Its sizes do not fit together or a number is not finite.
        """
    def validate(self) -> None:
        """
        Raise InvalidPlan when sizes do not fit together, a duration or weight is not positive or a number is not finite; InvalidPlanarTask and InvalidRobot for the task.
        """
    @property
    def base_control_points(self) -> typing.Any:
        """
        3 x (intervals + 3): x, y [m], angle [rad]; empty: computed from the joints.
        """
    @base_control_points.setter
    def base_control_points(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]) -> None: ...
    @property
    def control_points(self) -> typing.Any:
        """
        [rad] Of the joints' splines: joints x (intervals + 3).
        """
    @control_points.setter
    def control_points(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]) -> None: ...
    @property
    def durations(self) -> typing.Any:
        """
        [s] Of the phases. Assign a list to change them.
        """
    @durations.setter
    def durations(self, arg1: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def force_law(self) -> PlanarForceLaw:
        """
        Where the contact forces come from.
        """
    @force_law.setter
    def force_law(self, arg0: PlanarForceLaw) -> None: ...
    @property
    def force_polynomials(self) -> tuple:
        """
        Tuple: [N] polynomial: for each interval 4 x (2 points), coefficients of s^0..s^3, s = -1..1, of tangential and normal force, contact by contact, point by point.
        """
    @force_polynomials.setter
    def force_polynomials(
        self, arg1: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]]
    ) -> None: ...
    @property
    def motion(self) -> typing.Any:
        """
        Earlier name of ``task``, for one release.
        """
    @motion.setter
    def motion(self, value: typing.Any) -> None: ...
    @property
    def planner(self) -> str:
        """
        Which planner made it, e.g. sip.
        """
    @planner.setter
    def planner(self, arg0: str) -> None: ...
    @property
    def task(self) -> PlanarTask:
        """
        PlanarTask that it was made for.
        """
    @task.setter
    def task(self, arg1: PlanarTask) -> None: ...
    @property
    def weights(self) -> tuple:
        """
        Tuple: [-] least_norm: an array for each phase, contact by contact, point by point.
        """
    @weights.setter
    def weights(
        self, arg1: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]]
    ) -> None: ...

class PlanarTolerances:
    """
    Published tolerances of the checker of planar plans.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> PlanarTolerances: ...
    def __deepcopy__(self, memo: dict) -> PlanarTolerances: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        limit: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        drift: typing.SupportsFloat | typing.SupportsIndex = 0.0015,
        drift_angle: typing.SupportsFloat | typing.SupportsIndex = 0.005,
        balance: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
        moment: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        pull: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0015,
        continuity: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
        pose: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.001,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is no number or out of its range.
        """
    @property
    def balance(self) -> float:
        """
        [N] Force that nothing carries.
        """
    @balance.setter
    def balance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearance(self) -> float:
        """
        [m] Swinging end-effector in a solid, capsules in each other.
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def continuity(self) -> float:
        """
        [rad] Jumps at knots, and what is not rest at the ends.
        """
    @continuity.setter
    def continuity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def drift(self) -> float:
        """
        [m] End-effector in contact from where it should be.
        """
    @drift.setter
    def drift(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def drift_angle(self) -> float:
        """
        [rad] The same of its angle.
        """
    @drift_angle.setter
    def drift_angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> float:
        """
        [-] Of m g: tangential force beyond the cone.
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def limit(self) -> float:
        """
        [-] Position, velocity and torque beyond their limits, relative.
        """
    @limit.setter
    def limit(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def moment(self) -> float:
        """
        [N m] Moment that nothing carries.
        """
    @moment.setter
    def moment(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def pose(self) -> float:
        """
        [m, rad] Poses at given instants.
        """
    @pose.setter
    def pose(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def pull(self) -> float:
        """
        [-] Of m g: pull of a contact.
        """
    @pull.setter
    def pull(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sample_s(self) -> float:
        """
        [s] Sampling in time.
        """
    @sample_s.setter
    def sample_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Drift:
    """
    Largest distance and angle of a contact from where it should be.
    """
    def __copy__(self) -> Drift: ...
    def __deepcopy__(self, memo: dict) -> Drift: ...
    def __repr__(self) -> str: ...
    @property
    def angle_rad(self) -> float:
        """
        [rad]
        """
    @property
    def position_m(self) -> float:
        """
        [m]
        """

class SolidDepth:
    """
    How deep a swinging end-effector goes into the solid behind a surface at most.
    """
    def __copy__(self) -> SolidDepth: ...
    def __deepcopy__(self, memo: dict) -> SolidDepth: ...
    def __repr__(self) -> str: ...
    @property
    def asked(self) -> bool:
        """
        False where the task's no_clearance has the pair.
        """
    @property
    def depth_m(self) -> float:
        """
        The shortest way out [m]; negative: how far it stays out.
        """
    @property
    def end_effector(self) -> int:
        """
        Index.
        """
    @property
    def phase(self) -> int:
        """
        Where that is.
        """
    @property
    def surface(self) -> int:
        """
        Index.
        """
    @property
    def time_s(self) -> float:
        """
        When that is [s].
        """

def addresses(who: str, end_effector: EndEffector) -> bool:
    """
    Whether a name or kind addresses this end-effector.
    """

def any_plan_from_json(content: bytes) -> Plan | PlanarPlan:
    """
    The plan of either kind of a JSON text. Raises InvalidPlan.
    """

def built_in(kind: str) -> list[str]:
    """
    Sorted names of the built-in 'scenes', 'robots', 'planar_robots' or 'planar_tasks'.
    """

@typing.overload
def check(
    plan: Plan,
    scene: Scene = None,
    robot: Robot = None,
    tolerances: Tolerances = ...,
    until_s: typing.SupportsFloat | typing.SupportsIndex = ...,
) -> CheckResult:
    """
    Check a plan against a scene and a robot (None: those it carries), from its positions, forces and polygons alone, up to until_s [s] where that is before its end. Raises InvalidPlan when its arrays do not fit together, and Interrupted with what was found by then.
    """

@typing.overload
def check(plan: PlanarPlan, tolerances: PlanarTolerances = ..., self_collision: bool = False) -> CheckResult:
    """
    Check a planar plan from its splines with exact kinematics and dynamics. Raises InvalidPlan, InvalidPlanarTask or InvalidRobot where it is malformed, and Interrupted with what was found by then.
    """

def compiled_with() -> dict:
    """
    Compiler, version of Eigen and instruction set of the module, by name.
    """

def data_folder() -> typing.Any:
    """
    The folder of the built-in scenes, robots and planar tasks.
    """

def file_kind(content: bytes) -> str:
    """
    What a file is by its content, with its article, such as "a PNG picture"; "" where nothing tells.
    """

def join_surfaces(scene: Scene) -> Scene:
    """
    The scene with surfaces as one that lie in one plane, touch, and make a convex one together; with the name of the first, which start, goal and steps name then. Raises InvalidScene.
    """

def largest_drift(plan: PlanarPlan, sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> Drift:
    """
    Drift of a planar plan, from samples in time and exact kinematics.
    """

def least_norm_gain(
    task: PlanarTask,
    phase: typing.SupportsInt | typing.SupportsIndex,
    weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
    """
    (2 points) x 3: gain from [m (a - g); moment about moment_point_W] to the forces (tangential, normal) of all points of a phase.
    """

def load_planar_robot(source: typing.Any) -> PlanarRobot:
    """
    A built-in planar robot by its name, or one from a TOML file. Raises UnknownRobot, InvalidRobot.
    """

def load_planar_task(source: typing.Any) -> PlanarTask:
    """
    A built-in planar task by its name, or one from a TOML file. Raises UnknownPlanarTask, UnknownRobot, InvalidPlanarTask, InvalidRobot.
    """

def load_robot(source: typing.Any) -> Robot:
    """
    A built-in robot by its name, or one from a TOML file. Raises UnknownRobot, InvalidRobot.
    """

def load_scene(source: typing.Any) -> Scene:
    """
    A built-in scene by its name, or one from a TOML file. Raises UnknownScene, InvalidScene.
    """

def may_touch(surface: Surface, end_effector: EndEffector) -> bool:
    """
    Whether the surface lists the end-effector, by name or kind, or lists nobody.
    """

def moment_point_W(
    task: PlanarTask, phase: typing.SupportsInt | typing.SupportsIndex
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
    """
    Mean of the phase's expected points [m].
    """

def plan_from_json(content: bytes) -> Plan:
    """
    The plan of a JSON text. Raises InvalidPlan.
    """

def plan_loads(plan: Plan, sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.005) -> PlanLoads:
    """
    Largest values over the whole plan, looked at least every sample_s [s]. Raises InvalidPlan, InvalidOptions.
    """

def plan_samples(plan: Plan, times: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> dict:
    """
    Arrays of what Plan.at says at the times [s]. Raises InvalidInput that names the time, and InvalidPlan.
    """

def plan_to_json(plan: Plan) -> bytes:
    """
    A plan as JSON; numbers read back as the same. Raises InvalidPlan.
    """

def planar_inverse_dynamics(
    robot: PlanarRobot, configuration: PlanarConfiguration, forces: collections.abc.Sequence[PlanarForce] = []
) -> PlanarInverseDynamics:
    """
    Torques [N m] by the recursive Newton-Euler algorithm, and what is left over at the base.
    """

def planar_kinematics(robot: PlanarRobot, configuration: PlanarConfiguration) -> list[PlanarMotionOfFrame]:
    """
    Frames of all bodies: a list of PlanarMotionOfFrame.
    """

def planar_plan_from_json(content: bytes) -> PlanarPlan:
    """
    The planar plan of a JSON text. Raises InvalidPlan.
    """

def planar_plan_to_json(plan: PlanarPlan) -> bytes:
    """
    A planar plan as JSON; numbers read back as the same. Raises InvalidPlan.
    """

def planar_point(
    body: PlanarMotionOfFrame,
    point_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"],
    angle_B: typing.SupportsFloat | typing.SupportsIndex = 0.0,
) -> PlanarMotionOfFrame:
    """
    A point of a body, in the body's frame [m]; angle_B [rad] is added to the body's.
    """

def planar_robot_from_dict(data: typing.Any, source: typing.Any = "") -> PlanarRobot:
    """
    The planar robot of plain data with the keys of its file.
    """

def planar_robot_to_dict(robot: PlanarRobot) -> dict:
    """
    Plain data with the keys of a planar robot's file; what is at its default is left out.
    """

def planar_task_from_dict(data: typing.Any, source: typing.Any = "", folder: typing.Any = None) -> PlanarTask:
    """
    The planar task of plain data with the keys of its file. The robot that it names is looked for in `folder`; None: in the working directory.
    """

def planar_task_from_plain(data: typing.Any) -> PlanarTask:
    """
    Inverse of planar_task_to_plain. Raises InvalidPlanarTask; says nothing of what relates fields.
    """

def planar_task_to_dict(task: PlanarTask) -> dict:
    """
    Plain data with the keys of a planar task's file: the robot inline, all contacts of each phase; what is at its default is left out.
    """

def planar_task_to_plain(task: PlanarTask) -> dict:
    """
    All that a planar task holds under the names of its members; infinite numbers as texts.
    """

def quat_wxyz_from_rpy(
    rpy: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
    """
    Unit quaternion (w, x, y, z) of R_WB, w >= 0.
    """

def read_planar_robot(path: typing.Any) -> PlanarRobot:
    """
    A planar robot from a TOML file. Raises InvalidRobot.
    """

def read_planar_task(path: typing.Any) -> PlanarTask:
    """
    A planar task from a TOML file. Raises InvalidPlanarTask, InvalidRobot, UnknownRobot.
    """

def read_robot(path: typing.Any) -> Robot:
    """
    A robot from a TOML file. Raises InvalidRobot.
    """

def read_scene(path: typing.Any) -> Scene:
    """
    A scene from a TOML file. Raises InvalidScene.
    """

def require_ground(scene: Scene) -> None:
    """
    Raise InvalidScene where start or goal hangs in the air, or lies under or far beside the surfaces it names.
    """

def require_standing(scene: Scene, robot: Robot) -> None:
    """
    Refuse a start or goal where a robot cannot stand. Raises InvalidScene where an end-effector would have to reach far beyond its box for its surface, or where all surfaces that a stance names face so far down that no force on them holds anything up; also for a scene that is not valid, as InvalidRobot for a robot.
    """

def resolve_stance(scene: Scene, robot: Robot, stance: Stance, field: str = "stance") -> ResolvedStance:
    """
    Work out a stance for a robot. Raises InvalidScene when contacts name an end-effector that the robot does not have, or one that may not touch the surface.
    """

def robot_from_dict(data: typing.Any, source: typing.Any = "", folder: typing.Any = None) -> Robot:
    """
    The robot of plain data with the keys of a robot file. Files that it names are looked for in `folder`; None: it may name none.
    """

def robot_to_dict(robot: Robot) -> dict:
    """
    Plain data with the keys of a robot file; what is at its default is left out, reach polytopes are inline.
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

def scene_from_dict(data: typing.Any, source: typing.Any = "") -> Scene:
    """
    The scene of plain data with the keys of a scene file.
    """

def scene_to_dict(scene: Scene) -> dict:
    """
    Plain data with the keys of a scene file; what is at its default is left out.
    """

def schema_text(name: str) -> str:
    """
    The JSON schema of the files of a kind: 'scene', 'robot', 'planar_robot' or 'planar_task'.
    """

def solid_depths(plan: PlanarPlan, sample_s: typing.SupportsFloat | typing.SupportsIndex = 0.001) -> list[SolidDepth]:
    """
    How deep every swinging end-effector of a planar plan goes into the solid of every surface, from samples in time and exact kinematics; also of the pairs in the task's no_clearance.
    """

@typing.overload
def suspicious_geometry(scene: Scene) -> list[tuple[str, str, str]]:
    """
    What is legal and can hardly be meant: field, rule and value of each finding.
    """

@typing.overload
def suspicious_geometry(robot: Robot) -> list[tuple[str, str, str]]:
    """
    What is legal and can hardly be meant: field, rule and value of each finding.
    """

@typing.overload
def suspicious_geometry(robot: PlanarRobot) -> list[tuple[str, str, str]]:
    """
    What is legal and can hardly be meant: field, rule and value of each finding.
    """

def toml_from(content: bytes) -> dict:
    """
    The tables of a TOML file, dates as texts. Raises InvalidInput.
    """

def toml_text(data: typing.Any, header: typing.Any = "") -> typing.Any:
    """
    A mapping as TOML: plain values first, then tables and lists of tables. `header`: a comment to put on top.
    """

def whole_outlines(scene: Scene) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]]:
    """
    (n, 3) for each surface [m]: the corners of the one that join_surfaces() makes it a part of.
    """

__version__: str = "0.1.0"
PlanarMotion = PlanarTask
WholeBodyPlan = PlanarPlan
WholeBodyState = PlanarState
WholeBodyTolerances = PlanarTolerances
