"""mp.plan(..., motion=True): what is certified at once, what the search is told, and what is refused by name."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp  # noqa: E402
from command_line import one_line_error  # noqa: E402
from mcplan.alternation import _Asked  # noqa: E402
from mcplan.cli import main  # noqa: E402
from mcplan.errors import InvalidArgument, InvalidRobot  # noqa: E402
from mcplan.wb import MotionStatus, PlannedMotion  # noqa: E402
from mcplan.wb.result import Shortfall  # noqa: E402


class Found:
    """What a stage comes back with, as far as the next search asks for it."""

    def __init__(self, lack: Shortfall | None, motion=None) -> None:
        self.shortfall, self.motion = lack, motion


def test_a_walk_is_certified_in_the_first_round():
    result = mp.plan("flat", "talos", motion=True)
    assert isinstance(result, PlannedMotion) and result.solved and result.status == "solved"
    assert len(result.rounds) == 1 and str(result) == "solved after 1 round: plan solved, motion solved"
    assert result.motion.plan.duration() == result.plan.duration()
    mp.check(result.motion).raise_if_violated()


def test_a_time_limit_is_for_search_and_motion_together():
    result = mp.plan("flat", "talos", motion=True, time_limit=0.05)
    assert result.status == "time_limit" and not result.solved
    assert len(result.rounds) == 1 and result.plan.phases


@pytest.mark.slow
def test_a_jump_is_certified_after_another_round_or_refused_by_name():
    result = mp.plan("short_gap", "talos", motion=True, joint_limits=False)
    first = result.rounds[0]
    assert first.motion_status in (MotionStatus.SPEED_INFEASIBLE, MotionStatus.TORQUE_INFEASIBLE)
    assert "leg_" in first.found and len(result.rounds) >= 2
    assert result.rounds[1].asked == "joint limits"
    if result.solved:
        mp.check(result.motion).raise_if_violated()
        assert result.motion.plan.robot.end_effectors[0].limb.given
    else:
        assert result.motion_result.shortfall.joint in result.motion.joints
        assert result.motion_result.shortfall.factor > 1.0


@pytest.mark.slow
def test_a_jump_too_far_is_refused_with_joint_time_and_factor():
    result = mp.plan("gap", "talos", motion={"max_iterations": 60}, joint_limits=False)
    assert not result.solved and result.status in ("torque_infeasible", "speed_infeasible")
    lack = result.motion_result.shortfall
    assert lack.joint.startswith("leg_") and lack.factor > 1.1 and 0.0 < lack.time_s < result.plan.duration()
    assert result.rounds[-1].motion_status is None and result.rounds[-1].plan_status == "infeasible"


def test_limits_that_were_missing_are_told_to_the_next_search():
    robot = mp.load_robot("talos")
    asked = _Asked(robot, mp.ddp.Options())
    motion = mp.motion(standing(robot), max_iterations=0).motion
    limb = robot.end_effectors[0].limb
    plan = motion.plan
    assert asked.lower(plan, Found(Shortfall("torque", "leg_left_4_joint", 1.0, 1.2), motion))
    weaker = asked.robot.end_effectors[0].limb
    assert weaker.knee_torque == pytest.approx(limb.knee_torque / 1.2 / 1.05)
    assert weaker.hip_torque == pytest.approx(limb.hip_torque / 1.2 / 1.05)
    assert weaker.knee_speed == limb.knee_speed and asked.given.end_effectors[0].limb == limb
    assert asked.lower(plan, Found(Shortfall("speed", "leg_left_4_joint", 1.0, 1.5), motion))
    assert asked.robot.end_effectors[0].limb.knee_speed == pytest.approx(limb.knee_speed / 1.5 / 1.05)
    assert asked.lower(plan, Found(Shortfall("reach", "leg_left_1_joint", 1.0, 1.1), motion))
    nominal, lowest = robot.end_effectors[0].nominal_B, robot.end_effectors[0].reach_min_B
    assert asked.robot.end_effectors[0].reach_min_B == pytest.approx(nominal + 0.95 * (lowest - nominal))
    # An arm is no limb of the search: phases get longer. Where links meet, nothing that it knows would do.
    assert asked.lower(plan, Found(Shortfall("speed", "arm_left_2_joint", 1.0, 1.2), motion))
    assert asked.options.duration_min_s == pytest.approx(1.2 * 1.05 * 0.4)
    assert not asked.lower(plan, Found(Shortfall("distance", "links", 1.0, 1.2), motion))
    assert not asked.lower(plan, Found(None, motion))


def standing(robot: mp.Robot) -> mp.Plan:
    from standing import standing_plan

    return standing_plan(robot=robot)


def test_what_is_no_motion_and_robots_without_joints_are_refused():
    with pytest.raises(InvalidArgument, match="motion: must be True, or options"):
        mp.plan("flat", "talos", motion="yes")
    with pytest.raises(InvalidRobot, match="this robot has no joints"):
        mp.plan("flat", "humanoid44", motion=True)


def test_the_command_writes_the_motion_too(capsys, tmp_path):
    scene = mp.load_scene("flat")
    goal = scene.goal
    goal.position_W = [0.3, 0.0, 0.0]
    scene.goal = goal
    mp.files.scenes.save_scene(scene, tmp_path / "near.toml")
    words = ["plan", str(tmp_path / "near.toml"), "--robot", "go2", "--motion", str(tmp_path / "motion.npz"), "--json"]
    assert main(words) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["motion"]["status"] == "solved" and said["rounds"] == ["plan solved, motion solved"]
    mp.check(mp.wb.Motion.load(tmp_path / "motion.npz")).raise_if_violated()
    code = main(["plan", "flat", "--motion", str(tmp_path / "motion.txt")])
    assert "--motion" in one_line_error((code, *capsys.readouterr()))
