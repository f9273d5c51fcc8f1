"""How long a run may take."""

import pytest

import mcplan as mp

for name in ("mujoco", "pinocchio", "proxsuite"):
    pytest.importorskip(name)

from mcplan.online.ending import COMMAND_S, LONGEST_RATIO, LONGEST_S, length_of  # noqa: E402
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
    with_goal = OnlineOptions(goal=((4.0, 1.0, 0.0, 0.0),))
    assert length_of(plan, options, with_goal) == 4.0 + LONGEST_RATIO * planned_s + LONGEST_S
