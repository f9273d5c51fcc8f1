"""
Planning while the robot walks: what to do with a replan's plan.
"""

from __future__ import annotations
import mcplan._core
import typing

__all__: list[str] = ["HEIGHT_MARGIN_M", "follows", "with_feet_kept_up", "with_planned_height"]

def follows(report: mcplan._core.Report, period_s: typing.SupportsFloat | typing.SupportsIndex) -> bool:
    """
    Whether it is better to follow the plan of a replan than to stay with the plan under way: it was made from the measured state, and it is solved, acceptable, or keeps all limits for twice the time [s] between two replans.
    """

def with_feet_kept_up(plan: mcplan._core.Plan) -> mcplan._core.Plan:
    """
    The plan with the ways of feet that are in the air at its start kept from the ground, and raised over their splines by 0.5 m/s at most. Raises InvalidPlan.
    """

def with_planned_height(
    measured: mcplan._core.Knot,
    plan: mcplan._core.Plan,
    t: typing.SupportsFloat | typing.SupportsIndex,
    margin_m: typing.SupportsFloat | typing.SupportsIndex = 0.03,
) -> mcplan._core.Knot:
    """
    The state from which to plan on at time t [s] in the plan under way: the measured one, but with height and vertical velocity of the CoM as planned where they are off by less than a margin [m].
    """

HEIGHT_MARGIN_M: float = 0.03
