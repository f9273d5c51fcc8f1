"""States that are measured as they are planned."""

from __future__ import annotations

import mcplan as mp


def state_at(plan: mp.Plan, t: float) -> tuple[mp.model.Knot, list[int]]:
    """The planned state at a time [s], and the planned contacts."""
    now = plan.at(t)
    knot = mp.model.Knot(
        com_W=now.com_W,
        com_velocity_W=now.com_velocity_W,
        base_rpy=now.base_rpy,
        base_rpy_rate=now.base_rpy_rate,
        angular_momentum_W=now.angular_momentum_W,
        end_effectors_W=[end.position_W for end in now.end_effectors],
        end_effector_velocities_W=[end.velocity_W for end in now.end_effectors],
        end_effector_yaw=[end.yaw for end in now.end_effectors],
    )
    return knot, [end.surface for end in now.end_effectors]
