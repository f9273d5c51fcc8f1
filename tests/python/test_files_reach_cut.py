"""mcplan.files.reach_cut: faces up to which soles are lifted, higher ahead than behind."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.reach import Grid
from mcplan.files.reach_cut import Cut, below_cut, highest_cut, tops, uncut_top


def test_the_highest_cut_is_the_best_of_all_lines_below_the_tops():
    """Against a search over a fine grid of slopes, each line as high as the tops let it be."""
    rng = np.random.default_rng(3)
    found = 0
    for _ in range(200):
        x = np.sort(rng.uniform(-0.3, 0.4, 8))
        top = rng.uniform(-0.6, -0.5, 8) + rng.uniform(-0.2, 0.8) * x
        middle = 0.5 * float(x[0] + x[-1])
        slopes = np.linspace(0.0, 40.0, 20_001)
        best = max((top[:, None] - slopes * (x[:, None] - middle)).min(axis=0))
        cut = highest_cut(x, top, middle)
        if cut is None:
            assert best == pytest.approx(top.min(), abs=2e-4)
            continue
        found += 1
        assert (cut.height + cut.slope * x <= top + 1e-9).all()
        assert cut.top(middle) >= best - 1e-9 and cut.slope > 0.0
    assert 50 < found < 200


def test_tops_end_at_the_first_gap_of_the_lowest_column():
    reached = np.ones((3, 2, 5), dtype=bool)
    reached[0, 1, 2] = False  # what is above counts no more
    reached[2, 0, 0] = False  # not even the bottom
    grid = Grid(np.array([0.1, 0.2, -0.5]), 0.1, np.array([1, 0, 1]), reached)
    x, top = tops(grid, np.array([0.0, 0.2, -0.6]), np.array([0.2, 0.3, -0.2]))
    np.testing.assert_allclose(x, [0.0, 0.1, 0.2])
    np.testing.assert_allclose(top, [-0.5, -0.2, -0.6])


def test_a_face_holds_no_more_than_its_cut():
    rng = np.random.default_rng(4)
    for _ in range(50):
        cut = Cut(rng.uniform(-0.7, -0.4), rng.uniform(0.0, 2.0))
        face = cut.polytope()
        assert np.linalg.norm(face.A[0]) == pytest.approx(1.0, abs=1e-3)
        for x in (-0.2, 0.0, 0.2):
            assert face.A[0] @ [x, 0.0, cut.top(x)] >= face.b[0] - 2e-4


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_soles_come_up_higher_ahead_and_both_alike(name):
    robot = mp.load_robot(name)
    right, left = robot.end_effectors[0], robot.end_effectors[1]
    assert right.reach_cut == left.reach_cut and right.reach_cut.given
    (normal,), (b,) = right.reach_cut.A, right.reach_cut.b
    low, high = right.usual_box()  # beyond it the face goes on, and the box is no higher
    ahead, behind = ((b - normal[0] * x) / normal[2] for x in (high[0], low[0]))
    assert ahead == pytest.approx(right.reach_max_B[2], abs=2e-3)
    assert ahead > behind + 0.05 and behind > right.nominal_B[2]
    assert uncut_top(right) == pytest.approx((b - normal[0] * right.reach_min_B[0]) / normal[2])


def test_faces_that_cut_a_box_hold_what_they_say():
    robot = mp.load_robot("g1")
    end = robot.end_effectors[0]
    corners = [np.array(c) for c in itertools.product(*zip(end.reach_min_B, end.reach_max_B, strict=True))]
    assert any(not below_cut(end, corner) for corner in corners)
    assert below_cut(end, end.nominal_B)
    end.reach_cut = mp.model.Polytope()
    assert all(below_cut(end, corner) for corner in corners)
    assert uncut_top(end) == end.reach_max_B[2]


def test_robots_with_faces_are_saved_loaded_and_printed(tmp_path, capsys):
    robot = mp.load_robot("talos")
    file = tmp_path / "talos.toml"
    mp.files.robots.save_robot(robot, file)
    assert mp.load_robot(file) == robot
    assert main(["robots", "talos"]) == 0
    shown = capsys.readouterr().out
    assert "left_foot: its reach is cut at -" in shown and " z <= -" in shown
