"""Terms of the dynamics against differences along a motion, recursive Newton-Euler, and Pinocchio's other algorithms."""

import numpy as np
import pytest

import tracked

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking.robot_dynamics import RobotDynamics  # noqa: E402

STEP = 1e-5


@pytest.fixture(params=["talos", "g1"])
def case(request):
    urdf_model = tracked.urdf_model(request.param)
    return urdf_model, np.random.default_rng(11)


def at(urdf_model, configuration, velocity):
    dynamics = RobotDynamics(urdf_model)
    dynamics.update(configuration, velocity)
    return dynamics


def test_drifts_are_rates_of_motions_without_acceleration(case):
    urdf_model, rng = case
    for _ in range(4):
        configuration, velocity = tracked.random_state(urdf_model.model, urdf_model.neutral, rng)
        now = at(urdf_model, configuration, velocity)
        after = at(urdf_model, pin.integrate(urdf_model.model, configuration, STEP * velocity), velocity)
        before = at(urdf_model, pin.integrate(urdf_model.model, configuration, -STEP * velocity), velocity)

        def rate(of, after=after, before=before):
            return (of(after) - of(before)) / (2 * STEP)

        np.testing.assert_allclose(now.com_drift, rate(lambda b: b.com_velocity_W), atol=1e-5)
        scale = max(1.0, np.abs(now.momentum_drift).max())
        np.testing.assert_allclose(now.momentum_drift, rate(lambda b: b.momentum_W), atol=1e-5 * scale)
        np.testing.assert_allclose(now.base_drift, rate(lambda b: b.base_velocity_W), atol=1e-5)
        for end in range(len(urdf_model.frames)):
            found = rate(lambda b, end=end: b.end_effector(end).velocity_W)
            np.testing.assert_allclose(now.end_effector(end).drift, found, atol=1e-4)


def test_jacobians_are_derivatives_of_positions_and_rotations(case):
    urdf_model, rng = case
    configuration, velocity = tracked.random_state(urdf_model.model, urdf_model.neutral, rng)
    now = at(urdf_model, configuration, velocity)
    ends = [now.end_effector(i) for i in range(len(urdf_model.frames))]
    for direction in np.eye(urdf_model.model.nv):
        after = at(urdf_model, pin.integrate(urdf_model.model, configuration, STEP * direction), velocity)
        before = at(urdf_model, pin.integrate(urdf_model.model, configuration, -STEP * direction), velocity)
        change = (after.com_W - before.com_W) / (2 * STEP)
        np.testing.assert_allclose(now.com_jacobian @ direction, change, atol=1e-8)
        turned = pin.log3(after.base_WB @ before.base_WB.T) / (2 * STEP)
        np.testing.assert_allclose(now.base_jacobian @ direction, turned, atol=1e-8)
        for i, end in enumerate(ends):
            moved = (after.end_effector_position_W(i) - before.end_effector_position_W(i)) / (2 * STEP)
            turned = pin.log3(after.end_effector(i).rotation_W @ before.end_effector(i).rotation_W.T) / (2 * STEP)
            np.testing.assert_allclose(end.jacobian @ direction, [*moved, *turned], atol=1e-8)


def test_velocities_are_jacobians_times_the_velocity(case):
    urdf_model, rng = case
    configuration, velocity = tracked.random_state(urdf_model.model, urdf_model.neutral, rng)
    now = at(urdf_model, configuration, velocity)
    np.testing.assert_allclose(now.com_velocity_W, now.com_jacobian @ velocity, atol=1e-12)
    np.testing.assert_allclose(now.base_velocity_W, now.base_jacobian @ velocity, atol=1e-12)
    for i in range(len(urdf_model.frames)):
        np.testing.assert_allclose(now.end_effector(i).velocity_W, now.end_effector(i).jacobian @ velocity, atol=1e-10)


def test_momentum_is_the_sum_over_the_links(case):
    urdf_model, rng = case
    model, data = urdf_model.model, urdf_model.model.createData()
    configuration, velocity = tracked.random_state(model, urdf_model.neutral, rng)
    now = at(urdf_model, configuration, velocity)
    pin.forwardKinematics(model, data, configuration, velocity)
    linear, angular = np.zeros(3), np.zeros(3)
    for joint in range(1, model.njoints):
        inertia, placement = model.inertias[joint], data.oMi[joint]
        middle = placement.act(inertia.lever)
        spin = placement.rotation @ data.v[joint].angular
        speed = placement.rotation @ (data.v[joint].linear + np.cross(data.v[joint].angular, inertia.lever))
        turn = placement.rotation @ inertia.inertia @ placement.rotation.T
        linear += inertia.mass * speed
        angular += turn @ spin + np.cross(middle - now.com_W, inertia.mass * speed)
    np.testing.assert_allclose(now.mass * now.com_velocity_W, linear, atol=1e-9)
    np.testing.assert_allclose(now.momentum_W, angular, atol=1e-9)


def test_inertia_and_bias_are_those_of_newton_and_euler(case):
    urdf_model, rng = case
    model, data = urdf_model.model, urdf_model.model.createData()
    configuration, velocity = tracked.random_state(model, urdf_model.neutral, rng)
    now = at(urdf_model, configuration, velocity)
    rest, none = np.zeros(model.nv), pin.rnea(model, data, configuration, np.zeros(model.nv), np.zeros(model.nv))
    columns = [pin.rnea(model, data, configuration, rest, unit) - none for unit in np.eye(model.nv)]
    np.testing.assert_allclose(now.inertia, np.transpose(columns), atol=1e-9)
    np.testing.assert_allclose(now.bias, pin.rnea(model, data, configuration, velocity, rest), atol=1e-9)


def test_a_second_state_leaves_nothing_of_the_first(case):
    urdf_model, rng = case
    first, second = (tracked.random_state(urdf_model.model, urdf_model.neutral, rng) for _ in range(2))
    dynamics = RobotDynamics(urdf_model)
    dynamics.update(*first)
    kept, end = dynamics.com_jacobian.copy(), dynamics.end_effector(0)
    jacobian = end.jacobian.copy()
    com_jacobian = dynamics.com_jacobian
    dynamics.update(*second)
    fresh = at(urdf_model, *second)
    for name in ("inertia", "bias", "com_W", "com_jacobian", "momentum_map", "momentum_drift", "base_WB"):
        np.testing.assert_array_equal(getattr(dynamics, name), getattr(fresh, name))
    np.testing.assert_array_equal(kept, com_jacobian)
    np.testing.assert_array_equal(jacobian, end.jacobian)
