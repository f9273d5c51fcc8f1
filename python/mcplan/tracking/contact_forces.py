"""Points at which forces act on an end-effector in contact, their cones, and how a planned force is distributed to them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import with_axis_z

Array = NDArray[np.float64]

#: Ratios of the sole, and of the friction coefficient, that the controller makes use of; sides of the friction pyramid:
#: slopes of 13 degrees on a friction of 0.3 leave no margin for a coarse pyramid.
SIDES = 8
SOLE_RATIO, FRICTION_RATIO = 0.9, 0.98


def corners(half_size: Array) -> Array:
    """(4, 3) of a sole of this half length and half width in the contact frame [m]; zeros: (1, 3), a point."""
    length, width = np.asarray(half_size, float)
    if length <= 0.0 or width <= 0.0:
        return np.zeros((1, 3))
    return np.array([[length, width, 0.0], [-length, width, 0.0], [-length, -width, 0.0], [length, -width, 0.0]])


@dataclass(frozen=True)
class ForcePoints:
    """Force points of one end-effector: p points, 1 or 4.

    Attributes:
        offsets: (p, 3) in the contact frame [m].
        weights: (p, 3) weights @ [1, x, y] are the fractions of a force at (x, y) in the contact frame: they have that
            centre of pressure, and the minimum norm of all that do.
    """

    offsets: Array
    weights: Array

    @classmethod
    def of(cls, half_size: Array, outline_F: Array | None = None) -> ForcePoints:
        """Points of an end-effector.

        Args:
            half_size: Half length and half width of its sole [m]; zeros: a point.
            outline_F: (m, 2) convex outline of the surface below it, counter-clockwise in the contact frame [m]: only
                forces act on the part of the sole that is on it. None: on all of it.
        """
        length, width = SOLE_RATIO * np.asarray(half_size, float)
        if length <= 0.0 or width <= 0.0:
            return cls(np.zeros((1, 3)), np.array([[1.0, 0.0, 0.0]]))
        corners = np.array([[length, width], [-length, width], [-length, -width], [length, -width]])
        if outline_F is not None:
            on_surface = clipped(corners, outline_F)
            if len(on_surface) >= 3:
                # What lies farthest towards the corners: at most 4 points of the polygon, near to all of it.
                towards = on_surface @ (np.sign(corners) / [length, width]).T
                corners = on_surface[np.argmax(towards, axis=0)]
        moments = np.vstack([np.ones(4), corners.T])
        return cls(np.column_stack([corners, np.zeros(4)]), np.linalg.pinv(moments))

    @property
    def count(self) -> int:
        return len(self.offsets)

    def map(self, rotation_W: Array) -> Array:
        """(6, 3 p): wrench at the contact point, world axes, of the forces at the points: sum f_i, sum r_i x f_i."""
        x, y, z = (self.offsets @ rotation_W.T).T
        result = np.zeros((6, self.count, 3))
        result[0, :, 0] = result[1, :, 1] = result[2, :, 2] = 1.0
        result[3, :, 1], result[3, :, 2] = -z, y
        result[4, :, 0], result[4, :, 2] = z, -x
        result[5, :, 0], result[5, :, 1] = -y, x
        return result.reshape(6, -1)

    def distribute(self, force_W: Array, pressure_F: Array) -> Array:
        """(3 p,) forces at the points that add up to a force (3,) [N] acting at (2,) in the contact frame [m]."""
        return np.outer(self.weights @ np.array([1.0, *pressure_F]), force_W).ravel()

    def twist(self, moment_Nm: float, rotation_W: Array) -> Array:
        """(3 p,) minimum forces at the points that add up to nothing but a moment about the contact frame's z.

        f_i = tau z x (r_i - r) / sum |r_i - r|^2, r the mean of the points; none at a single point.
        """
        size, across = self._twist
        if size <= 0.0:
            return np.zeros(3 * self.count)
        return np.asarray((moment_Nm / size * across @ rotation_W.T).ravel())

    @cached_property
    def _twist(self) -> tuple[float, Array]:
        """sum |r_i - r|^2 and z x (r_i - r), (p, 3), in the contact frame."""
        arms = self.offsets - self.offsets.mean(axis=0)
        return float((arms**2).sum()), np.column_stack([-arms[:, 1], arms[:, 0], np.zeros(self.count)])


def clipped(polygon: Array, outline: Array) -> Array:
    """(k, 2) the part of a convex polygon (n, 2) inside another one (m, 2), both counter-clockwise."""
    result = np.asarray(polygon, float)
    for start, end in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        edge = end - start
        inside = edge[0] * (result[:, 1] - start[1]) - edge[1] * (result[:, 0] - start[0])
        kept = []
        for k in range(len(result)):
            here, there = inside[k], inside[(k + 1) % len(result)]
            if here >= 0.0:
                kept.append(result[k])
            if here * there < 0.0:
                kept.append(result[k] + here / (here - there) * (result[(k + 1) % len(result)] - result[k]))
        result = np.array(kept).reshape(-1, 2)
        if len(result) == 0:
            break
    return result


def pyramid(normal_W: Array, friction: float) -> Array:
    """(SIDES, 3) rows r with r f >= 0: a friction pyramid inside the cone."""
    hint = np.array([1.0, 0.0, 0.0]) if abs(normal_W[0]) < 0.9 else np.array([0.0, 0.0, 1.0])
    axes = with_axis_z(normal_W, hint)
    angles = 2.0 * np.pi * (np.arange(SIDES) + 0.5) / SIDES
    slope = FRICTION_RATIO * friction * np.cos(np.pi / SIDES)
    return slope * normal_W - np.column_stack([np.cos(angles), np.sin(angles)]) @ axes[:, :2].T
