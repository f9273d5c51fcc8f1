"""When a replan is due."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .options import OnlineOptions

Array = NDArray[np.float64]


class Pace:
    """Says when to replan: by the period, at touchdowns, and when the robot leaves its plan.

    Attributes:
        new_goal: No plan leads to the present goal yet.
        commanded: The robot walks at a velocity.
        slipped: An end-effector slips, on a surface that is more slippery than was known.
    """

    def __init__(self, options: OnlineOptions) -> None:
        self._options = options
        self._last_s = -np.inf  # never
        self._touched = False
        self.new_goal = self.commanded = self.slipped = False

    def asked(self, now_s: float) -> None:
        """A replan was asked for."""
        self._last_s, self._touched, self.slipped = now_s, False, False

    def due(
        self, now_s: float, touchdown: bool, plan: Plan, t: float, com_W: Array, com_velocity_W: Array
    ) -> str | None:
        """What asks for a replan now; None: nothing does.

        Args:
            now_s: On the controller's clock.
            touchdown: An end-effector came into contact just now.
            plan: The plan under way. t: Time in it [s].
            com_W, com_velocity_W: (3,) measured.
        """
        options = self._options
        if np.isinf(self._last_s):  # under a command the first plan, which leads to a goal, is replaced at once
            self._last_s = -options.period_s if self.commanded else 0.0
        since_s = now_s - self._last_s
        self._touched |= touchdown
        if since_s < options.pause_s - 1e-9:
            return None
        if self.slipped:
            return "slip"
        # Where nothing but standing is left, replans would put in steps on the spot again and again.
        goes_on = self.commanded or steps_left(plan, t) or self.new_goal
        if options.at_touchdowns and self._touched and goes_on:
            return "touchdown"
        if since_s > options.period_s - 1e-9 and goes_on:
            return "goal" if self.new_goal else "period"
        com_m, capture_m = distances(plan, t, com_W, com_velocity_W)
        if com_m > options.com_margin_m:
            return "CoM"
        return "capture point" if capture_m > options.capture_margin_m else None


class TouchdownPace(Pace):
    """Says when to plan a horizon of rhp: once both feet stand after a touchdown, and again until there is one.

    Attributes:
        failed: The last horizon could not be followed.
    """

    def __init__(self, options: OnlineOptions) -> None:
        super().__init__(options)
        self.failed = False

    def due_standing(self, now_s: float, touchdown: bool, both_stand: bool) -> str | None:
        """What asks for a horizon now; None: nothing does.

        Args:
            now_s: On the controller's clock.
            touchdown: A foot came into contact just now.
            both_stand: Both feet are in contact and none is about to leave.
        """
        self._touched |= touchdown
        if not both_stand:
            return None
        if self._touched:
            return "touchdown"
        return "again" if self.failed and now_s - self._last_s > self._options.period_s - 1e-9 else None


def steps_left(plan: Plan, t: float) -> bool:
    """Whether contacts change after a time [s] of a plan."""
    if t >= plan.duration():
        return False
    now = [end.surface for end in plan.at(max(t, 0.0)).end_effectors]
    return now != list(plan.final_contacts) or len(plan.phases) - 1 > plan.at(max(t, 0.0)).phase


def distances(plan: Plan, t: float, com_W: Array, com_velocity_W: Array) -> tuple[float, float]:
    """Of CoM and capture point p + v sqrt(h / g) from those planned [m], in the ground plane for the latter."""
    planned = plan.at(min(max(t, 0.0), float(plan.duration())))
    rate = planned.com_velocity_W if t <= plan.duration() else np.zeros(3)
    off = com_W - planned.com_W
    swing_s = np.sqrt(plan.robot.com_height / plan.scene.gravity)
    capture = off + swing_s * (com_velocity_W - rate)
    return float(np.linalg.norm(off)), float(np.linalg.norm(capture[:2]))
