"""Walks on two feet whose search begins with footsteps over the ground."""

from __future__ import annotations

import pytest

import mcplan as mp
from mcplan.files.solvable_scenes import solvable_scene


def strip(name: str, begin: float, end: float, height: float) -> mp.model.Surface:
    """Level ground across the way, the top of a solid where it is high [m]."""
    corners = [[begin, -1.0, height], [end, -1.0, height], [end, 1.0, height], [begin, 1.0, height]]
    surface = mp.model.Surface(name=name, vertices_W=corners, end_effectors=["foot"])
    if height > 0.0:
        surface.thickness = height
    return surface


def block(height: float, begin: float = 0.59, length: float = 0.62) -> mp.Scene:
    """Floor, a block across the way, and floor again."""
    end = begin + length
    ground = [strip("near", -1.0, begin, 0.0), strip("block", begin, end, height), strip("far", end, end + 3.0, 0.0)]
    return mp.Scene(
        surfaces=ground,
        start=mp.model.Stance(contacts={"foot": "near"}),
        goal=mp.model.Stance(position_W=[end + 1.0, 0.0, 0.0], contacts={"foot": "far"}),
    )


@pytest.mark.parametrize("robot", ["talos", "g1"])
@pytest.mark.parametrize("height", [0.05, 0.10, 0.14])
def test_a_block_in_the_way_is_stepped_onto(robot: str, height: float) -> None:
    """Searches ended with strides of 0.66 m over it, at up to sixty times the cost, after many seconds."""
    scene = block(height * (1.0 if robot == "talos" else 0.75))
    result = mp.plan(scene, robot)
    assert result.report.status == mp.Status.solved, result.report.message
    assert mp.check(result.plan).ok()
    assert result.report.cost < 0.02 * len(result.plan.phases)
    phases = result.plan.phases
    assert not any(all(contact.surface < 0 for contact in phase.contacts) for phase in phases)
    assert any(phase.contacts[foot].surface == 1 for phase in phases for foot in (0, 1))


def test_uneven_ground_is_walked_over_at_a_fraction_of_what_a_search_comes_to() -> None:
    heights, x = [0.0, 0.1, -0.06, 0.04, 0.12, 0.0], 0.3
    ground = [strip("s0", -1.0, x, 0.0)]
    for i, height in enumerate(heights[1:], start=1):
        last = i == len(heights) - 1
        ground.append(strip(f"s{i}", x, x + (2.0 if last else 0.45), height))
        x += 0.45
    scene = mp.Scene(
        surfaces=ground,
        start=mp.model.Stance(contacts={"foot": "s0"}),
        goal=mp.model.Stance(position_W=[x + 0.2, 0.0, 0.0], contacts={"foot": "s5"}),
    )
    walked = mp.plan(scene, "talos")
    searched = mp.plan(scene, "talos", stepping_guesses=False, max_iterations=2000)
    assert walked.report.status == mp.Status.solved, walked.report.message
    assert walked.report.iterations < searched.report.iterations
    assert searched.report.status != mp.Status.solved or walked.report.cost < 0.8 * searched.report.cost


@pytest.mark.parametrize("robot", ["talos", "g1"])
def test_a_long_walk_with_a_turn_on_an_open_floor_takes_a_few_hundred_iterations(robot: str) -> None:
    """Searches along both courses, on which the base turns to the way and on which it does not, took thousands."""
    ground = strip("floor", -3.0, 7.0, 0.0)
    ground.vertices_W = [[-3.0, -4.0, 0.0], [7.0, -4.0, 0.0], [7.0, 4.0, 0.0], [-3.0, 4.0, 0.0]]
    scene = mp.Scene(
        surfaces=[ground],
        start=mp.model.Stance(contacts={"foot": "floor"}),
        goal=mp.model.Stance(position_W=[4.1, 0.3, 0.0], yaw=2.8, contacts={"foot": "floor"}),
    )
    result = mp.plan(scene, robot)
    assert result.report.status == mp.Status.solved, result.report.message
    assert result.report.iterations < 1000
    assert result.report.cost < 0.01 * len(result.plan.phases)
    assert result.report.cost < 0.5


def test_what_strains_in_as_many_phases_as_are_given_is_walked_from_footsteps() -> None:
    robot = mp.load_robot("g1")
    scene = solvable_scene(20113, robot)
    walked = mp.plan(scene, robot, phases=22)
    searched = mp.plan(scene, robot, phases=22, stepping_guesses=False)
    assert walked.report.status == mp.Status.solved and len(walked.plan.phases) == 22
    assert walked.report.cost < 0.1 * searched.report.cost


def test_the_paper_robot_is_searched_for_as_the_paper_does() -> None:
    """It is walked from footsteps only where a search finds no plan, or one that strains it."""
    assert len(mp.plan("flat", "humanoid44").plan.phases) == 18


def test_any_number_of_threads_makes_the_same_walk() -> None:
    one, two = (mp.plan(block(0.12), "talos", threads=threads) for threads in (1, 2))
    assert one.plan == two.plan and one.report.iterations == two.report.iterations


def test_a_goal_that_is_very_far_away_is_no_matter_of_memory() -> None:
    scene = block(0.0)
    far = 9e3
    scene.surfaces[2].vertices_W = [[1.21, -1.0, 0.0], [far + 2.0, -1.0, 0.0], [far + 2.0, 1.0, 0.0], [1.21, 1.0, 0.0]]
    scene.goal.position_W = [far, 0.0, 0.0]
    result = mp.plan(scene, "talos", time_limit_s=0.2)
    assert result.report.status != mp.Status.solved


def test_four_feet_walk_over_a_block() -> None:
    """go2 had its feet on the ground beside the block, inside it, until its iterations were used up."""
    ground = strip("g", -1.0, 5.0, 0.0)
    scene = mp.Scene(
        surfaces=[ground, strip("p", 1.0, 2.0, 0.15)],
        start=mp.model.Stance(contacts={"foot": "g"}),
        goal=mp.model.Stance(position_W=[3.2, 0.0, 0.0], contacts={"foot": "g"}),
    )
    result = mp.plan(scene, "go2")
    assert result.report.status == mp.Status.solved, result.report.message
    assert any(contact.surface == 1 for phase in result.plan.phases for contact in phase.contacts)
