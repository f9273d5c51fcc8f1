"""mcplan.export.contacts: labels and forces, as planned and as simulated."""

from __future__ import annotations

import numpy as np

import mcplan as mp
from exports import plan, run


def test_labels_and_forces_of_a_plan_are_those_of_its_states(tmp_path):
    data = np.load(mp.export(plan(), "contacts", tmp_path / "contacts.npz"))
    for n, t in enumerate(data["times_s"]):
        for e, state in enumerate(plan().at(min(t, plan().duration())).end_effectors):
            assert data["surface"][n, e] == state.surface and data["contact"][n, e] == (state.surface >= 0)
            np.testing.assert_array_equal(data["force_w"][n, e], state.force_W)
            np.testing.assert_array_equal(data["position_w"][n, e], state.position_W)
    assert data["end_effectors"].tolist() == [end.name for end in plan().robot.end_effectors]
    assert data["fps"] == 50.0 and data["contact"].any() and not data["contact"].all()


def test_labels_of_a_run_are_those_of_the_simulator(tmp_path):
    data = np.load(mp.export(run(), "contacts", tmp_path / "contacts.npz"))
    np.testing.assert_array_equal(data["contact"], run().contacts[::2])
    np.testing.assert_array_equal(data["force_w"], run().forces_W[::2])
    np.testing.assert_array_equal(data["surface"], run().contacts_plan[::2])


def test_a_plan_without_joints_has_labels_too(tmp_path):
    from standing import standing_plan

    data = np.load(mp.export(standing_plan(), "contacts", tmp_path / "contacts.npz"))
    assert data["contact"].shape[0] == len(data["times_s"])


def test_rows_are_those_of_the_motion_of_the_same_rate(tmp_path):
    labels = np.load(mp.export(plan(), "contacts", tmp_path / "contacts.npz"))
    motion = np.load(mp.export(plan(), "mjlab", tmp_path / "motion.npz"))
    assert len(labels["contact"]) == len(motion["joint_pos"])
