"""A recording holds the steps that were taken, as they were."""

import numpy as np
import pytest

import tracked

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking.recorder import Acting, Recorder  # noqa: E402
from mcplan.tracking.robot_dynamics import RobotDynamics  # noqa: E402


@pytest.fixture(scope="module")
def filled():
    """A recording of five steps, and what was put in."""
    (plan, desired), urdf_model = tracked.still(), tracked.urdf_model("talos")
    joints = tuple(urdf_model.model.names[2:])
    recorder, dynamics, rng = (
        Recorder(plan, urdf_model, joints, desired),
        RobotDynamics(urdf_model),
        np.random.default_rng(1),
    )
    ends, given = len(urdf_model.frames), []
    for _ in range(5):
        state = tracked.random_state(urdf_model.model, urdf_model.neutral, rng)
        dynamics.update(*state)
        more = rng.normal(size=len(joints)), rng.normal(size=(ends, 3)), rng.uniform(size=ends) < 0.5
        wrench, push = rng.normal(size=6), rng.normal(size=3)
        recorder.add(dynamics, Acting(*more, wrench, push))
        given.append((*(part.copy() for part in (*state, *more, wrench, push)), dynamics.com_W.copy()))
        for part in (*more, wrench, push):
            part[...] = 0  # what is recorded is a copy
    return plan, desired, urdf_model, recorder.finish(1.25), given


def test_what_was_added_is_there(filled):
    _, _, urdf_model, run, given = filled
    names = ("configurations", "velocities", "torques", "forces_W", "contacts", "assist", "pushes_W", "com_W")
    for name, column in zip(names, zip(*given, strict=True), strict=True):
        np.testing.assert_array_equal(getattr(run, name), np.array(column), err_msg=name)
    data = urdf_model.model.createData()
    for n, (configuration, velocity, *_) in enumerate(given):
        pin.framesForwardKinematics(urdf_model.model, data, configuration)
        places = [data.oMf[frame].translation for frame in urdf_model.frames]
        np.testing.assert_allclose(run.end_effectors_W[n], places, atol=1e-12)
        spin = pin.computeCentroidalMomentum(urdf_model.model, data, configuration, velocity).angular
        np.testing.assert_allclose(run.angular_momentum_W[n], spin, atol=1e-9)


def test_only_the_steps_taken_are_kept(filled):
    plan, desired, urdf_model, run, _ = filled
    for name in run.__dataclass_fields__:
        value = getattr(run, name)
        if isinstance(value, np.ndarray) and not name.endswith("_limits"):
            assert len(value) == 5, name
    np.testing.assert_allclose(run.times_s, desired.dt_s * np.arange(5))
    assert run.fell_at_s == 1.25 and run.plan is plan and run.simulated_robot is urdf_model.robot
    np.testing.assert_array_equal(run.torque_limits, urdf_model.model.effortLimit[6:])
    np.testing.assert_array_equal(run.velocity_limits, urdf_model.model.velocityLimit[6:])


def test_the_plan_stands_beside_it(filled):
    _, desired, _, run, _ = filled
    np.testing.assert_array_equal(run.com_plan_W, desired.com_W[:5])
    np.testing.assert_array_equal(run.end_effectors_plan_W, desired.end_effectors_W[:5])
    np.testing.assert_array_equal(run.forces_plan_W, desired.forces_W[:5])
    np.testing.assert_array_equal(run.contacts_plan, desired.surfaces[:5])
    for quat, rotation in zip(run.base_quat_xyzw_plan, desired.base_WB, strict=False):
        np.testing.assert_allclose(pin.Quaternion(quat).matrix(), rotation, atol=1e-12)
