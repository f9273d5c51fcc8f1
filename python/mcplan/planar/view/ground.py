"""The ground of a planar task as solids, cut to the part where the motion is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.extent import below

if TYPE_CHECKING:
    from mcplan._core import PlanarSurface, PlanarTask

Array = NDArray[np.float64]

#: Ratio of a friction cone's radius to the robot's size.
CONE = 0.16


@dataclass(frozen=True)
class Slab:
    """The drawn part of a surface and of the solid behind it."""

    surface: int
    name: str
    front_W: Array  # (2, 2) [m] ends of the surface, along its tangent
    outline_W: Array  # (m, 2) [m] convex polygon, counter-clockwise; (0, 2) where another slab has that solid in it
    is_wall: bool


def slabs_of(task: PlanarTask, points_W: Array, margin: float, thickness: float) -> list[Slab]:
    """Solids of the surfaces near points, the lower ones first.

    Args:
        task: Its surfaces.
        points_W: Points of the motion, (n, 2) [m].
        margin: How far surfaces are drawn beyond the points [m].
        thickness: Thickness of the solids [m]; level ones that end somewhere reach down to the lowest ground.
    """
    fronts = [_front(task, i, points_W, margin) for i in range(len(task.surfaces))]
    bottom = min((float(front[:, 1].min()) for front, _ in fronts if len(front)), default=0.0) - thickness
    slabs = []
    for i, (surface, (front, cut)) in enumerate(zip(task.surfaces, fronts, strict=True)):
        if not len(front):
            continue
        normal = np.asarray(surface.normal_W, float)
        column = not endless(surface) and normal[1] > 0.5
        if column:
            feet = np.column_stack([front[:, 0], [bottom, bottom]])
            outline = np.vstack([front, feet[::-1]])
        else:
            # In a corner the solids meet behind the surfaces: reach into each other, then be cut there.
            reach = front + thickness * np.outer([-1.0, 1.0] * cut, surface.tangent_W)
            outline = np.vstack([reach, (reach - thickness * normal)[::-1]])
            for j in _before(task, i):
                other = task.surfaces[j]
                height = (outline - np.asarray(other.origin_W)) @ np.asarray(other.normal_W)
                outline = below(outline, -height - thickness)
        slabs.append(Slab(i, surface.name, front, outline[::-1], abs(normal[1]) < 0.3))
    return sorted(
        (_without_solid_in(slab, slabs) for slab in slabs),
        key=lambda s: (not endless(task.surfaces[s.surface]), float(s.front_W[:, 1].max())),
    )


def endless(surface: PlanarSurface) -> bool:
    """Whether a surface has no end on either side."""
    return not (np.isfinite(_from(surface)) or np.isfinite(float(surface.to)))


def cone_outline(angle: float, friction: float, radius: float) -> Array:
    """Sector (m, 2) [m] of the directions within a friction cone, its apex at the origin, on a surface at `angle`."""
    half = float(np.arctan(friction))
    angles = angle + 0.5 * np.pi + np.linspace(-half, half, 17)
    return np.vstack([np.zeros((1, 2)), radius * np.column_stack([np.cos(angles), np.sin(angles)])])


def _front(task: PlanarTask, i: int, points_W: Array, margin: float) -> tuple[Array, Array]:
    """Ends (2, 2) [m] of what is seen of a surface, (0, 2) when nothing is; whether others cut it off there, (2,)."""
    surface = task.surfaces[i]
    origin, tangent = np.asarray(surface.origin_W, float), np.asarray(surface.tangent_W, float)
    along = (points_W - origin) @ tangent
    low, high = max(along.min() - margin, _from(surface)), min(along.max() + margin, float(surface.to))
    cut = np.zeros(2)
    for j in _before(task, i):
        other = task.surfaces[j]
        normal = np.asarray(other.normal_W, float)
        slope = float(tangent @ normal)
        if abs(slope) < 1e-6:
            continue
        crossing = -float((origin - np.asarray(other.origin_W)) @ normal) / slope
        if slope > 0.0 and crossing > low:
            low, cut[0] = crossing, 1.0
        elif slope < 0.0 and crossing < high:
            high, cut[1] = crossing, 1.0
    if high <= low:
        return np.zeros((0, 2)), cut
    return origin + np.outer([low, high], tangent), cut


def _without_solid_in(slab: Slab, slabs: list[Slab]) -> Slab:
    """The slab, without its solid if that lies in another one's, as a riser's does in its tread's."""
    for other in slabs:
        earlier = other.surface < slab.surface
        if other is not slab and _within(slab, other) and (earlier or not _within(other, slab)):
            return replace(slab, outline_W=np.zeros((0, 2)))
    return slab


def _within(slab: Slab, other: Slab) -> bool:
    edges = np.roll(other.outline_W, -1, axis=0) - other.outline_W
    away = slab.outline_W[:, None] - other.outline_W[None]
    return bool(np.all(edges[None, :, 0] * away[:, :, 1] - edges[None, :, 1] * away[:, :, 0] > -1e-9))


def _before(task: PlanarTask, i: int) -> list[int]:
    """Endless surfaces that cut surface i off: all of its contacts lie before them."""
    places = [np.asarray(c.position_W) for phase in task.phases for c in phase.contacts if c.surface == i]
    cutting = []
    for j, other in enumerate(task.surfaces):
        if j == i or not endless(other):
            continue
        heights = [float((p - np.asarray(other.origin_W)) @ np.asarray(other.normal_W)) for p in places]
        if heights and min(heights) > 1e-6:
            cutting.append(j)
    return cutting


def _from(surface: PlanarSurface) -> float:
    return float(surface.from_)
