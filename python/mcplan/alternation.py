"""mp.plan(..., motion=True): search and whole-body stage in turn, until the motion is certified.

What the stage finds lacking is told to the next search as limits that it has: torques and speeds of limbs over the factor by
which they are exceeded, reach boxes drawn in, longer phases where a robot has no such limits.
"""

from __future__ import annotations

import copy
import inspect
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan import _core
from mcplan._core import Plan, PlanResult, Polytope, Robot, Scene
from mcplan.arguments import require
from mcplan.errors import Interrupted, InvalidArgument, shown
from mcplan.kinematics.urdf_model import load_model, own_joints
from mcplan.solve import make_options, robot_of, scene_of
from mcplan.solve import plan as search
from mcplan.wb.planned import PlannedMotion, Round, leads_to_the_goal
from mcplan.wb.result import MotionResult, MotionStatus, Shortfall

if TYPE_CHECKING:
    from mcplan.wb import Motion

#: Rounds at most.
ROUNDS = 5
#: What a search and a stage get at least where the time is over [s].
LEAST_S = 0.01
#: Beyond the factor by which a limit is exceeded, so that the next plan is not at its edge again.
MORE = 1.05
#: Of phases, at most.
MAX_LONGER = 2.0
#: Side of a reach box over the one before, seen from the nominal place.
DRAWN_IN = 0.95


def plan_with_motion(
    scene: Scene | str | Path,
    robot: Robot | str | Path,
    named: Mapping[str, Any],
    warm_start: Plan | None,
    options: _core.ddp.Options | None,
    motion: bool | Mapping[str, Any],
) -> PlannedMotion:
    """See mcplan.plan; `motion` has options of mcplan.motion by name."""
    if not isinstance(motion, bool | Mapping):
        raise InvalidArgument("motion", "must be True, or options of mcplan.motion by name", shown(motion))
    if isinstance(motion, Mapping):
        _require_options(motion)
    from mcplan.extras import require as require_extra

    require_extra("mcplan.plan with a motion", "view", "pinocchio", "scipy")
    require("warm_start", warm_start, Plan, optional=True)
    asked = _Asked(robot_of(robot), make_options(named, options))
    if not asked.given.urdf:
        load_model(asked.given)  # refuses it by name, before there is a search
    world, rounds = scene_of(scene), _Rounds()
    until, own = time.perf_counter() + asked.options.time_limit_s, dict(motion) if isinstance(motion, Mapping) else {}
    for _ in range(ROUNDS):
        asked.options.time_limit_s = max(until - time.perf_counter(), LEAST_S)
        try:
            planned = search(world, asked.robot, {}, warm_start, asked.options)
        except Interrupted as interrupted:
            raise Interrupted(rounds.ended(interrupted.result)) from None
        try:
            left_s = max(until - time.perf_counter(), LEAST_S)
            found = _carried_out(planned, asked.given, {"time_limit_s": left_s} | own)
        except Interrupted as interrupted:
            raise Interrupted(rounds.ended(planned, interrupted.result)) from None
        rounds.add(asked.last, planned, found)
        if found is None or (found.status is MotionStatus.SOLVED and leads_to_the_goal(planned)):
            break
        if time.perf_counter() > until or not asked.lower(planned.plan, found):
            break
        warm_start = None
    return rounds.result()


def _require_options(motion: Mapping[str, Any]) -> None:
    """Raise InvalidArgument for what is no option of mcplan.motion."""
    from mcplan.wb.solve import motion as find

    legal = [name for name in inspect.signature(find).parameters if name != "plan"]
    for name in motion:
        if name not in legal:
            rule = f"must have options of mcplan.motion: {', '.join(legal)}"
            raise InvalidArgument("motion", rule, shown(name))


@dataclass
class _Rounds:
    """What was found so far."""

    told: list[Round] = field(default_factory=list)
    best: tuple[PlanResult, MotionResult | None] | None = None

    def add(self, asked: str, planned: PlanResult, found: MotionResult | None) -> None:
        """Remember a round; the last one with a motion is the result."""
        status = None if found is None else found.status
        why = "" if found is None or status is MotionStatus.SOLVED else str(found.shortfall or found.report.message)
        self.told.append(Round(asked, str(planned.report.status), status, why))
        if self.best is None or found is not None:
            self.best = planned, found

    def result(self) -> PlannedMotion:
        assert self.best is not None
        return PlannedMotion(*self.best, tuple(self.told))

    def ended(self, planned: PlanResult | None, found: MotionResult | None = None) -> PlannedMotion | None:
        """The result of rounds that Ctrl-C ended in one that has come as far as this."""
        if planned is not None and (self.best is None or found is not None):
            self.best = planned, found
        return None if self.best is None else self.result()


def _carried_out(planned: PlanResult, given: Robot, options: dict[str, Any]) -> MotionResult | None:
    """The motion of a plan, of the robot as it was given; None: the plan is not one to carry out."""
    from mcplan.wb.solve import motion

    if not planned.plan.phases or str(planned.report.status) in ("infeasible", "no_sequence"):
        return None
    plan = planned.plan
    if any(end.limb.given for end in plan.robot.end_effectors):
        plan.robot = given
    return motion(plan, **options)


class _Asked:
    """What the next search is asked for: a robot with less, and options.

    Attributes:
        given: The robot as it was given.
        robot: That of the next search.
        options: Those of the next search.
        last: What was changed last, in a sentence.
    """

    def __init__(self, robot: Robot, options: _core.ddp.Options) -> None:
        self.given, self.robot, self.options, self.last = robot, copy.deepcopy(robot), copy.copy(options), ""
        self._limbs = any(end.limb.given for end in robot.end_effectors)

    def lower(self, plan: Plan, found: MotionResult) -> bool:
        """Take what was lacking from what the next search may use; False: nothing is known that would do."""
        lack = found.shortfall
        if lack is None:
            return self._without_flight(plan, found.motion)
        if lack.what in ("torque", "speed"):
            if not self._limbs or not self._in_a_limb(found, lack):
                return self._slower(plan, lack)
            if not self.options.joint_limits:
                self.options.joint_limits = True
                self.last = "joint limits"
                return True
            return self._weaker(lack)
        return lack.what == "reach" and self._drawn_in()

    def _in_a_limb(self, found: MotionResult, lack: Shortfall) -> bool:
        model = found.motion.model.complete
        limbs = [end for end, effector in enumerate(self.given.end_effectors) if effector.limb.given]
        return any(lack.joint == model.model.names[joint] for end in limbs for joint in own_joints(model, end))

    def _weaker(self, lack: Shortfall) -> bool:
        """Limits of all limbs over the factor: a plan that goes easy on one of two like legs does not load the other."""
        ratio, ends = 1.0 / (MORE * lack.factor), self.robot.end_effectors
        for end in ends:
            if not end.limb.given:
                continue
            if lack.what == "speed":
                end.limb.knee_speed *= ratio
                continue
            end.limb.knee_torque *= ratio
            end.limb.hip_torque = ratio * end.limb.hip_torque
            end.limb.ankle_torque = ratio * end.limb.ankle_torque
        self.robot.end_effectors = ends
        self.last = f"{lack.what} limits of limbs times {ratio:.2f}"
        return True

    def _slower(self, plan: Plan, lack: Shortfall) -> bool:
        """Longer phases, where no row of the search stands for the joint."""
        contacts = [phase.duration for phase in plan.phases if any(c.surface >= 0 for c in phase.contacts)]
        longer, options = min(MORE * lack.factor, MAX_LONGER), self.options
        options.duration_min_s = longer * max(min(contacts), options.duration_min_s)
        options.duration_max_s = max(longer * max(contacts), options.duration_max_s, options.duration_min_s)
        self.last = f"phases of at least {self.options.duration_min_s:.2f} s"
        return True

    def _drawn_in(self) -> bool:
        ends = self.robot.end_effectors
        for end in ends:
            nominal = end.nominal_B
            end.reach_min_B = nominal + DRAWN_IN * (end.reach_min_B - nominal)
            end.reach_max_B = nominal + DRAWN_IN * (end.reach_max_B - nominal)
            if end.reach_cut.given:
                A, b = np.asarray(end.reach_cut.A), np.asarray(end.reach_cut.b)
                end.reach_cut = Polytope(A=A, b=A @ nominal + DRAWN_IN * (b - A @ nominal))
        self.robot.end_effectors = ends
        self.last = f"reach times {DRAWN_IN:.2f}"
        return True

    def _without_flight(self, plan: Plan, motion: Motion) -> bool:
        """No flight, where one was planned and what keeps its motion from a certificate has no name."""
        flies = any(all(c.surface < 0 for c in phase.contacts) for phase in plan.phases)
        if not flies or not self.options.allow_flight:
            return False
        self.options.allow_flight = False
        self.last = "no flight"
        return True
