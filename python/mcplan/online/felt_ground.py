"""Ground as it is felt: surfaces lie where feet stand on them, and are as slippery as feet slip on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

if TYPE_CHECKING:
    from mcplan._core import Scene

Array = NDArray[np.float64]

#: Heights over the known plane that say something [m]: less is compliance of the contact and noise, more is no foothold.
FELT_MIN_M, FELT_MAX_M = 0.006, 0.1
#: Speed below which an end-effector in contact stands, and above which it slips [m/s].
STANDS_M_S = 0.05
#: A foot slips where it has done so for this many control steps: less is a landing.
SLIPPING_STEPS = 4
#: Friction that is felt lies between these ratios of the known one: a lower one is noise of small forces.
FRICTION_MIN, FRICTION_RATIO_MAX = 0.02, 0.95


def at_felt_heights(
    scene: Scene, surfaces: Sequence[int], positions_W: Sequence[Array], speeds_m_s: Sequence[float]
) -> Scene | None:
    """The scene with surfaces moved up or down to where end-effectors stand on them; None: they are where they should be.

    Surfaces that nobody stands on stay: the next step may be as planned.

    Args:
        scene: As the planner knows it.
        surfaces: (e,) the surface that each end-effector touches, -1: none.
        positions_W: (e,) contact points [m].
        speeds_m_s: (e,) of the contact points.
    """
    heights: dict[int, list[float]] = {}
    for surface, position_W, speed in zip(surfaces, positions_W, speeds_m_s, strict=True):
        if surface >= 0 and speed < STANDS_M_S:
            heights.setdefault(surface, []).append(_height(scene, surface, np.asarray(position_W)))
    moved = {i: float(np.mean(found)) for i, found in heights.items()}
    moved = {i: height for i, height in moved.items() if FELT_MIN_M < abs(height) < FELT_MAX_M}
    if not moved:
        return None
    out, places = scene.__copy__(), list(scene.surfaces)
    for i, height in moved.items():
        places[i] = places[i].__copy__()
        places[i].vertices_W = np.asarray(places[i].vertices_W, float) + np.array([0.0, 0.0, height])
    out.surfaces = places
    return out


def with_friction(scene: Scene, frictions: dict[int, float]) -> Scene:
    """The scene with other friction coefficients of some surfaces, by index."""
    out, surfaces = scene.__copy__(), list(scene.surfaces)
    for i, friction in frictions.items():
        surfaces[i] = surfaces[i].__copy__()
        surfaces[i].friction = friction
    out.surfaces = surfaces
    return out


class SlipSense:
    """Measures friction coefficients where end-effectors slip: a sliding contact has just its friction's force.

    Args:
        count: Number of end-effectors.
        force_min_N: Normal force below which a contact says nothing.
    """

    def __init__(self, count: int, force_min_N: float) -> None:
        self._force_min_N = force_min_N
        self._ratios: list[list[float]] = [[] for _ in range(count)]  # of the forces of each slip under way

    def update(
        self, scene: Scene, surfaces: Sequence[int], forces_W: Sequence[Array], velocities_W: Sequence[Array]
    ) -> dict[int, float]:
        """Friction coefficients of surfaces that have just turned out to be lower than known, by index.

        Args:
            scene: As it is known.
            surfaces: (e,) the surface with which each end-effector is in contact, -1: none.
            forces_W: (e,) contact forces on the robot [N].
            velocities_W: (e,) (p, 3) of the corners of soles, (3,) of points [m/s]. A sole slides where all of its corners
                do: one that rolls down onto the ground stands on an edge, and its force says nothing of friction.
        """
        found: dict[int, float] = {}
        for end, (surface, force_W, velocity_W) in enumerate(zip(surfaces, forces_W, velocities_W, strict=True)):
            if surface < 0:
                self._ratios[end] = []
                continue
            normal = polygon_normal(np.asarray(scene.surfaces[surface].vertices_W, float))
            pressing_N = float(normal @ force_W)
            along_W = velocity_W - np.multiply.outer(velocity_W @ normal, normal)
            sliding = np.linalg.norm(along_W, axis=-1).min() > STANDS_M_S
            if not sliding or pressing_N < self._force_min_N:
                self._ratios[end] = []
                continue
            along_N = float(np.linalg.norm(force_W - pressing_N * normal))
            self._ratios[end] = [*self._ratios[end], along_N / pressing_N][-SLIPPING_STEPS:]
            if len(self._ratios[end]) < SLIPPING_STEPS:
                continue
            friction = max(*self._ratios[end], FRICTION_MIN)
            known = found.get(surface, scene.surfaces[surface].friction)
            if friction < FRICTION_RATIO_MAX * known:
                found[surface] = friction
        return found


def _height(scene: Scene, surface: int, point_W: Array) -> float:
    """Of a point over the plane of a surface, upwards [m]; of walls, which are not lower or higher, nan."""
    outline_W = np.asarray(scene.surfaces[surface].vertices_W, float)
    normal = polygon_normal(outline_W)
    return float(normal @ (point_W - outline_W[0]) / normal[2]) if normal[2] > 0.1 else float("nan")
