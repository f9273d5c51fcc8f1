"""Loads and pushes that a controller's model does not know."""

import numpy as np
import pytest

from mcplan.tracking.unknown_forces import LAG_S, UnknownForces

DT_S = 0.002


def observe(forces, unknown_W, steps, as_expected=True, promises=True):
    """Steps in which the CoM accelerates by so much more than promised."""
    velocity_W = np.zeros(3)
    for step in range(steps):
        forces.update(velocity_W, as_expected)
        promised_W = np.array([np.sin(0.01 * step), 0.3, -0.1])
        if promises:
            forces.predict(promised_W)
        velocity_W = velocity_W + DT_S * (promised_W + unknown_W)


def test_a_push_is_felt_at_once_and_taken_off_through_a_lag_and_a_load_in_time():
    forces = UnknownForces(DT_S)
    observe(forces, np.array([0.5, -1.2, -0.9]), 65)
    np.testing.assert_allclose(forces.push.acceleration_W, [0.5, -1.2], rtol=0.02)
    assert 0.08 < forces.push.lasted_s <= 0.1
    share = 1.0 - np.exp(-0.09 / LAG_S)  # felt some 10 ms after soles have settled, 30 ms after the begin
    np.testing.assert_allclose(forces.acceleration_W[:2], share * np.array([0.5, -1.2]), rtol=0.05)
    assert -0.05 < forces.acceleration_W[2] < -0.02


def test_a_load_alone_is_no_push():
    forces = UnknownForces(DT_S)
    observe(forces, np.array([0.0, 0.0, -0.9]), 500)
    assert forces.push.lasted_s == 0.0
    assert forces.acceleration_W[2] < -0.2


@pytest.mark.parametrize("told", [{"as_expected": False}, {"promises": False}])
def test_where_the_program_was_wrong_or_had_no_solution_nothing_is_felt(told):
    forces = UnknownForces(DT_S)
    observe(forces, np.array([0.5, -1.2, 0.0]), 100, **told)
    np.testing.assert_array_equal(forces.acceleration_W, np.zeros(3))
