"""The solids below a scene's surfaces, and how far points are from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

if TYPE_CHECKING:
    from mcplan._core import Scene

Array = NDArray[np.float64]

#: Points so little below the underside are still inside [m]: a step lies on the floor, as the sole beside it does.
UNDERSIDE = 0.01


class Solids:
    """Prisms: a surface is the top of one, its thickness goes down along the surface's normal."""

    def __init__(self, scene: Scene) -> None:
        self.names = [surface.name for surface in scene.surfaces]
        self._solids = []
        self._boxes = np.empty((len(scene.surfaces), 2, 3))
        for i, surface in enumerate(scene.surfaces):
            outline = np.asarray(surface.vertices_W, float)
            normal = polygon_normal(outline)
            outward = np.cross(np.roll(outline, -1, axis=0) - outline, normal)
            outward /= np.linalg.norm(outward, axis=1, keepdims=True)
            self._solids.append((outline, normal, outward, float(surface.thickness)))
            corners = np.vstack([outline, outline - float(surface.thickness) * normal])
            self._boxes[i] = corners.min(axis=0), corners.max(axis=0)

    def near(self, points_W: Array, within_m: float) -> NDArray[np.int64]:
        """Indices of the solids whose box comes so near to that of the points (k, 3) [m]; where none does, the nearest one's."""
        low, high = np.min(points_W, axis=0), np.max(points_W, axis=0)
        gaps = np.maximum(self._boxes[:, 0] - high, low - self._boxes[:, 1]).max(axis=1, initial=0.0)
        return np.flatnonzero(gaps <= max(within_m, float(gaps.min(initial=np.inf))))

    def clearances(self, points_W: Array, only: NDArray[np.int64] | None = None) -> Array:
        """Distance of points from every solid.

        Args:
            points_W: (k, 3) [m].
            only: Indices of solids to look at; None: all. Of the others nothing is said: inf.

        Returns:
            (k, s) [m], s solids: negative inside, by the distance to the top or the nearest side; outside, the
            distance to the plane of the side that is farthest, which is at most the distance to the solid.
        """
        points_W = np.asarray(points_W, float)
        result = np.full((len(points_W), len(self._solids)), np.inf)
        for i in range(len(self._solids)) if only is None else only:
            outline, normal, outward, thickness = self._solids[i]
            height = (points_W - outline[0]) @ normal
            beyond = (np.einsum("kej,ej->ke", points_W[:, None] - outline, outward)).max(axis=1)
            below = -height - thickness
            inside = np.maximum(height, beyond)
            result[:, i] = np.where(below > UNDERSIDE, np.maximum(inside, below), inside)
        return result
