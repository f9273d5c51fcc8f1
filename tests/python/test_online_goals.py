"""Goals that are turned, or lie behind, are walked towards at velocities that lead there."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.online.goals import (
    LOOKED_FOR_S,
    NEAR_RAD,
    NEAR_RATIO,
    NEARER_RAD,
    NEARER_RATIO,
    NO_NEARER_S,
    Aim,
    is_elsewhere,
    require_goals,
    turn_to,
    velocity_to,
)
from mcplan.online.options import OnlineOptions

GOALS = [
    (1.0, 0.6, np.pi / 2),
    (1.0, 0.6, -np.pi / 2),
    (-0.6, 0.0, np.pi),
    (-0.6, 0.0, 0.0),
    (0.0, 0.0, -2.5),
    (1.0, -1.0, 3.0),
]
STEP_S = 0.1


@pytest.fixture(scope="module", params=["talos", "g1"])
def robot(request):
    return mp.load_robot(request.param)


def followed(goal, robot, delay_s: float = 1.0) -> tuple[np.ndarray, float, float]:
    """Place, heading and time at the end of a point that moves as it was told some time ago, integrated by itself."""
    place, heading, now_s, told = np.zeros(2), 0.0, 0.0, [(0.0, 0.0, 0.0)] * round(delay_s / STEP_S)
    while (velocity := velocity_to(goal, place, heading, robot)) is not None:
        assert now_s < 60.0, f"{goal}: at {place}, {heading:.2f} rad"
        told.append(velocity)
        ahead, left, rate = told.pop(0)
        place = place + STEP_S * np.array(
            [ahead * np.cos(heading) - left * np.sin(heading), ahead * np.sin(heading) + left * np.cos(heading)]
        )
        heading, now_s = heading + STEP_S * rate, now_s + STEP_S
    return place, heading, now_s


@pytest.mark.parametrize("goal", GOALS)
def test_who_moves_at_these_velocities_comes_near_the_goal_though_late(goal, robot):
    assert is_elsewhere(goal, np.zeros(2), 0.0, robot)
    place, heading, now_s = followed(goal, robot)
    assert np.hypot(*(place - goal[:2])) <= NEAR_RATIO * robot.com_height + 1e-9
    assert abs(np.exp(1j * (heading - goal[2])) - 1.0) <= NEAR_RAD
    assert now_s < 30.0


@pytest.mark.parametrize("goal", GOALS)
def test_velocities_are_those_of_the_mirrored_goal_mirrored(goal, robot):
    heading = 0.3
    velocity = velocity_to(goal, np.array([0.2, 0.1]), heading, robot)
    mirrored = velocity_to((goal[0], -goal[1], -goal[2]), np.array([0.2, -0.1]), -heading, robot)
    assert velocity is not None and mirrored is not None
    np.testing.assert_allclose(mirrored, np.array(velocity) * [1.0, -1.0, -1.0], atol=1e-12)


def test_goals_that_a_walk_leads_to_are_planned_to_at_once(robot):
    assert not is_elsewhere((1.2, 0.3, 0.0), np.zeros(2), 0.0, robot)
    assert not is_elsewhere((-0.1, 0.0, 0.1), np.zeros(2), 0.0, robot)
    assert velocity_to((0.1, 0.05, -0.2), np.zeros(2), 0.0, robot) is None


@pytest.mark.parametrize(
    ("heading", "goal", "turn"), [(3.0, -3.0, 2.0 * np.pi - 6.0), (0.1, 0.4, 0.3), (7.0, 0.7, -0.0168)]
)
def test_turns_go_the_shorter_way_round(heading, goal, turn):
    assert turn_to((0.0, 0.0, goal), heading) == pytest.approx(turn, abs=1e-4)


def test_after_a_stand_steps_to_the_goal_are_looked_for_before_it_is_walked_towards_at_a_velocity(robot):
    scene, place = mp.load_scene("flat"), np.array([0.5, 0.0, 0.9])
    aim = Aim(scene, robot)
    aim.stopped(3.0, place, 0.0)
    assert aim.open and not aim.steering and aim.velocity(3.0, place, 0.0) is None
    assert aim.goal == (*scene.goal.position_W[:2], scene.goal.yaw)
    aim.stopped(3.0 + LOOKED_FOR_S - 0.1, place, 0.0)
    assert not aim.steering
    aim.stopped(3.0 + LOOKED_FOR_S + 0.1, place, 0.0)
    assert aim.steering and aim.velocity(5.2, place, 0.0)[0] > 0.0
    aim.led_to()
    aim.stopped(9.0, place, 0.0)
    assert aim.open and not aim.steering
    # No steps lead to a goal that is turned.
    aim.stopped(9.1, place, 1.0)
    assert aim.steering


def test_where_a_velocity_brings_no_nearer_steps_to_the_goal_are_looked_for_again(robot):
    aim, place = Aim(mp.load_scene("flat"), robot), np.array([0.5, 0.0, 0.9])
    nearer = np.array([NEARER_RATIO * robot.com_height + 0.01, 0.0, 0.0])
    aim.stopped(0.0, place, 0.0)
    aim.stopped(3.0, place, 0.0)
    assert aim.steering
    for now_s, at in ((3.0, place), (6.9, place + 0.5 * nearer), (7.0, place + nearer), (10.9, place + nearer)):
        assert aim.velocity(now_s, at, 0.0) is not None
    assert aim.velocity(11.1, place + nearer, 0.0) is None
    assert aim.open and not aim.steering
    # For as long as after a stand, and then at a velocity once more.
    aim.stopped(11.2, place + nearer, 0.0)
    assert not aim.steering
    aim.stopped(11.1 + LOOKED_FOR_S + 0.1, place + nearer, 0.0)
    assert aim.steering and aim.velocity(13.3, place + nearer, 0.0) is not None
    assert aim.velocity(13.3 + NO_NEARER_S - 0.1, place + nearer, 0.0) is not None


def test_to_a_goal_that_is_turned_steps_are_looked_for_where_a_velocity_does_not_turn_to_it(robot):
    aim, place = Aim(mp.load_scene("flat"), robot), np.array([0.5, 0.0, 0.9])
    aim.stopped(0.0, place, 1.5)
    for now_s, heading in ((0.0, 1.5), (3.0, 1.45), (3.9, 1.5 - NEARER_RAD - 0.01), (7.8, 1.4)):
        assert aim.velocity(now_s, place, heading) is not None
    assert aim.velocity(8.0, place, 1.4) is None
    aim.stopped(8.1, place, 1.4)
    assert aim.open and not aim.steering
    aim.stopped(8.0 + LOOKED_FOR_S + 0.1, place, 1.4)
    assert aim.steering and aim.velocity(10.2, place, 1.4) is not None


@pytest.mark.parametrize("goal", [(1.0, 50.0, 0.0), (1.0, 6.0, 0.0), (1.0, -5.5, 0.0)])
def test_goals_over_no_ground_are_refused_before_anything_is_planned(goal, robot, monkeypatch):
    monkeypatch.setattr("mcplan.running.solve", None)
    for asked in (goal, [(1.2, 0.3), (*goal, 3.0)]):
        with pytest.raises(
            mp.errors.InvalidOptions, match=r"goal\[[01]\]: must lie over a surface.* m beside \"ground\""
        ):
            mp.run("flat", robot, goal=asked)


def test_goals_are_refused_at_the_height_of_another_surface(robot):
    with pytest.raises(mp.errors.InvalidOptions, match=r"goal\[0\]: must lie over a surface"):
        mp.run("stairs_broad", robot, goal=(0.3, 0.0))


def test_goals_that_a_foot_reaches_ground_from_are_taken(robot):
    for y in (0.0, 4.9, 5.1):
        require_goals(mp.load_scene("flat"), robot, OnlineOptions(goal=((0.0, 1.0, y, 0.0),)))
