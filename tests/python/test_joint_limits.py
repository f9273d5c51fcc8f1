"""Joint limits of legs in the contact-sequence search."""

from __future__ import annotations

import copy

import pytest

import mcplan as mp


def found(result, name):
    return next(v for v in mp.check(result.plan).constraints if v.name == name)


@pytest.mark.parametrize("scene", ["flat", "stairs_broad"])
def test_walks_are_solved_with_joint_limits(scene):
    result = mp.plan(scene, "talos")
    assert str(result.report.status) == "solved", result.report.message
    assert found(result, "joint_torque").phase >= 0
    assert found(result, "joint_torque").value < 0.0
    assert found(result, "joint_speed").value < 0.0


@pytest.mark.slow
def test_a_jump_beyond_the_knees_is_refused_and_without_the_option_it_is_planned():
    """The torques of `gap` without limits are 1.8 times what TALOS has."""
    refused = mp.plan("gap", "talos")
    assert str(refused.report.status) != "solved"
    assert refused.plan.robot.end_effectors[0].limb.given
    jump = mp.plan("gap", "talos", joint_limits=False)
    assert str(jump.report.status) == "solved"
    assert not jump.plan.robot.end_effectors[0].limb.given
    jump.plan.robot = mp.load_robot("talos")
    assert found(jump, "joint_torque").value > 0.3
    assert {v.name for v in mp.check(jump.plan).violations()} >= {"joint_torque", "joint_speed"}


def test_limits_of_a_robot_survive_its_file_and_its_plan(tmp_path):
    robot = mp.load_robot("talos")
    mp.files.robots.save_robot(robot, tmp_path / "talos.toml")
    assert mp.load_robot(tmp_path / "talos.toml").end_effectors[0].limb == robot.end_effectors[0].limb
    plan = mp.plan("flat", robot).plan
    for name in ("plan.npz", "plan.json"):
        plan.save(tmp_path / name)
        assert mp.Plan.load(tmp_path / name).robot.end_effectors[0].limb == robot.end_effectors[0].limb


def test_stronger_knees_plan_what_weaker_ones_do_not():
    """A squat on the way: with a tenth of the torque no leg bears the robot."""
    weak = copy.deepcopy(mp.load_robot("talos"))
    ends = weak.end_effectors
    for end in ends:
        if end.limb.given:
            end.limb.knee_torque = 0.1 * end.limb.knee_torque
    weak.end_effectors = ends
    result = mp.plan("flat", weak, time_limit=3.0)
    assert str(result.report.status) != "solved"
