"""min 1/2 x' H x + g' x   s.t.  A x = b,  l <= C x <= u:  ProxQP, one warm-started instance a size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import proxqp

Array = NDArray[np.float64]


@dataclass
class Problem:
    """Data of a quadratic program; m equalities, k inequalities of n variables."""

    hessian: Array  # (n, n)
    gradient: Array  # (n,)
    equality: Array  # (m, n)
    equality_value: Array  # (m,)
    rows: Array  # (k, n)
    lower: Array  # (k,)
    upper: Array  # (k,)


class QuadraticProgram:
    """Solves programs of the same structure again and again, each from the one before.

    Attributes:
        failures: How many were not solved.
        iterations: Sum over all.
    """

    def __init__(self, accuracy: float = 1e-5, max_iterations: int = 200) -> None:
        self._proxqp = proxqp.load()
        self._dense = self._proxqp.dense
        self._accuracy, self._max_iterations = accuracy, max_iterations
        self._solvers: dict[object, Any] = {}
        self.failures = self.iterations = 0

    def solve(self, problem: Problem, structure: object) -> Array | None:
        """The minimiser, or None if ProxQP does not report it as solved.

        Args:
            problem: The program.
            structure: Those with equal structure have the same sizes and warm-start each other.
        """
        warm = structure in self._solvers
        found = self._attempt(problem, structure)
        if found is None and warm:  # a start from afar can be worse than none
            found = self._attempt(problem, structure)
        self.failures += found is None
        return found

    def _attempt(self, problem: Problem, structure: object) -> Array | None:
        qp = self._solvers.get(structure)
        args = (
            problem.hessian,
            problem.gradient,
            problem.equality,
            problem.equality_value,
            problem.rows,
            problem.lower,
            problem.upper,
        )
        if qp is None:
            qp = self._dense.QP(len(problem.gradient), len(problem.equality_value), len(problem.lower))
            qp.settings.eps_abs = self._accuracy
            qp.settings.eps_rel = 0.0
            qp.settings.max_iter = self._max_iterations
            qp.settings.initial_guess = self._proxqp.InitialGuess.WARM_START_WITH_PREVIOUS_RESULT
            qp.init(*args)
            self._solvers[structure] = qp
        else:
            qp.update(*args)
        qp.solve()
        info = qp.results.info
        self.iterations += int(info.iter)
        if info.status != self._proxqp.QPSolverOutput.PROXQP_SOLVED or not np.isfinite(qp.results.x).all():
            del self._solvers[structure]  # a failed solve is no start for the next one
            return None
        return np.array(qp.results.x)  # a copy: the solver writes its next solution to the same place
