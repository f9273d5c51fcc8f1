"""mcplan_bench.growth: the scenes and robots that are measured, and slopes."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench import growth


@pytest.mark.parametrize("tiles", [1, 2, 5, 32])
def test_tiles_cover_start_and_goal(tiles):
    scene = growth.tiled_floor(tiles)
    assert len(scene.surfaces) == tiles
    for stance in (scene.start, scene.goal):
        (name,) = set(stance.contacts.values())
        (tile,) = [surface for surface in scene.surfaces if surface.name == name]
        low, high = tile.vertices_W[:, 0].min(), tile.vertices_W[:, 0].max()
        assert low <= stance.position_W[0] <= high
    assert sum(np.ptp(surface.vertices_W[:, 0]) for surface in scene.surfaces) == pytest.approx(3.0)


def test_a_longer_plan_has_a_longer_way():
    assert growth.long_floor(18).goal.position_W[0] == pytest.approx(2.0)
    scene = growth.long_floor(72)
    assert scene.goal.position_W[0] == pytest.approx(8.0)
    assert scene.surfaces[0].vertices_W[:, 0].max() > 8.0


@pytest.mark.parametrize("feet", [2, 3, 8])
def test_added_feet_stand_where_no_other_does(feet):
    robot = growth.with_feet(mp.load_robot("humanoid44"), feet)
    places = {tuple(np.round(end.nominal_B, 6)) for end in robot.end_effectors}
    assert len(places) == len({end.name for end in robot.end_effectors}) == feet
    robot.validate()


def test_the_exponent_of_a_power_is_found():
    rows = [{"varied": "phases", "phases": n, "ms": 0.3 * n**1.5} for n in (2, 4, 32)]
    rows.append({"varied": "surfaces", "phases": 18, "ms": 99.0})
    assert growth.exponent(rows, "phases", "ms", "phases") == pytest.approx(1.5)
    assert np.isnan(growth.exponent(rows, "surfaces", "ms", "phases"))


def test_a_quick_measurement_has_two_amounts_of_each():
    rows = growth.measure(quick=True, repeats=1)
    assert [row["varied"] for row in rows] == ["phases"] * 2 + ["end_effectors"] * 2 + ["surfaces"] * 2
    assert all(row["iteration_ms"] > 0.0 and row["neighbours"] > 0 for row in rows)
    # Twice the phases offer about twice the neighbours.
    assert rows[1]["neighbours"] / rows[0]["neighbours"] == pytest.approx(2.0, rel=0.2)
