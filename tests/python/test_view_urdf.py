"""A URDF's meshes follow the plan: contacts are met, feet lie flat, knees bend forward."""

import gzip

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample
from mcplan.kinematics.urdf_model import load_model
from mcplan.view import show
from mcplan.view.robot_urdf import CannotFollow, urdf_robot

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


@pytest.fixture(scope="module")
def talos():
    return by_hand.talos()


@pytest.fixture(scope="module")
def walking(talos):
    scene = by_hand.flat()
    plan = by_hand.walk(scene, talos)
    samples = sample(plan, scene, talos, 10.0)
    loaded = load_model(talos)
    return samples, loaded.model, follow(loaded, samples)


def test_postures_meet_com_and_contacts(walking, talos):
    samples, model, postures = walking
    data = model.createData()
    assert postures.residual < 5e-3
    for n, q in enumerate(postures.configurations):
        pin.framesForwardKinematics(model, data, q)
        assert np.linalg.norm(pin.centerOfMass(model, data, q) - samples.com_W[n]) < 5e-3
        for end in (0, 1):
            frame = data.oMf[model.getFrameId(talos.end_effectors[end].frame)]
            assert np.linalg.norm(frame.translation - samples.positions_W[n, end]) < 5e-3
            assert frame.rotation[2, 2] > np.cos(0.02)  # flat


def test_knees_bend_forward_and_joints_keep_their_limits(walking):
    _, model, postures = walking
    for q in postures.configurations:
        for side in ("left", "right"):
            assert q[model.joints[model.getJointId(f"leg_{side}_4_joint")].idx_q] > 0.05
        assert (q[7:] >= model.lowerPositionLimit[7:] - 1e-9).all()
        assert (q[7:] <= model.upperPositionLimit[7:] + 1e-9).all()


def test_motion_has_no_jumps(walking):
    samples, model, postures = walking
    for a, b in zip(postures.configurations[:-1], postures.configurations[1:], strict=True):
        rate = np.abs(pin.difference(model, a, b)[6:]).max() / (samples.times_s[1] - samples.times_s[0])
        assert rate < 8.0  # rad/s


def test_page_carries_the_meshes(talos):
    pytest.importorskip("meshcat")
    plan = by_hand.walk(by_hand.flat(), talos)
    shown = gzip.decompress(show(plan).payload)
    for part in (b"robot/leg_left_4_joint/", b"robot/arm_right_4_joint/", b"robot/head_2_joint/"):
        assert part in shown
    assert b"robot/left_foot_upper" not in shown


def test_a_plan_out_of_reach_falls_back_to_the_stick_robot(talos):
    pytest.importorskip("meshcat")
    plan = by_hand.walk(by_hand.stairs(), talos)  # steps of half a metre are too long with flat feet
    with pytest.raises(CannotFollow, match=r"misses .*_foot at \d"):
        urdf_robot(sample(plan, plan.scene, talos, 10.0), talos)
    with pytest.warns(UserWarning, match="stick robot instead"):
        page = show(plan)
    assert b"robot/left_foot_upper" in gzip.decompress(page.payload)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda robot: setattr(robot, "urdf", "/nowhere/robot.urdf"), "urdf: must be a readable URDF"),
        (lambda robot: setattr(robot, "urdf", "example-robot-data:nobody"), "urdf: must be a readable URDF"),
        (
            lambda robot: setattr(robot, "posture", {"third_arm": 0.1}),
            "posture: must name joints of the URDF, got 'third_arm'",
        ),
    ],
)
def test_bad_urdf_robots_are_named(change, message):
    robot = by_hand.talos()
    change(robot)
    with pytest.raises(mp.InvalidRobot) as error:
        load_model(robot)
    assert message in str(error.value)


def test_a_low_walk_over_tilted_patches_is_followed_with_its_soles_on_them():
    """The CoM is so low that ankles stay at their limits: the other joints have to do the work."""
    plan = mp.walk("rubbles", cycles=3).plan
    robot = plan.robot
    samples = sample(plan, plan.scene, robot, 10.0)
    loaded = load_model(robot)
    model, postures = loaded.model, follow(loaded, samples)
    ankles = [model.idx_qs[model.getJointId(f"leg_{side}_5_joint")] for side in ("left", "right")]
    assert postures.configurations[:, ankles].min() < model.lowerPositionLimit[ankles[0]] + 1e-3  # it is such a walk
    assert postures.residual < 0.05, postures.where
    data = model.createData()
    for n, q in enumerate(postures.configurations):
        assert (q[7:] >= model.lowerPositionLimit[7:] - 1e-9).all() and (
            q[7:] <= model.upperPositionLimit[7:] + 1e-9
        ).all()
        pin.framesForwardKinematics(model, data, q)
        for end, foot in enumerate(robot.end_effectors):
            if samples.surfaces[n, end] < 0:
                continue
            frame = data.oMf[model.getFrameId(foot.frame)]
            normal = mp._core.Polygon(plan.scene.surfaces[samples.surfaces[n, end]].vertices_W).normal_W
            assert np.linalg.norm(frame.translation - samples.positions_W[n, end]) < 5e-3
            assert frame.rotation[:, 2] @ normal > np.cos(0.03)
