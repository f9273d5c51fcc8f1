"""Whole-body plans: reference values, laws of their forces, invariance, and what the checker says."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from scipy.interpolate import BSpline

import mcplan as mp
from mcplan import _core
from reference_solutions import TORQUE_INTEGRALS, reference_names, reference_plan, reference_task

PLANS = [("cartwheel", "optimised_per_point"), ("climbing", "feasible_per_body"), ("walking", "optimised_uniform")]


def phase_and_time(plan: mp.PlanarPlan, t: float) -> tuple[int, float]:
    times = plan.knot_times()
    k = min(int(np.searchsorted(times, t, side="right")) - 1, len(times) - 2)
    return k, t - times[k]


def torque_integral(plan: mp.PlanarPlan, nodes: int = 12) -> float:
    """Of the squared torques, by Gauss-Legendre quadrature over each interval."""
    s, weights = np.polynomial.legendre.leggauss(nodes)
    total = 0.0
    for k, phase in enumerate(plan.task.phases):
        length = plan.durations[k] / phase.intervals
        for i in range(phase.intervals):
            torques = [plan.at_phase(k, length * (i + (x + 1.0) / 2.0)).torque for x in s]
            total += length / 2.0 * sum(w * tau @ tau for w, tau in zip(weights, torques, strict=True))
    return total


@pytest.mark.parametrize(("task", "name"), TORQUE_INTEGRALS)
def test_reference_solutions_have_their_stated_cost(task, name):
    # What is stated comes from polynomials of order 8 and has four to six digits.
    rough = (task, name) == ("walking", "optimised_per_point")  # longest intervals: 438.27 by exact dynamics
    plan = reference_plan(task, name)
    assert torque_integral(plan) == pytest.approx(TORQUE_INTEGRALS[task, name], rel=2e-4 if rough else 1e-4)


@pytest.mark.parametrize(("task", "name"), reference_names())
def test_reference_solutions_are_accepted(task, name):
    # One of them drifts by 1e-8 rad more than the 5 mrad it was allowed.
    result = mp.check(reference_plan(task, name), tolerances=mp.PlanarTolerances(drift_angle=5.001e-3))
    # The climbs were found when nothing kept swinging feet out of slope and wall.
    expected = {"clearance"} if task.startswith("climbing") else set()
    assert {violation.name for violation in result.violations()} == expected, str(result)


def test_depths_in_solids_are_told_of_every_pair_of_a_swinging_foot_and_a_surface():
    """By positions alone: the deepest of the soles' points at 1 kHz, of endless surfaces."""
    plan = reference_plan("climbing_steep", "feasible_per_point")
    task, robot = plan.task, plan.task.robot
    deepest: dict[tuple[int, int], float] = {}
    starts = np.concatenate([[0.0], np.cumsum(plan.durations)])
    for k, phase in enumerate(task.phases):
        for e in set(range(3)) - {contact.end_effector for contact in phase.contacts}:
            end = robot.end_effectors[e]
            for time_s in np.arange(0.0, plan.durations[k], 1e-3):
                frame = _core.planar_kinematics(robot, plan.at_phase(k, time_s).configuration)[end.body]
                sole = _core.planar_point(frame, end.position_B, end.angle_B)
                points = [_core.planar_point(sole, (along, 0.0)).position_W for along in end.points]
                for s, surface in enumerate(task.surfaces):
                    depth = max(-np.dot(point - surface.origin_W, surface.normal_W) for point in points)
                    deepest[e, s] = max(depth, deepest.get((e, s), -np.inf))
    found = {(d.end_effector, d.surface): d for d in _core.solid_depths(plan)}
    assert found.keys() == deepest.keys()
    for pair, depth in deepest.items():
        assert found[pair].depth_m == pytest.approx(depth, abs=1e-4)
        assert starts[found[pair].phase] <= found[pair].time_s <= starts[found[pair].phase + 1]
    assert max(deepest.values()) > 0.1


@pytest.mark.parametrize(("task", "name"), PLANS)
def test_joints_are_the_b_splines_of_scipy(task, name):
    plan = reference_plan(task, name)
    lengths = np.array(plan.interval_lengths())
    lengths = np.concatenate([np.repeat(lengths[0], 3), lengths, np.repeat(lengths[-1], 3)])
    knots = np.concatenate([[0.0], np.cumsum(lengths)]) - lengths[:3].sum()
    spline = BSpline(knots, plan.control_points.T, 3)
    for t in np.linspace(0.0, plan.duration(), 101):
        x = plan.at(t).configuration
        np.testing.assert_allclose(x.q, spline(t), atol=1e-12)
        np.testing.assert_allclose(x.velocity, spline(t, 1), atol=1e-10)
        np.testing.assert_allclose(x.acceleration, spline(t, 2), atol=1e-8)


@pytest.mark.parametrize(("task", "name"), PLANS)
def test_velocities_and_accelerations_are_those_of_the_positions(task, name):
    plan, h = reference_plan(task, name), 1e-6
    for t in np.linspace(0.0, plan.duration(), 43)[1:-1]:
        k, since = phase_and_time(plan, t)
        if not h < since < plan.durations[k] - h:
            continue
        before, now, after = (plan.at_phase(k, since + d).configuration for d in (-h, 0.0, h))
        speed = 1.0 + np.abs(now.base_acceleration).max()
        np.testing.assert_allclose(now.base_velocity, (after.base - before.base) / (2 * h), atol=1e-7 * speed)
        derivative = (after.base_velocity - before.base_velocity) / (2 * h)
        np.testing.assert_allclose(now.base_acceleration, derivative, atol=1e-4 * speed)


def expected_points(task: mp.PlanarTask, phase: int) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Place, tangent and normal of every point, contact by contact."""
    out = []
    for contact in task.phases[phase].contacts:
        tangent = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        for point in task.robot.end_effectors[contact.end_effector].points:
            out.append((contact.position_W + point * tangent, tangent, np.array([-tangent[1], tangent[0]])))
    return out


def wrench_matrix(task: mp.PlanarTask, phase: int) -> np.ndarray:
    """From (tangential, normal) of all points to force and moment about the mean of the points."""
    points = expected_points(task, phase)
    mean = np.mean([place for place, _, _ in points], axis=0)
    np.testing.assert_allclose(_core.moment_point_W(task, phase), mean, atol=1e-14)
    columns = []
    for place, *directions in points:
        arm = place - mean
        columns += [[*d, arm[0] * d[1] - arm[1] * d[0]] for d in directions]
    return np.array(columns).T


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("name", ["cartwheel", "climbing", "climbing_steep", "walking"])
def test_the_gain_solves_the_weighted_least_norm_problem(name, seed):
    task, rng = reference_task(name), np.random.default_rng(seed)
    for phase in range(len(task.phases)):
        matrix = wrench_matrix(task, phase)
        weights = np.exp(rng.uniform(-5.0, 5.0, matrix.shape[1] // 2))
        wanted = rng.normal(scale=[300.0, 300.0, 100.0])
        forces = _core.least_norm_gain(task, phase, weights) @ wanted
        np.testing.assert_allclose(matrix @ forces, wanted, atol=1e-9)
        # Stationary: what the forces cost has no component along motions that keep the wrench.
        cost = np.column_stack([10.0 * weights, weights]).ravel() * forces
        multiplier = np.linalg.lstsq(matrix.T, cost, rcond=None)[0]
        np.testing.assert_allclose(matrix.T @ multiplier, cost, atol=1e-9 * np.abs(cost).max())


def test_scaling_the_weights_leaves_the_forces():
    plan = reference_plan("climbing", "optimised_per_point")
    scaled = copy.deepcopy(plan)
    scaled.weights = [7.0 * weights for weights in plan.weights]
    for t in np.linspace(0.0, plan.duration(), 21):
        forces, others = ([[f.tangential, f.normal] for f in p.at(t).forces] for p in (plan, scaled))
        np.testing.assert_allclose(others, forces, atol=1e-9)


def test_a_symmetric_stance_at_rest_shares_the_weight():
    plan = reference_plan("walking", "feasible_uniform")
    robot = plan.task.robot
    for end in robot.end_effectors:
        end.points = [-0.1, 0.1]
    plan.task.phases = plan.task.phases[:1]
    plan.durations, plan.weights = [1.0], [np.ones(4)]
    plan.control_points = np.zeros((9, 6))
    # Feet as far behind the CoM as before it.
    for contact, side in zip(plan.task.phases[0].contacts, (-1.0, 1.0), strict=True):
        contact.position_W = [0.3 * side, 0.0]
    com_x = plan.at(0.0).com_W[0]
    for contact in plan.task.phases[0].contacts:
        contact.position_W[0] += com_x - plan.at(0.0).com_W[0]
    base = np.zeros((3, 6))
    base[:] = plan.at(0.0).configuration.base[:, None]
    base[0] -= plan.at(0.0).com_W[0] - _core.moment_point_W(plan.task, 0)[0]
    plan.base_control_points = base
    weight = robot.mass() * robot.gravity
    for force in plan.at(0.5).forces:
        assert force.normal == pytest.approx(weight / 4, rel=1e-12)
        assert abs(force.tangential) < 1e-10


def moved(plan: mp.PlanarPlan, by: np.ndarray) -> mp.PlanarPlan:
    out = copy.deepcopy(plan)
    for surface in out.task.surfaces:
        surface.origin_W += by
    for phase in out.task.phases:
        for contact in phase.contacts:
            contact.position_W += by
    return out


def turned(plan: mp.PlanarPlan, angle: float) -> mp.PlanarPlan:
    out = copy.deepcopy(plan)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    for surface in out.task.surfaces:
        surface.origin_W = turn @ surface.origin_W
        surface.angle += angle
    for phase in out.task.phases:
        for contact in phase.contacts:
            contact.position_W = turn @ contact.position_W
            contact.angle += angle
    return out


def mirrored(plan: mp.PlanarPlan) -> mp.PlanarPlan:
    """x becomes -x. A contact frame's y axis is mirrored, its x axis then points the other way along the sole."""
    out, flip = copy.deepcopy(plan), np.array([-1.0, 1.0])
    for body in out.task.robot.bodies:
        body.joint_P *= flip
        body.com_B *= flip
        body.offset *= -1.0
        body.position_min, body.position_max = -body.position_max, -body.position_min
    for end in out.task.robot.end_effectors:
        end.position_B *= flip
        end.angle_B *= -1.0
        end.points = [-point for point in end.points]
    for surface in out.task.surfaces:
        surface.origin_W *= flip
        surface.angle *= -1.0
        surface.from_, surface.to = -surface.to, -surface.from_
    for phase in out.task.phases:
        for contact in phase.contacts:
            contact.position_W *= flip
            contact.angle *= -1.0
    out.control_points = -plan.control_points
    return out


def along(plan: mp.PlanarPlan) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Torques, tangential and normal forces at some instants."""
    states = [plan.at(t) for t in np.linspace(0.0, plan.duration(), 29)]
    return (
        np.concatenate([state.torque for state in states]),
        np.array([force.tangential for state in states for force in state.forces]),
        np.array([force.normal for state in states for force in state.forces]),
    )


@pytest.mark.parametrize(("task", "name"), PLANS)
def test_torques_and_forces_do_not_depend_on_where_the_world_begins(task, name):
    plan = reference_plan(task, name)
    other = moved(plan, np.array([3.0, -7.0]))
    for ours, wanted in zip(along(other), along(plan), strict=True):
        np.testing.assert_allclose(ours, wanted, atol=1e-8)
    state, shifted = plan.at(0.7), other.at(0.7)
    np.testing.assert_allclose(shifted.com_W - state.com_W, [3.0, -7.0], atol=1e-12)
    assert shifted.angular_momentum == pytest.approx(state.angular_momentum, abs=1e-10)


@pytest.mark.parametrize(("task", "name"), PLANS)
def test_without_gravity_they_do_not_depend_on_which_way_is_up(task, name):
    plan = reference_plan(task, name)
    plan.task.robot.gravity = 0.0
    for angle in (0.9, -2.0):
        for ours, wanted in zip(along(turned(plan, angle)), along(plan), strict=True):
            np.testing.assert_allclose(ours, wanted, atol=1e-8)


@pytest.mark.parametrize(("task", "name"), PLANS)
def test_a_mirrored_motion_has_mirrored_torques_and_forces(task, name):
    plan = reference_plan(task, name)
    other = mirrored(plan)
    torque, tangential, normal = along(plan)
    for ours, wanted in zip(along(other), (-torque, -tangential, normal), strict=True):
        np.testing.assert_allclose(ours, wanted, atol=1e-8)
    assert [v.value for v in mp.check(other).constraints] == pytest.approx(
        [v.value for v in mp.check(plan).constraints], abs=1e-7
    )


def test_a_plan_that_is_pushed_out_of_shape_is_refused_by_name():
    plan = reference_plan("walking", "optimised_per_point")
    plan.control_points[2, 3] += 0.05
    with pytest.raises(mp.PlanViolated) as found:
        mp.check(plan).raise_if_violated()
    assert {"drift", "drift_angle", "friction"} <= {violation.name for violation in found.value.violations}
    tight = mp.PlanarTolerances(drift=1e-4, drift_angle=1.0)
    names = [v.name for v in mp.check(reference_plan("walking", "optimised_per_point"), tolerances=tight).violations()]
    assert names == ["drift"]


def test_drift_is_that_of_the_checker():
    plan = reference_plan("cartwheel", "feasible_per_point")
    found = {v.name: v.value for v in mp.check(plan).constraints}
    drift = _core.largest_drift(plan)
    assert (drift.position_m, drift.angle_rad) == (found["drift"], found["drift_angle"])


def test_plain_data_can_be_copied_pickled_and_pasted():
    task = reference_task("climbing")
    task.phases[1].poses = [_core.PlanarPose(body=0, fraction=0.5, min=[-np.inf, 0.3, 0.0], max=[1.0, np.inf, 0.5])]
    robot = task.robot
    robot.bodies[1].capsules = [_core.Capsule(from_B=[0.0, 0.0], to_B=[0.0, -0.4], radius=0.05)]
    robot.bodies[4].capsules = [_core.Capsule(from_B=[0.0, 0.0], to_B=[0.0, -0.4], radius=0.05)]
    robot.collision_pairs = [(1, 4)]
    for value in (task, robot):
        for other in (copy.deepcopy(value), pickle.loads(pickle.dumps(value)), eval(repr(value), vars(_core))):
            assert repr(other) == repr(value)
    other = copy.deepcopy(task)
    other.robot.bodies[0].mass = 5.0
    assert task.robot.bodies[0].mass == 8.0


def test_arrays_of_a_plan_can_be_changed_in_place():
    plan = reference_plan("cartwheel", "feasible_uniform")
    plan.control_points[0, 0] = 3.0
    plan.weights[0][1] = 2.0
    assert plan.control_points[0, 0] == 3.0 and plan.weights[0][1] == 2.0
    kept = plan.control_points
    plan.control_points = np.zeros((9, 13))  # what was there stays alive for those who hold it
    assert kept[0, 0] == 3.0 and plan.control_points[0, 0] == 0.0
    with pytest.raises(mp.errors.InvalidPlan, match="durations: must have 3 entries, got 2"):
        plan.durations = plan.durations[:2]
        plan.at(0.1)
