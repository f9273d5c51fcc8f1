"""Samples of whole-body plans: the plan's own states, bodies by exact kinematics, gaps where nothing is touched."""

import numpy as np
import pytest

from mcplan._core import planar_kinematics, planar_point
from mcplan.planar.view.samples import frame_times, sample_phases, sample_whole_body
from reference_solutions import reference_names, reference_plan


@pytest.fixture(scope="module", params=[("cartwheel", "optimised_per_point"), ("walking", "feasible_uniform")])
def plan(request):
    return reference_plan(*request.param)


def test_bodies_and_soles_are_those_of_exact_kinematics(plan):
    samples = sample_whole_body(plan, frame_times(plan.duration(), 20.0))
    robot = plan.task.robot
    for n, t in enumerate(samples.times_s):
        frames = planar_kinematics(robot, plan.at(min(float(t), plan.duration())).configuration)
        assert samples.positions_W[n] == pytest.approx(np.array([f.position_W for f in frames]), abs=1e-12)
        assert samples.angles[n] == pytest.approx([f.angle for f in frames], abs=1e-12)
        for e, end in enumerate(robot.end_effectors):
            sole = planar_point(frames[end.body], end.position_B, end.angle_B)
            assert samples.soles_W[n, e] == pytest.approx(sole.position_W, abs=1e-12)
            assert samples.sole_angles[n, e] == pytest.approx(sole.angle, abs=1e-12)


def test_both_sides_of_every_boundary_are_sampled(plan):
    samples = sample_phases(plan, 50.0)
    knots = plan.knot_times()
    for k in range(len(plan.durations)):
        own = samples.times_s[samples.phases == k]
        assert (own[0], own[-1]) == pytest.approx((knots[k], knots[k + 1]))
        last = np.flatnonzero(samples.phases == k)[-1]
        assert samples.torque[last] == pytest.approx(plan.at_phase(k, plan.durations[k]).torque)


def test_forces_stand_where_there_is_contact_and_nowhere_else(plan):
    samples = sample_phases(plan, 50.0)
    for n in range(samples.count):
        phase = plan.task.phases[samples.phases[n]]
        touching = {c.end_effector: c.surface for c in phase.contacts}
        for e in range(samples.surfaces.shape[1]):
            assert samples.surfaces[n, e] == touching.get(e, -1)
            finite = np.isfinite(samples.normal[n, e])
            assert finite.all() if e in touching else not finite.any()
            assert np.isfinite(samples.errors[n, e]).all() == (e in touching)


@pytest.mark.parametrize(("task", "name"), reference_names())
def test_components_are_those_of_the_force(task, name):
    plan = reference_plan(task, name)
    samples = sample_whole_body(plan, frame_times(plan.duration(), 10.0))
    for n, e, p in np.argwhere(np.isfinite(samples.normal)):
        surface = plan.task.surfaces[samples.surfaces[n, e]]
        force = samples.tangential[n, e, p] * surface.tangent_W + samples.normal[n, e, p] * surface.normal_W
        # Soles stand as the plan expects them, which is along the surface.
        assert samples.forces_W[n, e, p] == pytest.approx(force, abs=1e-6)


def test_frames_have_both_ends():
    times = frame_times(1.03, 30.0)
    assert (times[0], times[-1]) == (0.0, 1.03)
    assert np.diff(times).max() == pytest.approx(1.0 / 30.0, rel=0.05)
