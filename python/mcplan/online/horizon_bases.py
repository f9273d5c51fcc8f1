"""How the base turns in plans of rhp, which say nothing of it: as the legs reach what is planned for their feet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample_at
from mcplan.kinematics.smooth_postures import running_means

from .state import rpy_of, rpy_rate

if TYPE_CHECKING:
    from mcplan._core import Plan
    from mcplan.kinematics.urdf_model import UrdfModel

#: Postures are worked out so often [1/s].
RATE = 20.0


def with_bases(plan: Plan, urdf_model: UrdfModel) -> Plan:
    """The plan with the rotation of the base at its knots that postures by inverse kinematics have.

    Args:
        plan: Of rhp.
        urdf_model: Of the robot that walks, with the plan's end-effectors in the plan's order.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    duration = float(plan.duration())
    times = np.linspace(0.0, duration, max(2, round(duration * RATE) + 1))
    samples = sample_at(plan, plan.scene, plan.robot, times)
    found = running_means(urdf_model, times, follow(urdf_model, samples).configurations)
    turned, knots = plan.__copy__(), []
    for knot, at in zip(plan.knots, plan.knot_times(), strict=True):
        k = min(int(at / (times[1] - times[0])), len(times) - 2)
        step = times[k + 1] - times[k]
        configuration = pin.interpolate(urdf_model.model, found[k], found[k + 1], (at - times[k]) / step)
        base_WB = pin.Quaternion(configuration[3:7]).toRotationMatrix()
        omega_W = pin.log3(
            pin.Quaternion(found[k + 1][3:7]).toRotationMatrix() @ pin.Quaternion(found[k][3:7]).toRotationMatrix().T
        )
        own = knot.__copy__()
        own.base_rpy = rpy_of(base_WB)
        own.base_rpy_rate = rpy_rate(own.base_rpy, omega_W / step)
        knots.append(own)
    turned.knots = knots
    return turned
