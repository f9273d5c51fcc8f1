"""The cart-pole of examples/cart_pole: its dynamics, its limits, another solver, and its twin in C++."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from mcplan import ipm

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location("cart_pole", ROOT / "examples/cart_pole.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def result(example):
    return ipm.solve(example.swing_up(), tolerance=1e-7, constraint_tolerance=1e-7)


def test_it_swings_up_within_its_limits_which_it_reaches(example, result):
    assert result.status == mp.Status.solved, result
    x, force = result.x["x"], result.x["u"][:, 0]
    assert x[0].tolist() == [0.0] * 4 and x[-1] == pytest.approx([0.0, np.pi, 0.0, 0.0], abs=1e-12)
    assert np.abs(x[:, 0]).max() == pytest.approx(example.RAIL, abs=1e-4)
    assert np.abs(force).max() == pytest.approx(example.FORCE, abs=1e-4)
    assert np.abs(x[:, 0]).max() <= example.RAIL and np.abs(force).max() <= example.FORCE
    h = np.full(example.STEPS + 1, example.STEP)
    h[[0, -1]] /= 2.0
    assert result.objective == pytest.approx(h @ force**2, rel=1e-9)


def rates(example, x, force):
    """The equations of motion solved for the accelerations, from Lagrange's function by energy and momentum."""
    _, angle, velocity, omega = x
    M, m, length, g = example.CART, example.POLE, example.LENGTH, example.GRAVITY
    inertia = np.array([[M + m, m * length * np.cos(angle)], [m * length * np.cos(angle), m * length**2]])
    forces = np.array([force + m * length * omega**2 * np.sin(angle), -m * g * length * np.sin(angle)])
    return np.concatenate([[velocity, omega], np.linalg.solve(inertia, forces)])


def largest_error_of_a_step(example):
    """Between a step of the solution and its dynamics integrated from the same state, under forces linear in time."""
    integrate = pytest.importorskip("scipy.integrate")
    solved = ipm.solve(example.swing_up(), tolerance=1e-7, constraint_tolerance=1e-7)
    assert solved.status == mp.Status.solved, solved
    x, force = solved.x["x"], solved.x["u"][:, 0]
    errors = []
    for k in range(example.STEPS):

        def slope(t, state, k=k):
            part = t / example.STEP
            return rates(example, state, (1.0 - part) * force[k] + part * force[k + 1])

        end = integrate.solve_ivp(slope, (0.0, example.STEP), x[k], rtol=1e-10, atol=1e-12).y[:, -1]
        errors.append(np.abs(end - x[k + 1]).max())
    return max(errors)


def test_each_step_is_that_of_the_dynamics_but_for_the_trapezoids_error(example, monkeypatch):
    coarse = largest_error_of_a_step(example)
    assert coarse < 0.1
    monkeypatch.setattr(example, "STEPS", 2 * example.STEPS)
    monkeypatch.setattr(example, "STEP", example.STEP / 2.0)
    assert largest_error_of_a_step(example) < coarse / 5.0  # the third power of the step: an eighth


@pytest.mark.parametrize("solver", ["ipopt", "auto"])
def test_other_solvers_find_the_same_motion(example, result, solver):
    other = ipm.solve(example.swing_up(), solver=solver, tolerance=1e-7, constraint_tolerance=1e-7)
    assert other.status == mp.Status.solved
    assert other.objective == pytest.approx(result.objective, rel=1e-5)
    assert other.x["x"] == pytest.approx(result.x["x"], abs=1e-4)
    assert other.multipliers["motion"] == pytest.approx(result.multipliers["motion"], abs=1e-2)


def numbers(text):
    return [float(found) for found in re.findall(r"-?\d+\.\d+", text)], re.sub(r"-?\d+\.\d+", "", text).split()


def test_the_twin_in_cpp_prints_the_same_numbers():
    built = sorted((ROOT / "build").glob("*/examples/example_cart_pole"))
    if not built:
        pytest.skip("the C++ examples are not built: scripts/test builds them")
    twin = max(built, key=lambda path: path.stat().st_mtime)
    ours = subprocess.run([sys.executable, ROOT / "examples/cart_pole.py"], capture_output=True, text=True, check=True)
    theirs = subprocess.run([twin], capture_output=True, text=True, check=True)
    (a, words), (b, other_words) = numbers(ours.stdout), numbers(theirs.stdout)
    assert words == other_words and len(a) == 29 and ours.stderr == theirs.stderr == ""
    assert a == pytest.approx(b, abs=2e-4)
