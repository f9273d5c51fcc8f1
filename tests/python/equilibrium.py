"""Whether contacts can hold a body still: a linear program over forces in friction cones."""

from __future__ import annotations

import numpy as np
from scipy.optimize import linprog

import mcplan as mp
from mcplan._core import Polygon

#: Edges of the pyramid inside each friction cone.
EDGES = 8


def cone_edges(normal_W: np.ndarray, friction: float) -> np.ndarray:
    """(EDGES, 3) directions on the friction cone, normal part 1."""
    across = np.cross(normal_W, [1.0, 0.0, 0.0] if abs(normal_W[0]) < 0.9 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    along = np.cross(normal_W, across)
    angles = 2.0 * np.pi * np.arange(EDGES) / EDGES
    return normal_W + friction * (np.outer(np.cos(angles), across) + np.outer(np.sin(angles), along))


def forces_at_rest(
    scene: mp.Scene,
    com_W: np.ndarray,
    contacts: list[tuple[np.ndarray, int]],
    weight: float,
    through_com: bool = False,
    friction: float | None = None,
    most: float = np.inf,
) -> np.ndarray | None:
    """Contact forces (n, 3) of least normal sum that balance the weight and have no moment about the CoM; None: none do.

    sum f = (0, 0, weight) and sum (a - com) x f = 0, each force at its own point a and in the cone of its surface.

    Args:
        scene: Of the surfaces.
        com_W: [m]
        contacts: Position [m] and surface of each.
        weight: [N]
        through_com: Every force must point at the CoM or away from it.
        friction: Of all surfaces; None: their own.
        most: Largest normal force of a contact [N].
    """
    columns, owner = [], []
    for number, (point_W, surface) in enumerate(contacts):
        patch = scene.surfaces[surface]
        normal_W = Polygon(patch.vertices_W).normal_W
        edges = cone_edges(normal_W, patch.friction if friction is None else friction)
        moments = np.cross(point_W - com_W, edges)
        rows = np.zeros((3 * len(contacts), EDGES))
        rows[3 * number : 3 * number + 3] = moments.T
        balance = rows if through_com else moments.T  # of each contact, or of all together
        columns.append(np.vstack([edges.T, balance]))
        owner += [number] * EDGES
    matrix = np.hstack(columns)
    wanted = np.zeros(len(matrix))
    wanted[2] = weight
    normal = np.array([[float(number == at) for at in owner] for number in range(len(contacts))])
    limits = (normal, np.full(len(contacts), most)) if np.isfinite(most) else (None, None)
    found = linprog(np.ones(matrix.shape[1]), *limits, A_eq=matrix, b_eq=wanted, bounds=(0.0, None), method="highs")
    if not found.success:
        return None
    forces = np.zeros((len(contacts), 3))
    for number, column, amount in zip(owner, matrix.T, found.x, strict=True):
        forces[number] += amount * column[:3]
    return forces
