"""A plan sampled: states are the plan's own, contacts last as long as its phases, soles turn from one ground to the next."""

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
import wrenches
from mcplan.kinematics.samples import contact_intervals, knots_and_between, sample, sample_at, stance_samples
from standing import standing_plan
from stepping import stepping_plan


@pytest.fixture(scope="module")
def plan():
    return by_hand.walk(by_hand.stairs(), by_hand.humanoid())


def test_samples_are_the_plans_states_at_their_times(plan):
    samples = sample(plan, plan.scene, plan.robot, 20.0)
    assert samples.times_s[0] == 0.0 and samples.times_s[-1] == plan.duration()
    assert np.diff(samples.times_s) == pytest.approx(1.0 / 20.0, rel=0.02)
    for n in (0, 7, samples.count - 1):
        state = plan.at(float(samples.times_s[n]))
        assert (samples.com_W[n] == state.com_W).all() and (samples.com_velocity_W[n] == state.com_velocity_W).all()
        for end, found in enumerate(state.end_effectors):
            assert (samples.positions_W[n, end] == found.position_W).all()
            assert (samples.forces_W[n, end] == found.force_W).all()
            assert samples.surfaces[n, end] == found.surface
    assert samples.nearest(0.26) == 5


def test_knots_are_among_the_times_and_none_are_farther_apart_than_asked(plan):
    times = knots_and_between(plan, 30.0)
    assert (np.diff(times) > 0.0).all() and np.diff(times).max() <= 1.0 / 30.0 + 1e-12
    for knot in plan.knot_times():
        assert np.abs(times - knot).min() < 1e-12
    assert times[-1] <= plan.duration()
    assert sample_at(plan, plan.scene, plan.robot, times).count == len(times)


def test_contacts_of_joined_phases_are_one_interval(plan):
    """The first phase, both feet down, and the next, the right one in the air: the left foot's contact lasts on."""
    sequence, times = plan.contact_sequence(), plan.knot_times()
    for end in range(2):
        own = [i for i in contact_intervals(plan, plan.scene, plan.robot) if i.end_effector == end]
        assert all(a.end_s < b.start_s or a.surface != b.surface for a, b in zip(own[:-1], own[1:], strict=True))
        for k in range(len(plan.phases)):
            middle = 0.5 * (times[k] + times[k + 1])
            inside = [i.surface for i in own if i.start_s <= middle <= i.end_s]
            assert inside == ([sequence[k][end]] if sequence[k][end] >= 0 else [])


def test_soles_lie_on_their_surface_and_turn_in_the_air_between():
    scene = mp.load_scene("rubbles")
    plan = stepping_plan(2, scene, mp.load_robot("talos_wang"))
    samples = sample(plan, scene, plan.robot, 40.0)
    for n in range(samples.count):
        for end, surface in enumerate(samples.surfaces[n]):
            rotation = samples.rotations_W[n, end]
            assert rotation.T @ rotation == pytest.approx(np.eye(3), abs=1e-9)
            if surface >= 0:
                normal = mp._core.Polygon(scene.surfaces[surface].vertices_W).normal_W
                assert rotation[:, 2] == pytest.approx(normal, abs=1e-9)
    for end in range(2):  # no jumps where a foot lifts off or touches down
        steps = [a.T @ b for a, b in zip(samples.rotations_W[:-1, end], samples.rotations_W[1:, end], strict=True)]
        angles = np.arccos(np.clip((np.trace(np.array(steps), axis1=1, axis2=2) - 1.0) / 2.0, -1.0, 1.0))
        assert np.degrees(angles.max()) < 4.0


def test_centre_of_pressure_is_the_forces_mean_place():
    plan = stepping_plan(1)
    samples = sample(plan, plan.scene, plan.robot, 10.0)
    assert samples.has_points
    for n in range(0, samples.count, 5):
        for end in np.flatnonzero(samples.surfaces[n] >= 0):
            state = plan.at(float(samples.times_s[n])).end_effectors[end]
            up = state.point_forces_W[:, 2]
            expected = (up[:, None] * state.points_W).sum(axis=0) / up.sum()
            assert samples.pressure_W[n, end] == pytest.approx(expected, abs=1e-9)


def test_forces_of_a_pendulum_act_at_the_end_effector():
    plan = standing_plan()
    samples = sample(plan, plan.scene, plan.robot)
    assert not samples.has_points and (samples.pressure_W == samples.positions_W).all()


def test_a_stance_is_one_sample_with_soles_on_the_ground():
    scene, robot = mp.load_scene("flat"), mp.load_robot("humanoid44")
    stance = mp._core.resolve_stance(scene, robot, scene.start)
    samples = stance_samples(scene, robot, stance)
    assert samples.count == 1 and not samples.forces_W.any()
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    assert samples.rotations_W[0, feet, :, 2] == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(feet), 1)))


@pytest.fixture(scope="module")
def turn():
    return wrenches.turning(by_hand.humanoid())


def test_planned_centres_of_pressure_are_where_forces_act():
    plan = wrenches.standing_wrenches()
    samples = sample(plan, plan.scene, plan.robot, 10.0)
    assert samples.has_wrenches and not samples.has_points
    for n in range(samples.count):
        for end, contact in enumerate(plan.phases[0].contacts):
            if contact.surface < 0:
                assert (samples.pressure_W[n, end] == samples.positions_W[n, end]).all()
                assert not samples.moments_W[n, end].any()
                continue
            assert samples.pressure_W[n, end] == pytest.approx(contact.center_of_pressure_W, abs=1e-12)
            assert samples.moments_W[n, end] == pytest.approx(contact.moment_W, abs=1e-9)
            assert np.abs(samples.pressure_W[n, end] - samples.positions_W[n, end]).max() > 0.02


def test_a_pendulum_has_no_planned_centre_of_pressure():
    plan = standing_plan()
    assert not sample(plan, plan.scene, plan.robot).has_wrenches


def test_soles_head_as_the_plan_says_and_not_as_the_base_does(turn):
    samples = sample(turn, turn.scene, turn.robot, 60.0)
    apart = 0.0
    for n, t in enumerate(samples.times_s):
        state = turn.at(float(t))
        for end in range(2):
            x = samples.rotations_W[n, end, :, 0]
            assert np.arctan2(x[1], x[0]) == pytest.approx(state.end_effectors[end].yaw, abs=1e-9)
            assert samples.rotations_W[n, end, :, 2] == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)
            apart = max(apart, abs(state.end_effectors[end].yaw - state.base_rpy[2]))
    assert np.degrees(apart) > 15.0  # base and feet take turns
    for interval in samples.intervals:
        times = (samples.times_s >= interval.start_s) & (samples.times_s <= interval.end_s)
        rotations = samples.rotations_W[times, interval.end_effector]
        assert (rotations == interval.rotation_W).all()
    cosines = (np.einsum("neij,neij->ne", samples.rotations_W[:-1, :2], samples.rotations_W[1:, :2]) - 1.0) / 2.0
    angles = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    assert angles.max() < 30.0 * 1.875 / (0.6 * 60.0) + 0.1  # the quintic's largest slope


def test_hands_that_touch_nothing_turn_with_the_base(turn):
    samples = sample(turn, turn.scene, turn.robot, 20.0)
    for hand in (2, 3):
        assert (samples.rotations_W[:, hand] == samples.rotation_WB).all()
