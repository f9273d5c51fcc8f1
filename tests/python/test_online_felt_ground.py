"""Feet tell where the ground is, and how slippery."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.online.felt_ground import SLIPPING_STEPS, SlipSense, at_felt_heights, with_friction
from mcplan.online.known_ground import KnownGround
from mcplan.online.options import OnlineOptions
from mcplan.online.reach import HIGHER_MAX_M, lifting


@pytest.fixture
def scene():
    return mp.load_scene("stairs_broad")


def middle_of(surface):
    return np.asarray(surface.vertices_W).mean(axis=0)


@pytest.mark.parametrize("height_m", [0.03, -0.03])
def test_surfaces_are_where_feet_stand_on_them(scene, height_m):
    place = middle_of(scene.surfaces[1]) + [0.0, 0.0, height_m]
    moved = at_felt_heights(scene, [1, -1], [place, np.zeros(3)], [0.0, 0.0])
    for i, (after, before) in enumerate(zip(moved.surfaces, scene.surfaces, strict=True)):
        shift = np.asarray(after.vertices_W) - np.asarray(before.vertices_W)
        np.testing.assert_allclose(shift, np.tile([0.0, 0.0, height_m * (i == 1)], (len(shift), 1)), atol=1e-12)
    # What is known by now is not felt again.
    assert at_felt_heights(moved, [1], [place], [0.0]) is None


def test_feet_are_lifted_higher_over_ground_that_is_felt_elsewhere(scene):
    ground = KnownGround(scene, None, OnlineOptions(), 4, 20.0)
    assert ground.unevenness_m() == 0.0
    ground.scene = at_felt_heights(
        at_felt_heights(scene, [1], [middle_of(scene.surfaces[1]) + [0.0, 0.0, -0.03]], [0.0]),
        [2],
        [middle_of(scene.surfaces[2]) + [0.0, 0.0, 0.02]],
        [0.0],
    )
    assert ground.unevenness_m() == pytest.approx(0.03)
    talos = mp.load_robot("talos")
    assert lifting(talos, 0.0) is talos
    assert lifting(talos, 0.03).swing_height == pytest.approx(talos.swing_height + 0.03)
    small = talos.__copy__()
    small.com_height = 0.2
    assert lifting(small, 0.01).swing_height == pytest.approx(0.06)
    assert lifting(talos, 1.0).swing_height == pytest.approx(talos.swing_height + HIGHER_MAX_M)


def test_what_is_told_of_the_ground_is_not_uneven(scene):
    true = scene.__copy__()
    true.surfaces = [surface.__copy__() for surface in scene.surfaces]
    true.surfaces[1].vertices_W = np.asarray(true.surfaces[1].vertices_W) + [0.0, 0.0, 0.05]
    ground = KnownGround(scene, true, OnlineOptions(told_at_s=0.0), 4, 20.0)
    assert ground.told(0.0) and ground.unevenness_m() == 0.0


def test_slopes_move_so_that_feet_are_on_their_planes():
    ramp = mp.load_scene("ramp")
    i = next(i for i, s in enumerate(ramp.surfaces) if np.ptp(np.asarray(s.vertices_W)[:, 2]) > 0.1)
    corner, *others = np.asarray(ramp.surfaces[i].vertices_W)
    place = corner + 0.3 * (others[0] - corner) + [0.0, 0.0, 0.02]
    moved = at_felt_heights(ramp, [i], [place], [0.0])
    outline = np.asarray(moved.surfaces[i].vertices_W)
    normal = np.cross(outline[1] - outline[0], outline[2] - outline[1])
    assert normal @ (place - outline[0]) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("height_m", "speed_m_s"), [(0.003, 0.0), (0.03, 0.2), (0.2, 0.0)])
def test_compliance_moving_feet_and_far_ground_say_nothing(scene, height_m, speed_m_s):
    place = middle_of(scene.surfaces[1]) + [0.0, 0.0, height_m]
    assert at_felt_heights(scene, [1], [place], [speed_m_s]) is None


def test_a_foot_that_slides_measures_friction(scene):
    sense, force_W, sliding_W = SlipSense(1, 20.0), np.array([60.0, -80.0, 500.0]), np.array([-0.06, 0.08, 0.0])
    for _ in range(SLIPPING_STEPS - 1):  # a landing takes so long
        assert sense.update(scene, [0], [force_W], [sliding_W]) == {}
    found = sense.update(scene, [0], [force_W], [sliding_W])
    assert found == {0: pytest.approx(0.2)}
    slippery = with_friction(scene, found)
    assert slippery.surfaces[0].friction == pytest.approx(0.2)
    assert slippery.surfaces[1].friction == scene.surfaces[1].friction
    assert sense.update(slippery, [0], [force_W], [sliding_W]) == {}


def test_feet_that_stand_press_little_or_are_pressed_off_measure_none(scene):
    force_W, sliding_W = np.array([60.0, -80.0, 500.0]), np.array([-0.06, 0.08, 0.0])
    for surface, force, velocity in [
        (0, force_W, 0.3 * sliding_W),
        (0, 0.03 * force_W, sliding_W),
        (-1, force_W, sliding_W),
    ]:
        sense = SlipSense(1, 20.0)
        assert all(sense.update(scene, [surface], [force], [velocity]) == {} for _ in range(50))
    up = SlipSense(1, 20.0)  # leaving the ground is no slip
    assert all(up.update(scene, [0], [force_W], [np.array([0.0, 0.0, 0.3])]) == {} for _ in range(50))


def test_a_sole_that_rolls_onto_the_ground_does_not_slip_and_one_that_slides_is_measured_by_its_largest_force(scene):
    force_W, corners_W = np.array([20.0, 0.0, 500.0]), np.array([[0.1, 0.06, 0], [-0.1, 0.06, 0], [-0.1, -0.06, 0]])
    turn_W = np.array([0.0, 0.0, 2.0])  # about a corner that stands
    rolling = np.cross(turn_W, corners_W - corners_W[0])
    rolls = SlipSense(1, 20.0)
    assert all(rolls.update(scene, [0], [force_W], [rolling]) == {} for _ in range(50))
    slides = SlipSense(1, 20.0)
    for along_N in (50.0, 100.0, 60.0):
        found = slides.update(scene, [0], [np.array([along_N, 0.0, 500.0])], [rolling + [0.0, 1.0, 0.0]])
        assert found == {}
    found = slides.update(scene, [0], [force_W], [rolling + [0.0, 1.0, 0.0]])
    assert SLIPPING_STEPS == 4 and found == {0: pytest.approx(100.0 / 500.0)}


def test_what_is_not_to_be_felt_is_not(scene):
    ground = KnownGround(scene, None, OnlineOptions(felt_ground=False), 1, 20.0)
    for _ in range(50):
        assert ground.feel_slips([0], [np.array([60.0, -80.0, 500.0])], [np.array([1.0, 0.0, 0.0])]) == {}
    assert ground.scene is scene and ground.felt == 0 and not ground.told(1e3)
