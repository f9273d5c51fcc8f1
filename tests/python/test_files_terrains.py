"""mcplan.files.terrains: the published slopes, and ground on which talos_wang's feet can follow the steps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import linprog

import mcplan as mp
from mcplan._core import Polygon, resolve_stance
from mcplan.files.builtin import DATA
from mcplan.files.scenes import scene_to_dict
from mcplan.files.terrains import TERRAINS, random_patches, stairs_up, terrain_text

FLAT = (0.0, 0.0, 1.0)
ALONG, ACROSS = (0.1961, 0.9806), (0.2334, 0.9724)  # sine and cosine of 11.31 and 13.50 degrees
UP, DOWN = (-ALONG[0], 0.0, ALONG[1]), (ALONG[0], 0.0, ALONG[1])
PLUS, MINUS = (0.0, ACROSS[0], ACROSS[1]), (0.0, -ACROSS[0], ACROSS[1])
NORMALS = {  # of the surfaces of the first eleven steps, as published
    "up_and_down": [FLAT, UP, UP, DOWN, DOWN, UP, UP, DOWN, DOWN, UP, UP],
    "v_shape": [FLAT, PLUS, MINUS, MINUS, PLUS, PLUS, MINUS, MINUS, PLUS, PLUS, MINUS],
    "rubbles": [FLAT, PLUS, DOWN, MINUS, UP, DOWN, PLUS, MINUS, UP, PLUS, DOWN],
}
WALKS = [*sorted(TERRAINS), *range(20)]  # a number: random patches of that seed


def load(walk) -> mp.Scene:
    return mp.load_scene(walk) if isinstance(walk, str) else random_patches(walk)


def surface_of(scene: mp.Scene, name: str) -> np.ndarray:
    return scene.surfaces[scene.surface_index(name)].vertices_W


@pytest.mark.parametrize("name", sorted(TERRAINS))
def test_a_built_in_terrain_is_what_its_command_gives(name):
    assert (DATA / "scenes" / f"{name}.toml").read_text() == terrain_text(name)


@pytest.mark.parametrize("name", sorted(NORMALS))
def test_normals_in_the_order_of_the_steps_are_the_published_ones(name):
    scene = mp.load_scene(name)
    found = [Polygon(surface_of(scene, step.surface)).normal_W for step in scene.steps[:11]]
    np.testing.assert_allclose(found, NORMALS[name], atol=5e-5)


@pytest.mark.parametrize("name", sorted(NORMALS))
def test_patches_are_centred_at_height_0_with_edges_6_cm_above_and_below(name):
    scene = mp.load_scene(name)
    for column in range(5):
        for side, low in (("right", -0.5), ("left", 0.0)):
            corners = surface_of(scene, f"{side}_{column + 1}")
            np.testing.assert_allclose(corners.min(axis=0), [1.0 + 0.6 * column, low, -0.06], atol=1e-12)
            np.testing.assert_allclose(corners.max(axis=0), [1.6 + 0.6 * column, low + 0.5, 0.06], atol=1e-12)
    np.testing.assert_array_equal(surface_of(scene, "end")[[0, 2]], [[4.0, -0.5, 0.0], [50.0, 0.5, 0.0]])
    assert all(surface.friction == 0.3 for surface in scene.surfaces)


@pytest.mark.parametrize("name", [*sorted(NORMALS), "random_patches"])
def test_talos_wang_starts_where_wang_starts(name):
    scene = mp.load_scene(name)
    start = resolve_stance(scene, mp.load_robot("talos_wang"), scene.start)
    np.testing.assert_allclose(start.com_W, [0.6, 0.0, 0.75])
    np.testing.assert_allclose(start.end_effectors_W, [[0.6, 0.1, 0.0], [0.6, -0.1, 0.0]], atol=1e-12)
    assert scene.gravity == 9.80665


@pytest.mark.parametrize("walk", WALKS)
def test_feet_take_turns_and_every_patch_is_stepped_on_once(walk):
    scene = load(walk)
    assert [s.end_effector for s in scene.steps] == [
        ("left_foot", "right_foot")[i % 2] for i in range(len(scene.steps))
    ]
    stepped = [s.surface for s in scene.steps]
    assert sorted({*stepped, "ground"} - {"start"}) == sorted({"ground", *(s.name for s in scene.surfaces)} - {"start"})
    assert stepped[-1] == stepped[-2] == scene.goal.contacts["foot"]
    assert len(set(stepped)) == len(stepped) - 1


def can_be_stepped_on(scene: mp.Scene, robot: mp.Robot) -> bool:
    """One linear program over all steps: soles inside their surfaces, the polytopes of both feet whenever both stand."""
    ends = {end.name: end for end in robot.end_effectors}
    start = resolve_stance(scene, robot, scene.start)
    feet = dict(zip(ends, start.end_effectors_W, strict=True))
    # Unknown: foothold of each step, then the CoM after each step.
    count = len(scene.steps)
    rows, bounds, equal, level = [], [], [], []

    def block(*parts):
        row = np.zeros((len(parts[0][1]), 6 * count))
        for index, matrix in parts:
            row[:, 3 * index : 3 * index + 3] = matrix
        return row

    standing = {name: (None, at) for name, at in feet.items()}  # index of the foothold, or where it is
    for i, step in enumerate(scene.steps):
        polygon = Polygon(surface_of(scene, step.surface))
        sides = np.roll(polygon.vertices_W, -1, axis=0) - polygon.vertices_W
        outward = np.cross(sides, polygon.normal_W)
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        tangents = np.array([polygon.tangent_W(0), polygon.tangent_W(1)])
        half = np.abs(outward @ tangents.T) @ ends[step.end_effector].half_size
        rows.append(block((i, outward)))
        bounds.append((outward * polygon.vertices_W).sum(axis=1) - half)
        equal.append(block((i, polygon.normal_W[None, :])))
        level.append([polygon.normal_W @ polygon.vertices_W[0]])
        standing[step.end_effector] = (i, None)
        for name, (own, own_at) in standing.items():
            others = [(other, reach) for other, reach in ends[name].partner_reach.items()]
            sets = [(count + i, None, ends[name].com_reach), *((*standing[o], reach) for o, reach in others)]
            for index, at, reach in sets:  # A (x - own) <= b
                parts = [(k, sign * reach.A) for k, sign in ((index, 1.0), (own, -1.0)) if k is not None]
                moved = reach.b + (reach.A @ own_at if own is None else 0.0) - (reach.A @ at if index is None else 0.0)
                rows.append(block(*parts))
                bounds.append(moved)
    found = linprog(
        np.zeros(6 * count),
        A_ub=np.vstack(rows),
        b_ub=np.concatenate(bounds),
        A_eq=np.vstack(equal),
        b_eq=np.concatenate(level),
        bounds=(None, None),
    )
    assert found.status in (0, 2), found.message
    return found.status == 0


@pytest.mark.parametrize("walk", WALKS)
def test_footholds_and_com_exist_within_the_reach_of_talos_wang(walk):
    assert can_be_stepped_on(load(walk), mp.load_robot("talos_wang"))


def test_stairs_too_high_or_too_long_cannot_be_stepped_on():
    robot = mp.load_robot("talos_wang")
    assert not can_be_stepped_on(stairs_up(rise=0.6), robot)
    assert not can_be_stepped_on(stairs_up(tread=0.45), robot)


@pytest.mark.parametrize("seed", range(40))
def test_random_patches_keep_their_limits_and_are_the_same_for_their_seed(seed):
    scene = random_patches(seed)
    assert scene_to_dict(scene) == scene_to_dict(random_patches(seed))
    assert scene_to_dict(scene) != scene_to_dict(random_patches(seed + 1))
    patches = [s.vertices_W for s in scene.surfaces if s.name not in ("start", "end")]
    assert len(patches) == 20
    for patch in patches:
        assert 5.0 - 1e-3 <= math.degrees(math.acos(Polygon(patch).normal_W[2])) <= 15.0 + 1e-3
        assert abs(patch[:, 2].mean()) <= 0.10 + 1e-6
    corners = np.vstack([*patches, [[x, y, 0.0] for x in (1.0, 7.0) for y in (-0.5, 0.0, 0.5)]])
    for corner in corners:
        near = corners[np.hypot(*(corners[:, :2] - corner[:2]).T) < 1e-6]
        assert len(near) >= 2 and np.ptp(near[:, 2]) <= 0.24 + 1e-5
        assert np.abs(near[:, 2] - corner[2]).max() <= 0.12 + 1e-5


def test_stairs_are_closed_and_rise_by_12_cm():
    scene = mp.load_scene("stairs_up")
    below = scene.surfaces[0]
    for surface in scene.surfaces[1:]:
        assert surface.vertices_W[0, 0] == pytest.approx(below.vertices_W[1, 0])  # no gap
        assert surface.vertices_W[0, 2] - below.vertices_W[0, 2] == pytest.approx(0.12)
        assert surface.thickness == pytest.approx(0.12)
        below = surface
    assert [np.ptp(s.vertices_W[:, 0]) for s in scene.surfaces[1:-1]] == pytest.approx([0.3] * 5)
