"""Tubes of swinging soles: whatever a sole does within them at two nodes, it is over the ground on the way between."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

pytest.importorskip("pyarrow")

import mcplan as mp  # noqa: E402
from mcplan.files.sweep_terrains import make_scene  # noqa: E402
from mcplan.wb.ground import KEPT, LATE, Ground  # noqa: E402
from mcplan.wb.nodes import Nodes, nodes_of  # noqa: E402

#: Soles are looked at in some points, on some of the way; an edge may come up between by so much [m].
BETWEEN_POINTS_M = 1e-3


@pytest.fixture(scope="module")
def climb() -> tuple[mp.Plan, Nodes]:
    robot = mp.load_robot("g1")
    scene = make_scene("stairs", "", {"count": 2, "rise_m": 0.054, "tread_m": 0.37}, robot)
    plan = mp.plan(scene, robot).plan
    return plan, nodes_of(plan, 0.025)


def height_over(scene: mp.Scene, points: np.ndarray) -> float:
    """Least height of points (k, 3) over level surfaces, by the corners of their rectangles alone."""
    least = np.inf
    for surface in scene.surfaces:
        low, high = surface.vertices_W.min(axis=0), surface.vertices_W.max(axis=0)
        assert low[2] == high[2]
        above = ((points[:, :2] >= low[:2]) & (points[:, :2] <= high[:2])).all(axis=1) & (points[:, 2] > low[2] - 0.05)
        if above.any():
            least = min(least, float((points[above, 2] - low[2]).min()))
    return least


@pytest.mark.parametrize("foot", [0, 1])
def test_soles_within_their_tubes_are_over_the_ground_between_nodes(climb, foot):
    plan, nodes = climb
    half = plan.robot.end_effectors[foot].half_size
    sole = np.array([[x, y, 0.0] for x in np.linspace(-half[0], half[0], 9) for y in (-half[1], 0.0, half[1])])
    tubes = Ground(plan).tubes_W(plan, nodes, foot)
    pairs = [k for k in tubes if k + 1 in tubes]
    assert len(pairs) > 20
    worst = np.inf
    for k in pairs:
        corners = [
            [nodes.swings_W[n, foot] + [sign * tubes[n][1][0], 0.0, tubes[n][0][2]] for sign in (-1.0, 1.0)]
            for n in (k, k + 1)
        ]
        for start, end in itertools.product(*corners):
            for part in np.linspace(0.0, 1.0, 11):
                at = start + part * (end - start)
                turned = sole @ nodes.samples.rotations_W[k + (part > 0.5), foot].T
                worst = min(worst, height_over(plan.scene, at + turned))
    assert worst >= -BETWEEN_POINTS_M


def test_soles_are_free_where_they_are_lifted_and_high_in_the_middle(climb):
    plan, nodes = climb
    tubes = Ground(plan).tubes_W(plan, nodes, 0)
    ground = Ground(plan)
    for k, (low, _) in tubes.items():
        ratio = nodes.swung(k, 0)
        over = ground.clearance(nodes.swings_W[k, 0][None] + low, 0.0)
        if 0.4 < ratio < 0.6:
            assert over >= 0.01
        assert over >= -1e-9


def test_soles_do_not_skim_the_ground_before_they_land(climb):
    plan, nodes = climb
    ground, late = Ground(plan), 0
    for foot in range(2):
        for k, (low, _) in ground.tubes_W(plan, nodes, foot).items():
            if LATE[1] <= nodes.swung(k, foot) <= LATE[2]:
                planned = ground.clearance(nodes.swings_W[k, foot][None], 0.0)
                assert planned + low[2] >= KEPT * planned - 1e-9
                late += 1
    assert late > 4
