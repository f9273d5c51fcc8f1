"""
Multi-fidelity receding-horizon planning of walks on two feet.
"""

from __future__ import annotations
import collections.abc
import mcplan._core
import mcplan._core.nlp
from mcplan._core.nlp import Solver
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "Cycle",
    "Fidelity",
    "Options",
    "RecedingHorizon",
    "Result",
    "Solver",
    "State",
    "StepFrom",
    "Transcription",
    "Walk",
]

class Fidelity:
    """
    Model of the steps that are predicted but not executed (Wang et al., sec. IV).

    Members:

      single : Centroidal dynamics, free timing: the baseline.

      com : Candidate 1: linear CoM dynamics.

      rectangle : Candidate 2: relaxed torque, four corner forces per foot.

      point : Candidate 3: relaxed torque, one force per foot.
    """

    __members__: typing.ClassVar[dict[str, Fidelity]]
    com: typing.ClassVar[Fidelity]
    point: typing.ClassVar[Fidelity]
    rectangle: typing.ClassVar[Fidelity]
    single: typing.ClassVar[Fidelity]
    @typing.overload
    def __eq__(self, other: Fidelity) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Fidelity) -> bool: ...
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

class Transcription:
    """
    How the continuous motion becomes algebraic equations.

    Members:

      trapezoidal : Forces linear between nodes, motion integrated exactly.

      euler : The paper's forward Euler.
    """

    __members__: typing.ClassVar[dict[str, Transcription]]
    euler: typing.ClassVar[Transcription]
    trapezoidal: typing.ClassVar[Transcription]
    @typing.overload
    def __eq__(self, other: Transcription) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Transcription) -> bool: ...
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

class Options:
    """
    Options of the receding-horizon planner.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Options: ...
    def __deepcopy__(self, memo: dict) -> Options: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        fidelity: Fidelity = ...,
        lookahead: typing.SupportsInt | typing.SupportsIndex = 3,
        cycles: typing.SupportsInt | typing.SupportsIndex = 14,
        transcription: Transcription = ...,
        paper: bool = False,
        lifted_psi: bool = False,
        friction_rows: bool = False,
        all_faces: bool = False,
        intervals: typing.SupportsInt | typing.SupportsIndex = 7,
        double_support_s: tuple[float, float] = (0.1, 0.3),
        single_support_s: tuple[float, float] = (0.8, 1.2),
        landing_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        predicted_double_support_s: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        predicted_single_support_s: typing.SupportsFloat | typing.SupportsIndex = 0.6,
        com_velocity_max: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        momentum_max: typing.SupportsFloat | typing.SupportsIndex = 2.5,
        momentum_rate_max: typing.SupportsFloat | typing.SupportsIndex = 3.5,
        com_height: tuple[float, float] = (0.87, 1.15),
        sole_ratio: typing.SupportsFloat | typing.SupportsIndex = 0.8,
        friction_ratio: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        foothold_margin_m: typing.SupportsFloat | typing.SupportsIndex = 0.03,
        psi_max: typing.SupportsFloat | typing.SupportsIndex = 0.55,
        goal_weight: typing.SupportsFloat | typing.SupportsIndex = 10.0,
        friction_sides: typing.SupportsInt | typing.SupportsIndex = 8,
        tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-05,
        constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 400,
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex = ...,
        solver: mcplan._core.nlp.Solver = ...,
        automatic_ordering: bool = False,
        logger: collections.abc.Callable[[mcplan._core.LogLevel, str], None] = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is out of its range.
        """
    @property
    def all_faces(self) -> bool:
        """
        Keep faces of the reach polytopes that others imply.
        """
    @all_faces.setter
    def all_faces(self, arg0: bool) -> None: ...
    @property
    def automatic_ordering(self) -> bool:
        """
        Pivot order of Ipopt's linear solver is its own.
        """
    @automatic_ordering.setter
    def automatic_ordering(self, arg0: bool) -> None: ...
    @property
    def com_height(self) -> tuple[float, float]:
        """
        [-] Height of the CoM over every foot in contact, over robot.com_height: min, max.
        """
    @com_height.setter
    def com_height(self, arg0: tuple[float, float]) -> None: ...
    @property
    def com_velocity_max(self) -> float:
        """
        [m/s] Largest value of each component.
        """
    @com_velocity_max.setter
    def com_velocity_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def constraint_tolerance(self) -> float:
        """
        Tolerance of the solver on constraints.
        """
    @constraint_tolerance.setter
    def constraint_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def cycles(self) -> int:
        """
        Steps to execute; fewer if the sequence ends before.
        """
    @cycles.setter
    def cycles(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def double_support_s(self) -> tuple[float, float]:
        """
        [s] Duration of a phase on two feet: min, max.
        """
    @double_support_s.setter
    def double_support_s(self, arg0: tuple[float, float]) -> None: ...
    @property
    def fidelity(self) -> Fidelity:
        """
        Model of the steps after the first.
        """
    @fidelity.setter
    def fidelity(self, arg0: Fidelity) -> None: ...
    @property
    def foothold_margin_m(self) -> float:
        """
        [m] Distance of the sole from the edges of a surface where it has room.
        """
    @foothold_margin_m.setter
    def foothold_margin_m(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction_ratio(self) -> float:
        """
        [-] Ratio of the friction coefficient that forces make use of; paper: all.
        """
    @friction_ratio.setter
    def friction_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction_rows(self) -> bool:
        """
        Pyramids with faces across t1 and t2, not edges.
        """
    @friction_rows.setter
    def friction_rows(self, arg0: bool) -> None: ...
    @property
    def friction_sides(self) -> int:
        """
        Sides of the pyramid inside the friction cone, 3 to 64.
        """
    @friction_sides.setter
    def friction_sides(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def goal_weight(self) -> float:
        """
        [1/m^2] On the squared distance of the end to the goal.
        """
    @goal_weight.setter
    def goal_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def intervals(self) -> int:
        """
        Intervals of a phase, 2 to 100.
        """
    @intervals.setter
    def intervals(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def landing_s(self) -> float:
        """
        [s] Time by which the first phase of a horizon may last longer, for starts at a touch-down.
        """
    @landing_s.setter
    def landing_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def lifted_psi(self) -> bool:
        """
        Keep the relaxation's bounds psi as variables.
        """
    @lifted_psi.setter
    def lifted_psi(self, arg0: bool) -> None: ...
    @property
    def logger(self) -> collections.abc.Callable[[mcplan._core.LogLevel, str], None]:
        """
        Called with (LogLevel, line), a line a cycle; None: silent.
        """
    @logger.setter
    def logger(self, arg0: collections.abc.Callable[[mcplan._core.LogLevel, str], None]) -> None: ...
    @property
    def lookahead(self) -> int:
        """
        Steps in the horizon, 1 to 10, the executed one included.
        """
    @lookahead.setter
    def lookahead(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        Most iterations of a cycle.
        """
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def momentum_max(self) -> float:
        """
        [kg m^2/s] Largest value of each component of L.
        """
    @momentum_max.setter
    def momentum_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def momentum_rate_max(self) -> float:
        """
        [N m] Largest value of each component of L'.
        """
    @momentum_rate_max.setter
    def momentum_rate_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def paper(self) -> bool:
        """
        Absolute CoM box and outer friction pyramid, as published.
        """
    @paper.setter
    def paper(self, arg0: bool) -> None: ...
    @property
    def predicted_double_support_s(self) -> float:
        """
        [s] Fixed duration of a phase on two feet in predicted steps of the reduced models.
        """
    @predicted_double_support_s.setter
    def predicted_double_support_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def predicted_single_support_s(self) -> float:
        """
        [s] The same on one foot.
        """
    @predicted_single_support_s.setter
    def predicted_single_support_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def psi_max(self) -> float:
        """
        [-] Bound of the relaxation.
        """
    @psi_max.setter
    def psi_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def single_support_s(self) -> tuple[float, float]:
        """
        [s] Duration of a phase on one foot: min, max.
        """
    @single_support_s.setter
    def single_support_s(self, arg0: tuple[float, float]) -> None: ...
    @property
    def sole_ratio(self) -> float:
        """
        [-] Ratio of the sole that forces make use of; paper: all.
        """
    @sole_ratio.setter
    def sole_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def solver(self) -> mcplan._core.nlp.Solver:
        """
        Solver of the nonlinear programs.
        """
    @solver.setter
    def solver(self, arg0: mcplan._core.nlp.Solver) -> None: ...
    @property
    def time_limit_s(self) -> float:
        """
        [s] Wall clock of a cycle.
        """
    @time_limit_s.setter
    def time_limit_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        Optimality tolerance of the solver.
        """
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def transcription(self) -> Transcription:
        """
        How the continuous motion becomes algebraic equations.
        """
    @transcription.setter
    def transcription(self, arg0: Transcription) -> None: ...

class State:
    """
    Where the robot is: the start of a horizon.
    """
    def __copy__(self) -> State: ...
    def __deepcopy__(self, memo: dict) -> State: ...
    def __init__(
        self,
        *,
        com_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        com_velocity_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        angular_momentum_W: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = ...,
        feet_W: typing.Any = (),
        surfaces: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def angular_momentum_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        About the CoM [kg m^2/s].
        """
    @angular_momentum_W.setter
    def angular_momentum_W(self, arg1: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> None: ...
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
    def feet_W(self) -> numpy.ndarray:
        """
        Sole centres, one row a foot, in the robot's order [m].
        """
    @feet_W.setter
    def feet_W(self, arg1: typing.Any) -> None: ...
    @property
    def surfaces(self) -> typing.Any:
        """
        Indices of the surfaces on which the feet stand.
        """
    @surfaces.setter
    def surfaces(self, arg1: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> None: ...

class StepFrom:
    """
    Where the step that a cycle executes comes from.

    Members:

      none : Nothing is executed.

      converged : The solver converged.

      iterate : The best point of a solve that was cut short, usable as it is.

      previous_plan : The solve was cut short: what the last cycle with a plan of its own predicted for now, usable.
    """

    __members__: typing.ClassVar[dict[str, StepFrom]]
    converged: typing.ClassVar[StepFrom]
    iterate: typing.ClassVar[StepFrom]
    none: typing.ClassVar[StepFrom]
    previous_plan: typing.ClassVar[StepFrom]
    @typing.overload
    def __eq__(self, other: StepFrom) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: StepFrom) -> bool: ...
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

class Cycle:
    """
    How one cycle went.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def acceleration_cost(self) -> float:
        """
        Executed step: integral of |a|^2 [m^2/s^3].
        """
    @property
    def constraints(self) -> int: ...
    @property
    def cost(self) -> float:
        """
        Of the whole horizon.
        """
    @property
    def defect(self) -> float:
        """
        Largest residual of the horizon's equations.
        """
    @property
    def distance_m(self) -> float:
        """
        Executed step: travel of the CoM along the heading [m].
        """
    @property
    def drift_com_m(self) -> float:
        """
        Forces of the executed step replayed in continuous time against its states, at its end [m].
        """
    @property
    def drift_momentum(self) -> float:
        """
        The same of L [kg m^2/s].
        """
    @property
    def duration_s(self) -> float:
        """
        Executed step [s].
        """
    @property
    def evaluation_s(self) -> float:
        """
        Of which in functions and derivatives [s].
        """
    @property
    def executed(self) -> bool:
        """
        A step was taken into the walk: step_from is not none.
        """
    @property
    def index(self) -> int: ...
    @property
    def iterations(self) -> int: ...
    @property
    def linear_solver_s(self) -> float:
        """
        Of which in the linear solver [s].
        """
    @property
    def message(self) -> str: ...
    @property
    def momentum_cost(self) -> float:
        """
        Executed step: integral of |L|^2.
        """
    @property
    def solver(self) -> mcplan._core.nlp.Solver:
        """
        That found the step: ipopt or ipm.
        """
    @property
    def status(self) -> mcplan._core.Status:
        """
        solved: converged, and the checker accepts the executed step.
        """
    @property
    def step_from(self) -> StepFrom:
        """
        Where that step comes from.
        """
    @property
    def time_s(self) -> float:
        """
        Wall clock, set-up and check included [s].
        """
    @property
    def variables(self) -> int: ...
    @property
    def worst_violation(self) -> mcplan._core.Violation:
        """
        Of the executed step; without one, of the program's best point.
        """

class Walk:
    """
    A walk: its plan, how it was found, cycle by cycle.
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def _repr_html_(result: typing.Any) -> str:
        """
        The report of a result and its plan in HTML.

            Args:
                result: What an engine returns: it has a plan and a report.

        """
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def acc_per_m(self) -> float:
        """
        Integral of |a|^2 per metre, executed steps.
        """
    def distance_m(self) -> float:
        """
        Travelled by the CoM along the heading [m].
        """
    def drift_com_m(self) -> float:
        """
        Largest of a cycle [m].
        """
    def drift_momentum(self) -> float:
        """
        Largest of a cycle [kg m^2/s].
        """
    def momentum_per_m(self) -> float:
        """
        Integral of |L|^2 per metre, executed steps.
        """
    @property
    def cycles(self) -> tuple:
        """
        Tuple of Cycle.
        """
    @cycles.setter
    def cycles(self, arg1: collections.abc.Sequence[Cycle]) -> None: ...
    @property
    def plan(self) -> mcplan._core.Plan:
        """
        The executed steps, one after the other.
        """
    @plan.setter
    def plan(self, arg1: mcplan._core.Plan) -> None: ...
    @property
    def report(self) -> mcplan._core.Report:
        """
        Status and message of the worst cycle, times summed.
        """
    @report.setter
    def report(self, arg1: mcplan._core.Report) -> None: ...
    @property
    def success(self) -> bool:
        """
        Every cycle that was asked for gave a step within its constraints.
        """

class RecedingHorizon:
    """
    One nonlinear program a cycle, of whose steps the first is executed. Solves release the GIL; Ctrl-C ends them, and Interrupted carries the walk or the cycle.
    """
    @typing.overload
    def __init__(self, scene: mcplan._core.Scene, robot: mcplan._core.Robot, options: Options = ...) -> None:
        """
        The contact sequence is scene.steps; after its end the feet go on in turn on its last surface.
        """
    @typing.overload
    def __init__(
        self, scene: mcplan._core.Scene, robot: mcplan._core.Robot, sequence: mcplan._core.Plan, options: Options = ...
    ) -> None:
        """
        Contact sequence and start are those of a plan; the walk comes to rest after its last step.
        """
    def executed(self) -> mcplan._core.Plan:
        """
        The step that the last good cycle executes, from time 0.
        """
    def horizon(self) -> mcplan._core.Plan:
        """
        Its whole horizon, predicted steps included.
        """
    def result(self) -> Walk:
        """
        What was executed so far.
        """
    def state(self) -> State:
        """
        At the start of the next cycle.
        """
    @typing.overload
    def step(self) -> Cycle:
        """
        One cycle from where the last one ended; after one that a limit cut short without a step, on where that one stopped.
        """
    @typing.overload
    def step(self, measured: State) -> Cycle:
        """
        One cycle from a measured state.
        """
    def walk(self) -> Walk:
        """
        Run all cycles that the options ask for, or until one fails.
        """

Result = Walk
