"""How far legs may reach when a robot has to catch itself, and how high feet are lifted over ground that is uneven."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mcplan._core import Polytope

if TYPE_CHECKING:
    from mcplan._core import Robot

#: Sides of the wider box over the height of the CoM: ahead and back, and outward; inward it ends below the CoM.
AHEAD, OUTWARD = 0.285, 0.34
#: Least distance between the edges of two soles beside each other [m].
BESIDE_M = 0.02

#: Feet are lifted higher by this ratio of how far surfaces lie from where they were known to, by so much at most [m].
HIGHER_RATIO, HIGHER_MAX_M = 1.0, 0.05
#: A usual swing is no higher than this ratio of the CoM's height: of small robots that leave theirs open it is less.
USUAL_RATIO = 0.25


def lifting(robot: Robot, unevenness_m: float) -> Robot:
    """The robot that lifts its feet higher over ground that has been found to be uneven by so much [m].

    Where one surface lies elsewhere, the next one may, too: a swing that clears it by a little as it is known hits its
    edge. A swing is lifted by half its height or more where it passes the edge of a step.
    """
    if unevenness_m <= 0.0:
        return robot
    higher = robot.__copy__()
    usual_m = min(robot.swing_height, USUAL_RATIO * robot.com_height)
    higher.swing_height = usual_m + min(HIGHER_RATIO * unevenness_m, HIGHER_MAX_M)
    return higher


def widened(robot: Robot) -> Robot:
    """The robot with reach boxes that its legs fill, for two feet whose joints the planner knows (``limb``).

    Boxes are the largest ones that hold everywhere, feet on their own side of the body: those of TALOS end 7 cm beside the
    CoM and 0.20 m outward. A push takes the CoM over the standing foot, where a box says that no plan exists, and asks for
    steps farther out. Here boxes give way to what the planner knows of hips, knees and ankles, and feet are kept apart from
    each other instead. Other robots stay as they are.
    """
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    ends = [end.__copy__() for end in robot.end_effectors]
    if len(feet) != 2 or any(ends[i].limb.upper <= 0.0 or ends[i].partner_reach for i in feet):
        return robot
    side = {i: float(np.sign(ends[i].nominal_B[1])) for i in feet}
    if sorted(side.values()) != [-1.0, 1.0]:
        return robot
    height = float(robot.com_height)
    apart_m = sum(float(ends[i].half_size[1]) for i in feet) + BESIDE_M
    for i in feet:
        end, low, high = ends[i], np.array(ends[i].reach_min_B), np.array(ends[i].reach_max_B)
        low[0], high[0] = min(low[0], -AHEAD * height), max(high[0], AHEAD * height)
        if side[i] > 0.0:
            low[1], high[1] = min(low[1], 0.0), max(high[1], OUTWARD * height)
        else:
            low[1], high[1] = min(low[1], -OUTWARD * height), max(high[1], 0.0)
        end.reach_min_B, end.reach_max_B = low, high
        end.usual_reach = [-np.inf, np.inf]
        other = ends[feet[1] if i == feet[0] else feet[0]].name
        end.partner_reach = {other: Polytope(A=[[0.0, side[i], 0.0]], b=[-apart_m])}
    wide = robot.__copy__()
    wide.end_effectors = ends
    wide.validate()
    return wide
