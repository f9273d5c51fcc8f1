"""Robots from 5 mm to 20 m: the same plan in their own units, the same verdict of the checker."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mcplan as mp
from similar import Factors, numbers_of, similar_plan, similar_robot, similar_scene

#: Powers of 4, 2 and 8: products with them are exact.
EXACT = [
    Factors(4.0**-4, 2.0**-4, 8.0**-8),  # 2.7 mm, with the mass of a solid of that size, on earth
    Factors(4.0**-2, 2.0**-2, 8.0**-4),
    Factors(4.0**2, 2.0**2, 8.0**4),  # 11.2 m, 180 t
    Factors(1.0, 2.0, 1.0),  # a quarter of earth's gravity
    Factors(4.0**5, 1.0, 1.0),  # lengths in a unit near the millimetre, gravity near 9810
    Factors(4.0, 2.0**-3, 8.0),
]
HEIGHT_M, MASS_KG, GRAVITY = 0.70, 44.0, 9.8
#: CoM height [m], mass [kg].
SIZES = [(0.005, MASS_KG * (0.005 / HEIGHT_M) ** 3), (0.007, 0.002), (0.1, 0.5), (2.0, 900.0), (20.0, 440e3)]


def of_size(height: float, mass: float, gravity: float) -> Factors:
    """Factors from humanoid44 in earth's gravity to a robot of that height and mass in that gravity."""
    length = height / HEIGHT_M
    return Factors(length, math.sqrt(length * GRAVITY / gravity), mass / MASS_KG)


@pytest.fixture(scope="module")
def walk() -> mp.Plan:
    """Humanoid44 on `flat`, solved."""
    result = mp.plan("flat", "humanoid44")
    assert str(result.report.status) == "solved"
    return result.plan


@pytest.mark.parametrize("by", EXACT, ids=str)
@pytest.mark.parametrize("stated", [True, False], ids=["durations scaled", "durations at their default"])
def test_the_plan_of_a_similar_robot_is_the_similar_plan_to_the_last_bit(by, stated, walk):
    scene, robot = similar_scene(walk.scene, by), similar_robot(walk.robot, by, durations=stated)
    result = mp.plan(scene, robot)
    assert str(result.report.status) == "solved", result.report.message
    found, expected = numbers_of(result.plan), numbers_of(similar_plan(walk, by))
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)


@pytest.mark.parametrize(("scene", "options"), [("stairs", {}), ("gap", {"model": "lipm"})])
def test_so_it_is_on_other_scenes_and_with_the_papers_model(scene, options):
    by = EXACT[2]
    first = mp.plan(scene, "humanoid44", **options)
    second = mp.plan(similar_scene(first.plan.scene, by), similar_robot(first.plan.robot, by), **options)
    assert str(first.report.status) == str(second.report.status) == "solved"
    for name, values in numbers_of(similar_plan(first.plan, by)).items():
        np.testing.assert_array_equal(numbers_of(second.plan)[name], values, err_msg=name)


@pytest.mark.parametrize(("gravity", "stated"), [(1.62, True), (9.81, True), (9.81, False), (9810.0, False)], ids=str)
@pytest.mark.parametrize(("height", "mass"), SIZES)
def test_robots_of_every_size_walk_on_flat_ground_of_their_size(height, mass, gravity, stated, walk):
    # stated: swing height and durations are scaled with the rest; otherwise they are left at their defaults.
    by = of_size(height, mass, gravity)
    result = mp.plan(similar_scene(walk.scene, by), similar_robot(walk.robot, by, durations=stated))
    assert str(result.report.status) == "solved", result.report.message
    assert mp.check(result.plan).ok()


def test_a_scene_and_robot_in_millimetres_are_solved():
    by = Factors(1000.0, 1.0, 1.0)  # forces in mN, gravity 9800 mm/s^2
    scene, robot = mp.load_scene("stairs"), mp.load_robot("humanoid44")
    result = mp.plan(similar_scene(scene, by), similar_robot(robot, by))
    assert str(result.report.status) == "solved", result.report.message


#: A change to a plan and the constraint it violates, by an amount of a unit of length that humanoid44 has as 1 m.
def _slip(plan: mp.Plan, amount: float) -> None:
    for k in (1, 2):
        plan.knots[k].end_effectors_W[0, 0] += amount


def _jump(plan: mp.Plan, amount: float) -> None:
    plan.knots[-1].com_W[1] += 1e-5 * amount  # no phase starts there


def _beside_the_goal(plan: mp.Plan, amount: float) -> None:
    plan.scene.goal.position_W[0] += 10.0 * amount


BREAKS = {"slip": _slip, "dynamics": _jump, "goal": _beside_the_goal}


@pytest.mark.parametrize("name", BREAKS)
@pytest.mark.parametrize("in_tolerances", [0.25, 0.9, 1.1, 4.0])
@pytest.mark.parametrize("by", EXACT[:5], ids=str)
def test_the_verdict_is_invariant_under_similarity(name, in_tolerances, by, walk):
    broken = similar_plan(walk, Factors())
    BREAKS[name](broken, 1e-3 * in_tolerances)
    here, there = mp.check(broken), mp.check(similar_plan(broken, by))
    assert [v.name for v in here.violations()] == [v.name for v in there.violations()]
    for ours, theirs in zip(here.constraints, there.constraints, strict=True):
        assert (ours.phase, ours.end_effector, ours.unit) == (theirs.phase, theirs.end_effector, theirs.unit)
        if ours.tolerance > 0.0:
            assert ours.value / ours.tolerance == theirs.value / theirs.tolerance, ours.name
    assert (name in [v.name for v in here.violations()]) == (in_tolerances > 1.0)


@pytest.mark.parametrize("name", BREAKS)
@pytest.mark.parametrize(("height", "mass"), SIZES)
def test_for_any_size_tolerances_are_within_a_factor_of_two_of_the_similar_ones(name, height, mass, walk):
    by = of_size(height, mass, GRAVITY)
    for in_tolerances, rejected in ((0.4, False), (2.5, True)):
        # A velocity's tolerance has the factors of length and time.
        broken = similar_plan(walk, Factors())
        BREAKS[name](broken, 1e-3 * in_tolerances)
        assert (name in [v.name for v in mp.check(similar_plan(broken, by)).violations()]) == rejected


def test_tolerances_may_be_taken_as_they_stand(walk):
    small = similar_plan(walk, EXACT[1])
    _slip(small, 0.5e-3)
    assert [v.name for v in mp.check(small).violations()] == ["slip"]
    assert mp.check(small).violations()[0].tolerance == 1e-3 / 16
    absolute = {v.name: v.tolerance for v in mp.check(small, tolerances=mp.Tolerances(scaled=False)).constraints}
    assert absolute["slip"] == 1e-3 and absolute["pull"] == 1e-6


def test_robots_of_human_size_have_the_published_tolerances():
    for robot in ("humanoid44", "talos", "g1", "anymal"):
        plan = mp.plan("flat", robot, max_iterations=1).plan
        found = {v.name: (v.tolerance, v.unit) for v in mp.check(plan).constraints}
        assert found["slip"] == (1e-3, "m") and found["pull"] == (1e-6, "N") and found["clearance"] == (5e-3, "m")


@pytest.mark.parametrize(
    "by", [EXACT[1], *[pytest.param(by, marks=pytest.mark.slow) for by in (EXACT[2], EXACT[5])]], ids=str
)
def test_a_receding_horizon_walks_alike_at_every_size(by):
    scene, robot = mp.load_scene("rubbles"), mp.load_robot("talos_wang")
    options = {"fidelity": "point", "lookahead": 2, "cycles": 2}
    first = mp.walk(scene, robot, **options)
    second = mp.walk(similar_scene(scene, by), similar_robot(robot, by), **options)
    assert [str(c.status) for c in first.cycles] == [str(c.status) for c in second.cycles] == ["solved"] * 2
    found = numbers_of(second.plan)
    for name, values in numbers_of(similar_plan(first.plan, by)).items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)
    assert second.distance_m() == first.distance_m() * by.length
    assert second.cycles[0].duration_s == first.cycles[0].duration_s * by.time
    assert second.cycles[0].acceleration_cost == first.cycles[0].acceleration_cost * (by.velocity**2 / by.time)


@pytest.mark.parametrize("height", [0.01, pytest.param(15.0, marks=pytest.mark.slow)])
def test_a_receding_horizon_walks_at_sizes_that_are_no_power_of_two(height):
    scene, robot = mp.load_scene("rubbles"), mp.load_robot("talos_wang")
    length = height / float(robot.com_height)
    by = Factors(length, math.sqrt(length), length**3)
    walk = mp.walk(similar_scene(scene, by), similar_robot(robot, by), fidelity="point", lookahead=2, cycles=2)
    assert [str(cycle.status) for cycle in walk.cycles] == ["solved"] * 2, walk.report.message
    assert mp.check(walk.plan).ok()


@pytest.mark.parametrize("gravity", [0.01, 9810.0, 1e6])
def test_impossible_numbers_are_said_with_their_amount(gravity):
    scene = mp.load_scene("flat")
    scene.gravity = gravity  # a force cap of 1750 N against that weight
    result = mp.plan(scene, "humanoid44", max_iterations=300)
    assert ": 0 " not in result.report.message and "0 over" not in result.report.message.split(": ")[-1][:6]
    assert str(result.report.worst_violation)
    if str(result.report.status) != "solved":
        assert result.report.worst_violation.value > result.report.worst_violation.tolerance
