"""mp.motion: a whole-body motion along a plan of contacts and CoM."""

from __future__ import annotations

import logging
import numbers
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan
from mcplan._core import wb as _core
from mcplan.arguments import require as require_type
from mcplan.arguments import require_names, require_number, require_or_path
from mcplan.errors import Interrupted, InvalidOptions, InvalidPlan, shown
from mcplan.extras import require
from mcplan.files.plans import load_plan
from mcplan.files.whole_ground import on_whole_ground

from . import start as starts
from .between_nodes import balanced, with_forces, with_model
from .capsules import LinkCapsule, keep_apart, link_capsules
from .contact_points import corners_S, points_S, to_corners
from .motion import Motion
from .motion_fields import CORNERS, MAX_COORDINATE
from .moving_joints import MovingRobot
from .nodes import Nodes, nodes_of, require_few
from .problem import build_problem
from .result import MotionReport, MotionResult, MotionStatus
from .shortfalls import not_reached, shortfall_of
from .too_late import TooLate, deadline, standing

if TYPE_CHECKING:
    from .certificate.tolerances import MotionTolerances
    from .dynamics import Dynamics
    from .motion_model import MotionModel

Array = NDArray[np.float64]

#: Where the search may begin.
STARTS = ("follow", "stand")
#: Scaled rows within which a motion keeps its constraints: 0.03 N, 0.03 mm.
#: Of a motion's cost what exceeded limits may cost, and by how much they are made dearer where they cost more.
SMALL_PENALTY, DEARER = 1e-3, 30.0
#: Beyond which the base's angles Z-Y-X are too near to where they are singular [degrees].
MAX_PITCH_DEG = 75.0
#: What the certificate finds where forces do not balance between nodes, and the ratio of the time between nodes with which a
#: second search then tries again.
BALANCE, FINER = ("corrected_force", "corrected_moment", "residual_force", "residual_moment"), 0.8
#: What the certificate finds where a plan is beyond reach, and its motion stays behind.
OFF_THE_PLAN = {"com_rms", "com_max"}
#: Times at most that links are told to keep a distance, and solves are repeated.
ROUNDS = 4
#: Violation of scaled rows (1 N, 1 mm) with which a search that has not converged says by what a motion exceeds limits.
NEARLY = 1e-2
#: Scale of the base's rows [N, N m], and iterations after which a search that is not near still says what is lacking.
BASE_SCALE, TRIED = 100.0, 40
CONSTRAINT_TOLERANCE, COST_TOLERANCE, TOLERANCE, BARRIER = 3e-4, 1e-4, 1e-5, 0.1

_log = logging.getLogger("mcplan.wb")


def motion(
    plan: Plan | str | Path,
    *,
    joints: str | Sequence[str] = "default",
    node_s: float = 0.025,
    max_iterations: int = 60,
    time_limit_s: float = float("inf"),
    start: str = "follow",
    tolerances: MotionTolerances | None = None,
) -> MotionResult:
    """See mcplan.motion."""
    began = time.perf_counter()
    plan = on_whole_ground(_plan_of(plan))
    _require_options(joints, node_s, max_iterations, time_limit_s, start, tolerances)
    require("mcplan.motion", "view", "pinocchio", "scipy")

    robot = MovingRobot.of(plan, joints)
    require_few(plan, node_s)
    until = began + time_limit_s

    def with_nodes(step_s: float) -> MotionResult:
        search = _Search.of(robot, step_s, deadline(until))
        try:
            return _searched(search, start, max_iterations, began, until, tolerances)
        finally:
            search.dynamics.solver = None  # they hold each other

    try:
        result = with_nodes(node_s)
    except TooLate:
        return _too_late(robot, began)
    if not _fails_between_nodes(result) or time.perf_counter() > until:
        return result
    try:
        finer = with_nodes(FINER * node_s)
    except KeyboardInterrupt:
        raise _interrupted(result) from None
    except TooLate:
        return result
    if finer.report.status != MotionStatus.SOLVED:
        return result
    return _with_status(finer, finer.report.status, iterations=result.iterations + finer.iterations)


def _too_late(robot: MovingRobot, began: float) -> MotionResult:
    """The result of a search that had no time to begin."""
    stands = standing(robot)
    took = time.perf_counter() - began
    why = "the time limit was reached before the first iteration: the motion stands still"
    return MotionResult(stands, MotionReport(MotionStatus.TIME_LIMIT, why, 0, took, took, 0.0, 0.0, 0.0, float("nan")))


def _fails_between_nodes(result: MotionResult) -> bool:
    """Whether the forces of what has converged do not balance between its nodes, and nothing else is wrong with it."""
    if result.report.status != MotionStatus.NOT_CERTIFIED or result.certificate is None:
        return False
    return all(violation.name in BALANCE for violation in result.certificate.violations())


def _searched(
    search: _Search, start: str, max_iterations: int, began: float, until: float, tolerances: MotionTolerances | None
) -> MotionResult:
    x = search.start(start, deadline(until))
    started = time.perf_counter()
    found, certified_s, result = _Found(), 0.0, None
    while True:
        try:
            search.solve(found, x, max_iterations, until)
            before, certified_before, result = result, certified_s, search.result(found, began, started, certified_s)
            result = _judged(search, found, result, tolerances)
        except KeyboardInterrupt:
            if not found.solves:
                raise
            stopped = search.result(found, began, started, certified_s)
            raise _interrupted(stopped) from None
        certified_s = result.report.certificate_s
        if result.certificate is None and before is not None:
            return _with_status(before, before.status, iterations=result.iterations, certificate_s=certified_s)
        if not search.keep_apart(result):
            return result
        x = search.again(found.last.x)
        until += certified_s - certified_before


def _plan_of(plan: Plan | str | Path) -> Plan:
    if isinstance(plan, Plan):
        return plan
    require_or_path("plan", plan, "a Plan")
    found = load_plan(plan)
    require_type("plan", found, Plan)
    return found


def _require_options(
    joints: str | Sequence[str],
    node_s: float,
    max_iterations: int,
    time_limit_s: float,
    start: str,
    tolerances: MotionTolerances | None,
) -> None:
    from .certificate.tolerances import MotionTolerances

    require_names("joints", joints)
    require_type("tolerances", tolerances, MotionTolerances, optional=True)
    if not 1e-3 <= require_number("node_s", node_s) <= 0.2:
        raise InvalidOptions("node_s", "must lie in [0.001, 0.2] s", shown(node_s))
    if not require_number("time_limit_s", time_limit_s) > 0.0:
        raise InvalidOptions("time_limit_s", "must be positive", shown(time_limit_s))
    if isinstance(max_iterations, bool) or not isinstance(max_iterations, numbers.Integral) or max_iterations < 0:
        raise InvalidOptions("max_iterations", "must be a whole number of at least 0", shown(max_iterations))
    if not isinstance(start, str) or start not in STARTS:
        raise InvalidOptions("start", f"must be one of {', '.join(STARTS)}", shown(start))


def _require_within(nodes: Nodes) -> None:
    """Raise InvalidPlan for a plan that is nowhere near the ground, or whose base is pitched too far."""
    far = np.maximum(np.abs(nodes.samples.com_W).max(axis=1), np.abs(nodes.samples.positions_W).max(axis=(1, 2)))
    pitch = np.degrees(np.abs(nodes.base_zyx[:, 1]))
    for values, most, rule, unit in (
        (far, MAX_COORDINATE, f"must keep within {MAX_COORDINATE:g} m of the origin for a motion", "m"),
        (pitch, MAX_PITCH_DEG, f"must pitch the base by at most {MAX_PITCH_DEG:g} degrees for a motion", "degrees"),
    ):
        k = int(np.argmax(np.where(np.isnan(values), np.inf, values)))
        if not values[k] <= most:
            raise InvalidPlan("plan", rule, f"{values[k]:.4g} {unit} at {nodes.times_s[k]:.3f} s")


@dataclass
class _Found:
    """All solves so far, of which each began where the one before ended.

    Attributes:
        solves: They.
        exceeding: Whether one converged while it exceeded limits, which are made dearer then.
    """

    solves: list[_core.Solution] = field(default_factory=list)
    exceeding: bool = False

    @property
    def last(self) -> _core.Solution:
        return self.solves[-1]


@dataclass
class _Search:
    """A plan and a robot, and the solver's problem made of them."""

    robot: MovingRobot
    nodes: Nodes
    problem: _core.Problem
    dynamics: Dynamics
    solver: _core.Solver
    capsules: dict[str, LinkCapsule] = field(default_factory=dict)
    rounds: int = 0

    @staticmethod
    def of(robot: MovingRobot, node_s: float, in_time: Callable[[], None] = lambda: None) -> _Search:
        from .dynamics import Dynamics, spline_model

        plan, model = robot.plan, robot.model
        spline = spline_model(model, plan.scene.gravity)
        nodes = nodes_of(plan, node_s, in_time)
        _require_within(nodes)
        problem = build_problem(plan, spline, nodes, starts.posture(model), in_time)
        dynamics = Dynamics(spline)
        search = _Search(robot, nodes, problem, dynamics, _core.Solver(problem, dynamics))
        dynamics.solver = search.solver
        return search

    @property
    def plan(self) -> Plan:
        return self.robot.plan

    @property
    def model(self) -> MotionModel:
        return self.robot.model

    def start(self, kind: str, in_time: Callable[[], None] = lambda: None) -> Array:
        """Unknowns at which the search begins."""
        make = starts.follow_plan if kind == "follow" else starts.stand_still
        forces = starts.planned_forces_S(self.plan, self.nodes, self.problem.weight_N)
        return self.solver.unknowns(make(self.plan, self.model, self.nodes, in_time), forces)

    def solve(self, found: _Found, x: Array, max_iterations: int, until: float) -> None:
        """Solve, until a time of the performance counter. Limits that are exceeded are made dearer, from there on."""
        self._solve_once(found, x, max_iterations, until)
        first = found.last
        if first.status.name != "solved" or not first.penalty > SMALL_PENALTY * first.cost or found.exceeding:
            return
        found.exceeding = True
        weights = self.problem.weights
        weights.elastic *= DEARER
        self.problem.weights = weights
        self.renew()
        self._solve_once(found, first.x, max_iterations, until)

    def renew(self) -> None:
        """Make the solver of the problem as it is now."""
        self.solver = self.dynamics.solver = _core.Solver(self.problem, self.dynamics)

    def keep_apart(self, result: MotionResult) -> bool:
        """Let the links that a certificate finds nearest keep a distance; False: none are, or it was tried enough."""
        near = result.certificate.of("self_distance") if result.certificate else None
        if near is None or not near.violated or self.rounds == ROUNDS:
            return False
        self.rounds += 1
        self.capsules = self.capsules or link_capsules(self.model)
        return keep_apart(self.problem, self.model, self.capsules, near, result.motion.sample([near.time_s]).q[0])

    def again(self, x: Array) -> Array:
        """Unknowns of the problem with the rows that it has now, from those of the solver before."""
        coefficients, forces = self.solver.coefficients(x), self.solver.forces(x)
        self.renew()
        return self.solver.unknowns(coefficients, forces)

    def _solve_once(self, found: _Found, x: Array, max_iterations: int, until: float) -> None:
        log: Callable[[str], None] | None = _log.info if _log.isEnabledFor(logging.INFO) else None
        try:
            solution = self.solver.solve(
                start=x,
                max_iterations=max_iterations,
                time_limit_s=max(until - time.perf_counter(), 1e-3),
                constraint_tolerance=CONSTRAINT_TOLERANCE,
                cost_tolerance=COST_TOLERANCE,
                tolerance=TOLERANCE,
                initial_barrier=BARRIER,
                log=log,
            )
        except Interrupted as interrupted:
            if interrupted.result is not None:
                found.solves.append(interrupted.result)
            raise
        found.solves.append(solution)

    def result(self, found: _Found, began: float, started: float, certified_s: float) -> MotionResult:
        """The motion of a solution; its status is not decided on yet."""
        made = balanced(self.motion(found.last.x))
        report = MotionReport(
            status=MotionStatus.NOT_CONVERGED,
            message=found.last.message,
            iterations=sum(one.iterations for one in found.solves),
            time_s=time.perf_counter() - began - certified_s,
            start_s=started - began,
            evaluation_s=sum(one.evaluation_s for one in found.solves),
            linear_solver_s=sum(one.linear_solver_s for one in found.solves),
            certificate_s=certified_s,
            cost=found.last.cost,
        )
        return MotionResult(made, report)

    def motion(self, x: Array) -> Motion:
        """The motion of the solver's unknowns, forces moved to the corners of soles."""
        ends, nodes, count = self.plan.robot.end_effectors, self.nodes, self.nodes.count
        points = [corners_S(end) for end in ends]
        forces = np.zeros((count, len(ends), CORNERS, 3))
        given = np.asarray(self.solver.forces(x)).reshape(count, -1, 3)
        first = 0
        for end, own in enumerate(points):
            parts = given[:, first : first + len(own)]
            first += len(own)
            for interval in nodes.samples.intervals:
                if interval.end_effector != end:
                    continue
                inside = np.array([at[end] is interval for at in nodes.intervals])
                to = to_corners(points_S(self.plan, interval), own)
                forces[inside, end, : len(own)] = np.einsum("cp,ij,kpj->kci", to, interval.rotation_W, parts[inside])
        found = Motion(
            plan=self.plan,
            urdf=self.robot.urdf,
            joints=self.robot.joints,
            locked=self.robot.locked,
            times_s=self.nodes.times_s,
            coefficients=np.asarray(self.solver.coefficients(x)),
            corner_points_S=np.array([np.resize(own, (CORNERS, 3)) for own in points]),
            corner_forces_S=np.zeros_like(forces),
            contacts=self.nodes.contacts,
        )
        return with_forces(found, forces, with_model(found, self.model).sample(nodes.times_s).rotations_W)


def _interrupted(result: MotionResult) -> Interrupted:
    """Ctrl-C, with what there is: its search may have been done, but not what comes after."""
    return Interrupted(_with_status(result, MotionStatus.INTERRUPTED, message="before the motion was certified"))


def _with_status(result: MotionResult, status: MotionStatus, **changes: Any) -> MotionResult:
    return replace(result, report=replace(result.report, status=status, **changes))


def _judged(search: _Search, found: _Found, result: MotionResult, tolerances: MotionTolerances | None) -> MotionResult:
    """With the status that the solver's end, limits that were exceeded, and the certificate amount to."""
    from .certificate import certify

    ended = found.last.status.name
    if ended == "time_limit":
        return _with_status(result, MotionStatus.TIME_LIMIT)
    usage = np.asarray(search.solver.usage(found.last.x))
    near = found.exceeding or found.last.violation <= NEARLY
    tried = result.report.iterations >= TRIED
    left = BASE_SCALE * found.last.violation if tried else float("inf")
    shortfall = shortfall_of(usage, ended == "solved", near, search.nodes, result.motion, left)
    if shortfall is not None:
        kind = {"torque": MotionStatus.TORQUE_INFEASIBLE, "speed": MotionStatus.SPEED_INFEASIBLE}
        return _with_status(result, kind.get(shortfall.what, MotionStatus.REACH_INFEASIBLE), shortfall=shortfall)
    if ended != "solved":
        return result
    certificate = certify(result.motion, tolerances)
    astray = {violation.name for violation in certificate.violations()}
    if astray and astray <= OFF_THE_PLAN:
        shortfall = not_reached(search.model, search.plan, search.nodes)
    status = MotionStatus.SOLVED if certificate.ok() else MotionStatus.NOT_CERTIFIED
    message = "the certificate holds" if certificate.ok() else str(certificate.violations()[0])
    if shortfall is not None:
        status = MotionStatus.REACH_INFEASIBLE
    spent = result.report.certificate_s + certificate.time_s
    judged = _with_status(result, status, message=message, certificate_s=spent, shortfall=shortfall)
    return replace(judged, certificate=certificate)
