"""Walks of many steps over rough ground."""

import sys
from pathlib import Path

import mcplan as mp

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import obstacle_scenes


def test_a_walk_over_tilted_patches_takes_steps_that_do_not_strain_the_robot():
    result = mp.plan(obstacle_scenes.patches(1), "g1")
    assert result.report.status == mp.Status.solved and mp.check(result.plan).ok()
    assert result.report.cost < 0.02 * len(result.plan.phases)
