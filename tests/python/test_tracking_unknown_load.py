"""The load that a controller's model does not know."""

import numpy as np
import pytest

from mcplan.tracking.unknown_load import LARGEST, TIME_S, UnknownLoad

DT_S = 0.002


def observe(load, error, steps, as_expected=True, noise=0.0):
    """Steps in which the CoM accelerates by so much more than predicted, on what is predicted anew each time."""
    random, velocity = np.random.default_rng(1), 0.0
    for step in range(steps):
        load.update(velocity + noise * random.standard_normal(), as_expected)
        predicted = np.sin(0.01 * step)
        load.predict(predicted)
        velocity += DT_S * (predicted + error)


@pytest.mark.parametrize("error", [-0.9, 0.5])
def test_a_steady_error_is_found_as_a_first_order_lag_does(error):
    load = UnknownLoad(DT_S)
    observe(load, error, int(TIME_S / DT_S) + 1)
    assert load.acceleration == pytest.approx(error * (1.0 - np.exp(-1.0)), rel=5e-3)
    observe(load, error, int(8.0 * TIME_S / DT_S))
    assert load.acceleration == pytest.approx(error, rel=2e-3)


def test_noise_of_the_velocity_leaves_little_in_the_estimate():
    load = UnknownLoad(DT_S)
    observe(load, -0.9, 5000, noise=0.02)
    assert load.acceleration == pytest.approx(-0.9, abs=0.1)


def test_the_estimate_stays_while_contacts_are_not_those_that_were_expected():
    load = UnknownLoad(DT_S)
    observe(load, -0.9, 1000)
    before = load.acceleration
    observe(load, -9.8, 500, as_expected=False)
    assert load.acceleration == before


def test_the_estimate_is_bounded():
    load = UnknownLoad(DT_S)
    observe(load, -30.0, 5000)
    assert load.acceleration == -LARGEST


def test_a_step_without_a_solution_says_nothing():
    load = UnknownLoad(DT_S)
    for velocity in (0.0, -1.0, -2.0):  # nothing was predicted
        assert load.update(velocity, True) == 0.0


@pytest.mark.parametrize("velocity", [np.nan, np.inf])
def test_a_reading_that_is_no_number_does_not_stay_in_the_estimate(velocity):
    load = UnknownLoad(DT_S)
    observe(load, 0.5, 100)
    before = load.acceleration
    load.predict(0.0)
    assert load.update(velocity, True) == before
    observe(load, 0.5, 100)
    assert before < load.acceleration < 0.5
