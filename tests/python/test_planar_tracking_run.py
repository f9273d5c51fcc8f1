"""A whole-body plan in MuJoCo: its contact forces are the simulator's, and those of another robot are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mcplan.errors import InvalidOptions

pytest.importorskip("mujoco")
from mcplan.planar.tracking import Feedback, track_whole_body  # noqa: E402
from mcplan.planar.tracking.simulation import PlanarSimulation  # noqa: E402
from mcplan.tracking.options import Push  # noqa: E402
from tracked_cartwheel import QUICK, cartwheel, tracked  # noqa: E402


def test_the_simulator_finds_the_planned_forces():
    measures = tracked().measures
    assert measures.completed
    assert measures.completed_s == pytest.approx(cartwheel().duration() + QUICK.hold_s, abs=QUICK.control_step_s)
    assert measures.force_rms < 0.1
    assert measures.force_rms_robot < 0.1
    assert set(measures.force_rms_end_effectors) == {"A", "B", "C"}
    assert max(measures.force_rms_end_effectors.values()) < 0.1
    assert measures.drift_m < 0.01
    assert measures.simulator_warnings == 0
    assert measures.torque_feedback_ratio < 0.1  # the forces are the plan's torques' doing


def test_a_robot_that_is_a_tenth_heavier_has_other_forces():
    assert track_whole_body(cartwheel(), replace(QUICK, mass_scale=1.1)).measures.force_rms > 0.1


def test_torques_a_tenth_too_large_give_other_forces(monkeypatch):
    right = PlanarSimulation.apply
    monkeypatch.setattr(PlanarSimulation, "apply", lambda self, torques, q, v: right(self, 1.1 * torques, q, v))
    assert track_whole_body(cartwheel(), QUICK).measures.force_rms > 0.1


def test_a_run_starts_in_the_plans_state_and_records_every_control_step():
    recording = tracked().recording
    np.testing.assert_array_equal(recording.base[0], recording.base_plan[0])
    np.testing.assert_array_equal(recording.q[0], recording.q_plan[0])
    np.testing.assert_array_equal(recording.velocity[0], recording.velocity_plan[0])
    np.testing.assert_allclose(np.diff(recording.times_s), QUICK.control_step_s, atol=1e-12)
    state = cartwheel().at(float(recording.times_s[700]))
    np.testing.assert_allclose(recording.feedforward[700], state.torque, atol=1e-12)
    np.testing.assert_allclose(recording.base_plan[700], state.configuration.base, atol=1e-12)
    for force in state.forces:
        np.testing.assert_array_equal(recording.forces_plan_W[700, force.end_effector, force.point], force.force_W)


def test_a_robot_on_ice_is_told_to_have_left_its_plan():
    result = track_whole_body(cartwheel(), replace(QUICK, friction_scale=0.01))
    assert not result.measures.completed
    assert result.measures.completed_s == result.recording.left_plan_at_s == result.recording.times_s[-1]
    assert result.measures.completed_s < cartwheel().duration()


def test_without_feedback_the_robot_falls_over_its_foot():
    """Torques alone hold no robot up: what little the feedback adds is needed, and is all that is needed."""
    passive = track_whole_body(cartwheel(), QUICK, feedback=Feedback(stiffness=0.0, damping_s=0.0))
    assert not passive.measures.completed
    assert passive.measures.torque_feedback_ratio == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pushes": (Push(10.0, 0.1, 0.5),)}, "pushes: must be .. for planar robots"),
        ({"assist": True}, "assist: must be False for planar robots, got True"),
        ({"seed": 3}, "seed: must be 0 for planar robots, got 3"),
        ({"hold_s": -1.0}, "hold_s: must lie in 0 to 60"),
    ],
)
def test_what_planar_robots_do_not_have_is_refused(change, message):
    with pytest.raises(InvalidOptions, match=message):
        track_whole_body(cartwheel(), replace(QUICK, **change))
