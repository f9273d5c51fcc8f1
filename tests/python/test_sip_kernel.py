"""The kernel on whole bodies from where it used to fail: stuck between cones, far starts, what cannot be done."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import planar_task_from_plain, planar_task_to_plain
from test_sip_motions import assert_kept

SLOW = pytest.mark.slow


def far_start(task: str, forces: str, amplitude: float, seed: int) -> mp.PlanarPlan:
    """One second, control points anywhere within the amplitude [rad], weights of one."""
    plan = mp.whole_body(task, minimise="none", forces=forces, solver="ipm", max_iterations=1).plan
    joints, count = np.array(plan.control_points).shape
    free = np.random.default_rng(seed).uniform(-amplitude, amplitude, (joints, count - 4))
    plan.control_points = np.hstack([free[:, :1], free[:, :1], free, free[:, -1:], free[:, -1:]])
    phases = plan.task.phases
    plan.durations = [phase.intervals / plan.task.interval_count() for phase in phases]
    plan.weights = [np.ones_like(np.array(weights)) for weights in plan.weights]
    return plan


@pytest.mark.parametrize("task", ["climbing_steep", pytest.param("chimney", marks=SLOW)])
def test_between_steep_walls_a_motion_without_weights_is_found_by_way_of_weights(task):
    result = mp.whole_body(task, minimise="none", forces="uniform", solver="ipm")
    assert result.report.status == mp.Status.solved, result.report.message
    assert str(result.solver) == "Solver.ipm"
    assert all(np.ptp(weights) == 0.0 for weights in result.plan.weights)
    assert_kept(result.plan)


@pytest.mark.parametrize(
    ("task", "forces", "amplitude", "seed"),
    [
        ("walking", "per_body", 0.3, 3),  # a margin moved nothing
        ("cartwheel", "per_body", 0.6, 0),  # ten seconds long: order 8 leaves out 2 % of the weight
        ("cartwheel", "per_body", 0.6, 2),
        ("cartwheel", "per_point", 0.6, 1),
    ],
)
def test_what_polynomials_leave_out_of_long_intervals_is_made_up_for(task, forces, amplitude, seed):
    start = far_start(task, forces, amplitude, seed)
    result = mp.whole_body(task, warm_start=start, minimise="none", forces=forces, solver="ipm")
    assert result.report.status == mp.Status.solved, result.report.message
    assert_kept(result.plan)


@pytest.mark.parametrize("forces", ["uniform", "per_body", "per_point"])
@pytest.mark.parametrize(
    "task", ["cartwheel", pytest.param("walking", marks=SLOW), pytest.param("climbing", marks=SLOW)]
)
def test_motors_that_are_too_weak_are_said_to_be(task, forces):
    plain = planar_task_to_plain(mp.load_planar_task(task))
    for body in plain["robot"]["bodies"]:
        if isinstance(body["torque_max"], float):  # that of the base is no number
            body["torque_max"] *= 0.08
    result = mp.whole_body(planar_task_from_plain(plain), minimise="none", forces=forces, solver="ipm")
    assert result.report.status == mp.Status.infeasible, result.report.message
    assert "torque at" in result.report.message
    assert not mp.check(result.plan).ok()


@SLOW
def test_the_cheapest_walk_does_not_hang_on_the_weights_of_a_first_one():
    result = mp.whole_body("walking", forces="per_point", solver="ipm")
    assert result.report.status == mp.Status.solved, result.report.message
    assert result.report.cost <= 1.02 * 414.5


def test_friction_without_limit_is_no_obstacle():
    plain = planar_task_to_plain(mp.load_planar_task("cartwheel"))
    for surface in plain["surfaces"]:
        surface["friction"] = 1e9
    result = mp.whole_body(planar_task_from_plain(plain), minimise="none", forces="uniform", solver="ipm")
    assert result.report.status == mp.Status.solved, result.report.message
