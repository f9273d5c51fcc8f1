"""The assisted set-up: a bounded wrench on the base, for what a plan's model leaves out.

Tazaki's paper makes the base's inertia very large instead. That fixes the base's orientation, which the controller does
anyway, and not the CoM, which is what diverges; a wrench does both, and says how much help it was.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import rotation_vector

from .references import References
from .robot_dynamics import RobotDynamics

Array = NDArray[np.float64]

#: Stiffness and damping: [N/m], [N s/m]; [N m/rad], [N m s/rad]; for a robot of 90 kg.
FORCE_KP, FORCE_KD, MOMENT_KP, MOMENT_KD = 3000.0, 600.0, 2000.0, 200.0
#: Largest force and moment, as ratios to the weight and to weight x 1 m.
LARGEST_FORCE, LARGEST_MOMENT = 0.35, 0.17
_MASS = 90.0


def assistance(dynamics: RobotDynamics, desired: References, n: int) -> Array:
    """(6,) force [N] and moment [N m] on the base at control step n, world axes."""
    scale, weight = dynamics.mass / _MASS, dynamics.mass * 9.81
    force = FORCE_KP * (desired.com_W[n] - dynamics.com_W) + FORCE_KD * (
        desired.com_velocity_W[n] - dynamics.com_velocity_W
    )
    rotation = rotation_vector(desired.base_WB[n] @ dynamics.base_WB.T)
    moment = MOMENT_KP * rotation + MOMENT_KD * (desired.base_velocity_W[n] - dynamics.base_velocity_W)
    return np.concatenate(
        [_clipped(scale * force, LARGEST_FORCE * weight), _clipped(scale * moment, LARGEST_MOMENT * weight)]
    )


def _clipped(vector: Array, largest: float) -> Array:
    size = float(np.linalg.norm(vector))
    return vector * min(1.0, largest / max(size, 1e-12))
