"""Splines of a motion with more knots: the same functions.

A coefficient of a cubic B-spline is the blossom of any of its polynomials at three knots in a row (L. Ramshaw: Blossoms
are polar forms, 1989). Of x + v u + a u^2 / 2 + j u^3 / 6 the blossom at u_1, u_2, u_3 is

    x + v (u_1 + u_2 + u_3) / 3 + a (u_1 u_2 + u_1 u_3 + u_2 u_3) / 6 + j u_1 u_2 u_3 / 6.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import splines

Array = NDArray[np.float64]


def with_knots(nodes: Array, coefficients: Array, more: Array) -> Array:
    """Coefficients (k + 3, m) on the nodes `more` (k + 1), which contain all `nodes` (n + 1), of splines on those."""
    values, velocities, accelerations = splines.at_nodes(nodes, coefficients)
    jerks = np.diff(accelerations, axis=0) / np.diff(nodes)[:, None]
    knots = splines.knots_of(more)
    triples = np.stack([knots[1:-3], knots[2:-2], knots[3:-1]])
    at = splines.interval_of(nodes, np.clip(triples[1], nodes[0], nodes[-1]))
    u1, u2, u3 = ((knot - nodes[at])[:, None] for knot in triples)
    x, v, a, j = values[at], velocities[at], accelerations[at], jerks[at]
    return np.asarray(x + v * (u1 + u2 + u3) / 3.0 + a * (u1 * u2 + u1 * u3 + u2 * u3) / 6.0 + j * (u1 * u2 * u3) / 6.0)


def subdivided(nodes: Array, step_s: float) -> Array:
    """The nodes and, between each two, equal steps of at most step_s."""
    parts = [nodes[:1]]
    for start, end in zip(nodes[:-1], nodes[1:], strict=True):
        parts.append(np.linspace(start, end, max(1, int(np.ceil((end - start) / step_s - 1e-9))) + 1)[1:])
    return np.concatenate(parts)
