"""Stage problems of one's own: what the kernel finds is what linear algebra, Riccati's recursion and closed forms say."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import mcplan as mp
from mcplan import ipm

TIGHT = {"tolerance": 1e-9, "constraint_tolerance": 1e-9}


def spread_of(random, size):
    """A random matrix with eigenvalues between 1 and 3."""
    basis = np.linalg.qr(random.normal(size=(size, size)))[0]
    return basis @ np.diag(random.uniform(1.0, 3.0, size)) @ basis.T


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])
def test_a_quadratic_program_with_equalities_is_its_dense_kkt_system(seed, solver):
    random = np.random.default_rng(seed)
    n, m = 7, 3
    H, g = spread_of(random, n), random.normal(size=n)
    A, b = random.normal(size=(m, n)), random.normal(size=m)
    problem = ipm.Problem()
    v = [problem.variables("a", 4), problem.variables("b", 3)]
    problem.cost("cost", v, ipm.Quadratic(H, g))
    problem.equality("rows", v, ipm.Linear([A[:, :4], A[:, 4:]], b))
    result = ipm.solve(problem, solver=solver, **TIGHT)

    kkt = np.linalg.solve(np.block([[H, A.T], [A, np.zeros((m, m))]]), np.concatenate([-g, -b]))
    x = kkt[:n]
    assert result.status == mp.Status.solved, result
    assert np.concatenate([result.x["a"][0], result.x["b"][0]]) == pytest.approx(x, abs=1e-7)
    assert result.multipliers["rows"][0] == pytest.approx(kkt[n:], abs=1e-6)
    assert result.objective == pytest.approx(0.5 * x @ H @ x + g @ x, abs=1e-8)
    assert result.bound_multipliers["a"][0].tolist() == [0.0] * 4
    assert result.solver == ("ipopt" if solver == "ipopt" else "ipm")


@pytest.mark.parametrize("seed", range(5))
def test_limits_and_bounds_have_multipliers_with_which_the_gradient_vanishes(seed):
    random = np.random.default_rng(100 + seed)
    n = 6
    H, g = spread_of(random, n), 5.0 * random.normal(size=n)
    A = random.normal(size=(2, n))
    problem = ipm.Problem()
    x = problem.variables("x", n, lower=-0.5, upper=0.7)
    problem.cost("cost", [x], ipm.Quadratic(H, g))
    problem.inequality("rows", [x], ipm.Linear(A), lower=-0.3, upper=[0.2, np.inf])
    result = ipm.solve(problem, **TIGHT)
    assert result.status == mp.Status.solved, result
    found, rows, bounds = result.x["x"][0], result.multipliers["rows"][0], result.bound_multipliers["x"][0]
    assert H @ found + g + A.T @ rows + bounds == pytest.approx(np.zeros(n), abs=1e-9)
    for value, dual, low, high in [
        *zip(found, bounds, [-0.5] * n, [0.7] * n, strict=True),
        *zip(A @ found, rows, [-0.3, -0.3], [0.2, np.inf], strict=True),
    ]:
        assert low - 1e-8 <= value <= high + 1e-8
        if dual > 1e-5:
            assert value == pytest.approx(high, abs=1e-5)
        if dual < -1e-5:
            assert value == pytest.approx(low, abs=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_a_linear_quadratic_regulator_is_riccatis_recursion(seed):
    random = np.random.default_rng(200 + seed)
    n, m, steps = 4, 2, 30
    A, B = np.eye(n) + 0.2 * random.normal(size=(n, n)), random.normal(size=(n, m))
    Q, R, x0 = spread_of(random, n), spread_of(random, m), random.normal(size=n)

    problem = ipm.Problem()
    x = [problem.variables("x", n, k) for k in range(steps + 1)]
    u = [problem.variables("u", m, k) for k in range(steps)]
    problem.change(x[0], lower=x0, upper=x0)
    for k in range(steps):
        problem.equality("dynamics", [x[k], u[k], x[k + 1]], ipm.Linear([A, B, -np.eye(n)]))
        problem.cost("state", [x[k]], ipm.Quadratic(Q))
        problem.least_squares("input", [u[k]], ipm.Linear(np.linalg.cholesky(R).T))
    problem.cost("last", [x[steps]], ipm.Quadratic(Q))
    result = ipm.solve(problem, **TIGHT)

    P, gains = Q, []
    for _ in range(steps):
        K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
        P = Q + A.T @ P @ (A - B @ K)
        gains.append(K)
    at, states, inputs = x0, [x0], []
    for K in reversed(gains):
        inputs.append(-K @ at)
        at = A @ at + B @ inputs[-1]
        states.append(at)
    assert result.status == mp.Status.solved, result
    assert result.x["x"] == pytest.approx(np.array(states), abs=1e-7)
    assert result.x["u"] == pytest.approx(np.array(inputs), abs=1e-7)
    assert result.objective == pytest.approx(0.5 * x0 @ P @ x0, rel=1e-8)
    assert result.iterations <= 3  # Newton's method on a quadratic program without inequalities


def journey(distance=2.0, steps=20, effort=1.0, limit=np.inf):
    """A mass [1 kg] from rest to rest over a distance [m] under forces [N] that are constant in each of some steps of one
    duration; least is the time [s] and `effort` times the integral of the squared force."""
    problem = ipm.Problem()
    T = problem.variables("T", 1, (0, steps), lower=0.1, upper=10.0, start=1.0)
    x = [problem.variables("x", 2, k, start=[distance * k / steps, 1.0]) for k in range(steps + 1)]
    u = [problem.variables("u", 1, k, lower=-limit, upper=limit) for k in range(steps)]
    problem.change(x[0], lower=0.0, upper=0.0)
    problem.change(x[-1], lower=[distance, 0.0], upper=[distance, 0.0])

    def step(T, x, u, y):
        h = T[0] / steps
        return [x[0] + h * x[1] + 0.5 * h * h * u[0] - y[0], x[1] + h * u[0] - y[1]]

    def jacobian(T, x, u, y):
        h = T[0] / steps
        return [
            [(x[1] + h * u[0]) / steps, 1.0, h, 0.5 * h * h, -1.0, 0.0],
            [u[0] / steps, 0.0, 1.0, h, 0.0, -1.0],
        ]

    def hessian(T, x, u, y, weights):
        H = np.zeros((6, 6))
        H[0, 0] = weights[0] * u[0] / steps**2
        H[2, 0] = weights[0] / steps
        H[3, 0] = (weights[0] * T[0] / steps + weights[1]) / steps
        return H

    squared = ipm.Function(
        lambda T, u: effort * T[0] / steps * u[0] ** 2,
        lambda T, u: effort / steps * np.array([u[0] ** 2, 2.0 * T[0] * u[0]]),
        lambda T, u, weights: weights[0] * effort / steps * np.array([[0.0, 0.0], [2.0 * u[0], 2.0 * T[0]]]),
    )
    for k in range(steps):
        problem.equality("step", [T, x[k], u[k], x[k + 1]], ipm.Function(step, jacobian, hessian))
        if effort > 0.0:
            problem.cost("effort", [T, u[k]], squared)
    problem.cost("time", [T], ipm.Linear([[1.0]]))
    return problem


@pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])
@pytest.mark.parametrize("steps", [4, 20])
def test_a_final_time_that_lasts_all_stages_is_that_of_the_closed_form(solver, steps):
    """Over n steps the least integral of u^2 is 12 d^2 / T^3 / (1 - 1/n^2), by forces that fall linearly."""
    problem = journey(steps=steps)
    assert ipm.check_derivatives(problem) == []
    result = ipm.solve(problem, solver=solver, tolerance=1e-7)
    effort = 12.0 * 2.0**2 / (1.0 - 1.0 / steps**2)
    T = (3.0 * effort) ** 0.25
    assert result.status == mp.Status.solved, result
    assert result.iterations < 20
    assert result.x["T"] == pytest.approx(T, rel=1e-5)
    assert result.objective == pytest.approx(T + effort / T**3, rel=1e-7)
    assert np.diff(result.x["u"][:, 0], 2) == pytest.approx(np.zeros(steps - 2), abs=1e-4)
    assert result.multipliers["step"].shape == (steps, 2)


@pytest.mark.parametrize("solver", ["ipm", "ipopt"])
def test_in_least_time_the_force_is_full_one_way_and_then_the_other(solver):
    result = ipm.solve(journey(effort=0.0, limit=3.0), solver=solver, tolerance=1e-7)
    assert result.status == mp.Status.solved, result
    assert result.x["T"] == pytest.approx(2.0 * np.sqrt(2.0 / 3.0), abs=1e-4)
    assert result.x["u"][:10, 0] == pytest.approx(3.0, abs=1e-2) and result.x["u"][10:, 0] == pytest.approx(
        -3.0, abs=1e-2
    )


def circle_fit(hessian):
    """Centre and radius of a circle by least squares of distances to points."""
    random = np.random.default_rng(5)
    angles = random.uniform(0.0, 2.0 * np.pi, 40)
    points = np.array([0.3, -0.4]) + 1.7 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points += 0.05 * random.normal(size=points.shape)

    def residuals(v):
        return np.linalg.norm(points - v[:2], axis=1) - v[2]

    def jacobian(v):
        away = v[:2] - points
        return np.hstack([away / np.linalg.norm(away, axis=1)[:, None], -np.ones((len(points), 1))])

    def curvature(v, weights):
        H = np.zeros((3, 3))
        for point, weight in zip(points, weights, strict=True):
            away, distance = v[:2] - point, np.linalg.norm(v[:2] - point)
            H[:2, :2] += weight * (np.eye(2) / distance - np.outer(away, away) / distance**3)
        return H

    problem = ipm.Problem()
    v = problem.variables("circle", 3, start=[0.0, 0.0, 1.0])
    function = ipm.Function(residuals, jacobian, curvature if hessian else None)
    problem.least_squares("fit", [v], function, weights=2.0)
    return problem, residuals, jacobian


@pytest.mark.parametrize("hessian", [True, False])
def test_least_squares_need_no_hessian_and_end_where_the_gradient_vanishes(hessian):
    problem, residuals, jacobian = circle_fit(hessian)
    assert ipm.check_derivatives(problem) == []
    result = ipm.solve(problem, **TIGHT)
    assert result.status == mp.Status.solved, result
    v = result.x["circle"][0]
    assert jacobian(v).T @ residuals(v) == pytest.approx(np.zeros(3), abs=1e-7)
    assert result.objective == pytest.approx(np.sum(residuals(v) ** 2), rel=1e-9)
    assert v == pytest.approx([0.3, -0.4, 1.7], abs=0.05)


def test_a_problem_without_a_solution_is_infeasible_and_names_the_rows():
    problem = ipm.Problem()
    x = [problem.variables("x", 2, k, lower=-1.0, upper=1.0) for k in range(4)]
    for k in range(3):
        problem.equality("shift", [x[k], x[k + 1]], ipm.Linear([np.eye(2), -np.eye(2)], [0.0, 0.5]))
    problem.inequality("too_far", [x[3]], ipm.Linear([[1.0, 0.0], [0.0, 1.0]]), lower=[-np.inf, 3.0])
    for solver in ("ipm", "auto"):
        result = ipm.solve(problem, solver=solver)
        assert result.status == mp.Status.infeasible
        assert result.worst in {"too_far[1] at stage 3", *(f"shift[1] at stage {k}" for k in (1, 2, 3))}
        names = [name for name, _ in result.violations]
        assert "too_far[1] at stage 3" in names and not any("[0]" in name for name in names)
        assert result.violations[0] == (result.worst, result.violation)
        assert np.isnan(result.bound_multipliers["x"]).all()


def test_a_solve_begins_where_another_ended_and_bounds_may_have_changed():
    problem = journey()
    first = ipm.solve(problem)
    again = ipm.solve(problem, first, initial_barrier=1e-4)
    costs = [float(result.table.splitlines()[1].split()[1]) for result in (first, again)]  # at their starts
    assert costs == pytest.approx([1.0, first.objective], rel=1e-5)
    T = next(iter(problem._groups))
    problem.change(T, lower=2.5, upper=2.5)
    fixed = ipm.solve(problem, first)
    assert fixed.status == mp.Status.solved and fixed.x["T"][0, 0] == 2.5


def test_limits_of_iterations_and_time_are_kept_and_the_best_point_returned():
    problem = journey()
    short = ipm.solve(problem, max_iterations=2)
    assert short.status == mp.Status.iteration_limit and short.iterations == 2
    assert len(short.table.splitlines()) == 4  # a head, the start and two iterations
    late = ipm.solve(problem, time_limit_s=1e-6)
    assert late.status == mp.Status.time_limit and late.x["x"].shape == (21, 2)


def test_lines_of_the_table_are_logged_as_they_come():
    lines: list[str] = []
    result = ipm.solve(journey(), log=lines.append)
    assert "\n".join(lines) + "\n" == result.table


def test_results_do_not_depend_on_the_threads_that_solve_at_once():
    alone = ipm.solve(journey())
    shared, results = journey(), []

    def run():
        results.extend(ipm.solve(problem) for problem in (shared, journey()))

    threads = [threading.Thread(target=run) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 8
    for result in results:
        assert result.table == alone.table and (result.x["x"] == alone.x["x"]).all()


def test_a_function_may_solve_a_problem_itself():
    inner = ipm.Problem()
    y = inner.variables("y", 1)
    inner.cost("cost", [y], ipm.Quadratic([[2.0]], [-6.0]))

    def value(x):
        return x[0] ** 2 - ipm.solve(inner).x["y"][0, 0] * x[0]  # x^2 - 3 x

    problem = ipm.Problem()
    x = problem.variables("x", 1)
    problem.cost("cost", [x], ipm.Function(value, lambda x: 2.0 * x - 3.0, lambda x, w: 2.0 * w))
    assert ipm.solve(problem).x["x"][0, 0] == pytest.approx(1.5, abs=1e-4)


def test_a_result_reads_as_a_line_and_cannot_be_written_to():
    result = ipm.solve(journey())
    assert str(result).startswith(f"solved after {result.iterations} iterations and ")
    with pytest.raises(ValueError, match="read-only"):
        result.x["x"][0] = 1.0
    with pytest.raises(TypeError):
        result.x["x"] = np.zeros(2)


@pytest.mark.parametrize(("chain", "single"), [(2, 0), (4, 6), (5, 0)])
def test_fixed_last_states_that_take_different_numbers_of_inputs_are_one_linear_system(chain, single):
    """A chain of integrators with an input at its end, beside integrators with an input each; least squares of inputs."""
    n, m, steps, h = chain + single, 1 + single, 12, 0.1
    A, B = np.eye(n), np.zeros((n, m))
    A[range(chain - 1), range(1, chain)] = h
    B[chain - 1, 0] = h
    B[range(chain, n), range(1, m)] = h
    problem = ipm.Problem()
    x = [problem.variables("x", n, k) for k in range(steps + 1)]
    u = [problem.variables("u", m, k) for k in range(steps)]
    problem.change(x[0], lower=0.0, upper=0.0)
    problem.change(x[-1], lower=1.0, upper=1.0)
    for k in range(steps):
        problem.equality("step", [x[k], u[k], x[k + 1]], ipm.Linear([A, B, -np.eye(n)]))
        problem.cost("effort", [u[k]], ipm.Quadratic(np.eye(m)))
    result = ipm.solve(problem, tolerance=1e-6)
    reach = np.hstack([np.linalg.matrix_power(A, steps - 1 - k) @ B for k in range(steps)])
    least = np.linalg.pinv(reach) @ np.ones(n)
    assert result.status == mp.Status.solved and result.iterations <= 2
    assert result.x["u"].ravel() == pytest.approx(least, rel=1e-6, abs=1e-6 * np.abs(least).max())
