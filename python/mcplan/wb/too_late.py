"""Time limits before the solver's first iteration: what is prepared stops, and a robot that stands is what there is."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from .contact_points import corners_S
from .motion import Motion
from .motion_fields import CORNERS
from .nodes import nodes_of
from .start import stand_still

if TYPE_CHECKING:
    from .moving_joints import MovingRobot

#: Nodes of a motion that only stands, about.
COARSE = 1000
#: Between them, at least [s].
COARSE_S = 0.2


class TooLate(Exception):
    """The time limit was reached before the solver began."""


def deadline(until: float) -> Callable[[], None]:
    """What raises TooLate when it is called after a time of the performance counter."""

    def check() -> None:
        if time.perf_counter() > until:
            raise TooLate

    return check


def standing(robot: MovingRobot) -> Motion:
    """A motion that stands in the robot's posture throughout its plan, without forces."""
    plan = robot.plan
    nodes = nodes_of(plan, max(COARSE_S, plan.duration() / COARSE))
    points = [corners_S(end) for end in plan.robot.end_effectors]
    return Motion(
        plan=plan,
        urdf=robot.urdf,
        joints=robot.joints,
        locked=robot.locked,
        times_s=nodes.times_s,
        coefficients=stand_still(plan, robot.model, nodes, lambda: None),
        corner_points_S=np.array([np.resize(own, (CORNERS, 3)) for own in points]),
        corner_forces_S=np.zeros((nodes.count, len(points), CORNERS, 3)),
        contacts=nodes.contacts,
    )
