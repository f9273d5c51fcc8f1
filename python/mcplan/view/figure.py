"""What a drawn robot is made of: rigid parts with a pose per sample."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .shapes import Mesh


@dataclass(frozen=True)
class Part:
    """A rigid part of a figure."""

    name: str
    mesh: Mesh
    colour: str  # "#rrggbb"
    poses: NDArray[np.float64]  # (n, 4, 4) world from part, one per sample


@dataclass(frozen=True)
class Figure:
    """A robot drawn over all samples of a plan."""

    kind: str  # "stick" or "urdf"
    parts: list[Part]
    #: Points that limbs pass through, per end-effector: root, middle joint, end; each (n, 3) [m].
    joints_W: list[tuple[NDArray[np.float64], ...]] = field(default_factory=list)

    def points_W(self, n: int) -> NDArray[np.float64]:
        """Vertices (m, 3) of all parts at a sample [m]."""
        moved = [part.mesh.vertices @ part.poses[n, :3, :3].T + part.poses[n, :3, 3] for part in self.parts]
        return np.vstack(moved) if moved else np.zeros((0, 3))
