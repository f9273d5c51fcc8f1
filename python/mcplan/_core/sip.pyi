"""
Whole-body semi-infinite planning of planar robots.
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
    "Certificate",
    "ContactMode",
    "Continuous",
    "Forces",
    "FreeFlyer",
    "HessianChoice",
    "Options",
    "Planner",
    "Proof",
    "ProvedConstraint",
    "Result",
    "Solver",
    "TaylorModel",
    "certify",
]

class TaylorModel:
    """
    A function of s in [-1, 1] as a polynomial and a bound of what is left over:
    |f(s) - sum_k coefficients[k] s^k| <= remainder. Arithmetic keeps the bound true, also for floating-point rounding.
    """
    def __add__(self, arg0: TaylorModel) -> TaylorModel: ...
    def __init__(
        self,
        coefficients: typing.Any,
        order: typing.SupportsInt | typing.SupportsIndex = 8,
        error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None:
        """
        From a polynomial (of s^0, s^1, ...). Powers beyond `order` (0 to 12) go into the remainder, and `error`, an amount that the function may differ by. Raises InvalidInput, InvalidOptions.
        """
    def __mul__(self, arg0: TaylorModel) -> TaylorModel: ...
    def __neg__(self) -> TaylorModel: ...
    def __repr__(self) -> str: ...
    def __sub__(self, arg0: TaylorModel) -> TaylorModel: ...
    def at(self, s: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
        """
        Bounds at one place.
        """
    def cosine(self) -> TaylorModel: ...
    def integral(self) -> TaylorModel:
        """
        From 0 to s.
        """
    def range(self) -> tuple[float, float]:
        """
        Bounds over [-1, 1].
        """
    def scaled(
        self,
        factor: typing.SupportsFloat | typing.SupportsIndex,
        factor_error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> TaylorModel:
        """
        Times a constant that is within factor_error of factor.
        """
    def sine(self) -> TaylorModel: ...
    @property
    def coefficients(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def order(self) -> int: ...
    @property
    def remainder(self) -> float: ...
    @property
    def rounding(self) -> float:
        """
        Part of the remainder: floating-point arithmetic.
        """
    @property
    def truncation(self) -> float:
        """
        Part of the remainder: powers beyond the order.
        """

class Proof:
    """
    What is known of a constraint.

    Members:

      proved : Holds at every instant.

      not_proved : Neither proved nor violated at any point looked at.

      violated : Does not hold at the instant named.
    """

    __members__: typing.ClassVar[dict[str, Proof]]
    not_proved: typing.ClassVar[Proof]
    proved: typing.ClassVar[Proof]
    violated: typing.ClassVar[Proof]
    @typing.overload
    def __eq__(self, other: Proof) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Proof) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ProvedConstraint:
    """
    What certify() found out about one kind of constraint.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def bound(self) -> float:
        """
        Proved upper bound of the amount beyond the limit, over the whole motion, in `unit`.
        """
    @property
    def name(self) -> str:
        """
        As in the checker of planar plans.
        """
    @property
    def phase(self) -> int:
        """
        -1: nothing to prove.
        """
    @property
    def proof(self) -> Proof: ...
    @property
    def reached(self) -> float:
        """
        Proved lower bound of its maximum; above the tolerance: violated.
        """
    @property
    def time_s(self) -> float:
        """
        Where the bound is largest; of a violated constraint, where `reached` is.
        """
    @property
    def tolerance(self) -> float:
        """
        What was to be proved: bound <= tolerance.
        """
    @property
    def unit(self) -> str: ...
    @property
    def where(self) -> str:
        """
        Joint, end-effector or point.
        """

class Certificate:
    """
    What is proved of a planar plan at every instant.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def __str__(self) -> str: ...
    def proved(self) -> bool:
        """
        Whether every constraint is.
        """
    @property
    def constraints(self) -> list[ProvedConstraint]: ...
    @property
    def rounding(self) -> float:
        """
        Largest allowance for floating-point arithmetic in a bound, in shares of its tolerance.
        """
    @property
    def subdivisions(self) -> int:
        """
        Pieces of time looked at.
        """
    @property
    def time_s(self) -> float:
        """
        Wall clock [s].
        """

class Forces:
    """
    Where contact forces come from (Lengagne et al., secs. III-C and IV-D).

    Members:

      uniform : Weighted least norm, all weights 1: case 1.

      per_body : One weight for each contact of a phase: case 2.

      per_point : One weight for each point of a contact: case 3.

      parameters : Cubic polynomials of time over each interval, balance as constraints.
    """

    __members__: typing.ClassVar[dict[str, Forces]]
    parameters: typing.ClassVar[Forces]
    per_body: typing.ClassVar[Forces]
    per_point: typing.ClassVar[Forces]
    uniform: typing.ClassVar[Forces]
    @typing.overload
    def __eq__(self, other: Forces) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Forces) -> bool: ...
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

class ContactMode:
    """
    How an end-effector in contact is held where it should be.

    Members:

      tube : Position and angle stay within a tube at every instant.

      band : Polynomial coefficients 0..neq of position and angle within a band.

      strict : The same coefficients zero; one contact of a phase is left out.
    """

    __members__: typing.ClassVar[dict[str, ContactMode]]
    band: typing.ClassVar[ContactMode]
    strict: typing.ClassVar[ContactMode]
    tube: typing.ClassVar[ContactMode]
    @typing.overload
    def __eq__(self, other: ContactMode) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ContactMode) -> bool: ...
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

class Continuous:
    """
    How an inequality is kept at every instant of an interval.

    Members:

      hull : Every Bernstein coefficient within the limits.

      extremum : The polynomial's extrema within the limits: exact, not smooth.

      grid : At grid_points instants: nothing is said about the time between.
    """

    __members__: typing.ClassVar[dict[str, Continuous]]
    extremum: typing.ClassVar[Continuous]
    grid: typing.ClassVar[Continuous]
    hull: typing.ClassVar[Continuous]
    @typing.overload
    def __eq__(self, other: Continuous) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Continuous) -> bool: ...
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

class FreeFlyer:
    """
    The trajectory of the base.

    Members:

      computed : From the joints (eqs. 9-12).

      parameterised : Three more splines (Table I).
    """

    __members__: typing.ClassVar[dict[str, FreeFlyer]]
    computed: typing.ClassVar[FreeFlyer]
    parameterised: typing.ClassVar[FreeFlyer]
    @typing.overload
    def __eq__(self, other: FreeFlyer) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FreeFlyer) -> bool: ...
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

class HessianChoice:
    """
    Where second derivatives come from.

    Members:

      automatic : As suits the problem, and another one where that fails.

      exact : Of cost and constraints.

      gauss_newton : Of the cost alone, without its curvature.

      limited_memory : L-BFGS.
    """

    __members__: typing.ClassVar[dict[str, HessianChoice]]
    automatic: typing.ClassVar[HessianChoice]
    exact: typing.ClassVar[HessianChoice]
    gauss_newton: typing.ClassVar[HessianChoice]
    limited_memory: typing.ClassVar[HessianChoice]
    @typing.overload
    def __eq__(self, other: HessianChoice) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: HessianChoice) -> bool: ...
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
    Options of the semi-infinite planner.
    """

    __hash__: typing.ClassVar[None] = None
    def __copy__(self) -> Options: ...
    def __deepcopy__(self, memo: dict) -> Options: ...
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        forces: Forces = ...,
        torque_weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        duration_weight: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        jerk_weight: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        free_durations: bool = True,
        total_duration_s: tuple[float, float] = (1.0, 20.0),
        phase_duration_s: tuple[float, float] = (0.2, 5.0),
        contact: ContactMode = ...,
        tube_m: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        tube_rad: typing.SupportsFloat | typing.SupportsIndex = 0.005,
        neq: typing.SupportsInt | typing.SupportsIndex = 2,
        continuous: Continuous = ...,
        grid_points: typing.SupportsInt | typing.SupportsIndex = 10,
        order: typing.SupportsInt | typing.SupportsIndex = 8,
        free_flyer: FreeFlyer = ...,
        dynamics: bool = True,
        torque_limits: bool = True,
        clearance: bool = True,
        self_collision: bool = False,
        clearance_m: typing.SupportsFloat | typing.SupportsIndex = -0.001,
        min_normal_force: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        margin: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        log_weight_max: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        kinematics_first: bool = True,
        feasible_first: bool = True,
        solver: mcplan._core.nlp.Solver = ...,
        hessian: HessianChoice = ...,
        tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-05,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 1000,
        time_limit_s: typing.SupportsFloat | typing.SupportsIndex = ...,
        logger: collections.abc.Callable[[mcplan._core.LogLevel, str], None] = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def has_cost(self) -> bool:
        """
        Whether there is anything to minimise; torques with dynamics only.
        """
    def validate(self) -> None:
        """
        Raise InvalidOptions naming all that is out of its range.
        """
    @property
    def clearance(self) -> bool:
        """
        Swinging end-effectors outside of all solids.
        """
    @clearance.setter
    def clearance(self, arg0: bool) -> None: ...
    @property
    def clearance_m(self) -> float:
        """
        [m] Least height of swinging points: at lift-off they are at zero to the tube.
        """
    @clearance_m.setter
    def clearance_m(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def constraint_tolerance(self) -> float:
        """
        Tolerance of the solver on constraints.
        """
    @constraint_tolerance.setter
    def constraint_tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact(self) -> ContactMode:
        """
        How an end-effector in contact is held where it should be.
        """
    @contact.setter
    def contact(self, arg0: ContactMode) -> None: ...
    @property
    def continuous(self) -> Continuous:
        """
        How an inequality is kept at every instant of an interval.
        """
    @continuous.setter
    def continuous(self, arg0: Continuous) -> None: ...
    @property
    def duration_weight(self) -> float:
        """
        [1/s] Cost: duration.
        """
    @duration_weight.setter
    def duration_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def dynamics(self) -> bool:
        """
        Contact forces in their cones; off: kinematics alone.
        """
    @dynamics.setter
    def dynamics(self, arg0: bool) -> None: ...
    @property
    def feasible_first(self) -> bool:
        """
        With a cost: solve without it first, and start from that.
        """
    @feasible_first.setter
    def feasible_first(self, arg0: bool) -> None: ...
    @property
    def forces(self) -> Forces:
        """
        Where contact forces come from.
        """
    @forces.setter
    def forces(self, arg0: Forces) -> None: ...
    @property
    def free_durations(self) -> bool:
        """
        A duration for each phase; else one for the motion, shared by intervals.
        """
    @free_durations.setter
    def free_durations(self, arg0: bool) -> None: ...
    @property
    def free_flyer(self) -> FreeFlyer:
        """
        The trajectory of the base.
        """
    @free_flyer.setter
    def free_flyer(self, arg0: FreeFlyer) -> None: ...
    @property
    def grid_points(self) -> int:
        """
        Instants of an interval under Continuous.grid, both ends included.
        """
    @grid_points.setter
    def grid_points(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def hessian(self) -> HessianChoice:
        """
        Where second derivatives come from.
        """
    @hessian.setter
    def hessian(self, arg0: HessianChoice) -> None: ...
    @property
    def jerk_weight(self) -> float:
        """
        [s^5] Cost: integral of the squared joint jerks.
        """
    @jerk_weight.setter
    def jerk_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def kinematics_first(self) -> bool:
        """
        With dynamics: find contacts and joints within limits first, forces from there.
        """
    @kinematics_first.setter
    def kinematics_first(self, arg0: bool) -> None: ...
    @property
    def log_weight_max(self) -> float:
        """
        Bound of the logarithms of weights.
        """
    @log_weight_max.setter
    def log_weight_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def logger(self) -> collections.abc.Callable[[mcplan._core.LogLevel, str], None]:
        """
        Called with (LogLevel, line), a line an iteration; None: silent.
        """
    @logger.setter
    def logger(self, arg0: collections.abc.Callable[[mcplan._core.LogLevel, str], None]) -> None: ...
    @property
    def margin(self) -> float:
        """
        [-] Kept to joint, torque and force limits, relative.
        """
    @margin.setter
    def margin(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        Most iterations of each run of the solver.
        """
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_normal_force(self) -> float:
        """
        [N] Least normal force at every point.
        """
    @min_normal_force.setter
    def min_normal_force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def neq(self) -> int:
        """
        Highest coefficient of band and strict, 0 to order.
        """
    @neq.setter
    def neq(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def order(self) -> int:
        """
        Order of the Taylor polynomials, 3 to 12.
        """
    @order.setter
    def order(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def phase_duration_s(self) -> tuple[float, float]:
        """
        [s] Where free_durations is on: min, max; the task's own limits hold as well.
        """
    @phase_duration_s.setter
    def phase_duration_s(self, arg0: tuple[float, float]) -> None: ...
    @property
    def self_collision(self) -> bool:
        """
        The robot's collision pairs keep clear of each other.
        """
    @self_collision.setter
    def self_collision(self, arg0: bool) -> None: ...
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
        [s] Wall clock of the whole solve.
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
    def torque_limits(self) -> bool:
        """
        Joint torques within their limits.
        """
    @torque_limits.setter
    def torque_limits(self, arg0: bool) -> None: ...
    @property
    def torque_weight(self) -> float:
        """
        [1/(N m)^2 s] Cost: integral of the squared torques.
        """
    @torque_weight.setter
    def torque_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def total_duration_s(self) -> tuple[float, float]:
        """
        [s] Where free_durations is off: min, max.
        """
    @total_duration_s.setter
    def total_duration_s(self, arg0: tuple[float, float]) -> None: ...
    @property
    def tube_m(self) -> float:
        """
        [m] Half width of the tube or of the band.
        """
    @tube_m.setter
    def tube_m(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tube_rad(self) -> float:
        """
        [rad] The same of the angle.
        """
    @tube_rad.setter
    def tube_rad(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Result:
    """
    A planar plan and how it was found.
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
    @property
    def certificate(self) -> Certificate | None:
        """
        What is proved of the plan, a copy; None: not asked for.
        """
    @certificate.setter
    def certificate(self, arg1: Certificate | None) -> None: ...
    @property
    def constraints(self) -> int:
        """
        Rows of the program.
        """
    @property
    def drift_m(self) -> float:
        """
        Largest of a contact, at 1 kHz, from exact kinematics [m].
        """
    @property
    def drift_rad(self) -> float:
        """
        [rad]
        """
    @property
    def parameters(self) -> int:
        """
        Variables of the program.
        """
    @property
    def plan(self) -> mcplan._core.PlanarPlan:
        """
        The motion: a PlanarPlan.
        """
    @plan.setter
    def plan(self, arg1: mcplan._core.PlanarPlan) -> None: ...
    @property
    def report(self) -> mcplan._core.Report:
        """
        Status solved only if the checker accepts the plan; time_s is split in timing_s: "evaluation", "linear_solver", "check"; cost_terms by name.
        """
    @report.setter
    def report(self, arg1: mcplan._core.Report) -> None: ...
    @property
    def solver(self) -> mcplan._core.nlp.Solver:
        """
        That found the motion: ipopt or ipm.
        """

class Planner:
    """
    Whole-body planning of a planar robot through a sequence of contact stances by semi-infinite programming (Lengagne et al., 2010). Solves release the GIL; Ctrl-C ends them, and Interrupted carries the best plan so far.
    """
    def __init__(self, task: mcplan._core.PlanarTask, options: Options = ...) -> None:
        """
        Raises InvalidPlanarTask, InvalidRobot, InvalidOptions.
        """
    @typing.overload
    def solve(self) -> Result:
        """
        From the robot's zero posture throughout, weights of 1, and one second.
        """
    @typing.overload
    def solve(self, warm_start: mcplan._core.PlanarPlan) -> Result:
        """
        From a plan of the same robot and phases; forces, order, tube and durations may differ. Raises InvalidPlan where its phases or joints do not fit.
        """
    @property
    def constraints(self) -> int:
        """
        Rows of the program.
        """
    @property
    def parameters(self) -> int:
        """
        Variables of the program.
        """

def certify(
    plan: mcplan._core.PlanarPlan,
    tolerances: mcplan._core.PlanarTolerances = ...,
    order: typing.SupportsInt | typing.SupportsIndex = 8,
    max_depth: typing.SupportsInt | typing.SupportsIndex = 12,
    self_collision: bool = False,
) -> Certificate:
    """
    Prove every inequality of a planar plan at every instant, with Taylor models of `order` (2 to 12) on intervals that are halved up to `max_depth` (0 to 40) times. Raises InvalidPlan, InvalidPlanarTask, InvalidRobot, InvalidOptions.
    """
