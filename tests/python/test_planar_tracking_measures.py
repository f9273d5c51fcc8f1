"""Measures of a recording in which everything that is wrong was put in by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
from mcplan.planar.tracking.measures import PlanarMeasures, measure  # noqa: E402
from mcplan.planar.tracking.recording import PlanarRecording  # noqa: E402
from tracked_cartwheel import tracked  # noqa: E402


def perfect() -> PlanarRecording:
    """The cartwheel as planned."""
    r = tracked().recording
    points = np.where(np.isnan(r.points_contact_W), r.points_W, r.points_contact_W)
    return replace(
        r,
        forces_W=r.forces_plan_W.copy(),
        points_W=points,
        q=r.q_plan.copy(),
        base=r.base_plan.copy(),
        torques=r.feedforward.copy(),
        feedback=np.zeros_like(r.feedback),
    )


def of(recording: PlanarRecording) -> PlanarMeasures:
    return measure(recording, simulator_warnings=0, wall_clock_s=1.0)


def test_a_perfect_run_has_no_errors():
    measures = of(perfect())
    zeros = ("force_rms", "force_rms_robot", "drift_m", "slip_m", "joint_rms_rad", "base_rms_m", "early_contact_N_s")
    assert [getattr(measures, name) for name in zeros] == [0.0] * len(zeros)
    assert measures.torque_feedback_ratio == 0.0
    assert measures.completed


def test_forces_a_fifth_too_large_are_an_error_of_a_fifth_everywhere():
    run = perfect()
    measures = of(replace(run, forces_W=1.2 * run.forces_plan_W))
    assert measures.force_rms == pytest.approx(0.2)
    assert measures.force_rms_robot == pytest.approx(0.2)
    assert measures.force_rms_end_effectors == {name: pytest.approx(0.2) for name in "ABC"}


def test_what_one_end_effector_gives_another_is_seen_at_each_but_not_in_the_sum():
    run = perfect()
    moved = np.zeros_like(run.forces_W)
    moved[:, 0, 0], moved[:, 1, 0] = [3.0, 4.0], [-3.0, -4.0]
    measures = of(replace(run, forces_W=run.forces_plan_W + moved))
    assert measures.force_rms_robot == pytest.approx(0.0, abs=1e-12)
    for name, e in (("A", 0), ("B", 1)):
        planned = np.nansum(run.forces_plan_W[run.within_plan, e], axis=1)
        assert measures.force_rms_end_effectors[name] == pytest.approx(5.0 / np.sqrt((planned**2).sum(axis=1).mean()))


def test_how_points_of_an_end_effector_share_its_force_does_not_matter():
    run = perfect()
    moved = np.zeros_like(run.forces_W)
    moved[:, :, 0], moved[:, :, 1] = [7.0, 0.0], [-7.0, 0.0]
    assert of(replace(run, forces_W=run.forces_plan_W + moved)).force_rms == pytest.approx(0.0, abs=1e-12)


def test_a_point_that_slides_and_one_that_lifts_drift_but_only_the_first_slips():
    run = perfect()
    standing = run.surfaces_plan[:, 1] >= 0  # limb B, all the time
    assert standing.all()
    slid, lifted = run.points_W.copy(), run.points_W.copy()
    slid[500:, 1, 0, 0] += 0.004
    lifted[500:, 1, 0, 1] += 0.004
    for points, slip in ((slid, 0.004), (lifted, 0.0)):
        measures = of(replace(run, points_W=points))
        assert measures.drift_m == pytest.approx(0.004)
        assert measures.slip_m == pytest.approx(slip, abs=1e-12)


def test_a_force_on_a_swinging_foot_counts_as_impulse():
    run = perfect()
    swinging = run.surfaces_plan[:, 2] < 0
    forces = run.forces_W.copy()
    hit = np.flatnonzero(swinging)[100:110]  # ten control steps of 1 ms
    forces[hit, 2, 0] = [0.0, 50.0]
    assert of(replace(run, forces_W=forces)).early_contact_N_s == pytest.approx(50.0 * 0.010)


def test_distances_torques_and_endings():
    run = perfect()
    limits = run.torque_limits
    torques = np.zeros_like(run.torques)
    torques[17] = 0.9 * limits
    measures = of(
        replace(
            run,
            q=run.q_plan + 0.01,
            base=run.base_plan + [0.003, 0.004, 0.0],
            torques=torques,
            feedback=0.5 * run.feedforward,
            left_plan_at_s=0.25,
        )
    )
    assert measures.joint_rms_rad == pytest.approx(0.01)
    assert measures.base_rms_m == pytest.approx(0.005)
    assert measures.torque_use == pytest.approx(0.9)
    assert measures.torque_feedback_ratio == pytest.approx(0.5)
    assert not measures.completed
    assert measures.completed_s == 0.25
    assert measures.as_dict()["completed_s"] == 0.25
