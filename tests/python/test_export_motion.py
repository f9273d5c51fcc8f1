"""mcplan.export.motion: joints along a plan."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from exports import plan
from mcplan.export.source import Source
from mcplan.files.export_formats import FORMATS


def motion(what, rate_hz=50.0):
    source = Source.of(what, None, FORMATS["mjlab"], rate_hz)
    return source, source.motion


def corners_W(source, found, n):
    """Corners of each foot in contact (4, 3) by end-effector."""
    import pinocchio as pin

    model = found.urdf_model.model
    data = model.createData()
    pin.framesForwardKinematics(model, data, found.configurations[n])
    result = {}
    for e, (end, frame) in enumerate(zip(source.robot.end_effectors, found.urdf_model.frames, strict=True)):
        if source.samples.surfaces[n, e] >= 0 and end.kind == "foot":
            x, y = end.half_size
            sole = np.array([[x, y, 0], [x, -y, 0], [-x, y, 0], [-x, -y, 0]])
            result[e] = sole @ data.oMf[frame].rotation.T + data.oMf[frame].translation
    return result


def test_feet_in_contact_do_not_skate():
    """By 0.1 mm at most at the corners of the soles over each contact, and they lie on the ground by as much."""
    source, found = motion(plan())
    placed: dict[int, np.ndarray] = {}
    worst = 0.0
    for n in range(len(found.times_s)):
        now = corners_W(source, found, n)
        for e, points in now.items():
            first = placed.setdefault(e, points)
            worst = max(worst, float(np.linalg.norm(points - first, axis=1).max()), float(np.abs(points[:, 2]).max()))
        placed = {e: points for e, points in placed.items() if e in now}
    assert len(found.times_s) > 100
    assert worst < 1e-4


def test_joints_stay_within_their_limits_and_do_not_jump():
    _, found = motion(plan())
    model, joints = found.urdf_model.model, found.configurations[:, 7:]
    assert (joints >= model.lowerPositionLimit[7:] - 1e-9).all()
    assert (joints <= model.upperPositionLimit[7:] + 1e-9).all()
    assert np.abs(np.diff(joints, axis=0)).max() < 0.2


def test_the_com_goes_where_the_plan_has_it():
    import pinocchio as pin

    source, found = motion(plan())
    model = found.urdf_model.model
    data = model.createData()
    misses = [
        np.linalg.norm(pin.centerOfMass(model, data, q) - com)
        for q, com in zip(found.configurations, source.samples.com_W, strict=True)
    ]
    assert max(misses) < 0.01


def test_a_plan_of_a_robot_without_joints_names_those_that_have_some(tmp_path):
    other = plan().__copy__()
    other.robot = mp.load_robot("humanoid44")
    with pytest.raises(mp.errors.InvalidRobot, match="urdf: must name a URDF.*such as"):
        mp.export(other, "mjlab", tmp_path / "a.npz")
    assert not list(tmp_path.iterdir())
