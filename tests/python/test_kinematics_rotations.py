"""Rotations agree with SciPy's; blends go the shortest way; quaternions do not jump."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from mcplan.kinematics import rotations


def test_rotations_agree_with_scipy():
    rng = np.random.default_rng(7)
    rpy = rng.uniform(-3.0, 3.0, (50, 3)) * [1.0, 0.5, 1.0]
    matrices = rotations.from_rpy(rpy)
    assert np.allclose(matrices, Rotation.from_euler("ZYX", rpy[:, ::-1]).as_matrix())
    quats = rotations.quat_xyzw(matrices)
    assert np.allclose(Rotation.from_quat(quats).as_matrix(), matrices)
    assert (np.sum(quats[1:] * quats[:-1], axis=1) >= 0.0).all()
    for a, b in zip(matrices[:20], matrices[20:40], strict=True):
        arc = Slerp([0.0, 1.0], Rotation.from_matrix([a, b]))
        assert np.allclose(rotations.between(a, b, 0.3), arc(0.3).as_matrix(), atol=1e-9)


def test_half_a_turn_is_blended_by_a_quarter():
    half = rotations.about(np.array([0.0, 0.0, 1.0]), np.pi)
    quarter = rotations.between(np.eye(3), half, 0.5)
    assert np.abs(np.arccos((np.trace(quarter) - 1.0) / 2.0)) == pytest.approx(np.pi / 2.0, abs=1e-6)


def test_quaternions_of_half_turns_have_no_division_by_nothing():
    half_turns = np.array([np.diag([1.0, -1, -1]), np.diag([-1.0, 1, -1]), np.diag([-1.0, -1, 1])])
    assert np.abs(rotations.quat_xyzw(half_turns)) == pytest.approx(np.eye(4)[:3])


def test_axis_z_is_kept_and_x_is_as_near_as_it_can_be():
    rng = np.random.default_rng(1)
    for _ in range(20):
        z, hint = rng.normal(size=3), rng.normal(size=3)
        found = rotations.with_axis_z(z, hint)
        assert found.T @ found == pytest.approx(np.eye(3), abs=1e-12) and np.linalg.det(found) == pytest.approx(1.0)
        assert found[:, 2] == pytest.approx(z / np.linalg.norm(z))
        across = np.cross(z, hint)  # the nearest x has no part across the plane of z and hint
        assert found[:, 0] @ across == pytest.approx(0.0, abs=1e-12) and found[:, 0] @ hint > 0.0
    straight_up = rotations.with_axis_z(np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0]))
    assert straight_up[:, 2] == pytest.approx([0.0, 0.0, 1.0]) and np.isfinite(straight_up).all()


def test_normal_of_a_polygon_is_counter_clockwise_about_it():
    turn = Rotation.random(random_state=3).as_matrix()
    corners = np.array([[0.0, 0, 0], [2, 0, 0], [2.5, 1, 0], [1, 2, 0], [-0.5, 1, 0]])
    assert rotations.polygon_normal(corners @ turn.T + 1.0) == pytest.approx(turn[:, 2])
    assert rotations.polygon_normal(corners[::-1] @ turn.T) == pytest.approx(-turn[:, 2])


def test_pose_moves_points_as_rotation_and_translation_do():
    turn = Rotation.random(4, random_state=5).as_matrix()
    shift = np.arange(12.0).reshape(4, 3)
    point = np.array([0.3, -0.2, 0.5])
    assert (rotations.pose(turn, shift) @ [*point, 1.0])[:, :3] == pytest.approx(turn @ point + shift)


def test_rotations_of_quaternions_are_those_of_scipy_and_back():
    turns = Rotation.random(40, random_state=8)
    matrices = rotations.rotations_of(turns.as_quat())
    np.testing.assert_allclose(matrices, turns.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(rotations.rotations_of(-turns.as_quat()), matrices, atol=1e-15)
    np.testing.assert_allclose(rotations.rotations_of(rotations.quat_xyzw(matrices)), matrices, atol=1e-12)


def test_rotation_vectors_are_those_of_scipy():
    rng = np.random.default_rng(4)
    for _ in range(50):
        vector = rng.normal(size=3)
        vector *= rng.uniform(0.0, 3.1) / np.linalg.norm(vector)
        found = rotations.rotation_vector(Rotation.from_rotvec(vector).as_matrix())
        np.testing.assert_allclose(found, vector, atol=1e-9)
    assert not rotations.rotation_vector(np.eye(3)).any()


def test_the_smallest_rotation_leaves_what_is_normal_to_both():
    rng = np.random.default_rng(5)
    for _ in range(50):
        a, b = rng.normal(size=(2, 3))
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        turn = rotations.minimal_rotation(a, b)
        np.testing.assert_allclose(turn @ a, b, atol=1e-9)
        np.testing.assert_allclose(turn @ np.cross(a, b), np.cross(a, b), atol=1e-9)
        np.testing.assert_allclose(turn.T @ turn, np.eye(3), atol=1e-9)


def test_soles_lie_flat_and_head_where_they_are_told_to():
    """On what is not a wall ahead, the heading seen from above is the one asked for."""
    rng = np.random.default_rng(12)
    for _ in range(50):
        normal = np.array([*rng.uniform(-0.4, 0.4, 2), 1.0])
        normal /= np.linalg.norm(normal)
        yaw = rng.uniform(-3.1, 3.1)
        frame = rotations.sole_frame(normal, yaw)
        assert np.allclose(frame.T @ frame, np.eye(3)) and np.linalg.det(frame) > 0.0
        assert np.allclose(frame[:, 2], normal)
        heading = np.array([np.cos(yaw), np.sin(yaw), 0.0])
        # As near to the heading as anything in the surface can be.
        assert frame[:, 0] @ heading == pytest.approx(np.sqrt(1.0 - (normal @ heading) ** 2))
    level = rotations.sole_frame(np.array([0.0, 0.0, 1.0]), 2.0)
    assert np.allclose(level, rotations.about_z(np.array(2.0)))


def test_a_sole_on_a_wall_ahead_points_up():
    frame = rotations.sole_frame(np.array([-1.0, 0.0, 0.0]), 0.05)
    assert np.allclose(frame[:, 0], [0.0, 0.0, 1.0]) and np.allclose(frame[:, 2], [-1.0, 0.0, 0.0])
    beside = rotations.sole_frame(np.array([0.0, -1.0, 0.0]), 0.0)
    assert np.allclose(beside[:, 0], [1.0, 0.0, 0.0])
