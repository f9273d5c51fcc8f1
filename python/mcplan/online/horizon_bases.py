"""How the base turns in plans of rhp, which say nothing of it: as the legs reach what is planned for their feet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.rotations import rotation_vector, rotations_of
from mcplan.kinematics.samples import sample_at
from mcplan.kinematics.smooth_postures import running_means

from .state import rpy_of, rpy_rate

if TYPE_CHECKING:
    from mcplan._core import Plan
    from mcplan.kinematics.urdf_model import UrdfModel

#: Postures are worked out so often [1/s].
RATE = 20.0


def with_bases(plan: Plan, urdf_model: UrdfModel) -> Plan:
    """The plan with a base that turns, at its knots, as that of postures by inverse kinematics.

    On slopes, and where the CoM is low, legs reach what is planned for them with such a base alone.

    Args:
        plan: Of rhp.
        urdf_model: Of the robot that walks, with the plan's end-effectors in the plan's order.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    duration = float(plan.duration())
    times = np.linspace(0.0, duration, max(2, round(duration * RATE) + 1))
    samples = sample_at(plan, plan.scene, plan.robot, times)
    found = running_means(urdf_model, times, follow(urdf_model, samples).configurations)
    bases_WB, step_s = rotations_of(found[:, 3:7]), times[1] - times[0]
    turned, knots = plan.__copy__(), []
    for knot, at_s in zip(plan.knots, plan.knot_times(), strict=True):
        k = min(int(at_s / step_s), len(times) - 2)
        turn = rotation_vector(bases_WB[k + 1] @ bases_WB[k].T)
        own = knot.__copy__()
        own.base_rpy = rpy_of(pin.exp3((at_s - times[k]) / step_s * turn) @ bases_WB[k])
        own.base_rpy_rate = rpy_rate(own.base_rpy, turn / step_s)
        knots.append(own)
    turned.knots = knots
    return turned
