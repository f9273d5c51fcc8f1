"""Plans that the checker rejects by little are mended: the same sequence, further inside what was missed."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.scenes import scaled

MAX_ITERATIONS = 5000


def rectangle(name: str, x: tuple[float, float], y: tuple[float, float], z: float = 0.0) -> mp.model.Surface:
    corners = [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
    return mp.model.Surface(name=name, vertices_W=corners, end_effectors=["foot"])


def walk(name: str, surfaces: list[mp.model.Surface], goal: list[float]) -> mp.Scene:
    out = mp.Scene(name=name)
    out.surfaces = surfaces
    out.start.contacts = {"foot": surfaces[0].name}
    out.goal.contacts = {"foot": surfaces[-1].name}
    out.goal.position_W = np.array(goal)
    return out


def hole() -> mp.Scene:
    """A hole of 0.8 m with a corridor of 0.25 m to its left."""
    corridor = rectangle("corridor", (0.4, 1.2), (0.3, 0.55))
    return walk(
        "hole",
        [rectangle("a", (-1.0, 0.4), (-1.6, 1.6)), corridor, rectangle("b", (1.2, 3.2), (-1.6, 1.6))],
        [1.8, 0.0, 0.0],
    )


def stairs(tread_m: float) -> mp.Scene:
    """Four closed steps of 0.10 m up."""
    surfaces = []
    for i in range(5):
        begin = -1.2 if i == 0 else 0.4 + (i - 1) * tread_m
        step = rectangle(f"t{i}", (begin, 0.4 + i * tread_m if i < 4 else begin + 2.0), (-1.0, 1.0), 0.1 * i)
        step.thickness = 0.1 * (i + 1)
        surfaces.append(step)
    return walk("stairs", surfaces, [0.85 + 3 * tread_m, 0.0, 0.4])


def sideways_slope(degrees: float) -> mp.Scene:
    """A floor that falls off to the left of a walk along x."""
    floor = rectangle("floor", (-1.0, 3.0), (-1.5, 1.5))
    fall = math.tan(math.radians(degrees))
    floor.vertices_W = [[x, y, -fall * y] for x, y, _ in floor.vertices_W]
    return walk("sideways_slope", [floor], [1.5, 0.0, 0.0])


@pytest.mark.parametrize(
    ("scene", "robot"), [(hole(), "talos"), (scaled(mp.load_scene("stairs_broad"), 0.8), "g1")], ids=["hole", "stairs"]
)
def test_near_misses_are_mended_within_a_tenth_of_the_iterations_the_same_each_time(
    scene: mp.Scene, robot: str, tmp_path: Path
) -> None:
    result = mp.plan(scene, robot)
    assert result.report.status == mp.Status.solved, result.report.message
    assert mp.check(result.plan).ok()
    assert result.report.iterations <= 1.1 * MAX_ITERATIONS
    files = [tmp_path / "first.npz", tmp_path / "second.npz"]
    for file, plan in zip(files, (result.plan, mp.plan(scene, robot).plan), strict=True):
        plan.save(file)
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("depth", [0.30, 0.35])
def test_treads_that_ask_for_short_steps_are_climbed_in_as_many(depth: float) -> None:
    searched = mp.plan(stairs(depth), "talos", phases=26, stepping_guesses=False)
    result = mp.plan(stairs(depth), "talos")
    assert result.report.status == mp.Status.solved, result.report.message
    assert result.report.cost < 0.01 * len(result.plan.phases)
    assert searched.report.status != mp.Status.solved or searched.report.cost > 2.0 * result.report.cost  # strained


@pytest.mark.parametrize("robot", ["talos", "g1"])
def test_floors_that_fall_off_sideways_are_walked_along(robot: str) -> None:
    scene, model = sideways_slope(15.0), mp.load_robot(robot)
    result = mp.plan(scene, model)
    assert result.report.status == mp.Status.solved, result.report.message
    start = result.plan.knots[0]
    assert start.com_W[2] < model.com_height
    for end, place_W in zip(model.end_effectors, start.end_effectors_W, strict=True):
        if end.kind == "foot":
            assert place_W[2] - start.com_W[2] > end.reach_min_B[2]


def test_starts_out_of_reach_are_named_before_the_search() -> None:
    robot = mp.load_robot("g1")
    ends = robot.end_effectors
    for foot in ends[:2]:
        foot.reach_max_B, foot.reach_cut = [*foot.reach_max_B[:2], foot.nominal_B[2] + 0.06], mp.model.Polytope()
    robot.end_effectors = ends
    report = mp.plan(sideways_slope(25.0), robot).report
    assert report.status == mp.Status.infeasible
    assert report.iterations == 0
    assert report.message.startswith('start: left_foot would stand on "floor", ')
    assert " mm beyond its reach from the CoM at " in report.message
