"""mp.track: plans of either kind."""

import pytest

import mcplan as mp
import tracked_cartwheel
from mcplan.planar.tracking import DEFAULT_OPTIONS


def test_whole_body_plans_are_tracked_by_their_own_robot():
    pytest.importorskip("mujoco")
    plan = tracked_cartwheel.cartwheel()
    result = mp.track(plan, hold_s=0.0, control_step_s=1e-3)
    assert result.recording.plan is plan and result.completed
    assert result.options.simulation_step_s == DEFAULT_OPTIONS.simulation_step_s
    with pytest.raises(mp.InvalidInput, match='robot: must not be given with a whole-body plan, .* got "talos"'):
        mp.track(plan, "talos")
