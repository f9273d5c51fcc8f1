"""Shapes are closed and have the right size; clipping agrees with independent truth."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mcplan.view import shapes
from mcplan.view.extent import Extent
from mcplan.view.scene_drawing import grid_lines


def volume(mesh: shapes.Mesh) -> float:
    """By the divergence theorem; negative when faces look inwards."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6.0)


def is_closed(mesh: shapes.Mesh) -> bool:
    """Every edge is passed once in each direction (vertices in the same place count as one)."""
    _, same = np.unique(np.round(mesh.vertices, 9), axis=0, return_inverse=True)
    faces = same.reshape(-1)[mesh.faces]
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    forward = sorted(map(tuple, edges))
    return forward == sorted((b, a) for a, b in forward)


HEXAGON = np.column_stack([shapes.circle(6), np.zeros(6)])
MOVED = HEXAGON + np.array([0.1, 0.2, 0.0])
CASES = {
    "box": (shapes.box((1.0, 2.0, 3.0)), 6.0, 1e-12),
    "prism": (shapes.prism(HEXAGON, 0.5), 0.5 * 1.5 * np.sqrt(3.0), 1e-12),
    "disc": (shapes.disc(0.3, 0.1, 200), np.pi * 0.09 * 0.1, 1e-3),
    "cone": (shapes.cone(0.3, 0.6, 200), np.pi * 0.09 * 0.6 / 3.0, 2e-3),
    "ellipsoid": (shapes.ellipsoid((1.0, 2.0, 0.5), 80), 4.0 / 3.0 * np.pi, 1e-2),
    "capsule": (shapes.capsule(1.0, 0.2, 0.2, 60), np.pi * 0.04 + 4.0 / 3.0 * np.pi * 0.008, 2e-2),
    "tube": (
        shapes.tube(np.outer(np.linspace(0.0, 1.0, 9), [1.0, 1.0, 0.5]), 0.1, 90),
        np.pi * 0.01 * 1.5,
        2e-3,
    ),
    "stack": (shapes.rounded_stack([(0.0, 0.2, 0.3, 0.0), (0.5, 0.2, 0.3, 0.1)]), None, None),
    "plate": (shapes.plate((0.1, 0.05), 0.01, corner=0.0), 0.2 * 0.1 * 0.01, 1e-9),
}


@pytest.mark.parametrize("name", CASES)
def test_shapes_are_closed_and_face_outwards(name):
    mesh, expected, tolerance = CASES[name]
    assert is_closed(mesh)
    assert volume(mesh) > 0.0
    if expected is not None:
        assert volume(mesh) == pytest.approx(expected, rel=tolerance)


def test_prism_lies_below_its_outline_whatever_the_orientation():
    turn = Rotation.random(random_state=4).as_matrix()
    mesh = shapes.prism(HEXAGON @ turn.T, 0.4)
    heights = mesh.vertices @ turn[:, 2]
    assert heights.max() == pytest.approx(0.0, abs=1e-12)
    assert heights.min() == pytest.approx(-0.4)


def test_clipping_keeps_exactly_the_part_inside():
    rng = np.random.default_rng(11)
    extent = Extent(np.array([0.2, -0.1]), np.array([0.8, 0.6]), 0.7, 0.4)
    for _ in range(20):
        outline = np.column_stack([shapes.circle(7) * rng.uniform(0.3, 1.5) + rng.uniform(-0.5, 0.5, 2), np.zeros(7)])
        clipped = extent.clip(outline)
        points = rng.uniform(-2.0, 2.0, (400, 2))
        along, across = (points - extent.centre) @ extent.forward, (points - extent.centre) @ extent.left
        inside = _contains(outline, points) & (np.abs(along) <= 0.7) & (np.abs(across) <= 0.4)
        found = _contains(clipped, points) if len(clipped) else np.zeros(len(points), bool)
        assert (found == inside).all()


def test_grid_lines_end_on_the_outline():
    lines = grid_lines(MOVED, 0.5)
    assert len(lines) == 8
    for start, end in lines:
        shared = np.isclose(start[:2], end[:2])
        assert shared.any()
        assert np.allclose(start[:2][shared] / 0.5, np.round(start[:2][shared] / 0.5))
        for point in (start, end):
            assert abs(_overshoot(MOVED, point[None, :2])[0]) < 1e-9


def _overshoot(outline: np.ndarray, points: np.ndarray) -> np.ndarray:
    corners = outline[:, :2]
    edges = np.roll(corners, -1, axis=0) - corners
    outward = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1, keepdims=True)
    return np.max(np.einsum("ec,pec->pe", outward, points[:, None] - corners), axis=1)


def _contains(outline: np.ndarray, points: np.ndarray) -> np.ndarray:
    return _overshoot(outline, points) <= 0.0
