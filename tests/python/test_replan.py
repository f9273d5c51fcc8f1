"""mcplan.replan with what a control loop may hand over by mistake: a typed error that names it, or a result; no crash."""

from __future__ import annotations

import copy
import math
import random
from typing import Any

import numpy as np
import pytest

import mcplan as mp
from api_signatures import full_name, interface_of
from api_values import Values

NAN, INFINITE = math.nan, math.inf
LIMITS = {"max_iterations": 3, "restarts": 0, "time_limit": 0.05}


@pytest.fixture(scope="module")
def plan() -> mp.Plan:
    return mp.plan("flat", phases=6, max_iterations=3, restarts=0).plan


def knot(plan: mp.Plan, **changes: Any) -> mp.model.Knot:
    """The state at the plan's start with some values replaced."""
    measured = copy.copy(plan.knots[0])
    for name, value in changes.items():
        setattr(measured, name, value)
    return measured


@pytest.mark.parametrize("t", [NAN, INFINITE, -INFINITE, -1e-6, 1e9, 1e300, -1e300])
def test_a_time_outside_of_the_plan_is_refused(plan, t):
    with pytest.raises(mp.InvalidInput, match="t: must lie in"):
        mp.replan(plan, t, plan.knots[0], **LIMITS)


@pytest.mark.parametrize("where", [0.0, 1e-9, 0.5, 1.0])
def test_any_time_within_the_plan_has_a_result(plan, where):
    t = where * plan.duration()
    now = plan.at(t)
    measured = knot(
        plan,
        com_W=now.com_W,
        com_velocity_W=now.com_velocity_W,
        end_effectors_W=[end.position_W for end in now.end_effectors],
    )
    result = mp.replan(plan, t, measured, **LIMITS)
    assert result.plan.measured_start and isinstance(result.report.status, mp.Status)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"com_W": [0.0, NAN, 0.8]}, r"measured.com_W: must be finite numbers"),
        ({"com_W": [0.0, 0.0, INFINITE]}, r"measured.com_W: must be finite numbers"),
        ({"com_velocity_W": [NAN] * 3}, r"measured.com_velocity_W: must be finite numbers"),
        ({"base_rpy": [NAN, 0.0, 0.0]}, r"measured.base_rpy: must be finite numbers"),
        ({"base_rpy": [0.0, 0.0, 1e4]}, r"measured.base_rpy: must be angles of fewer than 1000 turns"),
        ({"base_rpy_rate": [0.0, -INFINITE, 0.0]}, r"measured.base_rpy_rate: must be finite numbers"),
        ({"angular_momentum_W": [0.0, 0.0, NAN]}, r"measured.angular_momentum_W: must be finite numbers"),
        ({"end_effectors_W": []}, r"measured.end_effectors_W: must be one per end-effector \(4\), got 0"),
        ({"end_effectors_W": np.zeros((3, 3))}, r"measured.end_effectors_W: must be one per end-effector \(4\), got 3"),
        ({"end_effectors_W": np.zeros((9, 3))}, r"measured.end_effectors_W: must be one per end-effector \(4\), got 9"),
        ({"end_effectors_W": np.full((4, 3), NAN)}, r"measured.end_effectors_W: must be finite numbers"),
        (
            {"end_effector_velocities_W": np.zeros((1, 3))},
            r"measured.end_effector_velocities_W: must be one per end-effector \(4\), got 1",
        ),
        (
            {"end_effector_velocities_W": np.zeros((9, 3))},
            r"measured.end_effector_velocities_W: must be one per end-effector \(4\), got 9",
        ),
        (
            {"end_effector_velocities_W": np.full((4, 3), NAN)},
            r"measured.end_effector_velocities_W: must be finite numbers",
        ),
        ({"end_effector_yaw": [0.0]}, r"measured.end_effector_yaw: must be one per end-effector \(4\), got 1"),
        ({"end_effector_yaw": [NAN] * 4}, r"measured.end_effector_yaw: must be finite numbers"),
    ],
)
def test_a_measured_state_of_the_wrong_size_or_without_numbers_is_refused(plan, changes, message):
    with pytest.raises(mp.errors.InvalidPlan, match=message):
        mp.replan(plan, 0.0, knot(plan, **changes), **LIMITS)


@pytest.mark.parametrize(
    "changes",
    [
        {"com_W": [1e6, 0.0, 0.0]},
        {"com_W": [0.0, 0.0, -3.0]},
        {"com_velocity_W": [1e9, 1e9, 1e9]},
        {"com_W": [1e300, 0.0, 0.0]},
        {"base_rpy": [0.0, math.pi / 2, 0.0]},
        {"base_rpy_rate": [1e12, 0.0, 0.0]},
        {"angular_momentum_W": [1e300, -1e300, 1e300]},
        {"end_effectors_W": np.full((4, 3), 1e200)},
        {"end_effector_yaw": [1e18] * 4},
    ],
)
def test_a_measured_state_that_no_robot_has_ends_in_a_status_or_a_typed_error(plan, changes):
    try:
        result = mp.replan(plan, 0.0, knot(plan, **changes), **LIMITS)
    except mp.InvalidInput:
        return
    assert result.report.status not in (mp.Status.solved, mp.Status.acceptable)


def test_another_robot_is_refused_by_its_end_effectors(plan):
    with pytest.raises(
        mp.errors.InvalidPlan, match=r"previous.robot.end_effectors: must be one per end-effector \(2\), got 4"
    ):
        mp.replan(plan, 0.0, plan.knots[0], scene=mp.load_scene("rubbles"), robot=mp.load_robot("talos_wang"), **LIMITS)


def test_another_robot_of_as_many_end_effectors_is_refused_by_their_names(plan):
    with pytest.raises(
        mp.errors.InvalidPlan, match=r"previous.robot.end_effectors\[0\].name: must be that of the robot \(rf_foot\)"
    ):
        mp.replan(plan, 0.0, plan.knots[0], robot=mp.load_robot("anymal"), **LIMITS)


@pytest.mark.parametrize("time_limit", [1e-6, 1e-4])
@pytest.mark.parametrize("left_s", [0.0, 1e-13, 1e-9])
def test_out_of_time_at_the_end_of_the_plan_there_is_a_status(plan, time_limit, left_s):
    result = mp.replan(plan, plan.duration() - left_s, plan.knots[-1], time_limit=time_limit)
    assert result.report.status == mp.Status.time_limit
    for phase in result.plan.phases:
        assert phase.duration > 1e-6


def test_a_surface_that_is_not_there_is_named(plan):
    with pytest.raises(mp.errors.InvalidPlan, match=r"measured.contacts.left_foot: must be .* scene, got \"x\""):
        mp.replan(plan, 0.0, plan.knots[0], contacts={"left_foot": "x"}, **LIMITS)


def test_a_scene_without_the_surfaces_of_the_plan_is_refused_or_planned_in(plan):
    few = copy.copy(plan.scene)
    few.surfaces = []
    with pytest.raises(mp.errors.InvalidScene, match="surfaces"):
        mp.replan(plan, 0.0, plan.knots[0], scene=few, **LIMITS)


@pytest.mark.parametrize("seed", range(8))
def test_edited_plans_scenes_robots_and_states_end_in_a_result_or_a_typed_error(plan, seed):
    rng = random.Random(seed)
    rail = mp.plan("gap_with_rail", phases=6, max_iterations=1, restarts=0).plan
    whole = [plan, rail, mp.load_robot("talos_wang"), mp.load_scene("gap"), mp.load_scene("flat")]
    pool: dict[str, list[Any]] = {}
    for value in [*whole, *(mp.load_robot("anymal"), plan.knots[1], rail.knots[2])]:
        pool.setdefault(full_name(type(value)), []).append(value)
    values = Values(rng, interface_of(), pool)
    for _ in range(40):
        previous, t = copy.deepcopy(rng.choice([plan, rail])), values.number()
        measured = copy.deepcopy(rng.choice(list(previous.knots)))
        others = {kind: rng.choice([None, *pool[f"mcplan._core.{kind.capitalize()}"]]) for kind in ("scene", "robot")}
        t = rng.choice([t, 0.0, 0.3 * previous.duration()])
        try:
            values.edit(rng.choice([previous, measured, *(value for value in others.values() if value)]))
            given = repr([*previous.phases, *previous.knots, measured])
        except (ValueError, TypeError):  # an edit that is refused where it is made
            continue
        try:
            mp.replan(previous, t, measured, **others, **LIMITS)
        except mp.InvalidInput:
            pass
        except BaseException as error:
            pytest.fail(f"seed {seed}: replan at {t} of {previous}, {measured}, {others} raised {error!r}")
        assert repr([*previous.phases, *previous.knots, measured]) == given  # what is handed over stays as it was
