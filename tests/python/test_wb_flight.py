"""A hop of a quadruped, from the example: certified with all limits on, and landed in simulation."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp  # noqa: E402
from mcplan.wb import MotionResult  # noqa: E402

FLIGHT_S = 0.15
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
