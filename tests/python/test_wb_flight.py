"""A hop of a quadruped, from the example: certified with all limits on, and landed in simulation."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp  # noqa: E402
from mcplan.wb import MotionResult  # noqa: E402
from mcplan.wb.flights import (  # noqa: E402
    FADE_S,
    LEAST_LOAD,
    MOST_LOAD,
    NEAR_ACCELERATION,
    NEAR_S,
    NEAR_TORQUE,
    RAMP_S,
    Flights,
)
from mcplan.wb.moving_joints import MovingRobot  # noqa: E402
from mcplan.wb.solve import _Search  # noqa: E402

FLIGHT_S = 0.22
EXAMPLE = Path(__file__).resolve().parents[2] / "examples/09_hop.py"


@pytest.fixture(scope="module")
def example() -> ModuleType:
    spec = importlib.util.spec_from_file_location("hop", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def hop(example: ModuleType) -> MotionResult:
    return mp.motion(example.hop(mp.load_robot("go2"), FLIGHT_S, push_s=0.3, rise_m=-0.02, lift_m=0.02))


def test_a_push_off_is_what_newton_says(example: ModuleType):
    rng = np.random.default_rng(0)
    for _ in range(10):
        steps, rise, speed = int(rng.integers(8, 30)), rng.uniform(-0.1, 0.1), rng.uniform(0.2, 1.5)
        force = example.push_off(steps, rise, speed)
        times = np.linspace(0.0, steps * example.STEP_S, 200 * steps + 1)
        force = np.interp(times, example.STEP_S * np.arange(steps + 1), force)
        velocity = np.concatenate([[0.0], np.cumsum(np.diff(times) * (force[1:] + force[:-1] - 2.0) / 2.0)])
        height = np.sum(np.diff(times) * (velocity[1:] + velocity[:-1]) / 2.0)
        assert example.GRAVITY * velocity[-1] == pytest.approx(speed, abs=1e-6)
        assert example.GRAVITY * height == pytest.approx(rise, abs=1e-6)


def test_forces_come_and_go_on_ramps_beside_a_flight_and_nowhere_else(hop: MotionResult):
    """A flight from 0.6 to 0.75 s: what is limited, by how much, and where factors of weights hold."""
    contact = SimpleNamespace(start_s=0.0, end_s=0.6)
    flights = Flights(np.array([0.6]), np.array([0.75]))
    assert flights.load_max(contact, 0.6) == pytest.approx(LEAST_LOAD)
    assert flights.load_max(contact, 0.6 - 0.5 * RAMP_S) == pytest.approx(0.5 * (LEAST_LOAD + MOST_LOAD))
    assert flights.load_max(contact, 0.6 - 1.01 * RAMP_S) == np.inf
    landed = SimpleNamespace(start_s=0.75, end_s=2.0)
    assert flights.load_max(landed, 0.75) == pytest.approx(LEAST_LOAD)
    assert flights.load_max(landed, 1.99) == np.inf
    assert flights.load_max(SimpleNamespace(start_s=0.0, end_s=0.59), 0.59) == np.inf  # another foot is still down
    assert flights.factors(0.7) == flights.factors(0.56) == (NEAR_ACCELERATION, NEAR_TORQUE)
    assert flights.factors(0.4) == flights.factors(1.0) == (1.0, 1.0)
    between = flights.factors(0.6 - NEAR_S - 0.5 * FADE_S)
    assert between == pytest.approx((NEAR_ACCELERATION**0.5, NEAR_TORQUE**0.5))
    never = Flights(np.zeros(0), np.zeros(0))
    assert never.factors(0.3) == (1.0, 1.0) and never.load_max(contact, 0.6) == np.inf

    # The motion keeps to them: four feet bear 4 x 0.4 weights in the last node before the flight at most.
    weight = hop.motion.plan.robot.mass * hop.motion.plan.scene.gravity
    away_s = np.array([1e-6, 0.02, 0.05])
    loads = hop.motion.forces(0.6 - away_s).sum(axis=2)[:, :, 2] / weight
    limits = LEAST_LOAD + (MOST_LOAD - LEAST_LOAD) * away_s / RAMP_S
    assert (loads <= limits[:, None] + 0.01).all() and loads[2].sum() > 0.5


def test_derivatives_beside_flights_are_those_of_differences(example: ModuleType):
    plan = example.hop(mp.load_robot("go2"), FLIGHT_S, push_s=0.3, rise_m=-0.02, lift_m=0.02)
    search = _Search.of(MovingRobot.of(plan, "default"), 0.1)
    rng = np.random.default_rng(8)
    x = search.start("follow")
    x = x + 0.05 * rng.standard_normal(x.size)
    for _ in range(3):
        step, length = rng.standard_normal(x.size), 1e-5
        slopes = search.solver.slopes(x, step)
        after, before = (search.solver.values(x + sign * length * step) for sign in (1.0, -1.0))
        differences = [(np.asarray(a) - np.asarray(b)) / (2.0 * length) for a, b in zip(after, before, strict=True)]
        for slope, expected in zip(slopes, differences, strict=True):
            assert np.abs(slope - expected).max() <= 1e-6 * np.abs(expected).max()


def test_a_hop_is_certified_with_its_flight(hop: MotionResult):
    assert str(hop.status) == "solved", str(hop.report)
    mp.check(hop.motion).raise_if_violated()
    free = (hop.motion.contacts < 0).all(axis=1)
    assert np.diff(hop.motion.times_s)[free].sum() == pytest.approx(FLIGHT_S, abs=1e-9)
    feet = hop.motion.sample(np.array([0.6 + FLIGHT_S / 2.0])).end_effectors_W[0]
    assert feet[:, 2].min() > 0.01


@pytest.mark.slow
def test_a_hop_is_landed_whatever_the_seed_changes(hop: MotionResult):
    pytest.importorskip("mujoco")
    pytest.importorskip("proxsuite")
    fell = [seed for seed in range(1, 21) if not mp.track(hop.motion, seed=seed, hold_s=0.5).completed]
    assert fell == []
