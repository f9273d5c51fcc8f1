"""How much of a scene is drawn: surfaces may reach far beyond the motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidScene

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene
    from mcplan.kinematics.samples import Samples

Array = NDArray[np.float64]


#: [m] CoM height for which margins are written, and size below which a surface is shown as a whole.
HEIGHT, SMALL = 0.7, 2.5
#: [m] from start to goal in scenes for such robots.
USUAL_DISPLACEMENT = 2.0


def scale_of(robot: Robot | None) -> float:
    """What margins are multiplied by: 1 for a robot whose CoM is 0.7 m high, but also for others of about that size."""
    if robot is None:
        return 1.0
    ratio = float(robot.com_height) / HEIGHT
    return 1.0 if 0.5 <= ratio <= 2.0 else ratio


def scale_of_scene(scene: Scene, robot: Robot | None) -> float:
    """What margins around a scene are multiplied by; without a robot the path through it and its smallest surface tell."""
    if robot is not None or not scene.surfaces:
        return scale_of(robot)
    displacement = float(np.linalg.norm(np.asarray(scene.goal.position_W, float) - scene.start.position_W))
    smallest = min(float(np.ptp(np.asarray(s.vertices_W, float), axis=0).max()) for s in scene.surfaces)
    ratio = max(displacement, smallest) / USUAL_DISPLACEMENT
    return 1.0 if 0.1 <= ratio <= 4.0 else ratio


@dataclass(frozen=True)
class Extent:
    """A vertical box, rotated to the direction of travel, outside of which surfaces are cut off."""

    centre: Array  # (2,) [m] of the box, world x and y
    forward: Array  # (2,) unit vector of travel
    half_length: float  # [m]
    half_width: float  # [m]

    @property
    def left(self) -> Array:
        return np.array([-self.forward[1], self.forward[0]])

    def clip(self, outline: Array) -> Array:
        """The part of a convex polygon (n, 3) inside the box, (m, 3); m is 0 when nothing is."""
        polygon = np.asarray(outline, float)
        walls = ((self.forward, self.half_length), (self.left, self.half_width))
        for axis, half in walls:
            for sign in (1.0, -1.0):
                polygon = below(polygon, sign * (polygon[:, :2] - self.centre) @ axis - half)
                if len(polygon) < 3:
                    return np.zeros((0, 3))
        return polygon


def require_drawable(scene: Scene) -> None:
    """Raises InvalidScene where a picture has nothing to go by. A scene that is wrong otherwise is drawn, so that one can see
    what is wrong with it."""
    for i, surface in enumerate(scene.surfaces):
        vertices = np.asarray(surface.vertices_W, float)
        if len(vertices) < 3:
            raise InvalidScene(f"surfaces[{i}].vertices", "must have at least 3 points", str(len(vertices)))
        if not np.isfinite(vertices).all():
            raise InvalidScene(f"surfaces[{i}].vertices", "must be finite numbers", "nan or inf")
    for name, stance in (("start", scene.start), ("goal", scene.goal)):
        if not np.isfinite(stance.position_W).all():
            raise InvalidScene(f"{name}.position", "must be finite numbers", "nan or inf")


def extent_of(scene: Scene, robot: Robot | None, samples: Samples | None, length: float, width: float) -> Extent:
    """The box around the motion (or around start and goal) with margins of `length` and `width` [m], for a robot of
    usual size."""
    scale = scale_of_scene(scene, robot)
    points = [np.asarray(s.position_W, float)[:2] for s in (scene.start, scene.goal)]
    if samples is not None:
        points += list(samples.com_W[:, :2]) + list(samples.positions_W[:, :, :2].reshape(-1, 2))
        travel = samples.com_W[-1, :2] - samples.com_W[0, :2]
    else:
        travel = points[1] - points[0]
    distance = float(np.linalg.norm(travel))
    yaw = float(scene.start.yaw)
    forward = travel / distance if distance > 0.1 * scale else np.array([np.cos(yaw), np.sin(yaw)])
    # Surfaces that are small belong to the picture as a whole: pads, stones, treads, walls.
    for surface in scene.surfaces:
        outline = np.asarray(surface.vertices_W, float)[:, :2]
        if np.ptp(outline, axis=0).max() < SMALL * scale:
            points += list(outline)
    spread = np.array(points)
    along, across = spread @ forward, spread @ np.array([-forward[1], forward[0]])
    middle = np.array([along.min() + along.max(), across.min() + across.max()]) / 2.0
    centre = middle[0] * forward + middle[1] * np.array([-forward[1], forward[0]])
    return Extent(
        centre, forward, 0.5 * float(np.ptp(along)) + scale * length, 0.5 * float(np.ptp(across)) + scale * width
    )


def below(polygon: Array, height: Array) -> Array:
    """The part of a convex polygon (n, 2 or 3) with height (n,) <= 0 (Sutherland and Hodgman)."""
    kept = []
    for i in range(len(polygon)):
        j = (i + 1) % len(polygon)
        if height[i] <= 0.0:
            kept.append(polygon[i])
        if (height[i] < 0.0 < height[j]) or (height[j] < 0.0 < height[i]):
            fraction = height[i] / (height[i] - height[j])
            kept.append(polygon[i] + fraction * (polygon[j] - polygon[i]))
    return np.array(kept).reshape(-1, polygon.shape[1])
