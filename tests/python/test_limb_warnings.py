"""What the checker warns of: straight limbs in solids."""

from __future__ import annotations

import json

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.scenes import save_scene


def fenced(x: float) -> mp.Scene:
    """Level ground with a fence from 0.25 to 0.60 m at x, below which the feet swing and legs pass through it."""
    scene = mp.load_scene("flat")
    corners = [[x, -2.0, 0.6], [x + 0.1, -2.0, 0.6], [x + 0.1, 2.0, 0.6], [x, 2.0, 0.6]]
    fence = mp.model.Surface(name="fence", vertices_W=corners, thickness=0.35, end_effectors=["right_hand"])
    scene.surfaces = [*scene.surfaces, fence]
    return scene


@pytest.fixture(scope="module")
def over_fence() -> mp.Plan:
    """A walk whose legs pass through a fence."""
    result = mp.plan(fenced(0.9), "humanoid44")
    assert str(result.report.status) == "solved"
    assert [w.surface for w in result.report.warnings] == ["fence"]
    return result.plan


def test_a_solved_plan_whose_legs_pass_through_a_fence_has_a_warning(over_fence):
    result = mp.check(over_fence)
    assert result.ok() and not result.violations()
    (warning,) = result.warnings
    assert (warning.name, warning.surface) == ("limb", "fence") and warning.end_effector.endswith("foot")
    assert 0.1 < warning.value < 0.4 and 0 <= warning.time_s <= over_fence.duration()
    at = over_fence.at(warning.time_s)
    names = [end.name for end in over_fence.robot.end_effectors]
    foot = at.end_effectors[names.index(warning.end_effector)].position_W
    assert min(foot[0], at.com_W[0]) < 1.0 and max(foot[0], at.com_W[0]) > 0.9
    assert str(result).startswith("ok\nwarning: limb at ") and "in the solid of 'fence'" in str(result)


def test_the_command_tells_warnings_and_its_exit_code_does_not(over_fence, tmp_path, capsys):
    file = tmp_path / "plan.npz"
    over_fence.save(file)
    assert main(["check", str(file)]) == 0
    assert "warning: limb at " in capsys.readouterr().out
    assert main(["check", str(file), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["ok"] and not told["violations"]
    assert [(w["name"], w["surface"]) for w in told["warnings"]] == [("limb", "fence")]


def test_a_walk_over_a_fence_has_the_warnings_of_its_plan(tmp_path, capsys):
    scene = fenced(0.1)
    walk = mp.walk(scene, cycles=2, lookahead=2)
    assert str(walk.report.status) == "solved"
    assert [w.surface for w in walk.report.warnings] == ["fence"]
    assert [str(w) for w in walk.report.warnings] == [str(w) for w in mp.check(walk.plan).warnings]
    file = tmp_path / "fenced.toml"
    save_scene(scene, file)
    words = ["rhp", str(file), "--cycles", "2", "--lookahead", "2", "--quiet"]
    assert main(words) == 0
    assert f"warning: {walk.report.warnings[0]}: limbs are not planned around solids" in capsys.readouterr().out
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["success"] and [(w["name"], w["surface"]) for w in told["warnings"]] == [("limb", "fence")]


def test_open_ground_warns_of_nothing():
    result = mp.plan("flat", "humanoid44")
    assert result.report.warnings == ()
    assert str(mp.check(result.plan)) == "ok"
