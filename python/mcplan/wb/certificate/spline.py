"""Values and derivatives of B-splines, by the recursion of Cox and de Boor (Piegl and Tiller, The NURBS Book, A2.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEGREE = 3


def spline_at(nodes: Array, coefficients: Array, times: Array) -> tuple[Array, Array, Array]:
    """Values and first and second derivatives (k, m) at times (k,).

    Args:
        nodes: (n + 1,) ascending; three more at each end mirror those beside it.
        coefficients: (n + 3, m).
        times: Within the nodes.
    """
    first, last = nodes[0], nodes[-1]
    before = [first - (nodes[i] - first) for i in (3, 2, 1)]
    after = [last + (last - nodes[-1 - i]) for i in (1, 2, 3)]
    knots = np.array([*before, *nodes, *after])
    span = np.minimum(np.searchsorted(nodes, times, side="right"), len(nodes) - 1) + DEGREE - 1
    derivatives = []
    for order in range(3):
        degree = DEGREE - order
        basis = _basis(knots, span, times, degree)
        derivatives.append(sum(basis[:, [r]] * coefficients[span - degree + r] for r in range(degree + 1)))
        # c'_i = p (c_i - c_{i-1}) / (t_{i+p} - t_i); the first one is of no use and only keeps the numbering.
        rise = np.diff(coefficients, axis=0, prepend=coefficients[:1])
        width = np.ones(len(coefficients))
        width[1:] = knots[1 + degree : len(coefficients) + degree] - knots[1 : len(coefficients)]
        coefficients = degree * rise / width[:, None]
    values, velocities, accelerations = derivatives
    return np.asarray(values), np.asarray(velocities), np.asarray(accelerations)


def _basis(knots: Array, span: NDArray[np.int64], times: Array, degree: int) -> Array:
    """(k, degree + 1) basis functions that are not zero in the span of each time."""
    basis = np.ones((len(times), degree + 1))
    for p in range(1, degree + 1):
        left = [times - knots[span + 1 - j] for j in range(p + 1)]
        right = [knots[span + j] - times for j in range(p + 1)]
        saved = np.zeros(len(times))
        for r in range(p):
            share = basis[:, r] / (right[r + 1] + left[p - r])
            basis[:, r] = saved + right[r + 1] * share
            saved = left[p - r] * share
        basis[:, p] = saved
    return basis
