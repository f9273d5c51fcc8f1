"""Exports of whole-body motions: the file has the motion's own joints, contacts and forces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")

import mcplan as mp  # noqa: E402
from mcplan.errors import InvalidInput  # noqa: E402
from mcplan.files.export_formats import FORMATS  # noqa: E402
from mcplan.wb import Motion  # noqa: E402
from motions_by_hand import LEFT, Talos, lifting_motion  # noqa: E402


@pytest.fixture(scope="module")
def lifting() -> Motion:
    return lifting_motion(Talos())


def test_joints_are_those_of_the_motion_and_the_locked_ones(lifting, tmp_path):
    mp.export(lifting, "mjlab", tmp_path / "reference.npz")
    data = np.load(tmp_path / "reference.npz")
    names = [str(name) for name in data["joint_names"]]
    times = np.arange(len(data["joint_pos"])) / 50.0
    _, v, _ = lifting.trajectory(times)
    x, _, _ = lifting.coordinates(times)
    assert times[-1] == pytest.approx(2.8)
    for column, name in enumerate(lifting.joints):
        np.testing.assert_allclose(data["joint_pos"][:, names.index(name)], x[:, 6 + column], atol=1e-12)
        np.testing.assert_allclose(data["joint_vel"][:, names.index(name)], v[:, 6 + column], atol=1e-12)
    for name, position in lifting.locked.items():
        np.testing.assert_array_equal(data["joint_pos"][:, names.index(name)], position)
        assert not data["joint_vel"][:, names.index(name)].any()


def test_contacts_and_forces_are_those_of_the_motion(lifting, tmp_path):
    mp.export(lifting, "contacts", tmp_path / "contacts.npz", rate_hz=40)
    data = np.load(tmp_path / "contacts.npz")
    states = lifting.sample(data["times_s"])
    np.testing.assert_array_equal(data["contact"], states.surfaces >= 0)
    assert not data["contact"][:, LEFT].all()
    np.testing.assert_array_equal(data["force_w"], states.wrenches_W[..., :3])
    np.testing.assert_array_equal(data["position_w"], states.end_effectors_W)


def test_a_saved_motion_is_written_in_every_format_of_a_humanoid(lifting, tmp_path):
    lifting.save(tmp_path / "motion.npz")
    for name, entry in FORMATS.items():
        if name == "contact-sequence":  # asks for a plan whose CoM is continuous, which one by hand need not have
            continue
        path: Path = tmp_path / f"{name}{entry.suffix[0]}"
        assert mp.export(tmp_path / "motion.npz", name, path) == path and path.stat().st_size > 0
        if entry.joints:
            direct = tmp_path / f"{name}_direct{entry.suffix[0]}"
            mp.export(lifting, name, direct)
            assert direct.read_bytes() == path.read_bytes()


def test_a_motion_has_its_own_robot(lifting, tmp_path):
    with pytest.raises(InvalidInput, match="must not be given with a run or a motion"):
        mp.export(lifting, "mjlab", tmp_path / "reference.npz", robot="talos")
