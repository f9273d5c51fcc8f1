"""Programs made from their solution: the multipliers of Karush, Kuhn and Tucker say what the minimiser is."""

import numpy as np
import pytest

pytest.importorskip("proxsuite")

from mcplan.tracking.quadratic_program import Problem, QuadraticProgram  # noqa: E402


def made(rng, n=12, m=4, k=15, solution=None):
    """A strictly convex program and its minimiser."""
    root = rng.normal(size=(n, n))
    hessian = root @ root.T + 0.5 * np.eye(n)
    x = rng.normal(size=n) if solution is None else solution
    equality, rows = rng.normal(size=(m, n)), rng.normal(size=(k, n))
    at = rows @ x
    lower, upper = at - rng.uniform(0.1, 2.0, k), at + rng.uniform(0.1, 2.0, k)
    multipliers = np.zeros(k)
    for i in range(k):
        which = rng.integers(5)
        if which == 0:  # held at its upper bound
            upper[i], multipliers[i] = at[i], rng.uniform(0.1, 1.0)
        elif which == 1:
            lower[i], multipliers[i] = at[i], -rng.uniform(0.1, 1.0)
        elif which == 2:
            upper[i] = np.inf
        elif which == 3:
            lower[i] = -np.inf
    gradient = -hessian @ x - equality.T @ rng.normal(size=m) - rows.T @ multipliers
    return Problem(hessian, gradient, equality, equality @ x, rows, lower, upper), x


def test_the_minimiser_is_found():
    rng = np.random.default_rng(0)
    for _ in range(20):
        problem, x = made(rng)
        qp = QuadraticProgram(accuracy=1e-9)
        np.testing.assert_allclose(qp.solve(problem, "one"), x, atol=1e-6)
        assert qp.failures == 0


def test_warm_starts_do_not_change_the_answer():
    rng = np.random.default_rng(1)
    qp = QuadraticProgram(accuracy=1e-9)
    for draw in range(30):
        structure = draw % 2  # two sizes in turn, as contacts come and go
        problem, x = made(rng, n=12 + structure, m=4, k=15 - structure)
        np.testing.assert_allclose(qp.solve(problem, structure), x, atol=1e-6)
    assert qp.failures == 0


def test_a_solution_nearby_is_found_in_fewer_iterations():
    rng = np.random.default_rng(2)
    problem, _ = made(rng)
    qp = QuadraticProgram()
    qp.solve(problem, "one")
    first = qp.iterations
    problem.gradient = problem.gradient + 1e-6
    qp.solve(problem, "one")
    assert qp.iterations - first < first


def test_a_program_without_a_point_fails_and_the_next_one_does_not():
    rng = np.random.default_rng(3)
    qp = QuadraticProgram(accuracy=1e-9)
    problem, x = made(rng)
    qp.solve(problem, "one")
    good = problem.rows[:2].copy(), problem.lower[:2].copy(), problem.upper[:2].copy()
    problem.rows[:2] = problem.rows[0]
    problem.lower[:2], problem.upper[:2] = [1.0, -np.inf], [np.inf, -1.0]
    assert qp.solve(problem, "one") is None
    assert qp.failures == 1
    problem.rows[:2], problem.lower[:2], problem.upper[:2] = good
    np.testing.assert_allclose(qp.solve(problem, "one"), x, atol=1e-6)
    assert qp.failures == 1


def test_the_answer_outlives_the_next_program():
    rng = np.random.default_rng(4)
    qp = QuadraticProgram(accuracy=1e-9)
    first, x = made(rng)
    found = qp.solve(first, "one")
    qp.solve(made(rng)[0], "one")
    np.testing.assert_allclose(found, x, atol=1e-6)
