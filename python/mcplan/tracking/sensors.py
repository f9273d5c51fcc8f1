"""What the controller reads of the robot's state: the simulator's, with noise if it is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Standard deviations of sensors at a noise of 1, drawn anew at every reading: base position [m] and orientation [rad],
#: linear [m/s] and angular velocity [rad/s] of the base; positions [rad] and velocities [rad/s] of joints.
BASE_M, BASE_RAD, BASE_M_S, BASE_RAD_S = 1e-3, 1e-3, 1e-2, 1e-2
JOINT_RAD, JOINT_RAD_S = 1e-4, 1e-2


class Sensors:
    """Reads states as Pinocchio has them.

    Args:
        noise: Standard deviations over those above; 0: none.
        seed: Seed of the noise.
    """

    def __init__(self, noise: float, seed: int) -> None:
        self._noise = noise
        self._random = np.random.default_rng([seed, 1])

    def read(self, configuration: Array, velocity: Array) -> tuple[Array, Array]:
        """Configuration (nq,) and velocity (nv,) with noise."""
        if self._noise <= 0.0:
            return configuration, velocity
        joints = len(velocity) - 6
        away = (
            self._noise
            * np.repeat([BASE_M, BASE_RAD, JOINT_RAD], [3, 3, joints])
            * self._random.normal(size=6 + joints)
        )
        rates = np.repeat([BASE_M_S, BASE_RAD_S, JOINT_RAD_S], [3, 3, joints])
        read = configuration.copy()
        read[:3] += away[:3]
        read[3:7] = _turned(configuration[3:7], away[3:6])
        read[7:] += away[6:]
        return read, velocity + self._noise * rates * self._random.normal(size=len(velocity))


def _turned(quat_xyzw: Array, angles_B: Array) -> Array:
    """A unit quaternion turned by small angles [rad] about its own axes."""
    x, y, z, w = quat_xyzw
    a, b, c = 0.5 * angles_B
    turned = np.array(
        [x + w * a + y * c - z * b, y + w * b + z * a - x * c, z + w * c + x * b - y * a, w - x * a - y * b - z * c]
    )
    return turned / np.linalg.norm(turned)
