"""Faces of a polytope that others imply."""

from __future__ import annotations

import numpy as np
from scipy.optimize import linprog
from walker import Array

#: Where the planner can be [m]: CoM over a foot, foot over a foot, either of them to the sides.
COM_HEIGHT, FOOT_HEIGHT, SIDEWAYS = (0.64, 0.86), (-0.13, 0.13), (-2.0, 2.0)


def pruned(A: Array, b: Array, height: tuple[float, float], slack: float = 1e-9) -> tuple[Array, Array]:
    """A x <= b without the rows that the others imply for x, y in SIDEWAYS and z in `height` [m]."""
    keep = list(range(len(b)))
    for row in range(len(b)):
        others = [i for i in keep if i != row]
        most = linprog(-A[row], A_ub=A[others], b_ub=b[others], bounds=[SIDEWAYS, SIDEWAYS, height], method="highs")
        if most.status == 0 and -most.fun <= b[row] + slack:
            keep = others
    return A[keep], b[keep]


def force_axes(frame: Array, friction: float, sides: int, outer: bool) -> list[int]:
    """World axes in which the bound |f| <= F on a force is not implied by friction and the same bound on f_z.

    Raises:
        ValueError: The pyramid reaches below the horizon, so that f_z >= 0 does not hold either.
    """
    phi = np.pi * (2 * np.arange(sides) + 1) / sides
    radius = friction / np.cos(np.pi / sides) if outer else friction
    rays = frame @ np.vstack([radius * np.cos(phi), radius * np.sin(phi), np.ones(sides)])
    if np.any(rays[2] <= 0):
        raise ValueError("friction pyramid reaches below the horizon")
    return [axis for axis in (0, 1) if np.any(np.abs(rays[axis]) > rays[2])]
