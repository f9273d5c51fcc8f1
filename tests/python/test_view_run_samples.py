"""Frames of a run: evenly chosen, contacts as the simulator had them."""

import dataclasses

import numpy as np
import pytest

import recordings
from mcplan.kinematics.urdf_model import load_model
from mcplan.view.run_samples import (
    SHORT,
    frame_indices,
    frames_of,
    push_text,
    pushes_of,
    simulated_intervals,
    stretches_of,
)

pytest.importorskip("pinocchio")


@pytest.mark.parametrize(("step", "rate"), [(0.002, 30.0), (0.002, 25.0), (0.004, 60.0), (0.05, 30.0)])
def test_frames_are_the_instants_nearest_to_even_ones(step, rate):
    times = np.arange(0.0, 3.0 + 1e-9, step)
    chosen = frame_indices(times, rate)
    assert chosen[0] == 0 and chosen[-1] == len(times) - 1
    assert (np.diff(chosen) > 0).all()
    assert len(chosen) == min(round(3.0 * rate) + 1, len(times))
    if len(chosen) < len(times):
        wanted = np.linspace(0.0, 3.0, len(chosen))
        assert np.abs(times[chosen] - wanted).max() <= 0.5 * step + 1e-9


def test_a_run_of_one_instant_has_one_frame_at_rest():
    recording = recordings.walking()
    one = dataclasses.replace(
        recording,
        **{
            item.name: value[:1]
            for item in dataclasses.fields(recording)
            if isinstance(value := getattr(recording, item.name), np.ndarray) and len(value) == len(recording.times_s)
        },
    )
    frames = frames_of(one, load_model(recording.simulated_robot), 30.0)
    assert frames.samples.count == 1
    assert not frames.samples.com_velocity_W.any() and not frames.samples.velocities_W.any()


def test_surfaces_are_those_of_the_plan_by_name_whatever_ground_is_simulated():
    recording = recordings.walking()
    planned = recording.plan.scene.__copy__()
    other = planned.surfaces[0].__copy__()
    other.name = "elsewhere"
    other.vertices_W = np.asarray(other.vertices_W) + [50.0, 0.0, 1.0]
    planned.surfaces = [*planned.surfaces, other]
    plan = recording.plan.__copy__()
    plan.scene = planned
    urdf_model = load_model(recording.simulated_robot)
    expected = [
        (i.end_effector, i.surface, i.start_s) for i in frames_of(recording, urdf_model, 30.0).samples.intervals
    ]
    for surfaces in (planned.surfaces[::-1], planned.surfaces[:1]):
        true = planned.__copy__()
        true.surfaces = surfaces
        run = dataclasses.replace(recording, plan=plan, true_scene=true)
        found = frames_of(run, urdf_model, 30.0).samples.intervals
        assert [(i.end_effector, i.surface, i.start_s) for i in found] == expected


def test_stretches_are_all_of_the_true_and_nothing_else():
    active = np.random.default_rng(3).random(200) < 0.6
    again = np.zeros_like(active)
    for start, stop in stretches_of(active):
        assert not again[start:stop].any()
        again[start:stop] = True
        assert start == 0 or not active[start - 1]
    assert (again == active).all()


def test_pushes_are_told_apart_that_overlap_and_begin_within_a_sample():
    recording = recordings.walking()
    ahead, left, rows = np.array([40.0, 0.0, 0.0]), np.array([0.0, 120.0, 0.0]), np.zeros_like(recording.pushes_W)
    rows[10:60] += ahead
    rows[60] += 0.3 * ahead
    rows[30] += 0.5 * left
    rows[31:40] += left
    rows[80] = left
    changed = dataclasses.replace(recording, pushes_W=rows)
    found = pushes_of(changed)
    assert found == [(10, 31), (31, 40), (40, 61), (80, 81)]
    assert [push_text(changed, *push) for push in found] == [f"push of {n} N" for n in (40, 126, 40, 120)]
    rows[:] = np.linspace(0.0, 1.0, len(rows))[:, None] * left  # one that varies
    assert pushes_of(dataclasses.replace(recording, pushes_W=rows)) == [(1, len(rows))]


def test_a_contact_lost_for_an_instant_is_one_contact_and_a_longer_loss_is_a_step():
    recording = recordings.walking()
    count = sum(i.end_effector == 0 for i in simulated_intervals(recording, recording.plan.scene))
    for lost, more in ((SHORT - 0.015, 0), (SHORT + 0.03, 1)):
        contacts = recording.contacts.copy()
        contacts[(recording.times_s >= 0.2) & (recording.times_s < 0.2 + lost), 0] = False
        changed = dataclasses.replace(recording, contacts=contacts)
        found = simulated_intervals(changed, recording.plan.scene)
        assert sum(i.end_effector == 0 for i in found) == count + more


def test_a_hand_that_touches_unplanned_is_given_the_nearest_surface():
    recording = recordings.walking()
    contacts = recording.contacts.copy()
    contacts[50:100, 2] = True
    intervals = simulated_intervals(dataclasses.replace(recording, contacts=contacts), recording.plan.scene)
    (hand,) = [i for i in intervals if i.end_effector == 2]
    assert hand.surface == 0
    assert (hand.start_s, hand.end_s) == pytest.approx((0.5, 1.0))
    assert hand.position_W == pytest.approx(recording.end_effectors_W[50:100, 2].mean(axis=0))


def test_frames_keep_the_recordings_numbers():
    recording = recordings.walking()
    frames = frames_of(recording, load_model(recording.simulated_robot), 25.0)
    chosen = frame_indices(recording.times_s, 25.0)
    assert (frames.samples.forces_W == recording.forces_W[chosen]).all()
    assert (frames.base_W == recording.configurations[chosen, :3]).all()
    assert frames.samples.rotations_W[:, :2, 2, 2].min() > 0.85  # soles: flat, or on their way
