"""How far swinging soles may be from where the plan has them, over the ground that is near."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .nodes import UPRIGHT

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .nodes import Nodes

Array = NDArray[np.float64]

#: Farthest from the plan's place, upward, downward and sideways [m]; sideways the first that leaves this part of the
#: height over the ground right below.
UP_M, DOWN_M, ASIDE_M, LEAST_RATIO = 0.1, 0.1, (0.02, 0.01, 0.004, 0.001), 0.7
#: Likewise sideways and upward in flights [m].
FLIGHT_M = 0.3
#: Kept over the ground from this part of a swing to its middle [m], growing from nothing in the parts before: where a sole
#: that is to be lifted within a node asks for all the torque that there is.
MIDDLE_M, MIDDLE, ENDS = 0.014, 0.35, 0.15
#: Kept there even where the plan has less [m].
LEAST_M = 0.012
#: Part of the planned height over the ground that a sole keeps late in its swing, and where that begins, is reached, ends to be
#: asked in full, and ends: one that skims the ground on its last decimetre lands early where the controller is a millimetre off.
#: Earlier, it takes torque to hold it higher.
KEPT, LATE = 0.35, (0.5, 0.7, 0.75, 0.9)
#: Left to a motion between what is kept and the plan, unless there is less than twice as much over the ground [m].
ROOM_M = 0.005
#: Kept over the ground wherever there is twice as much, but where feet go up and down alone: a foot that is being lifted lags
#: behind the chord between two nodes, at 20 m/s^2 and 25 ms by 1.6 mm [m].
BETWEEN_M = 0.002
#: Points of a sole along its sides, and parts of the way to the nodes before and after on which it is looked at as well.
GRID, PARTS = (5, 3), (-1.0, -0.5, 0.0, 0.5, 1.0)
#: Surfaces steeper than this cosine are walls, and those so far above a sole have it below them [m].
STEEP, ABOVE_M = 0.3, 0.05


class Ground:
    """The surfaces of a scene as heights over the plane."""

    def __init__(self, plan: Plan) -> None:
        self._sides: list[tuple[Array, Array]] = []
        self._planes: list[tuple[Array, Array]] = []
        for surface in plan.scene.surfaces:
            vertices = np.asarray(surface.vertices_W, float)
            normal = polygon_normal(vertices)
            if normal[2] < STEEP:
                continue
            flat = vertices[:, :2]
            sides = np.roll(flat, -1, axis=0) - flat
            inward = np.column_stack([-sides[:, 1], sides[:, 0]])  # counterclockwise, as the normal points upward
            inward /= np.linalg.norm(inward, axis=1)[:, None]
            self._sides.append((inward, np.einsum("sj,sj->s", inward, flat)))
            slope = -normal[:2] / normal[2]
            self._planes.append((slope, vertices[0, 2:3] - slope @ flat[0]))

    def clearance(self, points: Array, aside: float) -> float:
        """Least height of points (k, 3) over the ground that is no farther sideways than `aside` [m]."""
        least = np.inf
        for (inward, offsets), (slope, level) in zip(self._sides, self._planes, strict=True):
            near = ((points[:, :2] @ inward.T - offsets) >= -aside - 1e-9).all(axis=1)
            height = points[:, 2] - points[:, :2] @ slope - level - aside * float(np.linalg.norm(slope))
            seen = near & (height > -ABOVE_M)
            if seen.any():
                least = min(least, float(height[seen].min()))
        return least

    def tubes_W(
        self, plan: Plan, nodes: Nodes, end: int, in_time: Callable[[], None] = lambda: None
    ) -> dict[int, tuple[Array, Array]]:
        """How far the points of a sole in the air may be from where the plan has them, at least and at most [m], by node.

        Between two nodes a sole is over the ground that either of them is held over: it goes no farther sideways at any of
        them than the other one may.
        """
        free = [k for k in range(nodes.count) if nodes.intervals[k][end] is None]
        rooms, out = {}, {}
        for k in free:
            in_time()
            rooms[k] = self._room(plan, nodes, k, end)
        for k, (own, down) in rooms.items():
            aside = min(rooms[near][0] if near in rooms else own for near in (k - 1, k, k + 1))
            if nodes.flies(k):  # where the whole robot goes is for its CoM to say
                out[k] = np.array([-FLIGHT_M, -FLIGHT_M, -down]), np.array([FLIGHT_M, FLIGHT_M, FLIGHT_M])
            else:
                out[k] = np.array([-aside, -aside, -down]), np.array([aside, aside, UP_M])
        return out

    def _room(self, plan: Plan, nodes: Nodes, k: int, end: int) -> tuple[float, float]:
        """How far a sole may go sideways, and how far down where it does [m]."""
        samples, half = nodes.samples, np.asarray(plan.robot.end_effectors[end].half_size, float)
        x, y = (np.unique(half[i] * np.linspace(-1.0, 1.0, GRID[i])) for i in range(2))
        sole = np.array([[a, b, 0.0] for a in x for b in y])
        swept = np.array([_swept(nodes.swings_W[:, end], k, part) for part in PARTS])
        points = (swept[:, None] + sole @ samples.rotations_W[k, end].T).reshape(-1, 3)
        ratio = nodes.swung(k, end)
        keep = MIDDLE_M * float(np.clip((min(ratio, 1.0 - ratio) - ENDS) / (MIDDLE - ENDS), 0.0, 1.0))
        keep = max(keep, BETWEEN_M * float(np.clip((min(ratio, 1.0 - ratio) - UPRIGHT) / UPRIGHT, 0.0, 1.0)))
        under = min(self.clearance(points, 0.0), DOWN_M)
        over, aside = under, 0.0
        for aside in ASIDE_M:
            over = min(self.clearance(points, aside), DOWN_M)
            if over >= LEAST_RATIO * under:
                break
        down = max(0.0, over - min(keep, max(0.5 * over, over - ROOM_M)))
        down = min(down, over * (1.0 - KEPT * float(np.interp(ratio, LATE, (0.0, 1.0, 1.0, 0.0)))))
        return aside, min(down, over - LEAST_M) if min(ratio, 1.0 - ratio) >= MIDDLE else down


def _swept(positions_W: Array, k: int, part: float) -> Array:
    """Where a sole is on the way from node k to the next one, or back to the one before, at its height at node k."""
    to = positions_W[np.clip(k + (1 if part > 0.0 else -1), 0, len(positions_W) - 1)]
    flat = positions_W[k] + abs(part) * (to - positions_W[k])
    return np.array([flat[0], flat[1], positions_W[k, 2]])
