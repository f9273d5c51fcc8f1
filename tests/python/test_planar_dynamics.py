"""Planar kinematics and dynamics against Pinocchio, which knows nothing of planes, on random robots and motions."""

from __future__ import annotations

import numpy as np
import pytest

from mcplan import _core
from mcplan.errors import InvalidInput
from reference_solutions import reference_names, reference_plan

pin = pytest.importorskip("pinocchio")


def random_robot(rng: np.random.Generator, bodies: int) -> _core.PlanarRobot:
    return _core.PlanarRobot(
        name="random",
        gravity=rng.uniform(1.0, 20.0),
        bodies=[
            _core.PlanarBody(
                name=str(b),
                parent=-1 if b == 0 else int(rng.integers(0, b)),
                joint_P=np.zeros(2) if b == 0 else rng.normal(size=2),
                offset=0.0 if b == 0 else rng.normal(),
                mass=rng.uniform(0.1, 10.0),
                com_B=rng.normal(size=2),
                inertia=rng.uniform(0.01, 1.0),
            )
            for b in range(bodies)
        ],
        end_effectors=[_core.PlanarEndEffector(name="tip", body=bodies - 1, points=[0.0])],
    )


def pinocchio_model(robot: _core.PlanarRobot) -> tuple:
    """The model, and its joint for each body."""
    model = pin.Model()
    model.gravity.linear[:] = [0.0, -robot.gravity, 0.0]
    joints: list[int] = []
    for body in robot.bodies:
        if body.parent < 0:
            joint = model.addJoint(0, pin.JointModelPlanar(), pin.SE3.Identity(), body.name)
        else:
            place = pin.SE3(pin.rpy.rpyToMatrix(0.0, 0.0, body.offset), np.array([*body.joint_P, 0.0]))
            joint = model.addJoint(joints[body.parent], pin.JointModelRZ(), place, body.name)
        inertia = pin.Inertia(body.mass, np.array([*body.com_B, 0.0]), np.diag([0.0, 0.0, body.inertia]))
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
        joints.append(joint)
    return model, joints


def pinocchio_state(model, joints, x: _core.PlanarConfiguration) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Its planar joint has velocity and acceleration in the turned frame."""
    q, v, a = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    angle, rate = x.base[2], x.base_velocity[2]
    back = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    q[:4] = [x.base[0], x.base[1], np.cos(angle), np.sin(angle)]
    v[:3] = [*back @ x.base_velocity[:2], rate]
    a[:3] = [*back @ x.base_acceleration[:2] - rate * np.array([-v[1], v[0]]), x.base_acceleration[2]]
    for b, joint in enumerate(joints[1:]):
        q[model.idx_qs[joint]] = x.q[b]
        v[model.idx_vs[joint]] = x.velocity[b]
        a[model.idx_vs[joint]] = x.acceleration[b]
    return q, v, a


def pinocchio_dynamics(robot, x, forces) -> tuple[np.ndarray, np.ndarray]:
    """Torques, and what is left over at the base: force in the world, moment about the base's origin."""
    model, joints = pinocchio_model(robot)
    data = model.createData()
    q, v, a = pinocchio_state(model, joints, x)
    pin.forwardKinematics(model, data, q)
    outside = [pin.Force.Zero() for _ in range(model.njoints)]
    for body, point_W, force_W in forces:
        force = np.array([*force_W, 0.0])
        wrench_W = pin.Force(force, np.cross([*point_W, 0.0], force))
        outside[joints[body]] += data.oMi[joints[body]].actInv(wrench_W)
    tau = pin.rnea(model, data, q, v, a, outside)
    angle = x.base[2]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    torque = np.array([tau[model.idx_vs[joint]] for joint in joints[1:]])
    return torque, np.array([*turn @ tau[:2], tau[2]])


def random_configuration(rng: np.random.Generator, joints: int) -> _core.PlanarConfiguration:
    base, base_velocity, base_acceleration = rng.normal(scale=3.0, size=(3, 3))
    q, velocity, acceleration = rng.normal(scale=3.0, size=(3, joints))
    return _core.PlanarConfiguration(
        base=base,
        base_velocity=base_velocity,
        base_acceleration=base_acceleration,
        q=q,
        velocity=velocity,
        acceleration=acceleration,
    )


@pytest.mark.parametrize("seed", range(20))
def test_frames_are_those_of_pinocchio(seed):
    rng = np.random.default_rng(seed)
    robot = random_robot(rng, int(rng.integers(1, 12)))
    x = random_configuration(rng, robot.joint_count())
    model, joints = pinocchio_model(robot)
    data = model.createData()
    pin.forwardKinematics(model, data, *pinocchio_state(model, joints, x))
    for frame, joint in zip(_core.planar_kinematics(robot, x), joints, strict=True):
        place = data.oMi[joint]
        velocity = pin.getVelocity(model, data, joint, pin.LOCAL_WORLD_ALIGNED)
        acceleration = pin.getClassicalAcceleration(model, data, joint, pin.LOCAL_WORLD_ALIGNED)
        size = 1.0 + np.abs(acceleration.linear).max()
        np.testing.assert_allclose(frame.position_W, place.translation[:2], atol=1e-11)
        np.testing.assert_allclose([np.cos(frame.angle), np.sin(frame.angle)], place.rotation[:2, 0], atol=1e-12)
        np.testing.assert_allclose(frame.velocity_W, velocity.linear[:2], atol=1e-11 * size)
        np.testing.assert_allclose(frame.rate, velocity.angular[2], atol=1e-12 * size)
        np.testing.assert_allclose(frame.acceleration_W, acceleration.linear[:2], atol=1e-11 * size)
        np.testing.assert_allclose(frame.angular_acceleration, acceleration.angular[2], atol=1e-12 * size)


@pytest.mark.parametrize("seed", range(20))
def test_torques_of_random_robots_are_those_of_pinocchio(seed):
    rng = np.random.default_rng(seed)
    robot = random_robot(rng, int(rng.integers(1, 12)))
    x = random_configuration(rng, robot.joint_count())
    forces = [
        (int(rng.integers(0, len(robot.bodies))), rng.normal(size=2), 100.0 * rng.normal(size=2)) for _ in range(4)
    ]
    ours = _core.planar_inverse_dynamics(
        robot, x, [_core.PlanarForce(body=b, point_W=point, force_W=force) for b, point, force in forces]
    )
    torque, residual = pinocchio_dynamics(robot, x, forces)
    size = 1.0 + np.abs(residual).max()  # up to 1e4 N m at these speeds
    np.testing.assert_allclose(ours.torque, torque, atol=1e-12 * size, rtol=1e-11)
    np.testing.assert_allclose(ours.base_residual, residual, atol=1e-12 * size, rtol=1e-11)


@pytest.mark.parametrize(("task", "name"), reference_names())
def test_torques_along_whole_body_plans_are_those_of_pinocchio(task, name):
    plan = reference_plan(task, name)
    robot = plan.task.robot
    for t in np.linspace(0.0, plan.duration(), 37):
        state = plan.at(t)
        forces = [(robot.end_effectors[f.end_effector].body, f.position_W, f.force_W) for f in state.forces]
        torque, residual = pinocchio_dynamics(robot, state.configuration, forces)
        np.testing.assert_allclose(state.torque, torque, atol=1e-8)
        np.testing.assert_allclose(state.base_residual, residual, atol=1e-8)


def test_what_does_not_fit_the_robot_is_named():
    rng = np.random.default_rng(0)
    robot = random_robot(rng, 4)
    x = random_configuration(rng, 3)
    x.velocity = np.zeros(2)
    with pytest.raises(InvalidInput, match=r"configuration.velocity: must have an entry for each joint \(3\)"):
        _core.planar_kinematics(robot, x)
    force = _core.PlanarForce(body=4, point_W=[0.0, 0.0], force_W=[0.0, 1.0])
    with pytest.raises(InvalidInput, match="forces: must name a body, got 4"):
        _core.planar_inverse_dynamics(robot, random_configuration(rng, 3), [force])
