"""mcplan.files.generate: seeded, valid, and solvable by construction for humanoid44."""

from __future__ import annotations

import itertools
import math
import re

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import Polygon, resolve_stance
from mcplan.files.builtin import DATA
from mcplan.files.generate import KINDS, mirrored, moved, random_scene, stepping_stones_text
from mcplan.files.scenes import scene_to_dict

SEEDS = range(80)


def test_stepping_stones_is_what_its_seed_gives():
    assert (DATA / "scenes" / "stepping_stones.toml").read_text() == stepping_stones_text()


def test_stepping_stones_has_twelve_stones_at_mixed_heights():
    stones = [s for s in mp.load_scene("stepping_stones").surfaces if re.match("(left|right)_", s.name)]
    heights = np.array([s.vertices_W[0, 2] for s in stones])
    assert len(stones) >= 12
    assert len(set(heights)) == len(stones) and np.ptp(heights) <= 0.06


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_scene_is_valid_and_the_same_for_its_seed(seed):
    scene = random_scene(seed)
    scene.validate()
    assert scene_to_dict(scene) == scene_to_dict(random_scene(seed))
    assert scene.name == f"random_{KINDS[seed % 4]}_{seed}"
    assert scene_to_dict(scene) != scene_to_dict(random_scene(seed + 4))


@pytest.mark.parametrize("seed", SEEDS)
def test_both_stances_of_a_random_scene_are_the_nominal_one_on_the_surface(seed):
    scene, robot = random_scene(seed), mp.load_robot("humanoid44")
    for stance in (scene.start, scene.goal):
        resolved = resolve_stance(scene, robot, stance)
        turn = np.array([[math.cos(stance.yaw), math.sin(stance.yaw)], [-math.sin(stance.yaw), math.cos(stance.yaw)]])
        for end, position_W, surface in zip(
            robot.end_effectors, resolved.end_effectors_W, resolved.contacts, strict=True
        ):
            if surface < 0:
                continue
            np.testing.assert_allclose(turn @ (position_W - resolved.com_W)[:2], end.nominal_B[:2], atol=1e-9)
            assert Polygon(scene.surfaces[surface].vertices_W).outside(position_W) < -0.05  # well inside


@pytest.mark.parametrize("seed", SEEDS)
def test_next_surfaces_are_within_a_step_or_a_jump(seed):
    scene = random_scene(seed)
    level = moved(scene, -scene.start.yaw, np.zeros(3))
    origin = level.start.position_W
    spans = sorted(
        ((s.vertices_W - origin)[:, 0].min(), (s.vertices_W - origin)[:, 0].max(), s) for s in level.surfaces
    )
    for (_, end, before), (begin, _, after) in itertools.pairwise(spans):
        assert begin - end <= (0.8 if "gap" in scene.name else 0.3) + 1e-9
        if "slope" not in scene.name:
            assert abs(np.ptp([before.vertices_W[0, 2], after.vertices_W[0, 2]])) <= 0.12 + 1e-9
    slopes = [math.degrees(math.acos(min(abs(Polygon(s.vertices_W).normal_W[2]), 1.0))) for s in scene.surfaces]
    assert max(slopes) <= 15.0 + 1e-6
    assert np.linalg.norm(scene.goal.position_W - scene.start.position_W) < 2.2


def test_surfaces_of_random_scenes_do_not_overlap():
    for seed in SEEDS:
        scene = random_scene(seed)
        for i, one in enumerate(scene.surfaces):
            for other in scene.surfaces[i + 1 :]:
                middle = Polygon(one.vertices_W).centroid_W
                inside = [Polygon(other.vertices_W).outside(p * [1, 1, 0] + middle * [0, 0, 1]) for p in one.vertices_W]
                assert min(inside) > -1e-9, (scene.name, one.name, other.name)


def test_mirroring_twice_and_turning_back_give_the_scene_again():
    scene = random_scene(3)
    again = moved(moved(mirrored(mirrored(scene)), 0.7, np.zeros(3)), -0.7, np.zeros(3))
    for one, other in zip(scene.surfaces, again.surfaces, strict=True):
        np.testing.assert_allclose(one.vertices_W, other.vertices_W, atol=1e-12)
    assert again.goal.yaw == pytest.approx(scene.goal.yaw)


def test_mirroring_keeps_normals_upwards():
    for surface in mirrored(random_scene(3)).surfaces:
        assert Polygon(surface.vertices_W).normal_W[2] > 0.9
