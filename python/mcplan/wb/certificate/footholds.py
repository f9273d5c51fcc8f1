"""Where a plan puts its end-effectors, worked out from its knots and the scene's polygons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mcplan._core import Plan, Scene

Array = NDArray[np.float64]

#: A heading that is nearer to a surface's normal than this sine is none: a sole on a wall has its x axis upward.
ALONG_NORMAL = 0.1
#: Instants at a switch belong to both sides [s].
SAME_TIME_S = 1e-9


@dataclass(frozen=True)
class Foothold:
    """A contact of an end-effector that lasts.

    Attributes:
        end_effector: Its index.
        surface: That of the surface.
        start_s, end_s: When [s].
        position_W: (3,) [m].
        rotation_W: (3, 3) of the sole: z along the surface's normal, x along its heading.
    """

    end_effector: int
    surface: int
    start_s: float
    end_s: float
    position_W: Array
    rotation_W: Array


def footholds_of(plan: Plan) -> list[Foothold]:
    """The contacts of a plan, by end-effector and time; phases with the same contact are one."""
    times = [float(t) for t in plan.knot_times()]
    found = []
    for end in range(len(plan.robot.end_effectors)):
        surfaces = [int(phase.contacts[end].surface) for phase in plan.phases]
        first = 0
        while first < len(surfaces):
            after = first + 1
            while after < len(surfaces) and surfaces[after] == surfaces[first]:
                after += 1
            if surfaces[first] >= 0:
                yaw = float(plan.at(0.5 * (times[first] + times[after])).end_effectors[end].yaw)
                found.append(
                    Foothold(
                        end_effector=end,
                        surface=surfaces[first],
                        start_s=times[first],
                        end_s=times[after],
                        position_W=np.array(plan.knots[first].end_effectors_W[end], float),
                        rotation_W=sole_rotation(normal_of(plan.scene, surfaces[first]), yaw),
                    )
                )
            first = after
    return found


def standing(times: Array, foothold: Foothold) -> NDArray[np.bool_]:
    """Which instants a contact lasts, its ends included."""
    return np.asarray((times >= foothold.start_s - SAME_TIME_S) & (times <= foothold.end_s + SAME_TIME_S))


def normal_of(scene: Scene, surface: int) -> Array:
    """Unit normal of a surface, by the signed areas of its polygon (Newell)."""
    corners = np.asarray(scene.surfaces[surface].vertices_W, float)
    centred = corners - corners.mean(axis=0)
    area = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    return np.asarray(area / np.linalg.norm(area))


def height_over(scene: Scene, surface: int, points_W: Array) -> Array:
    """(...) heights of points over the plane of a surface [m], through the middle of its corners."""
    corners = np.asarray(scene.surfaces[surface].vertices_W, float)
    return np.asarray((points_W - corners.mean(axis=0)) @ normal_of(scene, surface))


def beyond_polygon(scene: Scene, surface: int, points_W: Array) -> Array:
    """(...) how far points lie outside of the sides of a surface's polygon [m]; negative inside."""
    corners = np.asarray(scene.surfaces[surface].vertices_W, float)
    sides = np.roll(corners, -1, axis=0) - corners
    outward = np.cross(sides, normal_of(scene, surface))
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    return np.asarray(np.einsum("...sj,sj->...s", points_W[..., None, :] - corners, outward).max(axis=-1))


def sole_rotation(normal: Array, yaw: float) -> Array:
    """Frame of a sole on a surface: the heading, projected onto it, is its x axis."""
    heading = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    along = heading - normal * (normal @ heading)
    if np.linalg.norm(along) < ALONG_NORMAL:
        along = np.array([0.0, 0.0, 1.0]) - normal * normal[2]
    x = along / np.linalg.norm(along)
    return np.column_stack([x, np.cross(normal, x), normal])
