"""Options by name, as typed dictionaries: for ``**options`` of mcplan.plan and its kin, and for your own annotations.

Made by scripts/option_types from the tables of fields of the compiled module; do not edit.
"""

from __future__ import annotations

import collections.abc
from typing import Literal, TypedDict

from mcplan import _core
from mcplan._core import ddp, rhp, sip

__all__ = ["DdpOptions", "DdpReplanOptions", "DdpWeights", "RhpOptions", "SipOptions"]


class DdpWeights(TypedDict, total=False):
    """Weights w of the cost terms 1/2 w^2 e^2 (Tazaki, Table I), for non-dimensional quantities: length in CoM heights,
    time in sqrt(height / gravity), mass 1. Those named _end hold at the first and last knot."""

    com: float
    """On the CoM's distance from its reference."""
    com_end: float
    """The same at the first and last knot."""
    velocity: float
    """On the CoM's velocity."""
    velocity_end: float
    """The same at the first and last knot."""
    rotation: float
    """On the base's angles and rates, inside for Model.lipm alone."""
    rotation_end: float
    """The same at the first and last knot."""
    angle: float
    """On the base's angles inside, of Model.wrench."""
    momentum: float
    """On the angular momentum inside, of Model.wrench."""
    center_of_pressure: float
    """On the distance of the acting force from the end-effector, of Model.wrench."""
    force_line: float
    """On the distance from there to the line that points at the CoM, of Model.wrench; very large: the paper's
    forces."""
    end_effector: float
    """On the end-effectors' distance from their reference."""
    end_effector_end: float
    """The same at the first and last knot."""
    stride: float
    """On the travel of an end-effector within a phase."""
    stiffness: float
    """On the contact stiffness."""
    moment: float
    """On contact moments."""
    limit: float
    """On what is beyond reach, stiffness, moment, force, friction, duration."""
    duration: float
    """Towards the middle of the duration box."""
    contact_min: float
    """First complementarity weight."""
    contact_max: float
    """Last complementarity weight, at least the first."""
    contact_growth: float
    """Factor of that weight between iterations, above 1."""
    overshoot_factor: float
    """On leaving a polygon sideways, at least 1."""
    own: collections.abc.Mapping[str, float]
    """Weights of single terms by the term's name, where they are not the usual ones."""
    upright: float
    """On the tilt of contact forces of tracked robots' point feet."""
    flight: float
    """On every phase without any contact."""
    contact_change: float
    """On every contact made or broken."""


class DdpOptions(TypedDict, total=False):
    """Options of the contact-sequence search; the defaults serve all built-in scenes."""

    phases: int
    """Number of phases N; 0: those of its footsteps, or 18, or more where the way asks for more."""
    method: Literal["standard", "paper"] | ddp.Method
    """Which search runs."""
    model: Literal["wrench", "lipm"] | ddp.Model
    """What a contact can do; Method.paper always takes Model.lipm."""
    stiffness_input: Literal["mu", "lambda_"] | ddp.StiffnessInput
    """How the contact stiffness enters as an input."""
    polish: Literal["penalty", "interior_point"] | ddp.Polish
    """What finds the motion of a contact sequence that is given."""
    weights: DdpWeights | ddp.Weights
    """Weights of the cost terms."""
    duration_min_s: float
    """[s] Shortest phase, as a soft limit; 0: the robot's."""
    duration_max_s: float
    """[s] Longest phase, as a soft limit; 0: the robot's."""
    flight_duration_min_s: float
    """[s] Shortest phase without any contact. The default goes with the size of the robot."""
    duration_initial_s: float
    """[s] First guess of all phases; 0: the middle of their box, 0.45 for Model.lipm."""
    proximal_weight: float
    """First weight on the change of the inputs; it adapts."""
    interior_points: int
    """Instants inside a phase where limits are held."""
    reach_margin_m: float
    """[m] The reach box is planned smaller by this. The default goes with the size of the robot."""
    sole_inside: float
    """[-] Share of a sole's half size by which footholds keep from the edges of their surface; 1: the whole sole is on
    it, where it is large enough; negative: the robot's sole_support."""
    friction: bool
    """Hold the friction cones."""
    friction_ratio: float
    """[-] Ratio of each surface's friction that contacts use; at least half of it is left to them. Negative: 0.8 for
    tracked robots on point feet, else 1."""
    load_ratio: float
    """[-] Least load of a point foot in contact of a tracked robot, over an equal share of the weight: how far the
    centre of pressure stays inside the support polygon. Negative: 0.3."""
    friction_sides: int
    """Sides of the pyramid inside the cone that is held instead of it; 0: the cone itself."""
    joint_limits: bool
    """Hold the joint limits of legs for which the robot has them; False: the plan's robot is one without."""
    whole_sequence_moves: bool
    """Look for better contact sequences as a whole, by dynamic programming, where it pays."""
    stepping_guesses: bool
    """Begin with end-effectors that step in turn, and with footsteps over the ground, beside what the search finds."""
    allow_flight: bool
    """Allow phases without any contact. Where steps lead to the goal they come last even so."""
    min_contacts: int
    """Number of contacts at any time; -1: two for robots that stand on four feet, where a plan is found so."""
    detours: bool
    """Look for ways round what steps cannot cross, too."""
    one_switch_per_step: bool
    """At most one contact is made or broken between two phases (Tazaki, eq. 32)."""
    restarts: int
    """Further attempts while the checker rejects the plan."""
    max_iterations: int
    """Most iterations, over all attempts; to mend a near miss a tenth more."""
    time_limit_s: float
    """[s] Wall clock of the search."""
    time_limit: float | None
    """Short for time_limit_s; None: the default."""
    threads: int
    """Threads that search ways, guesses and changes at once; the result does not depend on it."""
    seed: int
    """Seed of the order in which restarts vary the settings."""
    initial_sequence: collections.abc.Sequence[collections.abc.Sequence[int]]
    """phases + 1 rows: surface index per end-effector, -1 free. Empty: searched for."""
    record_history: bool
    """Keep the sequence of every iteration in the report."""
    logger: collections.abc.Callable[[_core.LogLevel, str], None] | None
    """Called with (LogLevel, line); None: silent."""
    watch: collections.abc.Callable[[_core.Plan], None] | None
    """Called with every iterate of the search, a Plan that is not checked; None: never."""


class DdpReplanOptions(DdpOptions, total=False):
    """How to plan on from a measured state, beside the options of the search."""

    committed_s: float
    """[s] Contacts that are due within this time are made and broken as planned, when and where. The default goes with
    the size of the robot."""
    start_slack_s: float
    """[s] Time within which what the measured state itself violates has to be made good. The default goes with the size
    of the robot."""
    phases_min: int
    """The horizon never gets shorter than this: at its end the robot stands."""
    horizon: int
    """Number of phases that are planned ahead under a velocity command. To a goal twice as many are planned anew: what
    comes later stays as it was planned."""
    other_sequences: bool
    """Try sequences near to the plan's own where that does not do."""
    recovery_first: bool
    """Pushed, try steps that catch the robot before the plan's own sequence, not after it."""
    crossing: bool
    """Where the plan's own sequence does not catch a push outward over the foot that stands, the foot in the air may
    step across it, in front of it or behind it."""
    max_work: int
    """Iterations times phases, over all sequences, after which no other one is tried: 1000 take about 30 ms."""
    previous_accepted: bool
    """The checker has accepted the plan under way, to its end: what is kept of it, on the same scene and for the same
    robot, is not looked at again."""


class RhpOptions(TypedDict, total=False):
    """Options of the receding-horizon planner."""

    fidelity: Literal["single", "com", "rectangle", "point"] | rhp.Fidelity
    """Model of the steps after the first."""
    lookahead: int
    """Steps in the horizon, 1 to 10, the executed one included."""
    cycles: int
    """Steps to execute; fewer if the sequence ends before."""
    transcription: Literal["trapezoidal", "euler"] | rhp.Transcription
    """How the continuous motion becomes algebraic equations."""
    paper: bool
    """Absolute CoM box and outer friction pyramid, as published."""
    lifted_psi: bool
    """Keep the relaxation's bounds psi as variables."""
    friction_rows: bool
    """Pyramids with faces across t1 and t2, not edges."""
    all_faces: bool
    """Keep faces of the reach polytopes that others imply."""
    intervals: int
    """Intervals of a phase, 2 to 100."""
    double_support_s: tuple[float, float]
    """[s] Duration of a phase on two feet: min, max."""
    single_support_s: tuple[float, float]
    """[s] Duration of a phase on one foot: min, max."""
    landing_s: float
    """[s] Time by which the first phase of a horizon may last longer, for starts at a touch-down."""
    predicted_double_support_s: float
    """[s] Fixed duration of a phase on two feet in predicted steps of the reduced models."""
    predicted_single_support_s: float
    """[s] The same on one foot."""
    com_velocity_max: float
    """[m/s] Largest value of each component."""
    momentum_max: float
    """[kg m^2/s] Largest value of each component of L."""
    momentum_rate_max: float
    """[N m] Largest value of each component of L'."""
    com_height: tuple[float, float]
    """[-] Height of the CoM over every foot in contact, over robot.com_height: min, max."""
    sole_ratio: float
    """[-] Ratio of the sole that forces make use of; paper: all."""
    friction_ratio: float
    """[-] Ratio of the friction coefficient that forces make use of; paper: all."""
    foothold_margin_m: float
    """[m] Distance of the sole from the edges of a surface where it has room."""
    psi_max: float
    """[-] Bound of the relaxation."""
    goal_weight: float
    """[1/m^2] On the squared distance of the end to the goal."""
    friction_sides: int
    """Sides of the pyramid inside the friction cone, 3 to 64."""
    tolerance: float
    """Optimality tolerance of the solver."""
    constraint_tolerance: float
    """Tolerance of the solver on constraints."""
    max_iterations: int
    """Most iterations of a cycle."""
    time_limit_s: float
    """[s] Wall clock of a cycle."""
    time_limit: float | None
    """Short for time_limit_s; None: the default."""
    solver: Literal["ipopt", "ipm", "auto"] | _core.nlp.Solver
    """Solver of the nonlinear programs."""
    automatic_ordering: bool
    """Pivot order of Ipopt's linear solver is its own."""
    logger: collections.abc.Callable[[_core.LogLevel, str], None] | None
    """Called with (LogLevel, line), a line a cycle; None: silent."""


class SipOptions(TypedDict, total=False):
    """Options of the semi-infinite planner."""

    forces: Literal["uniform", "per_body", "per_point", "parameters"] | sip.Forces
    """Where contact forces come from."""
    torque_weight: float
    """[1/(N m)^2 s] Cost: integral of the squared torques."""
    duration_weight: float
    """[1/s] Cost: duration."""
    jerk_weight: float
    """[s^5] Cost: integral of the squared joint jerks."""
    free_durations: bool
    """A duration for each phase; else one for the motion, shared by intervals."""
    total_duration_s: tuple[float, float]
    """[s] Where free_durations is off: min, max."""
    phase_duration_s: tuple[float, float]
    """[s] Where free_durations is on: min, max; the task's own limits hold as well."""
    contact: Literal["tube", "band", "strict"] | sip.ContactMode
    """How an end-effector in contact is held where it should be."""
    tube_m: float
    """[m] Half width of the tube or of the band."""
    tube_rad: float
    """[rad] The same of the angle."""
    neq: int
    """Highest coefficient of band and strict, 0 to order."""
    continuous: Literal["hull", "extremum", "grid"] | sip.Continuous
    """How an inequality is kept at every instant of an interval."""
    grid_points: int
    """Instants of an interval under Continuous.grid, both ends included."""
    order: int
    """Order of the Taylor polynomials, 3 to 12."""
    free_flyer: Literal["computed", "parameterised"] | sip.FreeFlyer
    """The trajectory of the base."""
    dynamics: bool
    """Contact forces in their cones; off: kinematics alone."""
    torque_limits: bool
    """Joint torques within their limits."""
    clearance: bool
    """Swinging end-effectors outside of all solids."""
    self_collision: bool
    """The robot's collision pairs keep clear of each other."""
    clearance_m: float
    """[m] Least height of swinging points: at lift-off they are at zero to the tube."""
    min_normal_force: float
    """[N] Least normal force at every point."""
    margin: float
    """[-] Kept to joint, torque and force limits, relative."""
    log_weight_max: float
    """Bound of the logarithms of weights."""
    kinematics_first: bool
    """With dynamics: find contacts and joints within limits first, forces from there."""
    feasible_first: bool
    """With a cost: solve without it first, and start from that."""
    solver: Literal["ipopt", "ipm", "auto"] | _core.nlp.Solver
    """Solver of the nonlinear programs."""
    hessian: Literal["automatic", "exact", "gauss_newton", "limited_memory"] | sip.HessianChoice
    """Where second derivatives come from."""
    tolerance: float
    """Optimality tolerance of the solver."""
    constraint_tolerance: float
    """Tolerance of the solver on constraints."""
    max_iterations: int
    """Most iterations of each run of the solver."""
    time_limit_s: float
    """[s] Wall clock of the whole solve."""
    time_limit: float | None
    """Short for time_limit_s; None: the default."""
    logger: collections.abc.Callable[[_core.LogLevel, str], None] | None
    """Called with (LogLevel, line), a line an iteration; None: silent."""
