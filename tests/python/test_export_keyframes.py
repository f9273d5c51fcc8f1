"""mcplan.export.keyframes: MuJoCo loads them with the model, and they put it where the plan is."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from exports import plan, run, simulation

mujoco = pytest.importorskip("mujoco")


def loaded(path, folder):
    """MuJoCo's model of the G1 with the keyframes included."""
    robot = """<mujoco><compiler autolimits="true"/><include file="keys.xml"/><worldbody>{body}</worldbody></mujoco>"""
    model = simulation()

    def nested(body: int) -> str:
        inner = "".join(nested(child) for child in range(body + 1, model.nbody) if model.body_parentid[child] == body)
        joint = model.body_jntadr[body]
        position, quat = (" ".join(map(repr, map(float, v))) for v in (model.body_pos[body], model.body_quat[body]))
        kind = "<freejoint/>"
        if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
            axis = " ".join(map(repr, map(float, model.jnt_axis[joint])))
            kind = f'<joint name="{model.joint(joint).name}" axis="{axis}"/>'
        name = model.body(body).name
        return f'<body name="{name}" pos="{position}" quat="{quat}">{kind}<geom size="0.01"/>{inner}</body>'

    (folder / "model.xml").write_text(robot.format(body=nested(1)))
    assert path.name == "keys.xml"
    return mujoco.MjModel.from_xml_path(str(folder / "model.xml"))


def test_keyframes_load_with_the_model_and_are_the_motion(tmp_path):
    model = loaded(mp.export(run(), "mujoco", tmp_path / "keys.xml", rate_hz=10), tmp_path)
    recording, data = run(), mujoco.MjData(model)
    assert model.nkey == len(recording.times_s[::10])
    for key in range(model.nkey):
        mujoco.mj_resetDataKeyframe(model, data, key)
        mujoco.mj_forward(model, data)
        assert data.time == pytest.approx(recording.times_s[10 * key])
        np.testing.assert_array_equal(data.qpos[:3], recording.configurations[10 * key, :3])
        for column, name in enumerate(recording.joints):
            joint = model.joint(name)
            assert data.qpos[joint.qposadr[0]] == recording.configurations[10 * key, 7 + column]
            assert data.qvel[joint.dofadr[0]] == recording.velocities[10 * key, 6 + column]


def test_without_a_rate_there_is_a_keyframe_at_each_knot_with_the_feet_on_the_ground(tmp_path):
    model = loaded(mp.export(plan(), "mujoco", tmp_path / "keys.xml"), tmp_path)
    assert model.nkey == len(plan().knot_times())
    data, foot = mujoco.MjData(model), plan().robot.end_effectors[0]
    for key in (0, model.nkey - 1):
        mujoco.mj_resetDataKeyframe(model, data, key)
        mujoco.mj_forward(model, data)
        ankle = model.body(foot.frame).id
        height = data.xpos[ankle, 2] + foot.frame_offset[2]
        assert height == pytest.approx(0.0, abs=1e-4)


def test_velocities_at_knots_are_those_of_the_plan(tmp_path):
    """The CoM that MuJoCo moves by qvel is as fast as planned, at instants that are half a second apart."""
    model = loaded(mp.export(plan(), "mujoco", tmp_path / "keys.xml"), tmp_path)
    data, body = mujoco.MjData(simulation()), 1
    for key, time_s in enumerate(plan().knot_times()):
        data.qpos[:], data.qvel[:] = model.key_qpos[key], model.key_qvel[key]
        mujoco.mj_forward(simulation(), data)
        mujoco.mj_subtreeVel(simulation(), data)
        planned = plan().at(float(time_s)).com_velocity_W
        assert np.linalg.norm(data.subtree_linvel[body] - planned) < 0.05


def test_velocities_are_those_of_mujoco(tmp_path):
    """Going on by qvel for a moment leads to the next instant of the recording."""
    model = loaded(mp.export(run(), "mujoco", tmp_path / "keys.xml", rate_hz=100), tmp_path)
    steps = []
    for key in range(0, model.nkey - 1, 9):
        qpos = model.key_qpos[key].copy()
        mujoco.mj_integratePos(model, qpos, model.key_qvel[key], 0.01)
        steps.append(np.abs(qpos - model.key_qpos[key + 1]).max())
    assert max(steps) < 1e-4
