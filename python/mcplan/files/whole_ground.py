"""Plans on ground in pieces, such as tiles: soles stand across seams, and what looks at soles needs the ground whole."""

from __future__ import annotations

from mcplan._core import Plan, join_surfaces
from mcplan._core.ddp import on_joined_ground


def on_whole_ground(plan: Plan) -> Plan:
    """The plan on surfaces that are joined where they lie in one plane and touch; itself where none do.

    Raises:
        InvalidPlan, InvalidScene: It is malformed.
    """
    plan.validate()
    whole = len(join_surfaces(plan.scene).surfaces) == len(plan.scene.surfaces)
    return plan if whole else on_joined_ground(plan)
