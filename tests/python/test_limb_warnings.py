"""What the checker warns of: straight limbs in solids."""

from __future__ import annotations

import copy
import json

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.scenes import save_scene


def fenced(x: float, bottom: float = 0.25, depth: float = 0.1) -> mp.Scene:
    """Level ground with a fence up to 0.60 m at x, from wall to wall, below which the feet swing."""
    scene = mp.load_scene("flat")
    corners = [[x, -20.0, 0.6], [x + depth, -20.0, 0.6], [x + depth, 20.0, 0.6], [x, 20.0, 0.6]]
    fence = mp.model.Surface(name="fence", vertices_W=corners, thickness=0.6 - bottom, end_effectors=["right_hand"])
    scene.surfaces = [*scene.surfaces, fence]
    return scene


@pytest.fixture(scope="module")
def walk() -> mp.Plan:
    """Over level ground."""
    result = mp.plan("flat", "humanoid44")
    assert str(result.report.status) == "solved"
    return result.plan


@pytest.fixture
def past_bar(walk) -> mp.Plan:
    """A walk whose legs pass through a bar, by no more than they can bend."""
    plan = copy.deepcopy(walk)
    plan.scene = fenced(0.9, bottom=0.55, depth=0.02)
    return plan


def test_a_plan_whose_legs_touch_a_bar_has_a_warning(past_bar):
    result = mp.check(past_bar)
    assert result.ok() and not result.violations()
    (warning,) = result.warnings
    assert (warning.name, warning.surface) == ("limb", "fence") and warning.end_effector.endswith("foot")
    assert 0.02 < warning.value < 0.15 and 0 <= warning.time_s <= past_bar.duration()
    at = past_bar.at(warning.time_s)
    names = [end.name for end in past_bar.robot.end_effectors]
    foot = at.end_effectors[names.index(warning.end_effector)].position_W
    assert min(foot[0], at.com_W[0]) < 0.92 and max(foot[0], at.com_W[0]) > 0.9
    assert str(result).startswith("ok\nwarning: limb at ") and "in the solid of 'fence'" in str(result)


def test_the_command_tells_warnings_and_its_exit_code_does_not(past_bar, tmp_path, capsys):
    file = tmp_path / "plan.npz"
    past_bar.save(file)
    assert main(["check", str(file)]) == 0
    assert "warning: limb at " in capsys.readouterr().out
    assert main(["check", str(file), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["ok"] and not told["violations"]
    assert [(w["name"], w["surface"]) for w in told["warnings"]] == [("limb", "fence")]


def test_legs_on_both_sides_of_a_fence_are_a_violation(walk, tmp_path, capsys):
    plan = copy.deepcopy(walk)
    plan.scene = fenced(0.9)
    result = mp.check(plan)
    assert [violation.name for violation in result.violations()] == ["limb"]
    assert [warning.surface for warning in result.warnings] == ["fence"]
    file = tmp_path / "plan.npz"
    plan.save(file)
    assert main(["check", str(file)]) == 1
    out = capsys.readouterr().out
    assert "limb at " in out and "warning: limb at " in out


def test_a_receding_horizon_over_a_fence_is_not_solved_and_has_the_warnings_of_its_plan(tmp_path, capsys):
    scene = fenced(0.1)
    walk = mp.walk(scene, cycles=2, lookahead=2)
    assert str(walk.report.status) != "solved" and walk.report.worst_violation.name == "limb"
    assert [w.surface for w in walk.report.warnings] == ["fence"]
    assert [str(w) for w in walk.report.warnings] == [str(w) for w in mp.check(walk.plan).warnings]
    file = tmp_path / "fenced.toml"
    save_scene(scene, file)
    words = ["rhp", str(file), "--cycles", "2", "--lookahead", "2", "--quiet"]
    assert main(words) == 0  # every cycle was done, the status tells what the checker finds
    assert f"warning: {walk.report.warnings[0]}: limbs are not planned around solids" in capsys.readouterr().out
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["status"] == "acceptable" and [(w["name"], w["surface"]) for w in told["warnings"]] == [
        ("limb", "fence")
    ]


def test_open_ground_warns_of_nothing():
    result = mp.plan("flat", "humanoid44")
    assert result.report.warnings == ()
    assert str(mp.check(result.plan)) == "ok"
