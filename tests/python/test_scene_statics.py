"""Built-in scenes with hands: a body can rest in them on contacts that are possible, by linear programs over the forces."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import mcplan as mp
from equilibrium import forces_at_rest
from mcplan._core import resolve_stance

ROBOT = mp.load_robot("humanoid44")
WEIGHT = ROBOT.mass * 9.8
CAP = min(end.max_force for end in ROBOT.end_effectors)


def stance_contacts(scene, field):
    """CoM and (position, surface) of each end-effector in a stance."""
    found = resolve_stance(scene, ROBOT, getattr(scene, field), field)
    return found.com_W, list(zip(found.end_effectors_W, found.contacts, strict=True))


def in_reach(com_W, ends, positions_W):
    """Whether end-effectors of the upright, unturned robot reach positions."""
    bodies = [ROBOT.end_effectors[ROBOT.end_effector_index(name)] for name in ends]
    relative = np.asarray(positions_W) - com_W
    return all(
        (place >= body.reach_min_B - 1e-9).all() and (place <= body.reach_max_B + 1e-9).all()
        for body, place in zip(bodies, relative, strict=True)
    )


@pytest.mark.parametrize("field", ["start", "goal"])
def test_chimney_can_be_stood_in_with_four_and_with_any_three_contacts(field):
    scene = mp.load_scene("chimney")
    com_W, contacts = stance_contacts(scene, field)
    assert all(scene.surfaces[surface].friction == 0.8 for _, surface in contacts)
    for count in (4, 3):
        for kept in itertools.combinations(contacts, count):
            forces = forces_at_rest(scene, com_W, list(kept), WEIGHT)
            assert forces is not None, kept
            np.testing.assert_allclose(forces.sum(axis=0), [0, 0, WEIGHT], atol=1e-6)
            assert np.linalg.norm(forces, axis=1).max() < CAP


def test_chimney_holds_nobody_by_one_wall_or_by_little_friction():
    scene = mp.load_scene("chimney")
    com_W, contacts = stance_contacts(scene, "start")
    for pair in ((0, 2), (1, 3)):  # right foot and hand, left foot and hand
        assert forces_at_rest(scene, com_W, [contacts[i] for i in pair], WEIGHT) is None
    assert forces_at_rest(scene, com_W, contacts, WEIGHT, friction=1e-3) is not None  # a force without end
    assert forces_at_rest(scene, com_W, contacts, WEIGHT, friction=0.05, most=CAP) is None
    assert forces_at_rest(scene, com_W, contacts, WEIGHT, friction=0.1, most=CAP) is not None


def test_a_climb_in_the_chimney_never_leaves_reach_or_balance():
    """The CoM goes up by 1 m in steps of 0.1 m; one end-effector after the other follows by as much, and three hold."""
    scene = mp.load_scene("chimney")
    names = [end.name for end in ROBOT.end_effectors]
    com_W, contacts = stance_contacts(scene, "start")
    goal_W, wanted = stance_contacts(scene, "goal")
    step_W = np.array([0.0, 0.0, 0.1])
    points = [point for point, _ in contacts]
    for _ in range(10):
        for end in range(4):
            com_W = com_W + 0.25 * step_W
            kept = [(points[i], contacts[i][1]) for i in range(4) if i != end]
            assert forces_at_rest(scene, com_W, kept, WEIGHT) is not None
            assert in_reach(com_W, [names[i] for i in range(4) if i != end], [point for point, _ in kept])
            points[end] = points[end] + step_W
            wall = scene.surfaces[contacts[end][1]].vertices_W
            assert (points[end] >= wall.min(axis=0) - 1e-9).all() and (points[end] <= wall.max(axis=0) + 1e-9).all()
        assert in_reach(com_W, names, points)
    np.testing.assert_allclose(com_W, goal_W, atol=1e-9)
    np.testing.assert_allclose(points, [point for point, _ in wanted], atol=1e-9)


@pytest.mark.parametrize("height", [0.55, 0.6, 0.65])
def test_hands_on_the_pads_bear_the_robot_unless_their_forces_point_at_the_com(height):
    """What the wrench model is for: friction 0.7 is plenty, and through the CoM not even 1.2 is enough."""
    scene = mp.load_scene("gap_with_rail")
    assert not any(surface.grasp for surface in scene.surfaces)
    com_W = np.array([0.9, 0.0, height])
    pads = [scene.surface_index(name) for name in ("right_pad", "left_pad")]
    contacts = [(np.array([0.9, side * 0.25, 0.5]), pad) for side, pad in zip((-1, 1), pads, strict=True)]
    assert all(scene.surfaces[pad].friction == 0.7 for pad in pads)
    assert in_reach(com_W, ["right_hand", "left_hand"], [point for point, _ in contacts])
    for friction in (None, 0.1):
        forces = forces_at_rest(scene, com_W, contacts, WEIGHT, friction=friction)
        assert forces is not None
        np.testing.assert_allclose(forces[:, 2], 0.5 * WEIGHT, rtol=1e-6)
    for friction in (None, 1.2):
        assert forces_at_rest(scene, com_W, contacts, WEIGHT, through_com=True, friction=friction) is None
    steep = 0.25 / (height - 0.5)
    assert forces_at_rest(scene, com_W, contacts, WEIGHT, through_com=True, friction=1.1 * steep) is not None


def test_no_foot_of_humanoid44_steps_over_the_gap_of_turn_jump():
    scene = mp.load_scene("turn_jump")
    before, after = (surface.vertices_W for surface in scene.surfaces)
    gap = after[:, 0].min() - before[:, 0].max()
    feet = [end for end in ROBOT.end_effectors if end.kind == "foot"]
    assert gap > max(a.reach_max_B[0] - b.reach_min_B[0] for a in feet for b in feet) + 0.05


@pytest.mark.parametrize("field", ["start", "goal"])
def test_platforms_of_turn_jump_hold_whole_soles_and_hardly_more(field):
    scene = mp.load_scene("turn_jump")
    stance = getattr(scene, field)
    _, contacts = stance_contacts(scene, field)
    turn = np.array([[np.cos(stance.yaw), -np.sin(stance.yaw)], [np.sin(stance.yaw), np.cos(stance.yaw)]])
    corners = []
    for end, (point_W, surface) in zip(ROBOT.end_effectors, contacts, strict=True):
        if end.kind == "foot":
            sole = [np.array(signs) * end.half_size for signs in itertools.product((-1, 1), (-1, 1))]
            corners += [point_W[:2] + turn @ corner for corner in sole]
            outline = scene.surfaces[surface].vertices_W
    low, high = outline[:, :2].min(axis=0), outline[:, :2].max(axis=0)
    corners = np.array(corners)
    assert (corners >= low).all() and (corners <= high).all()
    assert (corners.min(axis=0) - low < 0.06).all() and (high - corners.max(axis=0) < 0.06).all()
