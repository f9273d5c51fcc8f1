"""mcplan.files.solvable_scenes and mcplan_bench.solvable: scenes that can be crossed, and what is made of them."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.solvable_scenes import FRICTION, MAX_TILT_RAD, gait_of, kind_of, lay, solvable_scene
from mcplan_bench import solvable

ROBOTS = ("humanoid44", "talos", "g1")


def normal(surface: mp.model.Surface) -> np.ndarray:
    v = np.asarray(surface.vertices_W)
    n = np.cross(v[1] - v[0], v[2] - v[0])
    return n / np.linalg.norm(n)


@pytest.mark.parametrize("name", ROBOTS)
def test_patches_hold_a_walk_within_reach_friction_and_soles(name):
    robot = mp.load_robot(name)
    gait = gait_of(robot)
    feet = [end for end in robot.end_effectors if end.kind == "foot"]
    for seed in (seed for seed in range(60) if kind_of(seed, robot) == "patches"):
        laid = lay(seed, robot, Random(seed))
        by_name = {surface.name: surface for surface in laid.surfaces}
        walk = [np.array([0.0, -np.sign(laid.footholds[0][1][1]) * gait.feet_y, 0.0])]
        for on, place in laid.footholds:
            surface = by_name[on]
            n, v = normal(surface), np.asarray(surface.vertices_W)
            assert np.arccos(n[2]) <= MAX_TILT_RAD + 1e-9, seed
            assert abs((place - v[0]) @ n) < 1e-9, seed
            half = np.array(gait.half_sole) + 0.005  # about what the tilt takes of the sole's shadow
            assert np.all(v[:, :2].min(0) <= place[:2] - half + 0.005), seed
            assert np.all(v[:, :2].max(0) >= place[:2] + half - 0.005), seed
            # With the CoM over the middle between both feet, both lie in the reach box of some foot of their side.
            com = 0.5 * (walk[-1] + place) + [0.0, 0.0, gait.height * 0.97]
            for foot, at in zip(
                sorted(feet, key=lambda end: end.nominal_B[1]),
                sorted((walk[-1], place), key=lambda p: p[1]),
                strict=True,
            ):
                size = np.asarray(foot.reach_max_B) - np.asarray(foot.reach_min_B)
                assert np.all(np.abs(at - walk[-1])[[0, 2]] <= 0.75 * size[[0, 2]]), seed
                force = com - at
                angle = np.arccos(force @ n / np.linalg.norm(force)) if at is place else 0.0
                assert np.tan(angle) < FRICTION, seed
            walk.append(place)


def test_no_surface_covers_a_foothold_of_another():
    for name in ROBOTS:
        robot = mp.load_robot(name)
        half = np.array(gait_of(robot).half_sole)
        for seed in range(0, 40, 2):
            laid = lay(seed, robot, Random(seed))
            for on, place in laid.footholds:
                for surface in laid.surfaces:
                    v = np.asarray(surface.vertices_W)[:, :2]
                    apart = np.maximum(v.min(0) - place[:2], place[:2] - v.max(0))
                    assert surface.name == on or np.any(apart >= half - 1e-9), (name, seed, on, surface.name)


def test_a_seed_and_a_robot_give_the_same_scene_again():
    robot = mp.load_robot("talos")
    assert solvable_scene(4, robot) == solvable_scene(4, robot)
    assert solvable_scene(4, robot) != solvable_scene(5, robot)


def test_robots_have_the_kinds_that_they_are_able_to():
    kinds = {name: {kind_of(seed, mp.load_robot(name)) for seed in range(10)} for name in ROBOTS}
    assert kinds["humanoid44"] == {"patches", "strips", "stairs", "jump", "hold"}
    assert kinds["talos"] == {"patches", "strips", "stairs"}  # its joints' limits forbid such jumps
    assert kinds["g1"] == {"patches", "strips", "stairs"}


def test_an_outcome_is_planned_replayed_and_counted():
    outcome = solvable.solve(solvable.Task(0, "humanoid44"))
    assert outcome.status == "solved" and outcome.rejected == "" and outcome.kind == "patches"
    whole, robot, kind = solvable.summary([outcome])
    assert (whole["of"], robot["of"], kind["of"]) == ("all", "humanoid44", "patches")
    assert (whole["scenes"], whole["solved"], whole["rejected"], whole["failures"]) == (1, 1, 0, {})
    assert "seed 0 humanoid44 patches: solved" in solvable.line(outcome)


def test_a_replay_rejects_a_plan_that_was_changed():
    robot = mp.load_robot("humanoid44")
    plan = mp.plan(solvable_scene(0, robot), robot).plan
    assert solvable.rejection(plan) == ""
    knots = plan.knots
    knots[5].com_W = knots[5].com_W + [0.0, 0.01, 0.0]
    plan.knots = knots
    assert solvable.rejection(plan) != ""


@pytest.mark.parametrize("seed, robot", [(66, "humanoid44"), (48, "g1")])
def test_a_toe_that_catches_a_tread_and_too_few_phases_are_mended_by_the_search(seed, robot):
    """Neither was solved: a swing that caught an edge, and patches that ask for more steps than the reach does."""
    assert solvable.solve(solvable.Task(seed, robot)).status == "solved"
