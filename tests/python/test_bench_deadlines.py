"""What is measured about time limits: rows of every engine, and surfaces that are out of the way."""

from __future__ import annotations

import numpy as np
import pytest

from mcplan_bench import deadlines


def test_every_engine_is_measured_beyond_its_limit():
    rows = deadlines.overruns(quick=True)
    assert [row["engine"] for row in rows] == ["ddp", "rhp", "sip"]
    for row in rows:
        assert row["limit_s"] == 0.01 and row["cpu_s"] > 0.0
        assert row["cpu_over_s"] == pytest.approx(row["cpu_s"] - 0.01)
        assert row["status"] in {"time_limit", "solved"}


def test_idle_surfaces_lie_beside_the_way_and_change_nothing():
    scene = deadlines.with_idle_surfaces(100)
    assert len(scene.surfaces) == 101
    for surface in scene.surfaces[1:]:
        assert np.abs(surface.vertices_W[:, 1]).min() > 2.0
    alone, among = deadlines.idle_surfaces(quick=True)
    assert (alone["idle"], among["idle"]) == (0, 20)
    assert alone["iterations"] == among["iterations"] and among["status"] == "solved"
