"""
Contact-sequence search by switched differential dynamic programming.
"""

from __future__ import annotations
import collections.abc
import mcplan._core
from mcplan._core import PlanResult as Result
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "Method",
    "Model",
    "Options",
    "Polish",
    "ReplanOptions",
    "Result",
    "StiffnessInput",
    "SwitchedDdp",
    "VelocityCommand",
    "Weights",
    "on_joined_ground",
    "replan",
]

class Method:
    """
    Which search runs.

    Members:

      standard : Proximal switched DDP, neighbours and whole sequences priced exactly.

      paper : Tazaki's Algorithms 1 and 2 as published.
    """

    __members__: typing.ClassVar[dict[str, Method]]
    paper: typing.ClassVar[Method]
    standard: typing.ClassVar[Method]
    @typing.overload
    def __eq__(self, other: Method) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Method) -> bool: ...
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

class Model:
    """
    What a contact can do.

    Members:

      wrench : Forces act within the sole and need not point at the CoM: angular momentum, turning, friction as it is.

      lipm : The paper's: forces act at the end-effector and point at the CoM.
    """

    __members__: typing.ClassVar[dict[str, Model]]
    lipm: typing.ClassVar[Model]
    wrench: typing.ClassVar[Model]
    @typing.overload
    def __eq__(self, other: Model) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Model) -> bool: ...
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

class StiffnessInput:
    """
    How the contact stiffness enters the search as an input.

    Members:

      mu : mu itself, in which contact forces are linear.

      lambda_ : The paper's lambda, with mu = lambda^2.
    """

    __members__: typing.ClassVar[dict[str, StiffnessInput]]
    lambda_: typing.ClassVar[StiffnessInput]
    mu: typing.ClassVar[StiffnessInput]
    @typing.overload
    def __eq__(self, other: StiffnessInput) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: StiffnessInput) -> bool: ...
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

class Polish:
    """
    What finds the motion of a contact sequence that is given; with joint limits always the penalty.

    Members:

      penalty : Contacts and limits as weights, steps by a merit function.

      interior_point : Contacts exact, limits by an elastic barrier, steps by a filter.
    """

    __members__: typing.ClassVar[dict[str, Polish]]
    interior_point: typing.ClassVar[Polish]
    penalty: typing.ClassVar[Polish]
    @typing.overload
    def __eq__(self, other: Polish) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Polish) -> bool: ...
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

class Weights:
    """
    Weights w of the cost terms 1/2 w^2 e^2 (Tazaki, Table I), for non-dimensional quantities: length in CoM heights, time in sqrt(height / gravity), mass 1. Those named _end hold at the first and last knot.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Weights: ...
    def __deepcopy__(self, memo: dict) -> Weights: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        com: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        com_end: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        velocity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        velocity_end: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        rotation: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        rotation_end: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        angle: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        momentum: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        center_of_pressure: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        force_line: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        end_effector: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        end_effector_end: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        stride: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        stiffness: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        moment: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        limit: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        duration: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        contact_min: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        contact_max: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        contact_growth: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        overshoot_factor: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        own: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {},
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def angle(self) -> float:
        """
        On the base's angles inside, of Model.wrench.
        """
    @angle.setter
    def angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def center_of_pressure(self) -> float:
        """
        On the distance of the acting force from the end-effector, of Model.wrench.
        """
    @center_of_pressure.setter
    def center_of_pressure(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def com(self) -> float:
        """
        On the CoM's distance from its reference.
        """
    @com.setter
    def com(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def com_end(self) -> float:
        """
        The same at the first and last knot.
        """
    @com_end.setter
    def com_end(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_change(self) -> float:
        """
        On every contact made or broken.
        """
    @contact_change.setter
    def contact_change(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_growth(self) -> float:
        """
        Factor of that weight between iterations, above 1.
        """
    @contact_growth.setter
    def contact_growth(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_max(self) -> float:
        """
        Last complementarity weight, at least the first.
        """
    @contact_max.setter
    def contact_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_min(self) -> float:
        """
        First complementarity weight.
        """
    @contact_min.setter
    def contact_min(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def duration(self) -> float:
        """
        Towards the middle of the duration box.
        """
    @duration.setter
    def duration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def end_effector(self) -> float:
        """
        On the end-effectors' distance from their reference.
        """
    @end_effector.setter
    def end_effector(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def end_effector_end(self) -> float:
        """
        The same at the first and last knot.
        """
    @end_effector_end.setter
    def end_effector_end(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def flight(self) -> float:
        """
        On every phase without any contact.
        """
    @flight.setter
    def flight(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def force_line(self) -> float:
        """
        On the distance from there to the line that points at the CoM, of Model.wrench; very large: the paper's forces.
        """
    @force_line.setter
    def force_line(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def limit(self) -> float:
        """
        On what is beyond reach, stiffness, moment, force, friction, duration.
        """
    @limit.setter
    def limit(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def moment(self) -> float:
        """
        On contact moments.
        """
    @moment.setter
    def moment(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def momentum(self) -> float:
        """
        On the angular momentum inside, of Model.wrench.
        """
    @momentum.setter
    def momentum(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def overshoot_factor(self) -> float:
        """
        On leaving a polygon sideways, at least 1.
        """
    @overshoot_factor.setter
    def overshoot_factor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def own(self) -> typing.Any:
        """
        Weights of single terms by the term's name, where they are not the usual ones.
        """
    @own.setter
    def own(self, arg1: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex]) -> None: ...
    @property
    def rotation(self) -> float:
        """
        On the base's angles and rates, inside for Model.lipm alone.
        """
    @rotation.setter
    def rotation(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rotation_end(self) -> float:
        """
        The same at the first and last knot.
        """
    @rotation_end.setter
    def rotation_end(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stiffness(self) -> float:
        """
        On the contact stiffness.
        """
    @stiffness.setter
    def stiffness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stride(self) -> float:
        """
        On the travel of an end-effector within a phase.
        """
    @stride.setter
    def stride(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def upright(self) -> float:
        """
        On the tilt of contact forces of tracked robots' point feet.
        """
    @upright.setter
    def upright(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def velocity(self) -> float:
        """
        On the CoM's velocity.
        """
    @velocity.setter
    def velocity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def velocity_end(self) -> float:
        """
        The same at the first and last knot.
        """
    @velocity_end.setter
    def velocity_end(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Options:
    """
    Options of the contact-sequence search; the defaults serve all built-in scenes.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Options: ...
    def __deepcopy__(self, memo: dict) -> Options: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        phases: typing.SupportsInt | typing.SupportsIndex = 0,
        method: Method = ...,
        model: Model = ...,
        stiffness_input: StiffnessInput = ...,
        polish: Polish = ...,
        weights: Weights = ...,
        duration_min_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        duration_max_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        flight_duration_min_s: typing.SupportsFloat | typing.SupportsIndex = 0.4,
        duration_initial_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        proximal_weight: typing.SupportsFloat | typing.SupportsIndex = 30.0,
        interior_points: typing.SupportsInt | typing.SupportsIndex = 4,
        reach_margin_m: typing.SupportsFloat | typing.SupportsIndex = 0.003,
        sole_inside: typing.SupportsFloat | typing.SupportsIndex = -1.0,
        friction: bool = True,
        friction_ratio: typing.SupportsFloat | typing.SupportsIndex = -1.0,
        load_ratio: typing.SupportsFloat | typing.SupportsIndex = -1.0,
        friction_sides: typing.SupportsInt | typing.SupportsIndex = 0,
        joint_limits: bool = True,
        whole_sequence_moves: bool = True,
        stepping_guesses: bool = True,
        allow_flight: bool = True,
        min_contacts: typing.SupportsInt | typing.SupportsIndex = -1,
        detours: bool = True,
        one_switch_per_step: bool = True,
        restarts: typing.SupportsInt | typing.SupportsIndex = 3,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 5000,
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex = ...,
        threads: typing.SupportsInt | typing.SupportsIndex = 1,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        initial_sequence: collections.abc.Sequence[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]
        ] = [],
        record_history: bool = False,
        logger: collections.abc.Callable[[mcplan._core.LogLevel, str], None] = None,
        watch: collections.abc.Callable[[mcplan._core.Plan], None] = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is out of its range.
        """
    @property
    def allow_flight(self) -> bool:
        """
        Allow phases without any contact. Where steps lead to the goal they come last even so.
        """
    @allow_flight.setter
    def allow_flight(self, arg0: bool) -> None: ...
    @property
    def detours(self) -> bool:
        """
        Look for ways round what steps cannot cross, too.
        """
    @detours.setter
    def detours(self, arg0: bool) -> None: ...
    @property
    def duration_initial_s(self) -> float:
        """
        [s] First guess of all phases; 0: the middle of their box, 0.45 for Model.lipm.
        """
    @duration_initial_s.setter
    def duration_initial_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def duration_max_s(self) -> float:
        """
        [s] Longest phase, as a soft limit; 0: the robot's.
        """
    @duration_max_s.setter
    def duration_max_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def duration_min_s(self) -> float:
        """
        [s] Shortest phase, as a soft limit; 0: the robot's.
        """
    @duration_min_s.setter
    def duration_min_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def flight_duration_min_s(self) -> float:
        """
        [s] Shortest phase without any contact. The default goes with the size of the robot.
        """
    @flight_duration_min_s.setter
    def flight_duration_min_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> bool:
        """
        Hold the friction cones.
        """
    @friction.setter
    def friction(self, arg0: bool) -> None: ...
    @property
    def friction_ratio(self) -> float:
        """
        [-] Ratio of each surface's friction that contacts use; at least half of it is left to them. Negative: 0.8 for tracked robots on point feet, else 1.
        """
    @friction_ratio.setter
    def friction_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction_sides(self) -> int:
        """
        Sides of the pyramid inside the cone that is held instead of it; 0: the cone itself.
        """
    @friction_sides.setter
    def friction_sides(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def initial_sequence(self) -> list[list[int]]:
        """
        phases + 1 rows: surface index per end-effector, -1 free. Empty: searched for.
        """
    @initial_sequence.setter
    def initial_sequence(
        self, arg0: collections.abc.Sequence[collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]]
    ) -> None: ...
    @property
    def interior_points(self) -> int:
        """
        Instants inside a phase where limits are held.
        """
    @interior_points.setter
    def interior_points(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def joint_limits(self) -> bool:
        """
        Hold the joint limits of legs for which the robot has them; False: the plan's robot is one without.
        """
    @joint_limits.setter
    def joint_limits(self, arg0: bool) -> None: ...
    @property
    def load_ratio(self) -> float:
        """
        [-] Least load of a point foot in contact of a tracked robot, over an equal share of the weight: how far the centre of pressure stays inside the support polygon. Negative: 0.3.
        """
    @load_ratio.setter
    def load_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def logger(self) -> collections.abc.Callable[[mcplan._core.LogLevel, str], None]:
        """
        Called with (LogLevel, line); None: silent.
        """
    @logger.setter
    def logger(self, arg0: collections.abc.Callable[[mcplan._core.LogLevel, str], None]) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        Most iterations, over all attempts; to mend a near miss a tenth more.
        """
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def method(self) -> Method:
        """
        Which search runs.
        """
    @method.setter
    def method(self, arg0: Method) -> None: ...
    @property
    def min_contacts(self) -> int:
        """
        Number of contacts at any time; -1: two for robots that stand on four feet, where a plan is found so.
        """
    @min_contacts.setter
    def min_contacts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def model(self) -> Model:
        """
        What a contact can do; Method.paper always takes Model.lipm.
        """
    @model.setter
    def model(self, arg0: Model) -> None: ...
    @property
    def one_switch_per_step(self) -> bool:
        """
        At most one contact is made or broken between two phases (Tazaki, eq. 32).
        """
    @one_switch_per_step.setter
    def one_switch_per_step(self, arg0: bool) -> None: ...
    @property
    def phases(self) -> int:
        """
        Number of phases N; 0: those of its footsteps, or 18, or more where the way asks for more.
        """
    @phases.setter
    def phases(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def polish(self) -> Polish:
        """
        What finds the motion of a contact sequence that is given.
        """
    @polish.setter
    def polish(self, arg0: Polish) -> None: ...
    @property
    def proximal_weight(self) -> float:
        """
        First weight on the change of the inputs; it adapts.
        """
    @proximal_weight.setter
    def proximal_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def reach_margin_m(self) -> float:
        """
        [m] The reach box is planned smaller by this. The default goes with the size of the robot.
        """
    @reach_margin_m.setter
    def reach_margin_m(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def record_history(self) -> bool:
        """
        Keep the sequence of every iteration in the report.
        """
    @record_history.setter
    def record_history(self, arg0: bool) -> None: ...
    @property
    def restarts(self) -> int:
        """
        Further attempts while the checker rejects the plan.
        """
    @restarts.setter
    def restarts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int:
        """
        Seed of the order in which restarts vary the settings.
        """
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def sole_inside(self) -> float:
        """
        [-] Share of a sole's half size by which footholds keep from the edges of their surface; 1: the whole sole is on it, where it is large enough; negative: the robot's sole_support.
        """
    @sole_inside.setter
    def sole_inside(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stepping_guesses(self) -> bool:
        """
        Begin with end-effectors that step in turn, and with footsteps over the ground, beside what the search finds.
        """
    @stepping_guesses.setter
    def stepping_guesses(self, arg0: bool) -> None: ...
    @property
    def stiffness_input(self) -> StiffnessInput:
        """
        How the contact stiffness enters as an input.
        """
    @stiffness_input.setter
    def stiffness_input(self, arg0: StiffnessInput) -> None: ...
    @property
    def threads(self) -> int:
        """
        Threads that search ways, guesses and changes at once; the result does not depend on it.
        """
    @threads.setter
    def threads(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def time_limit_s(self) -> float:
        """
        [s] Wall clock of the search.
        """
    @time_limit_s.setter
    def time_limit_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def watch(self) -> collections.abc.Callable[[mcplan._core.Plan], None]:
        """
        Called with every iterate of the search, a Plan that is not checked; None: never.
        """
    @watch.setter
    def watch(self, arg0: collections.abc.Callable[[mcplan._core.Plan], None]) -> None: ...
    @property
    def weights(self) -> Weights:
        """
        Weights of the cost terms.
        """
    @weights.setter
    def weights(self, arg1: Weights) -> None: ...
    @property
    def whole_sequence_moves(self) -> bool:
        """
        Look for better contact sequences as a whole, by dynamic programming, where it pays.
        """
    @whole_sequence_moves.setter
    def whole_sequence_moves(self, arg0: bool) -> None: ...

class SwitchedDdp:
    """
    Contact-sequence search for one scene and robot. Solves release the GIL; Ctrl-C ends them, and Interrupted carries the best plan so far.
    """
    def __init__(self, scene: mcplan._core.Scene, robot: mcplan._core.Robot, options: Options = ...) -> None: ...
    def replan(
        self, previous: mcplan._core.Plan, t: typing.SupportsFloat | typing.SupportsIndex, measured: mcplan._core.Knot
    ) -> mcplan._core.PlanResult:
        """
        Plan on from a measured state at time t [s] of an earlier plan.
        """
    @typing.overload
    def solve(self) -> mcplan._core.PlanResult:
        """
        Plan from the scene's start to its goal.
        """
    @typing.overload
    def solve(self, warm_start: mcplan._core.Plan) -> mcplan._core.PlanResult:
        """
        The same, starting from an earlier plan's contact sequence, motion and timing.
        """

class VelocityCommand:
    """
    A velocity to walk at, instead of the scene's goal.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> VelocityCommand: ...
    def __deepcopy__(self, memo: dict) -> VelocityCommand: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        velocity_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"] = ...,
        yaw_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def velocity_B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        [m/s] Of the CoM: ahead and to the left of the heading.
        """
    @velocity_B.setter
    def velocity_B(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[2, 1]"]) -> None: ...
    @property
    def yaw_rate(self) -> float:
        """
        [rad/s] Of the base, to the left.
        """
    @yaw_rate.setter
    def yaw_rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ReplanOptions:
    """
    How to plan on from a measured state, beside the options of the search.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> ReplanOptions: ...
    def __deepcopy__(self, memo: dict) -> ReplanOptions: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        committed_s: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        start_slack_s: typing.SupportsFloat | typing.SupportsIndex = 0.6,
        phases_min: typing.SupportsInt | typing.SupportsIndex = 6,
        horizon: typing.SupportsInt | typing.SupportsIndex = 12,
        other_sequences: bool = True,
        recovery_first: bool = False,
        crossing: bool = False,
        max_work: typing.SupportsInt | typing.SupportsIndex = 1000,
        previous_accepted: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is out of its range.
        """
    @property
    def committed_s(self) -> float:
        """
        [s] Contacts that are due within this time are made and broken as planned, when and where. The default goes with the size of the robot.
        """
    @committed_s.setter
    def committed_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def crossing(self) -> bool:
        """
        Where the plan's own sequence does not catch a push outward over the foot that stands, the foot in the air may step across it, in front of it or behind it.
        """
    @crossing.setter
    def crossing(self, arg0: bool) -> None: ...
    @property
    def horizon(self) -> int:
        """
        Number of phases that are planned ahead under a velocity command. To a goal twice as many are planned anew: what comes later stays as it was planned.
        """
    @horizon.setter
    def horizon(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_work(self) -> int:
        """
        Iterations times phases, over all sequences, after which no other one is tried: 1000 take about 30 ms.
        """
    @max_work.setter
    def max_work(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def other_sequences(self) -> bool:
        """
        Try sequences near to the plan's own where that does not do.
        """
    @other_sequences.setter
    def other_sequences(self, arg0: bool) -> None: ...
    @property
    def phases_min(self) -> int:
        """
        The horizon never gets shorter than this: at its end the robot stands.
        """
    @phases_min.setter
    def phases_min(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def previous_accepted(self) -> bool:
        """
        The checker has accepted the plan under way, to its end: what is kept of it, on the same scene and for the same robot, is not looked at again.
        """
    @previous_accepted.setter
    def previous_accepted(self, arg0: bool) -> None: ...
    @property
    def recovery_first(self) -> bool:
        """
        Pushed, try steps that catch the robot before the plan's own sequence, not after it.
        """
    @recovery_first.setter
    def recovery_first(self, arg0: bool) -> None: ...
    @property
    def start_slack_s(self) -> float:
        """
        [s] Time within which what the measured state itself violates has to be made good. The default goes with the size of the robot.
        """
    @start_slack_s.setter
    def start_slack_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

def on_joined_ground(plan: mcplan._core.Plan) -> mcplan._core.Plan:
    """
    The same plan on ground that is whole, as plan() searches it: surfaces in one plane that touch, and make a convex one together, are one, with the name of the first. Replans keep soles within surfaces; on this they may cross seams. Raises InvalidPlan, InvalidScene.
    """

def replan(
    previous: mcplan._core.Plan,
    t: typing.SupportsFloat | typing.SupportsIndex,
    state: mcplan._core.Knot,
    contacts: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    scene: mcplan._core.Scene,
    robot: mcplan._core.Robot,
    options: ReplanOptions,
    search: Options,
    command: VelocityCommand | None = None,
) -> mcplan._core.PlanResult:
    """
    Plan on from a measured state at time t [s] of an earlier plan; see mcplan.replan. `contacts`: surface index by end-effector, -1 free; empty: as planned.
    """
