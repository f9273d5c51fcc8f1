"""Points at which an end-effector in contact bears force, their cones, and how a planned force is shared among them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import with_axis_z

Array = NDArray[np.float64]

#: Share of the sole, and of the friction coefficient, that the controller makes use of; sides of the friction pyramid:
#: slopes of 13 degrees on a friction of 0.3 leave no room for a coarse pyramid.
SIDES = 8
SOLE_SHARE, FRICTION_SHARE = 0.9, 0.98


@dataclass(frozen=True)
class ForcePoints:
    """Of one end-effector: p points, 1 or the 4 corners of its sole.

    Attributes:
        offsets: (p, 3) in the contact frame [m].
    """

    offsets: Array

    @classmethod
    def of(cls, half_size: Array) -> ForcePoints:
        """Points of an end-effector; half length and half width of its sole [m], zeros: a point."""
        length, width = SOLE_SHARE * np.asarray(half_size, float)
        if length <= 0.0 or width <= 0.0:
            return cls(np.zeros((1, 3)))
        corners = np.array([[x * length, y * width, 0.0] for x in (1, -1) for y in (1, -1)])
        return cls(corners)

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
    """(SIDES, 3) rows r with r f >= 0: a friction pyramid inside the cone."""
    hint = np.array([1.0, 0.0, 0.0]) if abs(normal_W[0]) < 0.9 else np.array([0.0, 0.0, 1.0])
    axes = with_axis_z(normal_W, hint)
    angles = 2.0 * np.pi * (np.arange(SIDES) + 0.5) / SIDES
    slope = FRICTION_SHARE * friction * np.cos(np.pi / SIDES)
    return slope * normal_W - np.column_stack([np.cos(angles), np.sin(angles)]) @ axes[:, :2].T
