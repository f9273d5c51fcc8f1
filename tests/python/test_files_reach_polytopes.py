"""mcplan.files.reach_polytopes: inside of what is reached, repeatable, and near the published ones of TALOS."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.reach_polytopes import Origin, add_reach_polytopes, inner_polytope, volume
from mcplan.files.robots import robot_to_dict
from mcplan.files.urdf_limbs import limb_of
from mcplan.files.urdf_setups import SETUPS


def holds(polytope: mp.model.Polytope, points: np.ndarray, slack: float = 0.0) -> np.ndarray:
    return (points @ polytope.A.T <= polytope.b + slack).all(axis=1)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("faces", [6, 12, 30])
def test_an_inner_polytope_lies_in_the_hull_of_its_points(seed, faces):
    from scipy.spatial import Delaunay

    rng = np.random.default_rng(seed)
    points = rng.normal(size=(400, 3)) * rng.uniform(0.2, 2.0, 3)
    points[0] = 0.1
    polytope = inner_polytope(points, faces)
    assert 4 <= len(polytope.b) <= faces
    assert holds(polytope, points[:1]).all()
    draws = rng.uniform(points.min(axis=0), points.max(axis=0), (4000, 3))
    inside = draws[holds(polytope, draws, -1e-5)]
    assert len(inside) > 20
    assert (Delaunay(points).find_simplex(inside) >= 0).all()


def test_more_faces_hold_more():
    points = np.random.default_rng(0).normal(size=(2000, 3))
    volumes = [volume(inner_polytope(points, faces)) for faces in (6, 12, 30, 100)]
    assert volumes == sorted(volumes)


def test_a_box_keeps_its_six_faces():
    grid = np.stack(np.meshgrid([0.0, 1.0], [0.0, 2.0], [0.0, 3.0]), axis=-1).reshape(-1, 3)
    polytope = inner_polytope(grid, 30)
    assert len(polytope.b) == 6
    assert volume(polytope) == pytest.approx(6.0, rel=1e-4)


@pytest.fixture(scope="module")
def talos():
    pytest.importorskip("pinocchio")
    pytest.importorskip("example_robot_data")
    robot = mp.load_robot("talos")
    add_reach_polytopes(robot, Origin("talos"), samples=4000)
    return robot


def test_the_same_seed_gives_the_same_polytopes(talos):
    again = mp.load_robot("talos")
    lines: list[str] = []
    add_reach_polytopes(again, Origin("talos"), samples=4000, progress=lines.append)
    assert robot_to_dict(again) == robot_to_dict(talos)
    assert len(lines) == 4 and "faces -> " in lines[0]


def test_seven_in_ten_points_are_reached_with_a_level_sole(talos):
    import example_robot_data

    source, ends = example_robot_data.load("talos"), SETUPS["talos"].ends
    limb = limb_of(source.model, source.q0, ends[1], ends)
    rng = np.random.default_rng(1)
    draws = rng.uniform([-0.7, -0.5, 0.3], [0.7, 0.1, 0.95], (4000, 3))
    draws = draws[holds(talos.end_effectors[1].com_reach, draws)][:50]
    starts = [limb.nominal, *(rng.uniform(limb.lower, limb.upper) for _ in range(4))]
    reached = [any(limb.solve(-point, start) is not None for start in starts) for point in draws]
    assert len(reached) == 50 and np.mean(reached) >= 0.7


def overlap(one: mp.model.Polytope, other: mp.model.Polytope, low: float, high: float) -> tuple[float, float]:
    """Volume that two sets share in a band of heights, over that of each."""
    points = np.random.default_rng(0).uniform([-1, -1, low], [1, 1, high], (200_000, 3))
    a, b = holds(one, points), holds(other, points)
    return (a & b).sum() / a.sum(), (a & b).sum() / b.sum()


@pytest.mark.parametrize(("side", "other"), [("left", "right"), ("right", "left")])
def test_polytopes_of_talos_overlap_with_the_published_ones(talos, side, other):
    """The figures of docs/scenes_and_robots.md: ours keep to the heights of Wang's walk; see there for the differences."""
    ours, published = (
        robot.end_effectors[robot.end_effector_index(f"{side}_foot")] for robot in (talos, mp.load_robot("talos_wang"))
    )
    of_ours, of_published = overlap(ours.com_reach, published.com_reach, 0.65, 0.80)
    print(side, "CoM", of_ours, of_published)
    assert of_ours >= 0.75 and of_published >= 0.55
    partner = f"{other}_foot"
    of_ours, of_published = overlap(ours.partner_reach[partner], published.partner_reach[partner], -0.13, 0.13)
    print(side, "partner", of_ours, of_published)
    assert of_ours >= 0.45 and of_published >= 0.3


def test_feet_stay_apart_and_on_their_sides(talos):
    right, left = talos.end_effectors[:2]
    assert max(right.com_reach.A @ [0.0, -0.1, 0.8] - right.com_reach.b) > 0  # CoM 0.1 m to the right of the right foot
    draws = np.random.default_rng(0).uniform(-1, 1, (200_000, 3))
    assert draws[holds(left.partner_reach["right_foot"], draws)][:, 1].max() <= -0.15 + 1e-5


@pytest.mark.parametrize(
    ("options", "message"),
    [({"faces": 5}, "faces: must be at least 6, got 5"), ({"samples": 10}, "samples: must be at least 1000, got 10")],
)
def test_numbers_out_of_range_are_named(options, message):
    pytest.importorskip("pinocchio")
    with pytest.raises(mp.InvalidInput) as found:
        add_reach_polytopes(mp.load_robot("talos"), Origin("talos"), **options)
    assert str(found.value) == message
