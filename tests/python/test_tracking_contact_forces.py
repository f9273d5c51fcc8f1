"""Points that bear force: areas by counting points, wrenches by summing, cones by their definition."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from mcplan.tracking.contact_forces import FRICTION_RATIO, SIDES, SOLE_RATIO, ForcePoints, clipped, pyramid

HALF = np.array([0.1, 0.06])


def convex(rng, count=8, centre=(0.0, 0.0), size=1.0):
    """A convex polygon, counter-clockwise."""
    points = np.asarray(centre) + size * rng.uniform(-1.0, 1.0, (count, 2))
    return points[ConvexHull(points).vertices]


def inside(polygon, points, room=0.0):
    """Whether points are on the left of all sides, by more than `room`."""
    result = np.ones(len(points), bool)
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        along = (b - a) / np.linalg.norm(b - a)
        result &= along[0] * (points[:, 1] - a[1]) - along[1] * (points[:, 0] - a[0]) > room
    return result


def area(polygon):
    x, y = np.asarray(polygon).T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def test_what_is_left_of_a_polygon_is_what_lies_in_both():
    rng = np.random.default_rng(5)
    overlaps = 0
    for _ in range(60):
        one, other = convex(rng), convex(rng, centre=rng.uniform(-1.2, 1.2, 2))
        both = clipped(one, other)
        points = rng.uniform(-2.5, 2.5, (4000, 2))
        surely = inside(one, points, 1e-9) & inside(other, points, 1e-9)
        if len(both) < 3:
            assert not surely.any()
            continue
        overlaps += 1
        assert area(both) > -1e-12
        assert (inside(both, points, -1e-9) | ~surely).all()
        assert (surely | ~inside(both, points, 1e-9)).all()
    assert overlaps > 20


def test_clipping_by_what_holds_it_or_misses_it_is_all_or_nothing():
    square = np.array([[1.0, 1], [-1, 1], [-1, -1], [1, -1]])
    np.testing.assert_array_equal(clipped(square, 3.0 * square), square)
    np.testing.assert_array_equal(clipped(square, square), square)
    assert len(clipped(square, square + [5.0, 0.0])) == 0
    corner = clipped(square, square + [1.5, 1.5])
    assert area(corner) == pytest.approx(0.25)


def test_a_whole_sole_bears_at_its_four_corners_drawn_in():
    points = ForcePoints.of(HALF)
    assert points.count == 4
    np.testing.assert_allclose(np.sort(np.abs(points.offsets[:, 0])), SOLE_RATIO * HALF[0])
    np.testing.assert_allclose(np.sort(np.abs(points.offsets[:, 1])), SOLE_RATIO * HALF[1])
    assert len(np.unique(np.sign(points.offsets[:, :2]), axis=0)) == 4
    # A surface that is large enough changes nothing.
    around = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
    np.testing.assert_allclose(ForcePoints.of(HALF, around).offsets, points.offsets)


def test_an_end_without_a_sole_bears_at_its_point():
    points = ForcePoints.of(np.zeros(2))
    assert points.count == 1 and not points.offsets.any()
    np.testing.assert_array_equal(points.distribute(np.array([1.0, 2, 3]), np.array([0.1, 0.2])), [1.0, 2, 3])


def test_only_what_is_on_the_surface_bears():
    rng = np.random.default_rng(6)
    sole = HALF * [[1, 1], [-1, 1], [-1, -1], [1, -1]]
    partial = 0
    for _ in range(40):
        outline = convex(rng, centre=rng.uniform(-0.15, 0.15, 2), size=0.15)
        points = ForcePoints.of(HALF, outline)
        assert points.count == 4 and not points.offsets[:, 2].any()
        assert inside(sole, points.offsets[:, :2], -1e-12).all()
        if len(clipped(SOLE_RATIO * sole, outline)) < 3:
            continue
        partial += 1
        assert inside(outline, points.offsets[:, :2], -1e-9).all()
    assert partial > 20


def test_toes_over_an_edge_leave_the_rest_of_the_sole():
    edge = np.array([[-1.0, -1], [0.02, -1], [0.02, 1], [-1, 1]])
    points = ForcePoints.of(HALF, edge).offsets
    np.testing.assert_allclose(np.sort(points[:, 0]), [-0.09, -0.09, 0.02, 0.02])
    np.testing.assert_allclose(np.abs(points[:, 1]), 0.054)


def test_shares_have_the_sum_and_the_centre_of_pressure_that_they_are_to_have():
    rng = np.random.default_rng(7)
    for _ in range(30):
        outline = (
            None if rng.integers(2) else np.array([[-1.0, -1], [rng.uniform(-0.05, 0.08), -1], [0.03, 1], [-1, 1]])
        )
        points = ForcePoints.of(HALF, outline)
        turn = Rotation.random(random_state=int(rng.integers(1e6))).as_matrix()
        force, pressure = rng.normal(size=3), rng.uniform(-1.0, 1.0, 2) * HALF
        forces = points.distribute(force, pressure)
        wrench = points.map(turn) @ forces
        np.testing.assert_allclose(wrench[:3], force, atol=1e-9)
        np.testing.assert_allclose(wrench[3:], np.cross(turn @ [*pressure, 0.0], force), atol=1e-9)


def test_the_map_is_force_and_moment_of_the_points_forces():
    rng = np.random.default_rng(8)
    points = ForcePoints.of(HALF)
    turn = Rotation.random(random_state=4).as_matrix()
    forces = rng.normal(size=(4, 3))
    wrench = points.map(turn) @ forces.ravel()
    np.testing.assert_allclose(wrench[:3], forces.sum(axis=0))
    np.testing.assert_allclose(wrench[3:], np.cross(points.offsets @ turn.T, forces).sum(axis=0))


@pytest.mark.parametrize("friction", [0.3, 0.7, 1.2])
def test_a_pyramid_is_inside_the_cone_and_fills_most_of_it(friction):
    rng = np.random.default_rng(9)
    for _ in range(10):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        rows = pyramid(normal, friction)
        assert rows.shape == (SIDES, 3)
        forces = rng.normal(size=(3000, 3))
        along = forces @ normal
        across = np.linalg.norm(forces - np.outer(along, normal), axis=1)
        allowed = (forces @ rows.T >= 0.0).all(axis=1)
        assert (along[allowed] >= 0.0).all()
        assert (across[allowed] <= FRICTION_RATIO * friction * along[allowed] + 1e-9).all()
        well_inside = across < np.cos(np.pi / SIDES) * FRICTION_RATIO * friction * along - 1e-9
        assert allowed[well_inside].all() and well_inside.any()
        assert (rows @ normal > 0.0).all()


def test_a_twist_is_a_moment_about_the_normal_and_nothing_else():
    for outline in (None, np.array([[-1.0, -1], [0.03, -1], [0.0, 1], [-1, 1]])):
        points = ForcePoints.of(HALF, outline)
        turn = Rotation.random(random_state=3).as_matrix()
        forces = points.twist(7.0, turn)
        np.testing.assert_allclose(points.map(turn) @ forces, [0.0, 0.0, 0.0, *(7.0 * turn[:, 2])], atol=1e-9)
        # The least of all such forces: a least-squares solution has no part that the wrench does not see.
        least = np.linalg.lstsq(points.map(turn), points.map(turn) @ forces, rcond=None)[0]
        np.testing.assert_allclose(forces, least, atol=1e-9)
    assert not ForcePoints.of(np.zeros(2)).twist(7.0, np.eye(3)).any()
