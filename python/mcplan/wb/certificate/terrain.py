"""Swinging soles over the solids below surfaces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .footholds import Foothold, beyond_polygon, normal_of, standing
from .inputs import CertifiedMotion
from .result import MotionViolation, largest, worse
from .states import States
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: Points of a sole along its sides: an edge of the terrain may come up between its corners.
GRID = (7, 3)
#: The middle fifth of a swing.
MIDDLE = (0.4, 0.6)
#: Points so little below the underside of a solid are still inside [m]: a step lies on the floor.
UNDERSIDE_M = 0.01


def clearance(
    motion: CertifiedMotion, states: States, footholds: list[Foothold], tolerances: MotionTolerances
) -> list[MotionViolation]:
    """Depth of end-effectors in the air in the terrain, and the height of feet over it in the middle of their swings."""
    depth = MotionViolation("clearance", 0.0, tolerances.clearance_m, "m")
    middle = MotionViolation("mid_swing", np.inf, tolerances.mid_swing_m, "m", at_least=True)
    for e, end in enumerate(motion.plan.robot.end_effectors):
        own = [foothold for foothold in footholds if foothold.end_effector == e]
        free = ~np.any([standing(states.times, foothold) for foothold in own] or [states.times < 0.0], axis=0)
        if not free.any():
            continue
        heights = np.full(len(states.times), np.inf)
        heights[free] = heights_over(motion, states, e, np.flatnonzero(free))
        about = replace(depth, value=-np.inf, end_effector=end.name)
        worst = largest(about, -heights[free], states.times[free])
        depth = worst if depth.end_effector == "" else worse(depth, worst)
        for begin, stop in _swings(motion, e, own):
            ratio = (states.times - begin) / max(stop - begin, 1e-9)
            inside = (ratio >= MIDDLE[0]) & (ratio <= MIDDLE[1])
            if end.kind == "foot" and inside.any():
                lowest = largest(about, -heights[inside], states.times[inside])
                low = replace(middle, value=-lowest.value, time_s=lowest.time_s, end_effector=end.name)
                middle = worse(middle, low)
    return [depth, middle]


def _swings(motion: CertifiedMotion, end: int, own: list[Foothold]) -> list[tuple[float, float]]:
    """Begin and end of an end-effector's swings [s]; one that is under way at the start has begun before, if the plan says so."""
    swings = [(before.end_s, after.start_s) for before, after in zip(own[:-1], own[1:], strict=True)]
    begun = max((s.elapsed_s for s in motion.plan.swings if s.end_effector == end and s.first_phase == 0), default=0.0)
    return [(-begun, own[0].start_s)] + swings if own and begun > 0.0 else swings


def heights_over(motion: CertifiedMotion, states: States, end: int, at: NDArray[np.int64]) -> Array:
    """(k,) least distance of an end-effector's sole from the solids [m] at some instants; negative: inside.

    Of a point outside it is the distance to the plane of the side that is farthest, at most that to the solid.
    """
    scene, half = motion.plan.scene, np.asarray(motion.plan.robot.end_effectors[end].half_size, float)
    sides = [np.unique(half[i] * np.linspace(-1.0, 1.0, GRID[i])) for i in range(2)]
    sole = np.array([[x, y, 0.0] for x in sides[0] for y in sides[1]])
    points = states.positions_W[at, end, None] + np.einsum("krc,pc->kpr", states.rotations_W[at, end], sole)
    nearest = np.full(len(at), np.inf)
    for number, surface in enumerate(scene.surfaces):
        height = (points - np.asarray(surface.vertices_W, float)[0]) @ normal_of(scene, number)
        outside = np.maximum(height, beyond_polygon(scene, number, points))
        below = -height - float(surface.thickness)
        outside = np.where(below > UNDERSIDE_M, np.maximum(outside, below), outside)
        nearest = np.minimum(nearest, outside.min(axis=1))
    return nearest
