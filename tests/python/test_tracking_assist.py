"""The wrench of the assistance: a spring and a damper, clipped."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mcplan.tracking.assist import (
    FORCE_KD,
    FORCE_KP,
    LARGEST_FORCE,
    LARGEST_MOMENT,
    MOMENT_KD,
    MOMENT_KP,
    assistance,
)

GOAL = Rotation.from_euler("ZYX", [0.4, -0.2, 0.1])
COM = np.array([0.3, -0.1, 0.8])


@pytest.fixture
def desired():
    return SimpleNamespace(
        com_W=COM[None],
        com_velocity_W=np.zeros((1, 3)),
        base_WB=GOAL.as_matrix()[None],
        base_velocity_W=np.zeros((1, 3)),
    )


def wrench(desired, mass=90.0, off=(0, 0, 0), speed=(0, 0, 0), turn=(0, 0, 0), rate=(0, 0, 0)):
    dynamics = SimpleNamespace(
        mass=mass,
        com_W=COM + off,
        com_velocity_W=np.array(speed, float),
        base_WB=(Rotation.from_rotvec(turn) * GOAL).as_matrix(),
        base_velocity_W=np.array(rate, float),
    )
    return assistance(dynamics, desired, 0)


def test_nothing_is_held_that_is_where_it_should_be(desired):
    np.testing.assert_allclose(wrench(desired), 0.0, atol=1e-12)


def test_it_pulls_back_in_proportion(desired):
    off, speed = np.array([0.01, -0.02, 0.005]), np.array([0.02, 0.03, -0.01])
    np.testing.assert_allclose(wrench(desired, off=off, speed=speed)[:3], -FORCE_KP * off - FORCE_KD * speed)
    turn, rate = np.array([0.01, -0.02, 0.015]), np.array([0.05, 0.1, -0.1])
    found = wrench(desired, turn=turn, rate=rate)
    np.testing.assert_allclose(found[3:], -MOMENT_KP * turn - MOMENT_KD * rate, atol=0.01)
    np.testing.assert_allclose(found[:3], 0.0, atol=1e-9)


def test_light_robots_are_held_more_softly(desired):
    off = np.array([0.004, 0.0, 0.001])
    np.testing.assert_allclose(wrench(desired, mass=30.0, off=off), wrench(desired, off=off) / 3.0)


@pytest.mark.parametrize("mass", [30.0, 90.0])
def test_it_is_clipped_in_size_and_not_in_direction(desired, mass):
    rng = np.random.default_rng(3)
    for _ in range(20):
        off, turn = rng.normal(size=3), rng.uniform(-0.6, 0.6, 3)
        found = wrench(desired, mass=mass, off=off, turn=turn, rate=3.0 * rng.normal(size=3))
        assert np.linalg.norm(found[:3]) <= LARGEST_FORCE * mass * 9.81 * (1 + 1e-12)
        assert np.linalg.norm(found[3:]) <= LARGEST_MOMENT * mass * 9.81 * (1 + 1e-12)
        towards = -off / np.linalg.norm(off)
        np.testing.assert_allclose(found[:3] / np.linalg.norm(found[:3]), towards, atol=1e-9)
