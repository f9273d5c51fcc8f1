"""mcplan.export.mjlab: joints and bodies in the order of who reads them, poses and velocities as MuJoCo has them."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from exports import G1_JOINTS, mujoco_states, plan, qpos_of, run, simulation
from mcplan.export.orders import order_of
from mcplan.kinematics.urdf_model import load_model

#: Beginning of the G1's joints as Isaac Lab lists them.
ISAAC = """left_hip_pitch right_hip_pitch waist_yaw left_hip_roll right_hip_roll waist_roll left_hip_yaw right_hip_yaw
waist_pitch left_knee right_knee left_shoulder_pitch right_shoulder_pitch left_ankle_pitch right_ankle_pitch
left_shoulder_roll right_shoulder_roll left_ankle_roll right_ankle_roll left_shoulder_yaw right_shoulder_yaw left_elbow
right_elbow left_wrist_roll right_wrist_roll left_wrist_pitch right_wrist_pitch left_wrist_yaw right_wrist_yaw""".split()


def exported(what, to, folder, **options) -> dict[str, np.ndarray]:
    return dict(np.load(mp.export(what, to, folder / "motion.npz", **options)))


@pytest.mark.parametrize("what", [plan, run], ids=["plan", "run"])
@pytest.mark.parametrize("to", ["mjlab", "isaaclab"])
def test_poses_and_velocities_of_bodies_are_those_of_mujoco(what, to, tmp_path):
    data, model, isaac = exported(what(), to, tmp_path), simulation(), to == "isaaclab"
    assert {model.body(body).name for body in range(1, model.nbody)} == set(data["body_names"])
    for n in range(0, len(data["joint_pos"]), 7):
        base, quat = data["body_pos_w"][n, 0], data["body_quat_w"][n, 0]
        qpos = qpos_of(model, base, quat, dict(zip(data["joint_names"], data["joint_pos"][n], strict=True)))
        qvel = np.zeros(model.nv)
        to_base = _matrix(*quat).T
        angular = to_base @ data["body_ang_vel_w"][n, 0]
        qvel[:3], qvel[3:6] = data["body_lin_vel_w"][n, 0], angular
        if isaac:  # MuJoCo's is that of the frame
            qvel[:3] -= to_base.T @ np.cross(angular, model.body_ipos[1])
        for name, speed in zip(data["joint_names"], data["joint_vel"][n], strict=True):
            qvel[model.joint(name).dofadr[0]] = speed
        states = mujoco_states(model, qpos, qvel, isaac)
        for b, body in enumerate(data["body_names"]):
            position, orientation, linear, angular = states[body]
            np.testing.assert_allclose(data["body_pos_w"][n, b], position, atol=1e-5)
            assert abs(data["body_quat_w"][n, b] @ orientation) == pytest.approx(1.0, abs=1e-9)
            np.testing.assert_allclose(data["body_lin_vel_w"][n, b], linear, atol=1e-5)
            np.testing.assert_allclose(data["body_ang_vel_w"][n, b], angular, atol=1e-5)


def _matrix(w, x, y, z):
    import pinocchio as pin

    return pin.Quaternion(w, x, y, z).matrix()


@pytest.mark.parametrize("robot", ["g1", "talos", "anymal", "go2"])
def test_depth_first_is_the_order_of_mujoco(robot):
    model = simulation(robot)
    order = order_of(load_model(mp.load_robot(robot)), breadth_first=False)
    assert order.joints == [model.joint(joint).name for joint in range(1, model.njnt)]
    assert order.bodies == [model.body(body).name for body in range(1, model.nbody)]


def test_orders_of_the_g1_are_those_of_unitree_and_isaac_lab():
    model = load_model(mp.load_robot("g1"))
    assert order_of(model, breadth_first=False).joints == G1_JOINTS
    assert order_of(model, breadth_first=True).joints == [f"{name}_joint" for name in ISAAC]


def test_both_orders_are_the_same_motion(tmp_path):
    one, other = exported(run(), "mjlab", tmp_path), exported(run(), "isaaclab", tmp_path)
    joints = [list(one["joint_names"]).index(name) for name in other["joint_names"]]
    bodies = [list(one["body_names"]).index(name) for name in other["body_names"]]
    assert joints != sorted(joints)
    for key in ("joint_pos", "joint_vel"):
        np.testing.assert_array_equal(one[key][:, joints], other[key])
    for key in ("body_pos_w", "body_quat_w", "body_ang_vel_w"):
        np.testing.assert_array_equal(one[key][:, bodies], other[key])
    assert np.abs(one["body_lin_vel_w"][:, bodies] - other["body_lin_vel_w"]).max() > 0.01  # frames and CoMs


def test_joints_of_a_run_are_those_recorded(tmp_path):
    data, recording = exported(run(), "mjlab", tmp_path), run()
    columns = [recording.joints.index(name) for name in data["joint_names"]]
    np.testing.assert_array_equal(data["joint_pos"], recording.configurations[::2, 7:][:, columns])
    np.testing.assert_array_equal(data["joint_vel"], recording.velocities[::2, 6:][:, columns])
    np.testing.assert_array_equal(data["body_pos_w"][:, 0], recording.configurations[::2, :3])
    assert data["fps"].tolist() == [50] and data["body_quat_w"].shape[2] == 4


@pytest.mark.slow
def test_velocities_of_a_plan_are_the_derivatives_of_its_positions(tmp_path):
    data = exported(plan(), "mjlab", tmp_path, rate_hz=200)
    for positions, velocities in (("joint_pos", "joint_vel"), ("body_pos_w", "body_lin_vel_w")):
        differences = (data[positions][2:] - data[positions][:-2]) * 100.0
        np.testing.assert_allclose(data[velocities][1:-1], differences, atol=0.02)


def test_a_rate_that_is_no_whole_number_is_refused(tmp_path):
    with pytest.raises(mp.InvalidInput, match=r"rate_hz: must be a whole number in this format, got 12\.5"):
        exported(plan(), "mjlab", tmp_path, rate_hz=12.5)
    assert not list(tmp_path.iterdir())
