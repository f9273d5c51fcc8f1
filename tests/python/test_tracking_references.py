"""References against the plan itself, and against differences of what they are rates of."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import mcplan as mp
import tracked
import wrenches
from mcplan.kinematics.rotations import from_rpy
from mcplan.tracking.references import LARGEST_SWING_ACCELERATION, angular_velocity, references
from stepping import stepping_plan

DT, HOLD = 0.002, 0.3


@pytest.fixture(scope="module")
def robot():
    return mp.load_robot("talos")


@pytest.fixture(scope="module")
def plan(robot):
    return stepping_plan(steps=2, robot=robot)


@pytest.fixture(scope="module")
def desired(plan, robot):
    return references(plan, robot, DT, HOLD)


def test_every_instant_is_the_plans(plan, desired):
    for n in range(0, desired.count, 37):
        if n * DT > plan.duration():
            break
        state = plan.at(n * DT)
        np.testing.assert_array_equal(desired.com_W[n], state.com_W)
        np.testing.assert_array_equal(desired.com_velocity_W[n], state.com_velocity_W)
        np.testing.assert_array_equal(desired.com_acceleration_W[n], state.com_acceleration_W)
        np.testing.assert_array_equal(desired.momentum_W[n], state.angular_momentum_W)
        np.testing.assert_allclose(desired.base_WB[n], from_rpy(np.asarray(state.base_rpy)), atol=1e-12)
        for i, end in enumerate(state.end_effectors):
            np.testing.assert_array_equal(desired.end_effectors_W[n, i], end.position_W)
            np.testing.assert_array_equal(desired.end_effector_velocities_W[n, i], end.velocity_W)
            np.testing.assert_array_equal(desired.forces_W[n, i], end.force_W)
            assert desired.surfaces[n, i] == end.surface


def test_the_last_state_is_held_at_rest(plan, robot, desired):
    assert (desired.count - 1) * DT >= plan.duration() + HOLD - 1e-9
    over = np.arange(desired.count) * DT > plan.duration()
    assert over.sum() == pytest.approx(HOLD / DT, abs=2)
    np.testing.assert_allclose(desired.com_W[over], [plan.at(plan.duration()).com_W] * over.sum())
    for rate in (
        desired.com_velocity_W,
        desired.com_acceleration_W,
        desired.momentum_W,
        desired.end_effector_velocities_W,
    ):
        assert not rate[over].any()
    assert (desired.surfaces[over] == list(plan.final_contacts)).all()
    np.testing.assert_allclose(
        desired.forces_W[over].sum(axis=1), [[0, 0, robot.mass * plan.scene.gravity]] * over.sum()
    )


def test_forces_are_scaled_to_the_robot_that_walks(plan, robot, desired):
    heavy = mp.load_robot("talos")
    heavy.mass *= 1.5
    np.testing.assert_allclose(references(plan, heavy, DT, HOLD).forces_W, 1.5 * desired.forces_W)


def test_forces_accelerate_the_com_as_the_plan_says(plan, robot, desired):
    now = np.arange(desired.count) * DT <= plan.duration()
    force = robot.mass * (desired.com_acceleration_W[now] + [0, 0, plan.scene.gravity])
    np.testing.assert_allclose(desired.forces_W[now].sum(axis=1), force, atol=1e-6 * robot.mass * 9.81)


def test_pressure_is_where_the_moment_of_the_planned_forces_vanishes(plan, desired):
    checked = 0
    for n in range(0, round(plan.duration() / DT), 53):
        for i, end in enumerate(plan.at(n * DT).end_effectors):
            forces = np.asarray(end.point_forces_W).reshape(-1, 3)
            if end.surface < 0 or forces[:, 2].sum() < 1.0:
                continue
            arms = np.asarray(end.points_W) - desired.pressure_W[n, i]
            np.testing.assert_allclose(np.cross(arms, forces).sum(axis=0)[:2], 0.0, atol=1e-6)
            checked += 1
    assert checked > 20


def test_accelerations_of_swings_are_rates_of_their_velocities(desired):
    free = desired.surfaces < 0
    assert not desired.end_effector_accelerations_W[~free].any()
    size = np.linalg.norm(desired.end_effector_accelerations_W, axis=2)
    assert size.max() <= LARGEST_SWING_ACCELERATION * (1 + 1e-9)
    rate = (desired.end_effector_velocities_W[2:] - desired.end_effector_velocities_W[:-2]) / (2 * DT)
    inner = free[1:-1] & (np.linalg.norm(rate, axis=2) < LARGEST_SWING_ACCELERATION)
    np.testing.assert_allclose(desired.end_effector_accelerations_W[1:-1][inner], rate[inner], atol=1e-9)


def test_positions_of_swings_are_integrals_of_their_velocities(desired):
    foot = int(np.flatnonzero((desired.surfaces < 0).any(axis=0) & (desired.surfaces >= 0).any(axis=0))[0])
    moved = desired.end_effectors_W[1:, foot] - desired.end_effectors_W[:-1, foot]
    mean = 0.5 * DT * (desired.end_effector_velocities_W[1:, foot] + desired.end_effector_velocities_W[:-1, foot])
    np.testing.assert_allclose(np.cumsum(mean, axis=0), np.cumsum(moved, axis=0), atol=1e-4)


def test_momentum_rate_is_that_of_the_momentum(plan, desired):
    inner = np.arange(1, round(plan.duration() / DT) - 1)
    difference = (desired.momentum_W[inner + 1] - desired.momentum_W[inner - 1]) / (2 * DT)
    np.testing.assert_allclose(desired.momentum_rate_W[inner], difference, atol=1e-9)


def test_angular_velocities_are_those_of_a_known_turn():
    axis = np.array([0.36, -0.48, 0.8])
    times = np.arange(0, 1, DT)
    angle = 0.8 * np.sin(3.0 * times)
    start = Rotation.random(random_state=2)
    turn = np.array([(Rotation.from_rotvec(a * axis) * start).as_matrix() for a in angle])
    rate = (2.4 * np.cos(3.0 * times))[:, None] * axis
    np.testing.assert_allclose(angular_velocity(turn, DT)[1:-1], rate[1:-1], atol=2e-4)
    stacked = angular_velocity(np.stack([turn, turn], axis=1), DT)
    np.testing.assert_allclose(stacked[:, 1], angular_velocity(turn, DT), atol=1e-12)


def test_another_base_brings_its_own_rate(desired):
    angle = 0.3 * np.arange(desired.count) * DT
    quats = Rotation.from_rotvec(np.outer(angle, [0.0, 0.0, 1.0])).as_quat()
    turned = desired.with_base(quats)
    np.testing.assert_allclose(turned.base_velocity_W, [[0.0, 0.0, 0.3]] * desired.count, atol=1e-5)
    np.testing.assert_allclose(turned.base_WB, Rotation.from_quat(quats).as_matrix(), atol=1e-12)
    assert turned.com_W is desired.com_W


def test_swings_run_from_nothing_to_all_and_say_whether_they_end(desired):
    for end in range(desired.surfaces.shape[1]):
        free = desired.surfaces[:, end] < 0
        assert (desired.swing_fraction[~free, end] == 1.0).all() and not desired.returns[~free, end].any()
        edges = np.flatnonzero(np.diff(np.concatenate([[0], free, [0]])))
        for first, after in edges.reshape(-1, 2):
            share = desired.swing_fraction[first:after, end]
            assert share[0] == 0.0 and share[-1] == 1.0 and (np.diff(share) > 0).all()
            assert (desired.returns[first:after, end] == (after < desired.count)).all()


def test_hands_that_touch_nothing_never_return():
    _, desired = tracked.still()
    hands = (desired.surfaces < 0).all(axis=0)
    assert hands.any() and not desired.returns[:, hands].any()


def test_wrenches_change_the_momentum_at_the_rate_that_is_asked_for(robot):
    """Against differences of the plan's own momentum, but for the steps next to a knot, where the rate jumps."""
    plan = wrenches.leaning(robot)
    desired = references(plan, robot, DT, HOLD)
    knots, compared = np.array(plan.knot_times()), 0
    for n in range(1, round(plan.duration() / DT) - 1):
        if np.abs(knots - n * DT).min() > 1.5 * DT:
            before, after = (plan.at((n + i) * DT).angular_momentum_W for i in (-1, 1))
            np.testing.assert_allclose(desired.momentum_rate_W[n], (after - before) / (2 * DT), atol=1e-3)
            compared += 1
    assert compared > 150 and np.abs(desired.momentum_rate_W).max() > 5.0
    assert not desired.momentum_rate_W[np.arange(desired.count) * DT > plan.duration()].any()


@pytest.mark.parametrize("yaw", [0.0, 0.5 * np.pi, 3.0])
def test_the_base_turns_as_its_momentum_says_however_it_heads(robot, yaw):
    """omega = R I^-1 R^T L, with roll and pitch of 10 to 15 degrees: no rates of angles in it."""
    plan = wrenches.leaning(robot, yaw=yaw)
    desired = references(plan, robot, DT, HOLD)
    knots = np.array(plan.knot_times())
    tilts = []
    for n in range(1, round(plan.duration() / DT) - 1):
        if np.abs(knots - n * DT).min() <= 1.5 * DT:
            continue
        state = plan.at(n * DT)
        turn = Rotation.from_euler("xyz", state.base_rpy).as_matrix()
        omega = turn @ ((turn.T @ state.angular_momentum_W) / robot.inertia)
        np.testing.assert_allclose(desired.base_velocity_W[n], omega, atol=2e-3)
        np.testing.assert_allclose(desired.base_WB[n], turn, atol=1e-12)
        tilts.append(np.abs(state.base_rpy[:2]))
    assert np.max(tilts) > 0.15
    assert np.linalg.norm(desired.base_velocity_W, axis=1).max() > 0.1


def test_momentum_and_moments_are_scaled_to_the_robot_that_walks(robot):
    plan, heavy = wrenches.leaning(robot), mp.load_robot("talos")
    heavy.mass *= 1.5
    light, desired = references(plan, robot, DT, HOLD), references(plan, heavy, DT, HOLD)
    for field in ("momentum_W", "momentum_rate_W", "moments_W"):
        np.testing.assert_allclose(getattr(desired, field), 1.5 * getattr(light, field), atol=1e-9)


def test_a_turn_asks_every_sole_to_turn_while_it_is_in_the_air(robot):
    plan = wrenches.turning(robot)
    desired = references(plan, robot, DT, HOLD)
    for foot in (0, 1):
        down = desired.surfaces[:, foot] >= 0
        inner = down & np.roll(down, 1) & np.roll(down, -1)
        assert not desired.sole_velocities_W[inner, foot].any()
        turned = np.cumsum(desired.sole_velocities_W[:, foot, 2]) * DT
        assert np.degrees(turned[-1]) == pytest.approx(90.0, abs=0.1)
    yaw = np.arctan2(desired.base_WB[:, 1, 0], desired.base_WB[:, 0, 0])
    assert np.degrees(yaw[-1]) == pytest.approx(90.0, abs=1e-6)
    np.testing.assert_allclose(np.cumsum(desired.base_velocity_W[:, 2]) * DT, yaw, atol=2e-3)
