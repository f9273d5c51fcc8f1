"""The stick robot: links are rigid, limbs end where the plan says, knees and elbows bend the right way."""

import numpy as np
import pytest

import plans_by_hand as by_hand
from mcplan.kinematics.samples import sample
from mcplan.view.colours import end_effector_colours
from mcplan.view.robot_stick import limbs_of, stick_robot


@pytest.fixture(scope="module", params=["stairs", "jump"])
def drawn(request):
    robot = by_hand.humanoid()
    scene = by_hand.stairs() if request.param == "stairs" else by_hand.gap()
    plan = by_hand.walk(scene, robot) if request.param == "stairs" else by_hand.jump(scene, robot)
    samples = sample(plan, scene, robot)
    return samples, robot, stick_robot(samples, robot, end_effector_colours(robot))


def test_links_keep_their_length(drawn):
    _, _, figure = drawn
    for root, middle, last in figure.joints_W:
        for start, end in ((root, middle), (middle, last)):
            length = np.linalg.norm(end - start, axis=1)
            assert np.ptp(length) < 1e-9
            assert length[0] > 0.1


def test_limbs_end_at_the_end_effectors(drawn):
    samples, robot, figure = drawn
    for end, (limb, joints) in enumerate(zip(limbs_of(robot), figure.joints_W, strict=True)):
        above = joints[2] - samples.positions_W[:, end]
        assert np.allclose(np.linalg.norm(above, axis=1), limb.end_offset)
        assert np.allclose(above, limb.end_offset * samples.rotations_W[:, end, :, 2])


def test_limbs_begin_on_the_body(drawn):
    samples, robot, figure = drawn
    for limb, joints in zip(limbs_of(robot), figure.joints_W, strict=True):
        root_B = np.einsum("nji,nj->ni", samples.rotation_WB, joints[0] - samples.com_W)
        assert np.allclose(root_B, limb.root_B)


def test_knees_bend_forward_and_elbows_backward(drawn):
    samples, robot, figure = drawn
    for end, joints in zip(robot.end_effectors, figure.joints_W, strict=True):
        out = joints[1] - 0.5 * (joints[0] + joints[2])
        ahead = np.sum(out * samples.rotation_WB[:, :, 0], axis=1)
        bent = np.linalg.norm(out, axis=1) > 0.02
        assert bent.any()
        assert (ahead[bent] > 0.0).all() if end.kind == "foot" else (ahead[bent] < 0.0).all()


def test_drawn_links_join_at_the_joints(drawn):
    _, robot, figure = drawn
    parts = {part.name: part for part in figure.parts}
    for end, joints in zip(robot.end_effectors, figure.joints_W, strict=True):
        for name, start, stop in (("upper", 0, 1), ("lower", 1, 2)):
            part = parts[f"{end.name}_{name}"]
            assert np.allclose(part.poses[:, :3, 3], joints[start])
            length = np.linalg.norm(joints[stop] - joints[start], axis=1)
            assert np.allclose(part.poses[:, :3, 3] + length[:, None] * part.poses[:, :3, 2], joints[stop])


def test_every_pose_is_a_rigid_motion(drawn):
    _, _, figure = drawn
    for part in figure.parts:
        rotation = part.poses[:, :3, :3]
        assert np.allclose(rotation @ rotation.transpose(0, 2, 1), np.eye(3), atol=1e-9), part.name
        assert np.allclose(np.linalg.det(rotation), 1.0), part.name


def test_feet_lie_flat_on_what_they_touch(drawn):
    samples, _, _ = drawn
    for n, row in enumerate(samples.surfaces):
        for end in np.flatnonzero(row >= 0):
            assert np.allclose(samples.rotations_W[n, end, :, 2], [0.0, 0.0, 1.0])
