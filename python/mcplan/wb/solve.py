"""mp.motion: a whole-body motion along a plan of contacts and CoM."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan
from mcplan._core import wb as _core
from mcplan.arguments import require as require_type
from mcplan.arguments import require_number, require_or_path
from mcplan.errors import Interrupted, InvalidOptions, shown
from mcplan.extras import require
from mcplan.files.plans import load_plan
from mcplan.files.robots import PACKAGE
from mcplan.files.urdf_setups import SETUPS

from . import start as starts
from .between_nodes import balanced, with_forces, with_model
from .contact_points import corners_S, points_S, to_corners
from .motion import CORNERS, Motion
from .motion_model import MotionModel, motion_model
from .moving_joints import moving_joints
from .nodes import Nodes, nodes_of
from .problem import build_problem
from .result import MotionReport, MotionResult, MotionStatus
from .shortfalls import shortfall_of

if TYPE_CHECKING:
    from .certificate.tolerances import MotionTolerances
    from .dynamics import Dynamics

Array = NDArray[np.float64]

#: Where the search may begin.
STARTS = ("follow", "stand")
#: Scaled rows within which a motion keeps its constraints: 0.03 N, 0.03 mm.
#: Of a motion's cost what exceeded limits may cost, and by how much they are made dearer where they cost more.
SMALL_PENALTY, DEARER = 1e-3, 30.0
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
    plan = _plan_of(plan)
    _require_options(node_s, max_iterations, time_limit_s, start)
    require("mcplan.motion", "view", "pinocchio", "scipy")
    search = _Search.of(plan, joints, node_s)
    try:
        return _searched(search, start, max_iterations, began, began + time_limit_s, tolerances)
    finally:
        search.dynamics.solver = None  # they hold each other


def _searched(
    search: _Search, start: str, max_iterations: int, began: float, until: float, tolerances: MotionTolerances | None
) -> MotionResult:
    x = search.start(start)
    started = time.perf_counter()
    try:
        found = search.solve(x, max_iterations, until)
    except Interrupted as interrupted:
        stopped = _Found.of(interrupted.result)
        if stopped is None:
            raise
        result = search.result(stopped, began, started)
        raise Interrupted(_with_status(result, MotionStatus.INTERRUPTED)) from None
    result = search.result(found, began, started)
    return _judged(search, found, result, tolerances)


def _plan_of(plan: Plan | str | Path) -> Plan:
    if isinstance(plan, Plan):
        return plan
    require_or_path("plan", plan, "a Plan")
    found = load_plan(plan)
    require_type("plan", found, Plan)
    return found


def _require_options(node_s: float, max_iterations: int, time_limit_s: float, start: str) -> None:
    if not 1e-3 <= require_number("node_s", node_s) <= 0.2:
        raise InvalidOptions("node_s", "must lie in [0.001, 0.2] s", shown(node_s))
    if not require_number("time_limit_s", time_limit_s) > 0.0:
        raise InvalidOptions("time_limit_s", "must be positive", shown(time_limit_s))
    if isinstance(max_iterations, bool) or not isinstance(max_iterations, int) or max_iterations < 0:
        raise InvalidOptions("max_iterations", "must be a whole number of at least 0", shown(max_iterations))
    if start not in STARTS:
        raise InvalidOptions("start", f"must be one of {', '.join(STARTS)}", shown(start))


@dataclass(frozen=True)
class _Found:
    """The last solution, and all solves of which each began where the one before ended."""

    last: _core.Solution
    solves: tuple[_core.Solution, ...]

    @staticmethod
    def of(result: Any) -> _Found | None:
        return result if isinstance(result, _Found) or result is None else _Found(result, (result,))


@dataclass
class _Search:
    """A plan and a robot, and the solver's problem made of them."""

    plan: Plan
    urdf: str
    joints: tuple[str, ...]
    locked: dict[str, float]
    model: MotionModel
    nodes: Nodes
    problem: _core.Problem
    dynamics: Dynamics
    solver: _core.Solver

    @staticmethod
    def of(plan: Plan, which: str | Sequence[str], node_s: float) -> _Search:
        from mcplan.kinematics.urdf_model import load_model

        from .dynamics import Dynamics, spline_model

        urdf = plan.robot.urdf.removeprefix(PACKAGE)
        urdf = urdf if urdf in SETUPS else plan.robot.urdf
        complete = load_model(plan.robot)
        joints, locked = moving_joints(complete, which)
        model = motion_model(plan, urdf, joints, locked, complete)
        spline = spline_model(model, plan.scene.gravity)
        nodes = nodes_of(plan, node_s)
        problem = build_problem(plan, spline, nodes, starts.posture(model))
        dynamics = Dynamics(spline)
        search = _Search(plan, urdf, joints, locked, model, nodes, problem, dynamics, _core.Solver(problem, dynamics))
        dynamics.solver = search.solver
        return search

    def start(self, kind: str) -> Array:
        """Unknowns at which the search begins."""
        make = starts.follow_plan if kind == "follow" else starts.stand_still
        forces = starts.planned_forces_S(self.plan, self.nodes, self.problem.weight_N)
        return self.solver.unknowns(make(self.plan, self.model, self.nodes), forces)

    def solve(self, x: Array, max_iterations: int, until: float) -> _Found:
        """The solution, until a time of the performance counter. Limits that it exceeds are made dearer, from there on."""
        first = self._solve_once(x, max_iterations, until)
        if first.status.name != "solved" or not first.penalty > SMALL_PENALTY * first.cost:
            return _Found(first, (first,))
        weights = self.problem.weights
        weights.elastic *= DEARER
        self.problem.weights = weights
        self.solver = self.dynamics.solver = _core.Solver(self.problem, self.dynamics)
        try:
            second = self._solve_once(first.x, max_iterations, until)
        except Interrupted as interrupted:
            raise Interrupted(_Found(interrupted.result or first, (first,))) from None
        return _Found(second, (first, second))

    def _solve_once(self, x: Array, max_iterations: int, until: float) -> _core.Solution:
        log: Callable[[str], None] | None = _log.info if _log.isEnabledFor(logging.INFO) else None
        return self.solver.solve(
            start=x,
            max_iterations=max_iterations,
            time_limit_s=max(until - time.perf_counter(), 1e-3),
            constraint_tolerance=CONSTRAINT_TOLERANCE,
            cost_tolerance=COST_TOLERANCE,
            tolerance=TOLERANCE,
            initial_barrier=BARRIER,
            log=log,
        )

    def result(self, found: _Found, began: float, started: float) -> MotionResult:
        """The motion of a solution; its status is not decided on yet."""
        made = balanced(self.motion(found.last.x))
        report = MotionReport(
            status=MotionStatus.NOT_CONVERGED,
            message=found.last.message,
            iterations=sum(one.iterations for one in found.solves),
            time_s=time.perf_counter() - began,
            start_s=started - began,
            evaluation_s=sum(one.evaluation_s for one in found.solves),
            linear_solver_s=sum(one.linear_solver_s for one in found.solves),
            certificate_s=0.0,
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
            urdf=self.urdf,
            joints=self.joints,
            locked=self.locked,
            times_s=self.nodes.times_s,
            coefficients=np.asarray(self.solver.coefficients(x)),
            corner_points_S=np.array([np.resize(own, (CORNERS, 3)) for own in points]),
            corner_forces_S=np.zeros_like(forces),
            contacts=self.nodes.contacts,
        )
        return with_forces(found, forces, with_model(found, self.model).sample(nodes.times_s).rotations_W)


def _with_status(result: MotionResult, status: MotionStatus, **changes: Any) -> MotionResult:
    return replace(result, report=replace(result.report, status=status, **changes))


def _judged(search: _Search, found: _Found, result: MotionResult, tolerances: MotionTolerances | None) -> MotionResult:
    """With the status that the solver's end, limits that were exceeded, and the certificate amount to."""
    from .certificate import certify

    ended = found.last.status.name
    if ended == "time_limit":
        return _with_status(result, MotionStatus.TIME_LIMIT)
    usage = np.asarray(search.solver.usage(found.last.x))
    shortfall = shortfall_of(usage, ended == "solved", len(found.solves) > 1, search.nodes, result.motion)
    if shortfall is not None:
        kind = {"torque": MotionStatus.TORQUE_INFEASIBLE, "speed": MotionStatus.SPEED_INFEASIBLE}
        return _with_status(result, kind.get(shortfall.what, MotionStatus.REACH_INFEASIBLE), shortfall=shortfall)
    if ended != "solved":
        return result
    certificate = certify(result.motion, tolerances)
    status = MotionStatus.SOLVED if certificate.ok() else MotionStatus.NOT_CERTIFIED
    message = "the certificate holds" if certificate.ok() else str(certificate.violations()[0])
    judged = _with_status(result, status, message=message, certificate_s=certificate.time_s)
    return replace(judged, certificate=certificate)
