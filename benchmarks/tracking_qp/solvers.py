"""Solvers of min 1/2 x' H x + g' x  s.t.  A x = b,  l <= C x <= u, each as its documentation has it, from the same arrays.

Each is made once and then called for one program after the other, as a controller does; those that can start from the
solution before do so.
"""

import clarabel
import numpy as np
import osqp
import quadprog
from scipy import sparse

from mcplan.tracking.quadratic_program import QuadraticProgram


class ProxQP:
    """mcplan's own."""

    def __init__(self):
        self.qp = QuadraticProgram()

    def __call__(self, problem, structure):
        return self.qp.solve(problem, structure)


class Quadprog:
    """Goldfarb and Idnani's active-set method, dense; each program from nothing."""

    def __call__(self, problem, structure):
        low, high = np.isfinite(problem.lower), np.isfinite(problem.upper)
        rows = np.vstack([problem.equality, problem.rows[low], -problem.rows[high]])
        values = np.concatenate([problem.equality_value, problem.lower[low], -problem.upper[high]])
        try:
            return quadprog.solve_qp(problem.hessian, -problem.gradient, rows.T, values, len(problem.equality_value))[0]
        except ValueError:
            return None


class Clarabel:
    """Interior points, sparse; each program from nothing."""

    def __init__(self):
        self.settings = clarabel.DefaultSettings()
        self.settings.verbose = False
        self.settings.tol_gap_abs = self.settings.tol_gap_rel = self.settings.tol_feas = 1e-5

    def __call__(self, problem, structure):
        low, high = np.isfinite(problem.lower), np.isfinite(problem.upper)
        rows = np.vstack([problem.equality, -problem.rows[low], problem.rows[high]])
        values = np.concatenate([problem.equality_value, -problem.lower[low], problem.upper[high]])
        cones = [
            clarabel.ZeroConeT(len(problem.equality_value)),
            clarabel.NonnegativeConeT(int(low.sum() + high.sum())),
        ]
        upper = sparse.csc_matrix(np.triu(problem.hessian))
        solver = clarabel.DefaultSolver(upper, problem.gradient, sparse.csc_matrix(rows), values, cones, self.settings)
        found = solver.solve()
        return np.array(found.x) if found.status == clarabel.SolverStatus.Solved else None


class Osqp:
    """ADMM, sparse; matrices of full pattern, so that they can be updated, and the solution before to start from."""

    def __init__(self):
        self.made = {}

    def __call__(self, problem, structure):
        rows = np.vstack([problem.equality, problem.rows])
        low = np.concatenate([problem.equality_value, problem.lower])
        high = np.concatenate([problem.equality_value, problem.upper])
        size = len(problem.gradient)
        solver = self.made.get(structure)
        if solver is None:
            solver = self.made[structure] = osqp.OSQP()
            # Column by column, upper triangle and all rows: entries that are zero now may not be later.
            hessian = sparse.triu(np.ones((size, size)), format="csc")
            hessian.data = self._upper(problem)
            pattern = sparse.csc_matrix(np.ones_like(rows))
            pattern.data = rows.T.ravel()
            settings = {"eps_abs": 1e-5, "eps_rel": 0.0, "max_iter": 4000, "verbose": False}
            solver.setup(hessian, problem.gradient, pattern, low, high, **settings)
        else:
            solver.update(q=problem.gradient, l=low, u=high, Px=self._upper(problem), Ax=rows.T.ravel())
        found = solver.solve(raise_error=False)
        return found.x if found.info.status == "solved" else None

    @staticmethod
    def _upper(problem):
        """The Hessian's upper triangle, one column after the other."""
        column, row = np.tril_indices(len(problem.gradient))
        return problem.hessian[row, column]


SOLVERS = {"ProxQP": ProxQP, "quadprog": Quadprog, "Clarabel": Clarabel, "OSQP": Osqp}


def objective(problem, x):
    """1/2 x' H x + g' x."""
    return 0.5 * x @ problem.hessian @ x + problem.gradient @ x


def excess(problem, x):
    """Largest violation of a constraint, in its own unit."""
    along = problem.rows @ x
    off = np.abs(problem.equality @ x - problem.equality_value)
    return float(max(off.max(), (problem.lower - along).max(), (along - problem.upper).max(), 0.0))
