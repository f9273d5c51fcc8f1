"""Motors: the line of torque over speed, delay and lag."""

import numpy as np
import pytest

from mcplan.tracking.actuators import KNEE, Lag, TorqueSpeed

MOTORS = TorqueSpeed.of(np.array([10.0, 20.0, 30.0]), np.array([5.0, 2.0, 0.0]))


def test_torque_falls_along_a_line_to_nothing_at_the_velocity_limit():
    for fraction, left in ((0.0, 1.0), (KNEE, 1.0), (0.5 * (1.0 + KNEE), 0.5), (1.0, 0.0)):
        low, high = MOTORS.bounds(fraction * np.array([5.0, 2.0, 100.0]))
        np.testing.assert_allclose(high, [10.0 * left, 20.0 * left, 30.0], atol=1e-12)
        np.testing.assert_allclose(low, [-10.0, -20.0, -30.0])  # braking is unreduced
        low, high = MOTORS.bounds(-fraction * np.array([5.0, 2.0, 100.0]))
        np.testing.assert_allclose(low, [-10.0 * left, -20.0 * left, -30.0], atol=1e-12)
        np.testing.assert_allclose(high, [10.0, 20.0, 30.0])


def test_bounds_are_never_crossed_and_never_beyond_the_torque_limits():
    for speed in np.random.default_rng(4).normal(scale=30.0, size=(200, 3)):
        low, high = MOTORS.bounds(speed)
        assert (low <= high).all() and (np.abs([low, high]) <= MOTORS.torque_limits).all()


def test_without_speed_limits_torque_is_full_at_every_speed():
    free = TorqueSpeed.of(MOTORS.torque_limits, np.array([5.0, 2.0, 0.0]), limited=False)
    low, high = free.bounds(np.array([50.0, -50.0, 1e3]))
    np.testing.assert_array_equal([low, high], [-free.torque_limits, free.torque_limits])


def test_torques_come_as_late_as_the_delay():
    lag = Lag(0.001, delay_s=0.003)
    assert lag.acts
    given = [float(lag.after(np.array([told]))[0]) for told in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)]
    assert given == [1.0, 1.0, 1.0, 1.0, 2.0, 3.0]


def test_a_step_of_torque_rises_by_the_time_constant_of_the_bandwidth():
    bandwidth_hz = 20.0
    lag = Lag(0.001, bandwidth_hz=bandwidth_hz)
    lag.after(np.zeros(1))
    count = 50
    for _ in range(count):
        given = lag.after(np.ones(1))
    assert given[0] == pytest.approx(1.0 - np.exp(-2.0 * np.pi * bandwidth_hz * 0.001 * count))


def test_a_motor_without_lag_gives_what_it_is_told():
    lag = Lag(0.001)
    assert not lag.acts
    assert [float(lag.after(np.array([told]))[0]) for told in (1.0, -2.0)] == [1.0, -2.0]
