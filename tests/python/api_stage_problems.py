"""Random stage problems, whose functions return or raise what they like: for api_solves."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import numpy as np

from api_values import JUNK
from mcplan import ipm

STAGES, SIZES = [1, 2, 3, 12], [1, 2, 3, 7]
FINISHED = [0.0, 1.0, -1.0, 0.5, 1e-9, 1e6]


def stage_problem(rng: random.Random, reenter: Callable[[], None]) -> ipm.Problem:
    """A problem of a few stages, mostly with a solution, sometimes with functions that are none.

    Args:
        rng: Draws it.
        reenter: What a function may call.
    """
    problem = ipm.Problem()
    count, size = rng.choice(STAGES), rng.choice(SIZES)
    bound = rng.choice([float("inf"), 3.0, 0.1, 0.0])
    x = [problem.variables("x", size, k, lower=-bound, upper=bound, start=_array(rng, (size,))) for k in range(count)]
    lasting = [problem.variables("p", 1, (0, count - 1))] if rng.random() < 0.5 else []
    hostile = rng.random() < 0.4
    for k in range(count):
        chosen = [*lasting, x[k]] + ([x[k + 1]] if k + 1 < count else [])
        n = sum(group.size for group in chosen)
        rows = rng.randint(1, size)
        for add in rng.sample([problem.equality, problem.inequality, problem.least_squares, problem.cost], 2):
            if add == problem.cost:
                problem.cost("cost", chosen, ipm.Quadratic(_array(rng, (n, n))))
            elif rng.random() < 0.5 or not hostile:
                add(f"{rows} linear of {k}", chosen, ipm.Linear(_array(rng, (rows, n)), _array(rng, (rows,))))
            else:
                add(f"{rows} curved of {k}", chosen, _function(rng, rows, n, reenter))
    return problem


def _array(rng: random.Random, shape: tuple[int, ...]) -> Any:
    out = np.array([rng.gauss(0.0, 1.0) for _ in range(int(np.prod(shape)))]).reshape(shape)
    if rng.random() < 0.1:
        out.flat[rng.randrange(out.size)] = rng.choice(FINISHED)
    return out


def _function(rng: random.Random, rows: int, n: int, reenter: Callable[[], None]) -> ipm.Function:
    A = _array(rng, (rows, n))
    calls = [0]

    def may_fail(good: Any) -> Any:
        calls[0] += 1
        if calls[0] == 1 or rng.random() < 0.97:
            return good
        if rng.random() < 0.2:
            reenter()
        if rng.random() < 0.2:
            raise ValueError("raised in a function")
        return rng.choice([*JUNK, good * np.nan, good[:0], np.zeros((rows, n, 1))])

    def value(*v: Any) -> Any:
        return may_fail(np.sin(A @ np.concatenate(v)))

    def jacobian(*v: Any) -> Any:
        return may_fail(np.cos(A @ np.concatenate(v))[:, None] * A)

    def hessian(*v: Any) -> Any:
        return may_fail(-A.T @ ((v[-1] * np.sin(A @ np.concatenate(v[:-1])))[:, None] * A))

    return ipm.Function(value, jacobian, hessian)
