"""Points at which an end-effector in contact bears force, their cones, and how a planned force is shared among them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import with_axis_z

Array = NDArray[np.float64]

#: Share of the sole, and of the friction coefficient, that the controller makes use of.
SOLE_SHARE, FRICTION_SHARE = 0.85, 0.9


@dataclass(frozen=True)
class ForcePoints:
    """Of one end-effector: p points, 1 or the 4 corners of its sole.

    Attributes:
        offsets: (p, 3) in the contact frame [m].
        max_force_N: Normal to the surface, at each point.
    """

    offsets: Array
    max_force_N: float

    @classmethod
    def of(cls, half_size: Array, max_force_N: float) -> ForcePoints:
        """Points of an end-effector; half length and half width of its sole [m], zeros: a point."""
        length, width = SOLE_SHARE * np.asarray(half_size, float)
        if length <= 0.0 or width <= 0.0:
            return cls(np.zeros((1, 3)), max_force_N)
        corners = np.array([[x * length, y * width, 0.0] for x in (1, -1) for y in (1, -1)])
        return cls(corners, max_force_N)

    @property
    def count(self) -> int:
        return len(self.offsets)

    def map(self, rotation_W: Array) -> Array:
        """(6, 3 p): wrench at the contact point, world axes, of the forces at the points: sum f_i, sum r_i x f_i."""
        result = np.zeros((6, 3 * self.count))
        for i, r in enumerate(self.offsets @ rotation_W.T):
            result[:3, 3 * i : 3 * i + 3] = np.eye(3)
            result[3:, 3 * i : 3 * i + 3] = [[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]]
        return result

    def share(self, force_W: Array, pressure_F: Array) -> Array:
        """(3 p,) forces at the points with the given sum and, as near as the sole allows, centre of pressure.

        Args:
            force_W: (3,) [N].
            pressure_F: (2,) where it acts, in the contact frame [m]: bilinear weights of the corners.
        """
        if self.count == 1:
            return force_W
        length, width = self.offsets[0, :2]
        u, v = np.clip([pressure_F[0] / length, pressure_F[1] / width], -1.0, 1.0)
        weights = [0.25 * (1 + x * u) * (1 + y * v) for x in (1, -1) for y in (1, -1)]
        return np.outer(weights, force_W).ravel()


def pyramid(normal_W: Array, friction: float) -> Array:
    """(5, 3) rows r f >= 0 of a friction pyramid inside the cone, and last the normal itself."""
    axes = with_axis_z(normal_W, np.array([1.0, 0.0, 0.0]) if abs(normal_W[0]) < 0.9 else np.array([0.0, 0.0, 1.0]))
    slope = FRICTION_SHARE * friction / np.sqrt(2.0)
    tangent = axes[:, :2].T
    return np.vstack([slope * normal_W - tangent, slope * normal_W + tangent, normal_W])
