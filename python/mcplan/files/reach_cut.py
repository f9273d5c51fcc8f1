"""Faces that cut the reach boxes of feet: a sole is lifted higher ahead of the body than behind it.

A box that holds everywhere ends at the height to which the sole can be lifted where it is lifted least, behind the body, where
ankles are at their limits. Ahead legs fold further: a face that rises to the front lets them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Polytope
from mcplan.files.reach import explore

if TYPE_CHECKING:
    from mcplan._core import EndEffector
    from mcplan.files.reach import Grid, Limb

Array = NDArray[np.float64]

#: Highest top that is looked for, above the nominal place, in CoM heights.
LIFT = 0.4
#: Boxes are rounded and shared by both sides, of which each has a grid of its own: points that far outside count as inside.
EDGE_M = 1e-3


@dataclass(frozen=True)
class Cut:
    """The face z <= height + slope x of reachable positions relative to the CoM, axes of the base.

    Attributes:
        height: Below the CoM [m].
        slope: Of the face over x [-].
    """

    height: float
    slope: float

    def top(self, x: float) -> float:
        """Height [m] of the face at x [m]."""
        return self.height + self.slope * x

    def polytope(self) -> Polytope:
        """As a face of unit length, rounded so that nothing more is inside than before."""
        length = float(np.hypot(1.0, self.slope))
        normal = np.round([-self.slope / length, 0.0, 1.0 / length], 4) + 0.0
        return Polytope(A=[normal], b=[float(np.floor(self.height / length * 1e3) / 1e3)])


def tops(grid: Grid, low: Array, high: Array) -> tuple[Array, Array]:
    """Heights up to which every column of a grid between the sides of a box is reached from the box's bottom on.

    Args:
        grid: Of the limb.
        low: Corner of the box [m].
        high: The opposite one [m]; its height does not count.

    Returns:
        (n,) places x [m] and (n,) the lowest of the tops along y there [m]; of a column that is not reached at the bottom,
        the bottom.
    """
    index = [np.arange(size) for size in grid.reached.shape]
    places = [grid.nominal[a] + grid.step * (index[a] - grid.origin[a]) for a in range(3)]
    inside = [(places[a] >= low[a] - EDGE_M) & (places[a] <= high[a] + EDGE_M) for a in range(2)]
    above = places[2] >= low[2] - EDGE_M
    columns = grid.reached[np.ix_(*inside, above)]
    reached = np.cumprod(columns, axis=2).sum(axis=2).min(axis=1)
    heights = np.concatenate([[low[2]], places[2][above]])
    return places[0][inside[0]], heights[reached]


def highest_cut(x: Array, top: Array, middle: float) -> Cut | None:
    """The face below all tops that leaves most of the box, and rises to the front; None where a level one does as well.

    Args:
        x: (n,) places ahead of the CoM [m].
        top: (n,) heights there [m].
        middle: Of the box [m]: the height there is the mean of the face's.
    """
    best = Cut(float(top.min()), 0.0)
    for i in range(len(x)):
        for j in range(len(x)):
            if not x[j] > x[i]:
                continue
            slope = float((top[j] - top[i]) / (x[j] - x[i]))
            cut = Cut(float(top[i] - slope * x[i]), slope)
            if (
                slope > 0.0
                and (top >= cut.height + slope * x - 1e-9).all()
                and cut.top(middle) > best.top(middle) + 1e-9
            ):
                best = cut
    return best if best.slope > 0.0 else None


def cut_of(sides: Sequence[tuple[Limb, Array, Array]], lift: float, step: float, seed: int) -> Cut | None:
    """The face up to which a sole is lifted everywhere in its box, on both sides of the body; None: a level one will do.

    Args:
        sides: Limb and corners [m] of its box.
        lift: How far above the nominal place to look [m].
        step: Of the grid [m].
        seed: Of the random starts of inverse kinematics.
    """
    found = []
    for limb, low, high in sides:
        nominal = limb.position(limb.nominal)
        corner = np.array([*high[:2] + EDGE_M, nominal[2] + lift])
        found.append(tops(explore(limb, low - EDGE_M, corner, step, seed), low, high))
    low, high = sides[0][1:]
    x, top = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return highest_cut(x, top, 0.5 * float(low[0] + high[0]))


def below_cut(end: EndEffector, target: Array) -> bool:
    """Whether a place relative to the CoM is inside of the faces that cut an end-effector's box.

    Args:
        end: The end-effector.
        target: (3,) [m], axes of the base.
    """
    cut = end.reach_cut
    return not cut.given or bool((np.asarray(cut.A) @ target <= np.asarray(cut.b)).all())


def uncut_top(end: EndEffector) -> float:
    """Height [m] relative to the CoM up to which no face cuts an end-effector's box."""
    low, high = np.asarray(end.reach_min_B), np.asarray(end.reach_max_B)
    return min(top_at(end, x, y) for x in (low[0], high[0]) for y in (low[1], high[1]))


def top_at(end: EndEffector, x: float, y: float) -> float:
    """Height [m] relative to the CoM up to which an end-effector comes at a place of its box.

    Args:
        end: The end-effector.
        x: Relative to the CoM [m], axes of the base.
        y: Likewise.
    """
    top = float(end.reach_max_B[2])
    for normal, b in zip(np.asarray(end.reach_cut.A), np.asarray(end.reach_cut.b), strict=True):
        if normal[2] > 0.0:
            top = min(top, float((b - normal[0] * x - normal[1] * y) / normal[2]))
    return top
