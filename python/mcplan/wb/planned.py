"""A plan and the whole-body motion that carries it out, and the rounds that it took to find both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan._core import Plan, PlanResult, Report

    from .motion import Motion
    from .result import MotionResult, MotionStatus

#: What the certificate of a motion decides on better than a plan's own rows, which stand for joints that it does not have.
DECIDED = ("reach", "joint_torque", "joint_speed")


@dataclass(frozen=True)
class Round:
    """A search and the whole-body stage after it.

    Attributes:
        asked: What the search was told that the one before was not; "": nothing.
        plan_status: How the search ended.
        motion_status: How the stage ended; None: it was not tried.
        found: What the stage found, in a sentence.
    """

    asked: str
    plan_status: str
    motion_status: MotionStatus | None
    found: str

    def __str__(self) -> str:
        lead = f"{self.asked}: " if self.asked else ""
        after = "no motion" if self.motion_status is None else f"motion {self.motion_status}"
        return f"{lead}plan {self.plan_status}, {after}{f' ({self.found})' if self.found else ''}"


@dataclass(frozen=True, eq=False)
class PlannedMotion:
    """What ``mp.plan(..., motion=True)`` comes back with.

    Attributes:
        planned: The search's result of the last round with a motion, else of the last one.
        motion_result: That round's motion; None: there is no plan to carry out.
        rounds: All rounds.
    """

    planned: PlanResult
    motion_result: MotionResult | None
    rounds: tuple[Round, ...]

    @property
    def plan(self) -> Plan:
        """The plan."""
        return self.planned.plan

    @property
    def report(self) -> Report:
        """How the search for the plan ended."""
        return self.planned.report

    @property
    def motion(self) -> Motion | None:
        """The motion; None: there is no plan to carry out."""
        return None if self.motion_result is None else self.motion_result.motion

    @property
    def solved(self) -> bool:
        """Whether the motion is certified and its plan leads to the goal."""
        result = self.motion_result
        return result is not None and str(result.status) == "solved" and leads_to_the_goal(self.planned)

    @property
    def status(self) -> str:
        """``solved``, else how the whole-body stage ended, else how the search did."""
        if self.solved:
            return "solved"
        result = self.motion_result
        return str(self.report.status if result is None or str(result.status) == "solved" else result.status)

    def __str__(self) -> str:
        last = self.rounds[-1] if self.rounds else ""
        return f"{self.status} after {len(self.rounds)} round{'s' * (len(self.rounds) != 1)}: {last}"


def leads_to_the_goal(planned: PlanResult) -> bool:
    """Whether a plan is solved but for what the certificate of its motion decides on: reach, joints, rest at the end."""
    if str(planned.report.status) == "solved":
        return True
    from mcplan._core import check

    if not planned.plan.phases:
        return False
    found = check(planned.plan).violations()
    return all(one.name in DECIDED or (one.name == "goal" and one.unit.endswith("/s")) for one in found)
