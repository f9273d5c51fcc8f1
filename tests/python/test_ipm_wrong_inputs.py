"""Whatever a user's problem says or its functions do ends in one typed error that says where, or in a status."""

from __future__ import annotations

import gc
import os
import signal
import sys
import threading
import weakref

import numpy as np
import pytest

import mcplan as mp
from mcplan import ipm
from mcplan.errors import InvalidArgument, InvalidInput, InvalidOptions

SOLVERS = pytest.mark.parametrize("solver", ["ipm", "ipopt", "auto"])


def with_function(value=None, jacobian=None, hessian=None):
    """Three stages of two variables, and at stage 2 the block "lane": a circle around zero. Any function may be replaced."""
    problem = ipm.Problem()
    x = [problem.variables("x", 2, k, lower=-3.0, upper=3.0, start=[0.5, 0.4]) for k in range(3)]
    calls = {"at": -1}

    def counted(x):
        calls["at"] += 1
        return value(x, calls["at"])

    function = ipm.Function(
        counted if value else lambda x: [x @ x],
        jacobian or (lambda x: 2.0 * x),
        hessian or (lambda x, weights: 2.0 * weights[0] * np.eye(2)),
    )
    problem.inequality("lane", [x[2]], function, lower=1.0, upper=4.0)
    for k in range(2):
        problem.equality("shift", [x[k], x[k + 1]], ipm.Linear([np.eye(2), -np.eye(2)]))
        problem.cost("near", [x[k]], ipm.Quadratic(np.eye(2), [-1.5, 0.0]))
    return problem


def test_the_problem_without_a_fault_is_solved():
    problem = with_function()
    assert ipm.check_derivatives(problem) == []
    result = ipm.solve(problem)
    assert result.status == mp.Status.solved and result.x["x"][0] == pytest.approx([1.5, 0.0], abs=1e-3)


def good_first(bad):
    """What is right when the block is added, and then is not."""
    return lambda x, call: [x @ x] if call == 0 else bad


@SOLVERS
@pytest.mark.parametrize(
    ("functions", "field", "rule", "value"),
    [
        ({"value": good_first([1.0, 2.0])}, "value", "must return a number", "shape 2"),
        ({"value": good_first(None)}, "value", "must return a number", "None"),
        ({"value": good_first("1.0")}, "value", "must return a number", "str"),
        ({"value": good_first(1j)}, "value", "must return a number", "complex"),
        ({"value": good_first([[1.0], [2.0, 3.0]])}, "value", "must return a number", "list"),
        ({"jacobian": lambda x: np.zeros((2, 1))}, "jacobian", "must return an array of 1 x 2 numbers", "shape 2 x 1"),
        ({"jacobian": lambda x: [1.0, 2.0, 3.0]}, "jacobian", "must return an array of 1 x 2 numbers", "shape 3"),
        ({"hessian": lambda x, w: np.eye(3)}, "hessian", "must return an array of 2 x 2 numbers", "shape 3 x 3"),
        ({"hessian": lambda x, w: [object()]}, "hessian", "must return an array of 2 x 2 numbers", "list"),
    ],
)
def test_a_function_that_returns_something_else_is_named_with_its_block_and_stage(
    solver, functions, field, rule, value
):
    with pytest.raises(InvalidInput) as found:
        ipm.solve(with_function(**functions), solver=solver)
    error = found.value
    assert (error.field, error.rule, error.value) == (f"lane at stage 2: {field}", rule, value)


@SOLVERS
@pytest.mark.parametrize("name", ["value", "jacobian", "hessian"])
@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_what_is_not_finite_is_a_status_that_names_its_block(solver, name, number):
    functions = {
        "value": {"value": lambda x, call: [number if call else x @ x]},
        "jacobian": {"jacobian": lambda x: [number, 1.0]},
        "hessian": {"hessian": lambda x, w: np.full((2, 2), number)},
    }
    result = ipm.solve(with_function(**functions[name]), solver=solver)
    assert result.status == mp.Status.numerical_failure
    assert result.message == "not finite: constraint lane at stage 2"


class OwnError(Exception):
    """What a user's function raises."""


@SOLVERS
@pytest.mark.parametrize("kind", [OwnError, ZeroDivisionError, SystemExit, GeneratorExit])
@pytest.mark.parametrize("name", ["value", "jacobian", "hessian"])
def test_what_a_function_raises_comes_out_as_it_is_with_a_note(solver, kind, name):
    raised = kind("of my own")

    def fails(*given):
        if name == "value" and given[1] == 0:
            return given[0] @ given[0]
        raise raised

    with pytest.raises(kind) as found:
        ipm.solve(with_function(**{name: fails}), solver=solver)
    assert found.value is raised
    if sys.version_info >= (3, 11):
        assert found.value.__notes__ == [f"raised by '{name}' of lane at stage 2"]


def test_what_a_logger_raises_comes_out():
    def fails(line):
        raise OwnError

    with pytest.raises(OwnError):
        ipm.solve(with_function(), log=fails)


@pytest.mark.usefixtures("ctrl_c")
@SOLVERS
def test_ctrl_c_within_a_function_ends_the_solve_with_the_best_point(solver):
    def value(x, call):
        if call == 6:
            os.kill(os.getpid(), signal.SIGINT)
        return [x @ x]

    with pytest.raises(mp.Interrupted) as stop:
        for _ in range(100):
            ipm.solve(with_function(value), solver=solver)
    result = stop.value.result
    assert isinstance(result, ipm.Result) and result.status == mp.Status.interrupted
    assert result.message == "stopped by the caller"
    assert np.isfinite(result.x["x"]).all()


@pytest.mark.usefixtures("ctrl_c")
def test_ctrl_c_ends_a_solve_that_calls_no_function():
    problem = ipm.Problem()
    x = [problem.variables("x", 30, k) for k in range(300)]
    for k in range(299):
        problem.equality("shift", [x[k], x[k + 1]], ipm.Linear([np.eye(30), -np.eye(30)], 0.1))
        problem.cost("near", [x[k]], ipm.Quadratic(np.eye(30)))
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            ipm.solve(problem)
    timer.join()


def build(**change):
    """One stage with one variable and one row, whose arguments may be replaced."""
    problem = ipm.Problem()
    given = {"name": "x", "size": 2, "stage": 0, "lower": -1.0, "upper": 1.0, "start": 0.0} | change
    return problem, problem.variables(given.pop("name"), given.pop("size"), given.pop("stage"), **given)


@pytest.mark.parametrize(
    ("change", "error", "text"),
    [
        ({"name": 3}, InvalidArgument, "name: must be a str, got 3"),
        ({"name": ""}, InvalidInput, "name: must be a name that can be printed"),
        ({"size": 0}, InvalidInput, "x: size: must lie in"),
        ({"size": 2.0}, InvalidArgument, "x: size: must be a whole number, got 2.0"),
        ({"size": True}, InvalidArgument, "x: size: must be a whole number"),
        ({"size": 10**30}, InvalidInput, "x: size: must lie in"),
        ({"stage": -1}, InvalidInput, "x: stage: must lie in"),
        ({"stage": (3, 1)}, InvalidInput, "x: stage: must lie in"),
        ({"stage": "0"}, InvalidArgument, "x: stage: must be a whole number"),
        ({"stage": (0, 1, 2)}, InvalidArgument, "x: stage: must be a whole number, or a first and a last one"),
        ({"lower": float("inf"), "upper": float("inf")}, InvalidInput, r"lower\[0\]: must lie below infinity, got inf"),
        (
            {"lower": -float("inf"), "upper": [1.0, -float("inf")]},
            InvalidInput,
            r"upper\[1\]: must lie above minus inf",
        ),
        ({"lower": [0.0, 2.0]}, InvalidInput, r"x at stage 0: lower\[1\]: must not lie above upper\[1\] = 1, got 2"),
        ({"lower": [0.0] * 3}, InvalidInput, "x at stage 0: lower: must be 2 numbers or one for all, got 3 numbers"),
        ({"upper": float("nan")}, InvalidInput, "x at stage 0: upper: must be numbers, got nan"),
        ({"start": float("inf")}, InvalidInput, "x at stage 0: start: must be finite, got inf"),
        ({"start": "0"}, InvalidArgument, "x at stage 0: start: must be an array of numbers"),
        ({"start": [[0.0, 1.0]]}, InvalidInput, "x at stage 0: start: must be a number or a list of numbers"),
    ],
)
def test_variables_are_refused_by_name(change, error, text):
    with pytest.raises(error, match=text):
        build(**change)


def test_blocks_are_refused_by_name():
    problem, x = build()
    _, other = build()
    one = ipm.Linear([[1.0, 1.0]])
    square = ipm.Function(lambda x: x @ x, lambda x: 2.0 * x)
    with pytest.raises(InvalidInput, match="x at stage 0: is there already"):
        problem.variables("x", 2)
    with pytest.raises(InvalidInput, match="x at stage 1: size: must be 2 as at stage 0, or have another name, got 3"):
        problem.variables("x", 3, 1)
    with pytest.raises(InvalidInput, match=r"row: variables\[0\]: must be variables of this problem"):
        problem.equality("row", [other], one)
    with pytest.raises(InvalidInput, match=r"row: variables\[1\]: must be in the list once"):
        problem.equality("row", [x, x], one)
    for wrong in (x, [], "x", None, [0]):
        with pytest.raises(InvalidArgument, match="row: variables"):
            problem.equality("row", wrong, one)
    with pytest.raises(InvalidInput, match="row: matrix: must have 2 columns, the size of its variables, got 3"):
        problem.equality("row", [x], ipm.Linear([[1.0, 1.0, 1.0]]))
    with pytest.raises(InvalidArgument, match="row: function: must be a Function or a Linear, got a Quadratic"):
        problem.equality("row", [x], ipm.Quadratic(np.eye(2)))
    with pytest.raises(InvalidInput, match="row: must have 1 rows as before, or another name, got 2"):
        problem.equality("row", [x], one)
        problem.equality("row", [x], ipm.Linear(np.eye(2)))
    with pytest.raises(InvalidInput, match=r"band: lower\[0\]: must not lie above upper\[0\] = 1, got 2"):
        problem.inequality("band", [x], one, lower=2.0, upper=1.0)
    with pytest.raises(InvalidInput, match=r"band: upper\[0\]: must lie above minus infinity, got -inf"):
        problem.inequality("band", [x], one, upper=-np.inf)
    with pytest.raises(
        InvalidInput, match=r"fit: matrix: must have squares that are finite, got numbers up to 1e\+200"
    ):
        problem.least_squares("fit", [x], ipm.Linear([[1e200, 1.0]]))
    with pytest.raises(InvalidInput, match="sum: must be one number: a cost"):
        problem.cost("sum", [x], ipm.Linear(np.eye(2)))
    with pytest.raises(InvalidInput, match="fit: weights: must not be negative, got -1"):
        problem.least_squares("fit", [x], one, weights=-1.0)
    for add in (problem.cost, problem.equality, problem.inequality):
        with pytest.raises(InvalidArgument, match=r"curved: hessian: must be given: hessian\(\*v, weights\)"):
            add("curved", [x], square)
    problem.least_squares("fit", [x], square)


@pytest.mark.parametrize(
    ("make", "error", "text"),
    [
        (lambda: ipm.Function(3, print), InvalidArgument, "value: must be a function, got 3"),
        (lambda: ipm.Function(print, print, 3), InvalidArgument, "hessian: must be a function"),
        (lambda: ipm.Linear([1.0, 2.0]), InvalidInput, "matrix: must be a matrix, got shape 2"),
        (lambda: ipm.Linear([[1.0], [1.0, 2.0]]), InvalidArgument, "matrix: must be an array of numbers"),
        (
            lambda: ipm.Linear([np.eye(2), np.eye(3)]),
            InvalidInput,
            r"matrix\[1\]: must have 2 rows, as matrix\[0\] has",
        ),
        (lambda: ipm.Linear(np.eye(2), [1.0] * 3), InvalidInput, "constant: must be 2 numbers or one for all"),
        (lambda: ipm.Quadratic(np.ones((2, 3))), InvalidInput, "matrix: must be square, got shape 2 x 3"),
        (lambda: ipm.Quadratic([[np.nan]]), InvalidInput, "matrix: must be finite, got nan"),
    ],
)
def test_functions_of_blocks_are_refused_by_name(make, error, text):
    with pytest.raises(error, match=text):
        make()


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"tolerance": 0.0}, InvalidOptions, "tolerance: must be a positive number, got 0"),
        ({"tolerance": "1"}, InvalidArgument, "tolerance: must be a number"),
        ({"constraint_tolerance": float("nan")}, InvalidOptions, "constraint_tolerance"),
        ({"max_iterations": -1}, InvalidOptions, "max_iterations: must be at least 0"),
        ({"max_iterations": 1.5}, InvalidArgument, "max_iterations: must be a whole number"),
        ({"time_limit_s": 0.0}, InvalidOptions, "time_limit_s: must be a positive number"),
        ({"solver": "snopt"}, InvalidOptions, "solver: must be one of ipopt, ipm, auto"),
        ({"solver": 3}, InvalidArgument, "solver: must be one of ipopt, ipm, auto"),
        ({"log": 3}, InvalidArgument, "log: must be a function"),
        ({"start": {}}, InvalidArgument, "start: must be a Result or None"),
    ],
)
def test_options_are_refused_by_name(options, error, text):
    with pytest.raises(error, match=text):
        ipm.solve(with_function(), **options)


def test_an_empty_problem_and_the_result_of_another_one_are_refused():
    with pytest.raises(InvalidInput, match="problem: must have variables"):
        ipm.solve(ipm.Problem())
    other = ipm.Problem()
    other.variables("x", 2)
    with pytest.raises(InvalidInput, match="x: must be an array of 3 x 2 numbers, got shape 1 x 2"):
        ipm.solve(with_function(), ipm.solve(other))
    other.variables("y", 2)
    with pytest.raises(InvalidInput, match="at: must have variables 'y'"):
        ipm.check_derivatives(other, {"x": [[0.0, 0.0]]})


def test_wrong_derivatives_are_found_by_block_variable_and_kind():
    first, second = (
        ipm.check_derivatives(
            with_function(
                jacobian=lambda x: [2.0 * x[0], 3.0 * x[1]], hessian=lambda x, w: np.diag([2.0, 3.0]) * w[0] + 1e-9
            )
        ),
        ipm.check_derivatives(with_function(hessian=lambda x, w: np.zeros((2, 2)))),
    )
    assert [(w.block, w.kind, w.row, w.variables) for w in first] == [
        ("lane at stage 2", "jacobian", 0, ("x[1] at stage 2",))
    ]
    assert first[0].given == pytest.approx(1.2) and first[0].difference == pytest.approx(0.8)
    assert str(first[0]) == "lane at stage 2: jacobian, row 0, d/d x[1] at stage 2: 1.2, central difference 0.8"
    assert [(w.kind, w.variables) for w in second] == [
        ("hessian", (f"x[{i}] at stage 2", f"x[{i}] at stage 2")) for i in range(2)
    ]


def test_least_squares_are_checked_by_their_residuals():
    problem = ipm.Problem()
    x = problem.variables("x", 1, start=1.0)
    problem.least_squares("fit", [x], ipm.Function(lambda x: x**2 - 1.0, lambda x: x))  # zero at the start
    assert [(w.block, w.kind) for w in ipm.check_derivatives(problem)] == [("fit at stage 0", "jacobian")]


def test_functions_may_keep_and_change_their_arguments_and_add_to_the_problem():
    kept = []

    def value(x, call):
        kept.append(x)
        problem.variables("later", 1, len(kept))
        out = x @ x
        x[:] = np.nan
        return out

    problem = ipm.Problem()
    problem = with_function(value)
    assert ipm.solve(problem).status == mp.Status.solved
    assert len(kept) > 3


def test_a_problem_whose_functions_refer_to_it_is_collected():
    problem = ipm.Problem()
    x = problem.variables("x", 1)
    problem.least_squares("fit", [x], ipm.Function(lambda v: v - len(problem._groups), lambda v: 1.0))
    assert ipm.solve(problem).x["x"][0, 0] == pytest.approx(1.0)
    seen = weakref.ref(problem)
    problem = None
    gc.collect()
    assert seen() is None
