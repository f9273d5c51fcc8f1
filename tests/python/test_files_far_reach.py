"""mcplan.files.far_reach: what legs reach beyond their usual box is reached by inverse kinematics."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.far_reach import FARTHEST, add_far_reach, leg_reaches
from mcplan.files.leg_geometry import legs_of, max_length
from mcplan.files.reach import share_reached
from mcplan.files.reach_cut import below_cut
from mcplan.files.urdf import load_model
from mcplan.files.urdf_limbs import contact_frame, limb_of
from mcplan.files.urdf_setups import SETUPS

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


def within(robot, end, place):
    return below_cut(end, place) and leg_reaches(robot, end, place)


def test_what_a_leg_is_long_enough_for_is_reached_beyond_the_usual_box():
    robot, ends = mp.load_robot("talos"), SETUPS["talos"].ends
    model, posture, _ = load_model("talos", ends)
    beyond = 0
    for number, end in enumerate(robot.end_effectors):
        if end.kind != "foot":
            continue
        limb = limb_of(model, posture, ends[number], ends)
        low, high, (back, ahead) = np.array(end.reach_min_B), np.array(end.reach_max_B), end.usual_reach
        assert max(-low[0], high[0]) <= FARTHEST * robot.com_height
        holds = functools.partial(within, robot, end)
        for first, last in ((low[0], back), (ahead, high[0])):
            beyond += 1
            box = (np.array([first, *low[1:]]), np.array([last, *high[1:]]))
            assert share_reached(limb, box, 60, number, holds=holds) >= 0.95, (end.name, first)
    assert beyond == 4


def test_a_leg_is_long_enough_up_to_its_length():
    robot = mp.load_robot("talos")
    foot = robot.end_effectors[0]
    assert leg_reaches(robot, foot, np.asarray(foot.nominal_B))
    down = np.asarray(foot.nominal_B) - [0.0, 0.0, 0.2]
    assert not leg_reaches(robot, foot, down)
    # Straight down the leg is longer by what the foot is lower, less what its hip comes down with it.
    hip = np.asarray(foot.limb.hip_B)
    spare = max_length(foot.limb) - foot.limb.margin - (hip - foot.nominal_B - foot.limb.ankle)[2]
    lower = spare / (1.0 - foot.limb.hip_shift)
    assert leg_reaches(robot, foot, np.asarray(foot.nominal_B) - [0.0, 0.0, 0.99 * lower])
    assert not leg_reaches(robot, foot, np.asarray(foot.nominal_B) - [0.0, 0.0, 1.01 * lower])


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_shipped_robots_reach_as_far_as_their_urdf_says(name):
    """The G1 no further than usual: its hips lie where a straight line does not say, once a foot is far behind."""
    shipped, robot, ends = mp.load_robot(name), mp.load_robot(name), SETUPS[name].ends
    listed = list(robot.end_effectors)
    for end in listed:
        low, high = end.usual_box()
        end.reach_min_B, end.reach_max_B, end.usual_reach = low, high, [-np.inf, np.inf]
    robot.end_effectors = listed
    model, nominal, _ = load_model(name, ends)
    for end in ends:
        contact_frame(model, end)
    legs = legs_of(model, nominal, ends, {end.name: limb_of(model, nominal, end, ends, name) for end in ends})
    add_far_reach(robot, legs, 0.02)
    assert robot == shipped
    assert np.isfinite(shipped.end_effectors[0].usual_reach).all() == (name == "talos")
