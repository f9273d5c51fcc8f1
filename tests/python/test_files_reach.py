"""mcplan.files.reach: the largest box, against exhaustive search."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from mcplan.files.reach import Grid, largest_box


def brute_force(grid: Grid) -> float:
    """Largest volume of boxes of reached points around the origin, preferring those with it inside."""
    best = {True: 0.0, False: 0.0}
    shape = grid.reached.shape
    ranges = [itertools.product(range(o + 1), range(o, n)) for o, n in zip(grid.origin, shape, strict=True)]
    for spans in itertools.product(*ranges):
        if all(grid.reached[tuple(i)] for i in itertools.product(*(range(a, b + 1) for a, b in spans))):
            inside = all(a < o < b for (a, b), o in zip(spans, grid.origin, strict=True))
            best[inside] = max(best[inside], float(np.prod([b - a for a, b in spans])))
    return best[True] or best[False]


@pytest.mark.parametrize("seed", range(12))
def test_largest_box_against_brute_force(seed):
    rng = np.random.default_rng(seed)
    reached = rng.random((5, 4, 5)) < 0.93
    origin = np.array([2, rng.integers(0, 3), 2])
    reached[tuple(origin)] = True
    grid = Grid(nominal=np.array([0.1, 0.2, 0.3]), step=0.5, origin=origin, reached=reached)
    low, high = largest_box(grid)
    assert np.prod((high - low) / 0.5) == pytest.approx(brute_force(grid))
    assert (low <= grid.nominal + 1e-12).all() and (high >= grid.nominal - 1e-12).all()
