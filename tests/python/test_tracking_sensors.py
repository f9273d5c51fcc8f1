"""What the controller reads: the state, or the state with noise of a known size that a seed repeats."""

import numpy as np
import pytest

from mcplan.tracking.sensors import BASE_M, BASE_RAD, BASE_RAD_S, JOINT_RAD, JOINT_RAD_S, Sensors

CONFIGURATION = np.array([1.0, 2.0, 3.0, 0.0, 0.0, np.sin(0.3), np.cos(0.3), 0.1, -0.2])
VELOCITY = np.arange(8.0)


def test_without_noise_the_state_is_read_as_it_is():
    configuration, velocity = Sensors(0.0, 1).read(CONFIGURATION, VELOCITY)
    np.testing.assert_array_equal(configuration, CONFIGURATION)
    np.testing.assert_array_equal(velocity, VELOCITY)


def test_noise_has_its_size_and_no_mean():
    sensors, noise = Sensors(2.0, 3), 2.0
    reads = [sensors.read(CONFIGURATION, VELOCITY) for _ in range(4000)]
    positions, velocities = (np.array(column) for column in zip(*reads, strict=True))
    assert np.linalg.norm(positions[:, 3:7], axis=1) == pytest.approx(1.0)
    # Small turns about the own axes: twice the vector part of the quaternion relative to the true one.
    x, y, z, w = CONFIGURATION[3:7]
    relative = positions[:, 3:7] @ np.array([[w, -z, y, x], [z, w, -x, y], [-y, x, w, z], [-x, -y, -z, w]])
    for values, deviation in (
        (positions[:, :3] - CONFIGURATION[:3], BASE_M),
        (2.0 * relative[:, :3], BASE_RAD),
        (positions[:, 7:] - CONFIGURATION[7:], JOINT_RAD),
        ((velocities - VELOCITY)[:, 3:6], BASE_RAD_S),
        ((velocities - VELOCITY)[:, 6:], JOINT_RAD_S),
    ):
        np.testing.assert_allclose(values.std(axis=0), noise * deviation, rtol=0.06)
        assert np.abs(values.mean(axis=0)).max() < 0.06 * noise * deviation


def test_a_seed_repeats_the_noise():
    first, again, other = (Sensors(1.0, seed).read(CONFIGURATION, VELOCITY) for seed in (5, 5, 6))
    np.testing.assert_array_equal(np.concatenate(first), np.concatenate(again))
    assert not np.array_equal(first[1], other[1])
