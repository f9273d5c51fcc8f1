"""Distances to the prisms below surfaces, against boxes known by their sides."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import mcplan as mp
from mcplan.tracking.solids import Solids


def scene(turn: np.ndarray, shift: np.ndarray) -> mp.Scene:
    corners = np.array([[-0.2, -0.1, 0.0], [0.2, -0.1, 0.0], [0.2, 0.1, 0.0], [-0.2, 0.1, 0.0]])
    box = mp.model.Surface(name="box", vertices_W=corners @ turn.T + shift, friction=0.8, thickness=0.3)
    ground = mp.model.Surface(name="ground", vertices_W=50.0 * corners - [0, 0, 5.0], friction=0.8, thickness=1.0)
    return mp.Scene(name="boxes", surfaces=[box, ground])


def test_signed_distance_to_a_turned_box():
    rng = np.random.default_rng(2)
    for turn in Rotation.random(5, random_state=1).as_matrix():
        shift = rng.uniform(-1.0, 1.0, 3)
        points = rng.uniform(-0.6, 0.6, (200, 3))
        found = Solids(scene(turn, shift)).clearances(points @ turn.T + shift)[:, 0]
        away = np.abs(points - [0.0, 0.0, -0.15]) - [0.2, 0.1, 0.15]
        through_the_underside = (points[:, 2] < -0.15) & (away[:, 2] > away[:, :2].max(axis=1)) & (away[:, 2] < 0.011)
        usual = ~through_the_underside
        assert found[usual] == pytest.approx(away.max(axis=1)[usual], abs=1e-9)


def test_the_floor_below_a_step_is_no_way_out():
    """A toe 3 cm inside a step, at the height of its underside or a little lower, is 3 cm deep in it."""
    toes = [[-0.17, 0.0, -0.3], [-0.17, 0.0, -0.305], [-0.17, 0.0, -0.2]]
    assert Solids(scene(np.eye(3), np.zeros(3))).clearances(toes)[:, 0] == pytest.approx(-0.03)
    assert Solids(scene(np.eye(3), np.zeros(3))).clearances([[-0.17, 0.0, -0.4]])[0, 0] == pytest.approx(0.1)


def test_names_and_columns_are_the_scenes_surfaces():
    solids = Solids(scene(np.eye(3), np.zeros(3)))
    assert solids.names == ["box", "ground"]
    assert solids.clearances([[0.0, 0.0, 0.02]]) == pytest.approx(np.array([[0.02, 5.02]]))


def test_of_solids_that_are_far_the_nearest_is_looked_at():
    scene = mp.load_scene("stepping_stones")
    solids = Solids(scene)
    for point in ([0.3, 0.0, 0.05], [50.0, 0.0, 0.0], [0.0, 0.0, 9.0]):
        points = np.array([point])
        near = solids.near(points, 0.5)
        every, some = solids.clearances(points)[0], solids.clearances(points, near)[0]
        assert len(near) > 0 and (some[near] == every[near]).all()
        left_out = np.setdiff1d(np.arange(len(every)), near)
        assert np.isinf(some[left_out]).all() and (every[left_out] > -1e-12).all()
    assert len(solids.near(np.array([[0.3, 0.0, 0.05]]), 0.5)) < len(solids.names)
