"""What is called solved is an optimum by arithmetic of our own: problems drawn to be degenerate, narrow, or without end."""

from __future__ import annotations

import copy
import math
import pickle
import threading

import numpy as np
import pytest

import mcplan as mp
from mcplan import ipm

INF = np.inf


class Quadratic:
    """A quadratic program of two stages around a point that keeps all limits, of a kind that solvers may trip over."""

    def __init__(self, seed, kind):
        random = np.random.default_rng(seed)
        n = self.n = int(random.integers(2, 9))
        m, k = int(random.integers(0, n)), int(random.integers(0, 6))
        B = random.normal(size=(n, n if kind != "flat" else max(1, n // 2)))
        self.H, self.g = B @ B.T, 3.0 * random.normal(size=n)
        inside = random.normal(size=n)
        self.A, self.C = random.normal(size=(m, n)), random.normal(size=(k, n))
        if kind == "repeated" and m:
            self.A = np.vstack([self.A, self.A[:1], 2.0 * self.A[:1] - self.A[-1:]])
        widths = random.uniform(0.0, 3.0, (2, n + k))
        if kind == "narrow":
            widths = 10.0 ** random.uniform(-9.0, 1.0, (2, n + k))
        else:
            widths[random.random(widths.shape) < 0.3] = INF
        if kind == "fixed":
            widths[:, :n][:, random.random(n) < 0.4] = 0.0
        centre = np.concatenate([inside, self.C @ inside])
        self.b = -self.A @ inside
        self.lower, self.upper = centre - widths[0], centre + widths[1]

    def solve(self, solver):
        n, half = self.n, self.n // 2
        problem = ipm.Problem()
        variables = [
            problem.variables("a", half, 0, lower=self.lower[:half], upper=self.upper[:half]),
            problem.variables("b", n - half, 1, lower=self.lower[half:n], upper=self.upper[half:n]),
        ]
        problem.cost("cost", variables, ipm.Quadratic(self.H, self.g))
        if len(self.A):
            problem.equality("equal", variables, ipm.Linear(self.A, self.b))
        if len(self.C):
            problem.inequality("between", variables, ipm.Linear(self.C), lower=self.lower[n:], upper=self.upper[n:])
        return ipm.solve(problem, solver=solver)

    def errors(self, result):
        """Gradient of the Lagrangian and complementarity, over what multipliers allow for, and violation."""
        x, z = (np.concatenate([of["a"][0], of["b"][0]]) for of in (result.x, result.bound_multipliers))
        y = result.multipliers["between"][0] if len(self.C) else np.zeros(0)
        gradient = self.H @ x + self.g + z + self.C.T @ y
        if len(self.A):
            gradient = gradient + self.A.T @ result.multipliers["equal"][0]
        at, dual = np.concatenate([x, self.C @ x]), np.concatenate([z, y])
        violation = np.concatenate([self.lower - at, at - self.upper, np.abs(self.A @ x + self.b)]).max()
        free = self.upper - self.lower > 1e-8  # of what is fixed multipliers have either sign
        room = np.where(dual > 0.0, self.upper - at, at - self.lower)[free]
        products = np.abs(dual[free]) * np.minimum(np.abs(room), 1e10)
        size = max(1.0, np.abs(np.concatenate([dual, *result.multipliers.values()], axis=None)).mean() / 100.0)
        return np.abs(gradient).max() / size, violation, products.max(initial=0.0) / size


@pytest.mark.parametrize("kind", ["plain", "flat", "repeated", "fixed", "narrow"])
def test_what_is_called_solved_is_an_optimum(kind):
    solved = 0
    for seed in range(150):
        program = Quadratic(seed, kind)
        result = program.solve("ipm")
        if result.status != mp.Status.solved:
            assert result.status != mp.Status.infeasible, (seed, result)
            continue
        solved += 1
        gradient, violation, complementarity = program.errors(result)
        assert violation <= 1e-6 and gradient <= 1e-5 and complementarity <= 5e-5, (seed, result)
    assert solved >= 140


@pytest.mark.parametrize("width", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-300])
@pytest.mark.parametrize("offset", [0.0, 1.0])
def test_limits_that_lie_close_together_leave_the_optimum_where_it_is(width, offset):
    problem = ipm.Problem()
    x = problem.variables("x", 2, lower=[offset, -5.0], upper=[offset + width, 5.0])
    problem.cost("cost", [x], ipm.Quadratic(np.eye(2), [1.0, 1.0]))
    problem.inequality("row", [x], ipm.Linear([[1.0, 2.0]]), lower=1.0 + offset, upper=1.0 + offset + width)
    result = ipm.solve(problem)
    assert result.status == mp.Status.solved
    assert result.x["x"][0] == pytest.approx([offset, 0.5], abs=2.0 * width + 1e-9)


@pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])
def test_a_cost_without_end_is_a_numerical_failure_that_says_so(solver):
    for gradient, curvature, lower in ([1.0, 1.0], 0.0, -INF), ([0.1, 0.2], -1.0, -INF), ([-1.0, 1.0], 0.0, 0.0):
        problem = ipm.Problem()
        x = problem.variables("x", 2, lower=lower)
        problem.cost("cost", [x], ipm.Quadratic(curvature * np.eye(2), gradient))
        result = ipm.solve(problem, solver=solver)
        assert result.status == mp.Status.numerical_failure
        assert result.message == "the iterates diverge; is the cost bounded from below?"


@pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])
@pytest.mark.parametrize("target", [5.0, -15.0])
def test_functions_are_called_within_the_bounds_alone_where_there_is_no_solution_too(solver, target):
    """The logarithm of what lies in [0.001, 10] is neither."""
    called = []

    def value(x):
        called.append(x[0])
        return [math.log(x[0]) - target]

    problem = ipm.Problem()
    x = problem.variables("x", 1, lower=1e-3, upper=10.0, start=1.0)
    problem.equality("log", [x], ipm.Function(value, lambda x: 1.0 / x, lambda x, w: -w / x**2))
    problem.cost("cost", [x], ipm.Quadratic([[1.0]]))
    result = ipm.solve(problem, solver=solver)
    assert result.status == mp.Status.infeasible and result.worst == "log at stage 0"
    assert min(called) >= 1e-3 and max(called) <= 10.0
    if solver == "ipm":
        assert result.x["x"][0, 0] == pytest.approx(10.0 if target > 0.0 else 1e-3, rel=1e-6)  # violated least


@pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])
def test_a_cost_that_is_not_finite_is_not_solved_where_every_variable_is_fixed(solver):
    problem = ipm.Problem()
    x = problem.variables("x", 1, lower=1.0, upper=1.0)
    problem.cost("cost", [x], ipm.Function(lambda x: INF, lambda x: 1.0, lambda x, w: 0.0))
    result = ipm.solve(problem, solver=solver)
    assert result.status == mp.Status.numerical_failure and result.message == "not finite: cost cost at stage 0"


def free_fall(stages):
    """What rolls on by itself from a known state: at each stage as many equalities as variables."""
    problem = ipm.Problem()
    x = [problem.variables("x", 2, k) for k in range(stages + 1)]
    problem.change(x[0], lower=1.0, upper=1.0)
    for k in range(stages):
        problem.equality("step", [x[k], x[k + 1]], ipm.Linear([[[0.8, 0.6], [-0.6, 0.8]], -np.eye(2)]))
    problem.cost("last", [x[-1]], ipm.Quadratic(np.eye(2)))
    return problem


def test_a_horizon_may_be_longer_than_the_stack_of_its_thread_is_deep():
    problem, results = free_fall(10000), []
    size = threading.stack_size(256 * 1024)
    try:
        thread = threading.Thread(target=lambda: results.append(ipm.solve(problem)))
        thread.start()
        thread.join()
    finally:
        threading.stack_size(size)
    assert results[0].status == mp.Status.solved
    assert np.linalg.norm(results[0].x["x"], axis=1) == pytest.approx(np.full(10001, math.sqrt(2.0)), abs=1e-9)


def test_more_unknowns_at_one_stage_than_places_are_refused_before_memory_is_asked_for():
    problem = ipm.Problem()
    problem.variables("x", 50000)
    y = problem.variables("y", 1)
    problem.cost("cost", [y], ipm.Quadratic([[1.0]]))
    with pytest.raises(mp.errors.InvalidInput, match="problem: must have a factor of at most 2147483647 entries"):
        ipm.solve(problem)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda result: pickle.loads(pickle.dumps(result))])
def test_results_can_be_copied_and_pickled(copied):
    problem = free_fall(3)
    result = ipm.solve(problem)
    other = copied(result)
    assert str(other) == str(result) and other.status == mp.Status.solved
    assert (other.x["x"] == result.x["x"]).all() and (other.multipliers["step"] == result.multipliers["step"]).all()
    with pytest.raises(ValueError, match="read-only"):
        other.x["x"][0] = 1.0
    assert ipm.solve(problem, other).iterations <= 1


def test_a_problem_may_grow_in_one_thread_while_another_solves_it():
    problem = free_fall(5)
    done = threading.Event()

    def grow():
        k = 0
        while not done.is_set() and k < 20000:
            y = problem.variables("y", 1, k)
            problem.equality("more", [y], ipm.Linear([[1.0]], 1.0))
            k += 1

    thread = threading.Thread(target=grow)
    thread.start()
    try:
        for _ in range(20):
            result = ipm.solve(problem)
            assert result.status == mp.Status.solved and result.x["x"].shape == (6, 2)
    finally:
        done.set()
        thread.join()
