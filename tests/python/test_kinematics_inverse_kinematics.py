"""Postures follow the plan: contacts are met, feet lie flat, knees bend forward."""

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
import wrenches
from mcplan.kinematics.inverse_kinematics import follow, has_sole
from mcplan.kinematics.samples import sample, sample_at
from mcplan.kinematics.urdf_model import load_model

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
    urdf_model = load_model(talos)
    return samples, urdf_model.model, follow(urdf_model, samples)


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


def test_a_low_walk_over_tilted_patches_is_followed_with_its_soles_on_them():
    """The CoM is so low that ankles stay at their limits: the other joints have to do the work."""
    plan = mp.walk("rubbles", cycles=3).plan
    robot = plan.robot
    samples = sample(plan, plan.scene, robot, 10.0)
    urdf_model = load_model(robot)
    model, postures = urdf_model.model, follow(urdf_model, samples)
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


def test_misses_and_tilts_are_those_of_the_frames(walking, talos):
    samples, model, postures = walking
    data = model.createData()
    n = samples.count // 2
    pin.framesForwardKinematics(model, data, postures.configurations[n])
    com = pin.centerOfMass(model, data, postures.configurations[n])
    assert postures.com_misses[n] == pytest.approx(np.linalg.norm(com - samples.com_W[n]), abs=1e-12)
    for end, body in enumerate(talos.end_effectors):
        frame = data.oMf[model.getFrameId(f"mcplan/{body.name}")]
        away = np.linalg.norm(frame.translation - samples.positions_W[n, end])
        assert postures.end_misses[n, end] == pytest.approx(away, abs=1e-9)
        angle = np.arccos(np.clip((np.trace(frame.rotation.T @ samples.rotations_W[n, end]) - 1) / 2, -1, 1))
        assert postures.tilts[n, end] == pytest.approx(angle if has_sole(body) else 0.0, abs=1e-6)


def test_out_of_reach_more_iterations_change_little(talos):
    """Beside a stretched knee plain Gauss-Newton swings to and fro: misses would depend on where it is stopped."""
    plan = by_hand.walk(by_hand.stairs(), talos)  # treads half a metre apart
    urdf_model = load_model(talos)
    samples = sample(plan, plan.scene, talos, 40.0)
    once = follow(urdf_model, samples)
    again = follow(urdf_model, samples, once.configurations)
    assert 0.01 < once.residual < 0.05, once.where
    assert again.residual == pytest.approx(once.residual, abs=0.01)
    feet = once.end_misses[:, :2]
    assert feet.max() < 0.03


def test_postures_turn_with_the_base_and_the_soles_of_a_plan():
    """A turn of 180 degrees: nothing is missed, wherever the robot heads, and legs are twisted by half a step at most."""
    robot = mp.load_robot("talos")
    plan = wrenches.turning(robot, angle=np.pi, pairs=3)
    urdf_model = load_model(robot)
    found = follow(urdf_model, sample(plan, plan.scene, robot, 10.0))
    assert found.residual < 2e-3, found.where
    assert np.degrees(found.tilts.max()) < 1.0
    last = found.configurations[-1]
    assert np.degrees(2.0 * np.arctan2(np.linalg.norm(last[3:6]), abs(last[6]))) == pytest.approx(180.0, abs=1.5)
    backwards = sample_at(plan, plan.scene, robot, np.array([plan.duration()]))  # alone: from the robot's own posture
    assert follow(urdf_model, backwards).residual < 2e-3
