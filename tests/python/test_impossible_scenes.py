"""Scenes without a plan are told so before the search, by name; those with a plan never are."""

from __future__ import annotations

import json
import math

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.generate import random_scene


def rectangle(name: str, x: tuple[float, float], z: float = 0.0) -> mp.model.Surface:
    corners = [[x[0], -1.0, z], [x[1], -1.0, z], [x[1], 1.0, z], [x[0], 1.0, z]]
    return mp.model.Surface(name=name, vertices_W=corners, end_effectors=["foot"])


def scene(surfaces: list[mp.model.Surface], goal: list[float]) -> mp.Scene:
    out = mp.Scene(name="impossible")
    out.surfaces = surfaces
    out.start.contacts = {"foot": surfaces[0].name}
    out.goal.contacts = {"foot": surfaces[-1].name}
    out.goal.position_W = goal
    return out


def gap(width: float) -> mp.Scene:
    return scene([rectangle("a", (-1.0, 0.5)), rectangle("b", (0.5 + width, 3.0 + width))], [1.0 + width, 0.0, 0.0])


def slippery(degrees: float, friction: float) -> mp.Scene:
    rise = math.tan(math.radians(degrees))
    slope = rectangle("s", (-1.0, 3.0))
    slope.vertices_W = [[x, y, rise * x] for x, y, _ in slope.vertices_W]
    slope.friction = friction
    return scene([slope], [1.0, 0.0, rise])


def goal_in_a_block() -> mp.Scene:
    block = rectangle("block", (1.5, 2.5), 1.0)
    block.thickness, block.end_effectors = 1.0, ["right_hand"]
    out = scene([rectangle("a", (-3.0, 3.0)), block], [2.0, 0.0, 0.0])
    out.goal.contacts = {"foot": "a"}
    return out


IMPOSSIBLE = {
    'goal: the trunk of humanoid44, with the CoM at [2.0, 0.0, 0.7], would be in the solid of "block"': goal_in_a_block(),
    'the gap of 5 m between "a" and "b" is wider than any jump of humanoid44: at most ': gap(5.0),
    'friction 0.05 of "s" cannot hold on a slope of 30 degrees, which takes 0.577': slippery(30.0, 0.05),
    'goal: right_foot would stand on "a", 0.1 m out of its reach from the CoM at [1.0, 0.0, 0.85]': scene(
        [rectangle("a", (-3.0, 3.0))], [1.0, 0.0, 0.15]
    ),
}


@pytest.mark.parametrize("message", IMPOSSIBLE)
def test_an_impossible_scene_is_infeasible_by_name_before_the_first_iteration(message):
    for model in ("wrench", "lipm"):
        result = mp.plan(IMPOSSIBLE[message], model=model)
        assert str(result.report.status) == "infeasible" and result.report.iterations == 0
        assert result.report.message.startswith(message[:40]), result.report.message
        assert not result.plan.phases


@pytest.mark.parametrize("robot", ["talos", "g1", "anymal", "go2"])
def test_gaps_that_no_jump_crosses_are_told_for_robots_of_urdfs_too(robot):
    report = mp.plan(gap(5.0), robot).report
    assert report.status == mp.Status.infeasible and report.iterations == 0
    assert report.message.startswith(f'the gap of 5 m between "a" and "b" is wider than any jump of {robot}: at most ')


def test_the_command_says_it_and_saves_nothing(tmp_path, capsys):
    file = tmp_path / "gap.toml"
    mp.files.scenes.save_scene(gap(5.0), file)
    assert main(["plan", str(file), "-o", str(tmp_path / "plan.npz")]) == 1
    out = capsys.readouterr()
    assert "infeasible after" in out.out and 'the gap of 5 m between "a" and "b"' in out.out
    assert "Not written, since there is no plan" in out.out and not (tmp_path / "plan.npz").exists()
    assert main(["plan", str(file), "--json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["status"] == "infeasible" and told["phases"] == 0
    assert told["worst_violation"]["name"] == "contact_sequence"


def test_a_gap_says_nothing_of_robots_without_a_speed_limit():
    robot = mp.load_robot("humanoid44")
    robot.max_com_speed = math.inf
    result = mp.plan(gap(5.0), robot, time_limit=0.05)
    assert str(result.report.status) == "time_limit" and "violates" in result.report.message


@pytest.mark.parametrize("seed", range(6))
def test_random_scenes_that_can_be_crossed_by_construction_are_searched(seed):
    result = mp.plan(random_scene(seed), model="lipm", max_iterations=3, restarts=0)
    assert result.plan.phases, result.report.message


def test_too_few_phases_are_infeasible_whatever_the_last_attempt_has_come_to() -> None:
    report = mp.plan("flat", "go2", phases=2).report
    assert report.status == mp.Status.infeasible
    assert report.message.startswith("the best plan violates ")
    assert report.worst_violation.value > report.worst_violation.tolerance
