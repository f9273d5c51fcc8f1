"""Which plans are whole-body plans: they are drawn from their own joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeGuard

if TYPE_CHECKING:
    from mcplan import Plan, WholeBodyPlan


def is_whole_body(plan: Plan | WholeBodyPlan) -> TypeGuard[WholeBodyPlan]:
    """Whether a plan holds joint trajectories of a planar robot."""
    from mcplan._core import WholeBodyPlan

    return isinstance(plan, WholeBodyPlan)
