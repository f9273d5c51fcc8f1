"""Headings in mcplan.replan: estimators wrap them around, plans count turns, and a robot may walk in circles."""

from __future__ import annotations

import math

import pytest

import mcplan as mp
from planned_states import state_at

TURN = 2.0 * math.pi


def turn(knot: mp.model.Knot, by: float) -> None:
    knot.base_rpy = [*knot.base_rpy[:2], knot.base_rpy[2] + by]
    knot.end_effector_yaw = [yaw + by for yaw in knot.end_effector_yaw]


@pytest.fixture(scope="module")
def backwards() -> mp.Plan:
    """A short walk that heads to where headings are wrapped around."""
    scene = mp.load_scene("flat")
    start, goal = scene.start, scene.goal
    start.yaw = goal.yaw = 3.0
    goal.position_W = [start.position_W[0] - 0.3, *start.position_W[1:]]
    scene.start, scene.goal = start, goal
    return mp.plan(scene, "humanoid44", phases=10).plan


@pytest.mark.parametrize("turns", [-2, -1, 1, 3])
@pytest.mark.parametrize("command", [None, (0.1, 0.0, 0.1)])
def test_a_heading_is_the_same_however_its_turns_are_counted(backwards, turns, command):
    knot, contacts = state_at(backwards, 1.0)
    as_planned = mp.replan(backwards, 1.0, knot, contacts=contacts, command=command)
    turn(knot, turns * TURN)
    turned = mp.replan(backwards, 1.0, knot, contacts=contacts, command=command)
    assert as_planned.report.status == turned.report.status == mp.Status.solved
    for t in (0.0, 0.7, 1.5):
        was, now = as_planned.plan.at(t), turned.plan.at(t)
        assert now.com_W == pytest.approx(was.com_W, abs=1e-4)
        assert math.remainder(now.base_rpy[2] - was.base_rpy[2], TURN) == pytest.approx(0.0, abs=1e-4)


def test_soles_may_be_counted_otherwise_than_the_base(backwards):
    knot, contacts = state_at(backwards, 1.0)
    knot.end_effector_yaw = [yaw - TURN for yaw in knot.end_effector_yaw]
    assert mp.replan(backwards, 1.0, knot, contacts=contacts).report.status == mp.Status.solved


def test_a_goal_is_the_same_however_its_turns_are_counted():
    scene = mp.load_scene("flat")
    start, goal = scene.start, scene.goal
    start.yaw, goal.yaw = 3.0, -3.0
    goal.position_W = start.position_W
    scene.start, scene.goal = start, goal
    across = mp.plan(scene, "humanoid44").plan
    goal.yaw += TURN
    scene.goal = goal
    counted = mp.plan(scene, "humanoid44").plan
    assert across == counted and counted.knots[-1].base_rpy[2] == pytest.approx(goal.yaw, abs=0.01)
    goal.yaw -= TURN
    scene.goal = goal
    knot, contacts = state_at(across, 1.0)
    on = mp.replan(across, 1.0, knot, contacts=contacts, scene=scene)
    assert on.report.status == mp.Status.solved
    assert on.plan.knots[-1].base_rpy[2] == pytest.approx(TURN - 3.0, abs=0.01)


@pytest.mark.parametrize("wrapped", [True, False])
@pytest.mark.parametrize("rate", [0.3, -0.3])
def test_a_robot_turns_on_beyond_half_a_turn(backwards, wrapped, rate):
    plan = backwards
    if rate < 0.0:  # the same on the other side: 3.0 rad counted as -3.28
        knot, contacts = state_at(plan, 0.1)
        turn(knot, -TURN)
        plan = mp.replan(plan, 0.1, knot, contacts=contacts, command=(0.0, 0.0, rate)).plan
    heading = turned = plan.at(0.0).base_rpy[2]
    for i in range(40 if rate > 0.0 else 90):
        knot, contacts = state_at(plan, 0.1)
        if wrapped:
            turn(knot, math.remainder(knot.base_rpy[2], TURN) - knot.base_rpy[2])
        result = mp.replan(plan, 0.1, knot, contacts=contacts, command=(0.0, 0.0, rate))
        assert result.report.status in (mp.Status.solved, mp.Status.acceptable), (i, result.report.message)
        plan = result.plan
        turned += math.remainder(plan.at(0.0).base_rpy[2] - turned, TURN)
    assert (turned - heading) * math.copysign(1.0, rate) > 0.6


def test_a_command_to_spin_is_slowed_down(backwards):
    knot, contacts = state_at(backwards, 1.0)
    result = mp.replan(backwards, 1.0, knot, contacts=contacts, command=(0.0, 0.0, 50.0))
    assert "of the velocity command is followed" in result.report.message
    assert abs(result.plan.scene.goal.yaw) <= TURN


@pytest.mark.parametrize("off", [-0.2, 0.15])
def test_a_sole_in_the_air_goes_on_from_its_own_heading(backwards, off):
    t = next(t / 10 for t in range(5, 40) if state_at(backwards, t / 10)[1][:2].count(-1) == 1)
    knot, contacts = state_at(backwards, t)
    foot = contacts.index(-1)
    headings = list(knot.end_effector_yaw)
    headings[foot] += off
    knot.end_effector_yaw = headings
    result = mp.replan(backwards, t, knot, contacts=contacts)
    assert result.report.status == mp.Status.solved
    assert result.plan.at(0.0).end_effectors[foot].yaw == pytest.approx(headings[foot], abs=1e-9)
    landed = next(k for k in range(1, 6) if result.plan.contact_sequence()[k][foot] >= 0)
    end = result.plan.at(result.plan.knot_times()[landed]).end_effectors[foot].yaw
    assert abs(end - knot.base_rpy[2]) < abs(off)
