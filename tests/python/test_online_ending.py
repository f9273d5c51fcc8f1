"""How long a run may take."""

from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp

for name in ("mujoco", "pinocchio", "proxsuite"):
    pytest.importorskip(name)

from mcplan.online.ending import COMMAND_S, LONGEST_RATIO, LONGEST_S, fallen, length_of  # noqa: E402
from mcplan.online.options import OnlineOptions  # noqa: E402
from mcplan.online.steering import STEERED_S  # noqa: E402
from mcplan.tracking.options import Options  # noqa: E402


def test_the_length_of_a_run_is_that_asked_for_or_what_its_walk_takes():
    plan = mp.plan("flat", "humanoid44").plan
    options, walk = Options(), OnlineOptions()
    planned_s = plan.duration() + options.hold_s
    assert length_of(plan, options, OnlineOptions(duration_s=3.0), is_steered=True) == 3.0
    assert length_of(plan, options, walk, is_steered=True) == STEERED_S
    assert length_of(plan, options, walk) == LONGEST_RATIO * planned_s + LONGEST_S
    assert length_of(plan, options, OnlineOptions(replanning=False)) == planned_s
    assert length_of(plan, options, OnlineOptions(command=((0.0, 0.1, 0.0, 0.0),))) == COMMAND_S
    later = OnlineOptions(command=((0.0, 0.1, 0.0, 0.0), (12.0, 0.0, 0.1, 0.0)))
    assert length_of(plan, options, later) == 12.0 + COMMAND_S
    with_goal = OnlineOptions(goal=((4.0, 1.0, 0.0, 0.0),))
    assert length_of(plan, options, with_goal) == 4.0 + LONGEST_RATIO * planned_s + LONGEST_S


def test_robots_without_feet_of_that_kind_fall_as_others_do():
    robot = mp.load_robot("talos")
    for end in robot.end_effectors:
        end.kind = "paw"
    high = SimpleNamespace(com_W=[0.0, 0.0, 0.9], base_WB=np.eye(3), end_effector_position_W=lambda _: np.zeros(3))
    low = SimpleNamespace(**{**vars(high), "com_W": [0.0, 0.0, 0.4]})
    assert fallen(low, robot) and not fallen(high, robot)
