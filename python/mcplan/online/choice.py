"""Whether a robot that nothing pushes stays with the plan under way though there is a new one."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .planner import Update

#: Age of the plan under way up to which it is better than one that misses limits at once [periods].
YOUNG_PERIODS = 3.0


def longer(plan: Plan, under_way: Plan, t: float) -> bool:
    """Whether a plan has more phases than are left of the one under way, and one in which a late foot lands.

    Where nothing pushes the robot, another step on the spot, put in again and again, would keep it from its goal.
    """
    left = len(under_way.phases) - int(under_way.at(min(t, float(under_way.duration()))).phase)
    return len(plan.phases) > left + 1


def misses_at_once(update: Update, age_s: float, period_s: float) -> bool:
    """Whether a plan is nearly solved and misses a limit before the next one is due, and the one under way is young.

    A swing's first tenth is such a moment: corners of soles begin to count as its measured height is below that of any
    swing, and a plan that makes good for that bends the whole motion. The next replan has no such start.
    """
    misses = update.status == "acceptable" and update.kept_until_s - update.begins_s < period_s
    return misses and age_s < YOUNG_PERIODS * period_s
