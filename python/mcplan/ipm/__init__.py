"""The interior-point kernel for stage problems of one's own: what plans walks here may plan other things elsewhere.

    from mcplan import ipm

    problem = ipm.Problem()
    x = [problem.variables("x", 2, k, lower=-5.0, upper=5.0) for k in range(21)]  # position, velocity
    u = [problem.variables("u", 1, k, lower=-1.0, upper=1.0) for k in range(20)]
    problem.change(x[0], lower=[1.0, 0.0], upper=[1.0, 0.0])
    for k in range(20):
        problem.equality("dynamics", [x[k], u[k], x[k + 1]], ipm.Linear([A, B, -np.eye(2)]))
        problem.cost("effort", [x[k], u[k]], ipm.Quadratic(np.eye(3)))
    result = ipm.solve(problem)
    print(result)
    result.x["u"]  # 20 x 1, a row for each stage

A problem has variables, which are in use at one stage or at several, and blocks, which are functions of the variables of
one stage or of two neighbours: equalities, inequalities and costs. A block's function is given by arrays (``Linear``,
``Quadratic``) or by Python functions for its value, Jacobian and Hessian (``Function``).

The page docs/ipm.md says more, docs/theory/ipm.md what the kernel does.
"""

from __future__ import annotations

from mcplan.ipm.functions import Function, Linear, Quadratic
from mcplan.ipm.problem import Problem, Variables
from mcplan.ipm.solving import Result, WrongDerivative, check_derivatives, solve

__all__ = [
    "Function",
    "Linear",
    "Problem",
    "Quadratic",
    "Result",
    "Variables",
    "WrongDerivative",
    "check_derivatives",
    "solve",
]
