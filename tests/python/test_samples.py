"""Plan.sample: arrays of what Plan.at says."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp


@pytest.fixture(scope="module")
def plan() -> mp.Plan:
    return mp.plan("stairs").plan


def test_samples_are_what_at_says_of_each_time(plan):
    times = np.concatenate([[plan.duration(), 0.0], np.linspace(0.1, plan.duration(), 57), plan.knot_times()])
    samples = plan.sample(times)
    assert len(samples) == len(times) and isinstance(samples, mp.model.PlanSamples)
    for i, t in enumerate(times):
        state = plan.at(t)
        assert (samples.times[i], samples.phase[i]) == (t, state.phase)
        for name in ("com_W", "com_velocity_W", "com_acceleration_W", "base_rpy", "base_rpy_rate", "base_quat_wxyz"):
            np.testing.assert_array_equal(getattr(samples, name)[i], getattr(state, name))
        np.testing.assert_array_equal(samples.angular_momentum_W[i], state.angular_momentum_W)
        for e, end in enumerate(state.end_effectors):
            assert (samples.surfaces[i, e], samples.end_effector_yaw[i, e]) == (end.surface, end.yaw)
            np.testing.assert_array_equal(samples.end_effectors_W[i, e], end.position_W)
            np.testing.assert_array_equal(samples.end_effector_velocities_W[i, e], end.velocity_W)
            np.testing.assert_array_equal(samples.forces_W[i, e], end.force_W)
            np.testing.assert_array_equal(samples.moments_W[i, e], end.moment_W)
            np.testing.assert_array_equal(samples.centers_of_pressure_W[i, e], end.center_of_pressure_W)


def test_no_times_give_empty_arrays(plan):
    samples = plan.sample([])
    assert (len(samples), samples.com_W.shape, samples.forces_W.shape) == (0, (0, 3), (0, 4, 3))


def test_what_is_sampled_is_newtons_law(plan):
    times = np.linspace(0.0, plan.duration(), 500)
    samples = plan.sample(times)
    force = samples.forces_W.sum(axis=1) + [0.0, 0.0, -plan.robot.mass * plan.scene.gravity]
    np.testing.assert_allclose(force, plan.robot.mass * samples.com_acceleration_W, atol=1e-6)


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([0.0, -0.1], r"times\[1\]: must lie in \[0, "),
        ([0.0, 1.0, np.nan], r"times\[2\]: must lie in"),
        ([1e9], r"times\[0\]: must lie in"),
        ("soon", "times: must be an array of numbers"),
        ([[0.0, 1.0]], "times: must have one dimension"),
        (0.5, "times: must have one dimension"),
    ],
)
def test_times_outside_the_plan_are_named(plan, times, message):
    with pytest.raises(mp.InvalidInput, match=message):
        plan.sample(times)


def test_a_plan_that_does_not_fit_together_is_refused(plan):
    broken = mp.Plan(knots=list(plan.knots)[:-1], phases=plan.phases, scene=plan.scene, robot=plan.robot)
    with pytest.raises(mp.errors.InvalidPlan):
        broken.sample([0.0])


def test_the_end_may_be_missed_by_rounding(plan):
    """Sums of steps end a bit after it; ``at`` takes them, too."""
    end_s = plan.duration()
    samples = plan.sample([-1e-12, end_s + 1e-12])
    fastest_m_s = 10.0
    assert np.abs(samples.com_W - plan.sample([0.0, end_s]).com_W).max() <= 1e-12 * fastest_m_s
