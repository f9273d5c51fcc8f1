"""Conversions between Pinocchio's and MuJoCo's states: against what the two integrators do with them."""

import numpy as np
import pytest

import mcplan as mp
import simulated

mujoco = pytest.importorskip("mujoco")
pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking import states  # noqa: E402
from mcplan.tracking.mujoco_model import build  # noqa: E402


@pytest.fixture(scope="module")
def model():
    return build(mp.load_robot("talos"), simulated.level())


@pytest.fixture(params=range(4))
def state(model, request):
    return simulated.random_state(model, np.random.default_rng(request.param))


def test_there_and_back_is_where_it_was(model, state):
    configuration, velocity, acceleration = state
    back = states.to_pinocchio(model, *states.to_mujoco(model, configuration, velocity))
    np.testing.assert_allclose(back[0], configuration, atol=1e-14)
    np.testing.assert_allclose(back[1], velocity, atol=1e-14)
    qacc = states.acceleration_to_mujoco(model, configuration, velocity, acceleration)
    back = states.acceleration_to_pinocchio(model, configuration, velocity, qacc)
    np.testing.assert_allclose(back, acceleration, atol=1e-13)


def test_both_have_every_body_at_the_same_place(model, state):
    configuration, velocity, _ = state
    pin_model, pin_data, data = model.urdf_model.model, model.urdf_model.model.createData(), mujoco.MjData(model.mj)
    data.qpos[:], data.qvel[:] = states.to_mujoco(model, configuration, velocity)
    mujoco.mj_fwdPosition(model.mj, data)
    mujoco.mj_fwdVelocity(model.mj, data)
    pin.forwardKinematics(pin_model, pin_data, configuration, velocity)
    flow = np.zeros(6)
    for name in model.joints:
        joint, body = pin_model.getJointId(name), model.mj.jnt_bodyid[model.mj.joint(name).id]
        np.testing.assert_allclose(data.xpos[body], pin_data.oMi[joint].translation, atol=1e-12)
        np.testing.assert_allclose(data.xmat[body].reshape(3, 3), pin_data.oMi[joint].rotation, atol=1e-12)
        mujoco.mj_objectVelocity(model.mj, data, mujoco.mjtObj.mjOBJ_XBODY, body, flow, 0)
        expected = pin.getVelocity(pin_model, pin_data, joint, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        np.testing.assert_allclose(flow, [*expected.angular, *expected.linear], atol=1e-11)


def test_velocities_are_the_derivatives_of_configurations(model, state):
    """MuJoCo's own integration of qvel for a moment leads where Pinocchio's integration of its velocity leads."""
    configuration, velocity, _ = state
    step = 1e-6
    qpos, qvel = states.to_mujoco(model, configuration, velocity)
    mujoco.mj_integratePos(model.mj, qpos, qvel, step)
    ahead, _ = states.to_pinocchio(model, qpos, qvel)
    expected = pin.integrate(model.urdf_model.model, configuration, step * velocity)
    np.testing.assert_allclose(ahead, expected, atol=1e-11)


def test_accelerations_are_the_derivatives_of_velocities(model, state):
    configuration, velocity, acceleration = state
    qacc = states.acceleration_to_mujoco(model, configuration, velocity, acceleration)
    step = 1e-6

    def qvel_at(time):
        moved = pin.integrate(model.urdf_model.model, configuration, time * velocity)
        return states.to_mujoco(model, moved, velocity + time * acceleration)[1]

    slope = (qvel_at(step) - qvel_at(-step)) / (2 * step)
    np.testing.assert_allclose(qacc, slope, atol=1e-7)


def test_power_is_the_same_in_both(model, state):
    configuration, velocity, force = state
    _, qvel = states.to_mujoco(model, configuration, velocity)
    assert states.force_to_mujoco(model, configuration, force) @ qvel == pytest.approx(force @ velocity)
