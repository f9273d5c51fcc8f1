"""mcplan.files.urdf: the checked-in robots agree with their URDFs, and their reach boxes are really reached."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.reach import share_reached
from mcplan.files.urdf import SETUPS, limb_of

pin = pytest.importorskip("pinocchio")
example_robot_data = pytest.importorskip("example_robot_data")


@pytest.fixture(scope="module", params=sorted(SETUPS))
def loaded(request):
    source = example_robot_data.load(request.param)
    return mp.load_robot(request.param), SETUPS[request.param], source.model, source.q0.copy()


def test_mass_height_and_inertia_are_those_of_the_urdf(loaded):
    robot, _, model, posture = loaded
    data = model.createData()
    assert robot.mass == pytest.approx(pin.computeTotalMass(model), abs=1e-3)
    com_W = pin.centerOfMass(model, data, posture)
    pin.framesForwardKinematics(model, data, posture)
    soles = [data.oMf[model.getFrameId(e.frame)].translation[2] for e in robot.end_effectors if e.kind == "foot"]
    assert robot.com_height == pytest.approx(com_W[2] - np.mean(soles), abs=2e-3)
    # Steiner's sum over the bodies, independent of Pinocchio's centroidal algorithm
    inertia = np.zeros((3, 3))
    for joint in range(1, model.njoints):
        placement, body = data.oMi[joint], model.inertias[joint]
        arm = placement.act(body.lever) - com_W
        inertia += placement.rotation @ body.inertia @ placement.rotation.T
        inertia += body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    np.testing.assert_allclose(robot.inertia, np.diag(inertia), atol=2e-3)


def test_posture_names_joints_of_the_urdf(loaded):
    robot, _, model, _ = loaded
    assert len(robot.posture) == sum(model.nqs[j] == 1 for j in range(2, model.njoints))
    assert all(model.existJointName(name) for name in robot.posture)


def test_nine_in_ten_random_points_of_every_reach_box_are_reached(loaded):
    robot, setup, model, posture = loaded
    for number, end in enumerate(robot.end_effectors):
        limb = limb_of(model, posture, setup.ends[number], setup.ends)
        share = share_reached(limb, end.reach_min_B, end.reach_max_B, count=60, seed=number)
        assert share >= 0.9, (robot.name, end.name, share)


def test_points_a_leg_length_too_far_are_not_reached(loaded):
    robot, setup, model, posture = loaded
    limb = limb_of(model, posture, setup.ends[0], setup.ends)
    below = robot.end_effectors[0].nominal_B - [0, 0, robot.com_height]
    assert share_reached(limb, below, below + 1e-6, count=3, seed=0) == 0.0


def test_jacobian_of_a_limb_agrees_with_differences(loaded):
    _, setup, model, posture = loaded
    rng = np.random.default_rng(0)
    for end in setup.ends:
        limb = limb_of(model, posture, end, setup.ends)
        joints = rng.uniform(limb.lower, limb.upper)
        jacobian = limb.jacobian(joints)[:3].copy()
        step = 1e-6
        for i in range(joints.size):
            unit = np.eye(joints.size)[i] * step
            slope = (limb.position(joints + unit) - limb.position(joints - unit)) / (2 * step)
            np.testing.assert_allclose(jacobian[:, i], slope, atol=1e-8)


def test_legs_stay_on_their_own_side(loaded):
    robot, *_ = loaded
    for end in robot.end_effectors:
        assert end.reach_min_B[1] * end.reach_max_B[1] > 0.0
        if end.kind == "foot":
            assert min(abs(end.reach_min_B[1]), abs(end.reach_max_B[1])) >= end.half_size[1]
