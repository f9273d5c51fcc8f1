"""Cubic splines with continuous accelerations, from coefficients of B-splines and back.

With nodes t_0 .. t_n the knots are the nodes and three more at each end, mirrored: t_-i = t_0 - (t_i - t_0). Of the n + 3
basis functions those of c_i, c_i+1, c_i+2 alone are not zero at node i (de Boor, A Practical Guide to Splines, ch. IX).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Intervals that a spline has at least: with fewer the mirrored knots are not defined.
MIN_INTERVALS = 3


def knots_of(nodes: Array) -> Array:
    """(n + 7,) knots of nodes (n + 1,)."""
    before = 2.0 * nodes[0] - nodes[3:0:-1]
    after = 2.0 * nodes[-1] - nodes[-2:-5:-1]
    return np.concatenate([before, nodes, after])


def at_nodes(nodes: Array, coefficients: Array) -> tuple[Array, Array, Array]:
    """Values and first and second derivatives (n + 1, m) at the nodes of splines with coefficients (n + 3, m).

    The derivatives are splines of one degree less whose coefficients are divided differences: of the second one, which
    is linear, they are its values at the nodes.
    """
    t, k = knots_of(nodes)[:, None], np.arange(len(nodes))
    t1, t2, t3, t4, t5 = (t[k + i] for i in range(1, 6))
    c = coefficients
    first = 3.0 * (c[1:] - c[:-1]) / (t[4:-1] - t[1:-4])
    second = 2.0 * (first[1:] - first[:-1]) / (t4 - t2)
    velocities = (first[:-1] * (t4 - t3) + first[1:] * (t3 - t2)) / (t4 - t2)
    lower = (t4 - t3) ** 2 / ((t4 - t1) * (t4 - t2))
    upper = (t3 - t2) ** 2 / ((t5 - t2) * (t4 - t2))
    values = lower * c[:-2] + (1.0 - lower - upper) * c[1:-1] + upper * c[2:]
    return values, velocities, second


def evaluate(nodes: Array, coefficients: Array, times: Array) -> tuple[Array, Array, Array]:
    """Values and first and second derivatives (k, m) at times (k,) of splines with coefficients (n + 3, m).

    Between nodes these are cubic polynomials: the Taylor series from the node before, whose third derivative is the
    slope of the second one.
    """
    values, velocities, accelerations = at_nodes(nodes, coefficients)
    i = interval_of(nodes, times)
    u = (times - nodes[i])[:, None]
    x, v, a = values[i], velocities[i], accelerations[i]
    jerk = (accelerations[i + 1] - a) / (nodes[i + 1] - nodes[i])[:, None]
    return (
        x + u * (v + u * (0.5 * a + u * jerk / 6.0)),
        v + u * (a + 0.5 * u * jerk),
        a + u * jerk,
    )


def interval_of(nodes: Array, times: Array) -> NDArray[np.int64]:
    """Index of the interval of each time; at a node that which begins there."""
    return np.clip(np.searchsorted(nodes, times, side="right") - 1, 0, len(nodes) - 2)


def interpolating(nodes: Array, values: Array) -> Array:
    """Coefficients (n + 3, m) of the splines through values (n + 1, m) at the nodes that start and end at rest."""
    count = len(nodes)
    basis = np.eye(count + 2)
    at, velocity, _ = at_nodes(nodes, basis)
    rows = np.vstack([velocity[:1], at, velocity[-1:]])
    rest = np.zeros((1, values.shape[1]))
    return np.linalg.solve(rows, np.vstack([rest, values, rest]))
