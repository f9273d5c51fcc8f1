"""Postures to stay near to along a plan, where the plan itself does not say how the base is turned."""

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


def postures_along(loaded: UrdfModel, plan: Plan, count: int, dt_s: float) -> Array:
    """Configurations (count, nq) that follow a plan by inverse kinematics, dt apart; the last one is held."""
    import pinocchio as pin  # type: ignore[import-untyped]

    samples = sample(plan, plan.scene, plan.robot, RATE)
    # The postures' torso and base jump where feet leave the ground; a base that is asked to jump throws the robot.
    found = running_means(loaded, samples.times_s, follow(loaded, samples).configurations)
    step = samples.times_s[1] - samples.times_s[0]
    result = np.empty((count, loaded.model.nq))
    for n in range(count):
        at = min(n * dt_s / step, len(found) - 1.0)
        k = min(int(at), len(found) - 2)
        share = at - k
        share = share * share * (3.0 - 2.0 * share)
        result[n] = pin.interpolate(loaded.model, found[k], found[k + 1], share)
    return result
