"""Terrain for physics simulation: each surface of a scene is the top of a solid prism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

if TYPE_CHECKING:
    from mcplan._core import Scene, Surface

Array = NDArray[np.float64]

#: Solids are no thinner than this [m]: what hits them with some speed must not come out of the other side.
MIN_DEPTH_M = 0.02
#: Surfaces no steeper than this (their normal's z) are extruded straight down, others against their normal.
UPRIGHT = 0.5
#: Friction of surfaces that may be grasped. MuJoCo's contacts only push: a hand on them does not slide, but cannot
#: pull.
GRASP_FRICTION = 5.0

#: Bits of contype and conaffinity: end-effectors and terrain make contact with each other, links with each other.
ROBOT_BIT, TERRAIN_BIT, LINK_BIT = 1, 2, 4


def prism(surface: Surface) -> tuple[Array, NDArray[np.int64]]:
    """The solid under a surface.

    Floors and slopes are extruded straight down by their thickness: seen from above the solid fills just the polygon,
    so it cannot stand out of a neighbour that lies lower. Walls are extruded against their normal.

    Args:
        surface: A convex polygon of k corners.

    Returns:
        Corners (2k, 3) [m], world frame, the surface's own first; triangles (4k - 4, 3), counter-clockwise seen from
        outside.
    """
    top = np.asarray(surface.vertices_W, float)
    normal = polygon_normal(top)
    down = np.array([0.0, 0.0, -1.0]) if normal[2] >= UPRIGHT else -normal
    k = len(top)
    corners = np.vstack([top, top + max(surface.thickness, MIN_DEPTH_M) * down])
    fan = np.array([(0, i, i + 1) for i in range(1, k - 1)])
    ahead = (np.arange(k) + 1) % k
    here, below, below_ahead = np.arange(k), np.arange(k) + k, ahead + k
    sides = [np.column_stack([here, below, below_ahead]), np.column_stack([here, below_ahead, ahead])]
    return corners, np.vstack([fan, fan[:, ::-1] + k, *sides])


def add_terrain(spec: Any, scene: Scene, friction_scale: float = 1.0, shift_m: float = 0.0) -> list[Any]:
    """Add the surfaces of a scene to a MuJoCo model under construction.

    Contacts take friction and stiffness from the terrain's geom, whatever those of the other one are (its priority is
    higher).

    Args:
        spec: mujoco.MjSpec.
        scene: Its surfaces.
        friction_scale: Factor on their friction.
        shift_m: Height by which they are lifted.

    Returns:
        Their geoms, in the order of the scene's surfaces.
    """
    import mujoco

    geoms = []
    for number, surface in enumerate(scene.surfaces):
        corners, triangles = prism(surface)
        mesh = spec.add_mesh(name=f"surface/{number}")
        mesh.uservert = (corners + [0.0, 0.0, shift_m]).ravel().tolist()
        mesh.userface = triangles.ravel().tolist()
        geom = spec.worldbody.add_geom(
            name=f"surface/{number}", type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"surface/{number}"
        )
        friction = GRASP_FRICTION if surface.grasp else surface.friction
        geom.friction = [friction * friction_scale, 0.0, 0.0]
        geom.contype, geom.conaffinity, geom.priority = TERRAIN_BIT, ROBOT_BIT, 1
        geom.rgba = [0.75, 0.75, 0.72, 1.0]
        geoms.append(geom)
    return geoms
