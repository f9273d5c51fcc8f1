"""Where contact forces act: at four points of a sole that lie on the surface under it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.inverse_kinematics import has_sole

if TYPE_CHECKING:
    from mcplan._core import EndEffector, Plan
    from mcplan.kinematics.samples import Interval

Array = NDArray[np.float64]

#: A motion's forces act at the corners of this part of a sole; the solver holds them to a little less, and by this much
#: [m] but for half of a sole, which leaves room to correct them between its nodes.
CORNER_RATIO, SOLVED_RATIO, CORRECTED_M = 0.95, 0.9, 6e-3
#: Points keep this distance from the edges of surfaces [m].
EDGE_M = 2e-3


def corners_S(end: EndEffector, ratio: float = CORNER_RATIO) -> Array:
    """(4, 3) corners of a part of a sole, in its frame [m]: of that on which a motion's forces act; (1, 3) without a sole."""
    if not has_sole(end):
        return np.zeros((1, 3))
    return _rectangle(ratio * np.asarray(end.half_size, float))


def _rectangle(half_size: Array) -> Array:
    x, y = half_size
    return np.array([[x, y, 0.0], [x, -y, 0.0], [-x, -y, 0.0], [-x, y, 0.0]])


def points_S(plan: Plan, interval: Interval) -> Array:
    """Where the solver lets forces of a contact act: corners of the sole, moved inwards onto the surface."""
    end = plan.robot.end_effectors[interval.end_effector]
    if not has_sole(end):
        return corners_S(end)
    half = np.asarray(end.half_size, float)
    inside = np.maximum(CORNER_RATIO * half - CORRECTED_M, 0.5 * half)
    corners = _rectangle(np.minimum(SOLVED_RATIO * half, inside))
    vertices = np.asarray(plan.scene.surfaces[interval.surface].vertices_W, float)
    polygon = ((vertices - interval.position_W) @ interval.rotation_W)[:, :2]
    area = np.roll(polygon, -1, axis=0)
    if float(np.sum(polygon[:, 0] * area[:, 1] - polygon[:, 1] * area[:, 0])) < 0.0:
        polygon = polygon[::-1]
    edges = np.roll(polygon, -1, axis=0) - polygon
    inward = np.column_stack([-edges[:, 1], edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    offsets = np.einsum("ej,ej->e", inward, polygon) + EDGE_M
    common = _clipped(corners[:, :2], inward, offsets)
    if len(common) == 0:
        return corners
    centre = common.mean(axis=0)
    room, along = inward @ centre - offsets, (corners[:, :2] - centre) @ inward.T
    ratios = np.where(along < 0.0, np.maximum(room, 0.0) / np.maximum(-along, 1e-12), 1.0)
    corners[:, :2] = centre + np.minimum(1.0, ratios.min(axis=1))[:, None] * (corners[:, :2] - centre)
    return corners


def _clipped(polygon: Array, inward: Array, offsets: Array) -> Array:
    """Corners (k, 2) of what half planes inward @ x >= offset leave of a convex polygon; none: (0, 2)."""
    for normal, offset in zip(inward, offsets, strict=True):
        kept: list[Array] = []
        for i in range(len(polygon)):
            a, b = polygon[i], polygon[(i + 1) % len(polygon)]
            of_a, of_b = float(normal @ a) - offset, float(normal @ b) - offset
            if of_a >= 0.0:
                kept.append(a)
            if of_a * of_b < 0.0:
                kept.append(a + (b - a) * of_a / (of_a - of_b))
        polygon = np.array(kept).reshape(-1, 2)
    return polygon


def to_corners(points: Array, corners: Array) -> Array:
    """(corners, points) parts of forces at points within a rectangle that, at its corners, give the same wrench."""
    if len(corners) == 1:
        return np.ones((1, 1))
    ratios = points[:, :2] / np.abs(corners[0, :2])
    signs = np.sign(corners[:, :2])
    return np.asarray(0.25 * np.prod(1.0 + signs[:, None] * ratios[None], axis=2))
