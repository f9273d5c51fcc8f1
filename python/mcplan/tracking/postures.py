"""Postures near to a plan that does not itself say how the base is rotated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample
from mcplan.kinematics.smooth_postures import running_means
from mcplan.kinematics.urdf_model import UrdfModel

if TYPE_CHECKING:
    from mcplan._core import Plan

Array = NDArray[np.float64]

#: Postures are worked out so often [1/s] and interpolated.
RATE = 20.0


def postures_along(urdf_model: UrdfModel, plan: Plan, count: int, dt_s: float) -> Array:
    """Configurations (count, nq) that follow a plan by inverse kinematics, dt apart; the last one is repeated."""
    import pinocchio as pin  # type: ignore[import-untyped]

    samples = sample(plan, plan.scene, plan.robot, RATE)
    # The postures' torso and base jump where feet leave the ground; a base that is asked to jump throws the robot.
    found = running_means(urdf_model, samples.times_s, follow(urdf_model, samples).configurations)
    step = samples.times_s[1] - samples.times_s[0]
    result = np.empty((count, urdf_model.model.nq))
    for n in range(count):
        at = min(n * dt_s / step, len(found) - 1.0)
        k = min(int(at), len(found) - 2)
        fraction = at - k
        fraction = fraction * fraction * (3.0 - 2.0 * fraction)
        result[n] = pin.interpolate(urdf_model.model, found[k], found[k + 1], fraction)
    return result
