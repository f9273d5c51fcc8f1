"""Runs in words: what is said of how a run ended, of disturbances, of lengths and of the joint nearest to its limit."""

from __future__ import annotations

import dataclasses

import pytest

from mcplan.tracking import Options, Push, TrackingResult
from mcplan.tracking.report import disturbances_text, length, nearest_to_torque_limit

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

import plans_by_hand as by_hand  # noqa: E402
import recordings  # noqa: E402
import tracked_cartwheel  # noqa: E402


@pytest.fixture(scope="module")
def result() -> TrackingResult:
    return TrackingResult(recordings.walking(), recordings.measures(), Options())


def ended(result: TrackingResult, interrupted: bool = False, **measures) -> str:
    changed = TrackingResult(result.recording, recordings.measures(**measures), result.options, interrupted)
    return str(changed).splitlines()[0]


def test_the_headline_says_how_it_ended(result):
    lead, lasts = f"{result.recording.plan.scene.name}  talos  ", result.recording.plan.duration()
    plan = f" (plan of {lasts:.2f} s, unassisted)"
    assert ended(result) == f"{lead}followed to the end: 8.43 s without a fall{plan}"
    assert ended(result, fell=True, completed_s=2.5) == f"{lead}fell after 2.50 s{plan}"
    assert ended(result, True, completed_s=2.5) == f"{lead}interrupted after 2.50 s, until then without a fall{plan}"
    assert (
        result.completed and not TrackingResult(result.recording, recordings.measures(fell=True), Options()).completed
    )


def test_the_joint_nearest_to_its_limit_is_that_of_the_largest_share(result):
    recording = result.recording
    torques = recording.torques.copy()
    joint = recording.joints.index("leg_left_4_joint")
    torques[:, joint] *= 0.0
    torques[120, joint] = -0.97 * recording.torque_limits[joint]
    changed = dataclasses.replace(recording, torques=torques)
    assert nearest_to_torque_limit(changed) == ("leg_left_4_joint", pytest.approx(recording.times_s[120]))


def test_disturbances_are_named_with_sign_unit_and_direction():
    assert disturbances_text(Options()) == ""
    pushes = (Push(40.0, 0.2, 3.0, 90.0), Push(25.0, 0.5, 1.0, -90.0), Push(10.0, 0.1, 2.0, 33.0))
    options = Options(mass_scale=1.05, friction_scale=0.8, ground_shift_m=-0.01, pushes=pushes, seed=7)
    assert disturbances_text(options) == (
        "mass +5.0 %, friction -20.0 %, ground -10.0 mm, push of 40 N for 0.2 s at 3.00 s to the left, "
        "push of 25 N for 0.5 s at 1.00 s to the right, push of 10 N for 0.1 s at 2.00 s towards 33 deg (seed 7)"
    )


@pytest.mark.parametrize(
    ("metres", "text"),
    [
        (0.0, "0 mm"),
        (0.00123, "1.2 mm"),
        (0.0146, "15 mm"),
        (0.0994, "99 mm"),
        (0.0996, "10 cm"),
        (0.31, "31 cm"),
        (1.594, "1.59 m"),
    ],
)
def test_lengths_are_read_as_they_are_said(metres, text):
    assert length(metres) == text


def test_planar_runs_are_told_by_their_contact_forces():
    result = tracked_cartwheel.tracked()
    lines = str(result).splitlines()
    assert lines[0].startswith("cartwheel  climber9  followed to the end: ")
    assert f"{100.0 * result.measures.force_rms:.1f} % rms (A " in lines[1]
    gone = dataclasses.replace(result, measures=dataclasses.replace(result.measures, completed=False, completed_s=0.4))
    assert str(gone).startswith("cartwheel  climber9  left its plan after 0.40 s ") and not gone.completed
    assert result.completed and not dataclasses.replace(result, interrupted=True).completed


def test_reports_of_robots_made_by_hand_name_the_robot_that_was_simulated(result):
    other = by_hand.talos()
    other.name = "talos_two"
    changed = dataclasses.replace(result, recording=dataclasses.replace(result.recording, robot=other))
    assert str(changed).split()[1] == "talos_two"
