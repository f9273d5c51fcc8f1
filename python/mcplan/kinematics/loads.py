"""What a plan of contact wrenches asks for: largest angular momentum, force and friction of each end-effector."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mcplan._core import plan_loads

if TYPE_CHECKING:
    from mcplan._core import Plan

#: [s] between the instants that are looked at, at most; start and end of every phase are among them.
STEP_S = 0.005


@dataclass
class Loads:
    """Largest values over a plan.

    Attributes:
        angular_momentum: Length of the angular momentum about the CoM [kg m^2/s].
        forces: Largest force of each end-effector in contact, in weights of the robot.
        frictions: Largest ratio of its tangential to its normal force, infinite for a pull.
    """

    angular_momentum: float = 0.0
    forces: dict[str, float] = field(default_factory=dict)
    frictions: dict[str, float] = field(default_factory=dict)


def loads_of(plan: Plan) -> Loads | None:
    """Loads of a plan of contact wrenches; None for others."""
    if not plan.phases or not all(phase.has_wrenches for phase in plan.phases):
        return None
    found = plan_loads(plan, STEP_S)
    names = [end.name for end in plan.robot.end_effectors]
    return Loads(
        found.angular_momentum,
        {names[load.end_effector]: load.force for load in found.contacts},
        {names[load.end_effector]: load.friction for load in found.contacts},
    )
