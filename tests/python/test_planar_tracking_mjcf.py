"""Planar robots in MuJoCo against mcplan's own planar kinematics and dynamics, on random trees and along rays."""

from __future__ import annotations

import numpy as np
import pytest

from mcplan import _core, load_planar_task
from test_planar_dynamics import random_configuration, random_robot

mujoco = pytest.importorskip("mujoco")
from mcplan.planar.tracking.mjcf import POINT_RADIUS_M, PlanarModel, build, set_state  # noqa: E402
from mcplan.planar.tracking.settings import Feedback  # noqa: E402
from mcplan.tracking import Options  # noqa: E402

PASSIVE = Feedback(stiffness=0.0, damping_s=0.0)


def random_case(seed: int) -> tuple[_core.PlanarRobot, _core.PlanarConfiguration, np.random.Generator]:
    rng = np.random.default_rng(seed)
    robot = random_robot(rng, int(rng.integers(1, 12)))
    return robot, random_configuration(rng, robot.joint_count()), rng


def state_of(model: PlanarModel, configuration: _core.PlanarConfiguration) -> mujoco.MjData:
    data = mujoco.MjData(model.mj)
    set_state(model, data, configuration)
    mujoco.mj_forward(model.mj, data)
    return data


@pytest.mark.parametrize("seed", range(20))
def test_inverse_dynamics_of_mujoco_are_planar_inverse_dynamics(seed):
    robot, x, _ = random_case(seed)
    model = build(_core.PlanarTask(robot=robot))
    model.mj.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(model.mj)
    set_state(model, data, x)
    mujoco.mj_inverse(model.mj, data)
    ours = _core.planar_inverse_dynamics(robot, x)
    size = 1.0 + np.abs(ours.base_residual).max()  # up to 1e4 N m at these speeds
    np.testing.assert_allclose(
        data.qfrc_inverse[model.dofs], np.r_[ours.base_residual, ours.torque], atol=1e-12 * size, rtol=1e-9
    )


@pytest.mark.parametrize("seed", range(10))
def test_bodies_are_where_planar_kinematics_puts_them(seed):
    robot, x, _ = random_case(seed)
    model = build(_core.PlanarTask(robot=robot))
    data = state_of(model, x)
    for number, frame in enumerate(_core.planar_kinematics(robot, x)):
        body = mujoco.mj_name2id(model.mj, mujoco.mjtObj.mjOBJ_BODY, f"{number} {robot.bodies[number].name}")
        np.testing.assert_allclose(data.xpos[body], [frame.position_W[0], 0.0, frame.position_W[1]], atol=1e-11)
        along = data.xmat[body].reshape(3, 3)[:, 0]
        np.testing.assert_allclose(along, [np.cos(frame.angle), 0.0, np.sin(frame.angle)], atol=1e-11)


@pytest.mark.parametrize("seed", range(5))
def test_the_lowest_point_of_a_sphere_is_the_point_where_forces_act(seed):
    robot, x, rng = random_case(seed)
    end = _core.PlanarEndEffector(
        name="foot", body=0, position_B=rng.normal(size=2), angle_B=rng.normal(), points=[-0.3, 0.2]
    )
    robot.end_effectors = [end]
    model = build(_core.PlanarTask(robot=robot))
    data = state_of(model, x)
    sole = _core.planar_point(_core.planar_kinematics(robot, x)[0], end.position_B, end.angle_B)
    along, into = np.array([[np.cos(sole.angle), np.sin(sole.angle)], [-np.sin(sole.angle), np.cos(sole.angle)]])
    for point, geom in zip(end.points, model.point_geoms[0], strict=True):
        lowest = data.geom_xpos[geom][[0, 2]] - POINT_RADIUS_M * into
        np.testing.assert_allclose(lowest, sole.position_W + point * along, atol=1e-11)


@pytest.mark.parametrize("seed", range(5))
def test_motors_push_their_own_joints_up_to_their_limits(seed):
    robot, x, rng = random_case(seed)
    limits = rng.uniform(1.0, 5.0, size=len(robot.bodies))
    bodies = list(robot.bodies)
    for body, limit in zip(bodies, limits, strict=True):
        body.torque_max = limit
    robot.bodies = bodies
    model = build(_core.PlanarTask(robot=robot), feedback=PASSIVE)
    data = mujoco.MjData(model.mj)
    set_state(model, data, x)
    asked = rng.uniform(-8.0, 8.0, size=robot.joint_count())
    data.ctrl[:] = asked
    mujoco.mj_forward(model.mj, data)
    wanted = np.r_[0.0, 0.0, 0.0, np.clip(asked, -limits[1:], limits[1:])]
    np.testing.assert_allclose(data.qfrc_actuator[model.dofs], wanted, atol=1e-12)


@pytest.mark.parametrize("name", ["stairs", "climbing", "chimney"])
@pytest.mark.parametrize("shift_m", [0.0, 0.03])
def test_a_ray_against_a_surface_ends_on_it(name, shift_m):
    task = load_planar_task(name)
    model = build(task, Options(ground_shift_m=shift_m))
    data = mujoco.MjData(model.mj)
    mujoco.mj_kinematics(model.mj, data)
    for i, surface in enumerate(task.surfaces):
        ends = np.clip([surface.from_, surface.to], -1.0, 1.0)
        for along in np.linspace(*ends, 7)[1:-1]:
            place = surface.origin_W + along * surface.tangent_W + [0.0, shift_m]
            start = place + 0.01 * surface.normal_W
            hit = np.array([-1], dtype=np.int32)
            distance = mujoco.mj_ray(
                model.mj,
                data,
                np.array([start[0], 0.0, start[1]]),
                np.array([-surface.normal_W[0], 0.0, -surface.normal_W[1]]),
                None,
                1,
                -1,
                hit,
            )
            assert distance == pytest.approx(0.01, abs=1e-9), (surface.name, along)
            assert hit[0] in model.surface_geoms
            assert model.mj.geom_friction[model.surface_geoms[i], 0] == surface.friction


def test_scales_reach_masses_and_friction():
    task = load_planar_task("cartwheel")
    model = build(task, Options(mass_scale=1.1, friction_scale=0.5))
    assert model.mj.body_subtreemass[0] == pytest.approx(1.1 * task.robot.mass(), rel=1e-12)
    assert model.mj.geom_friction[model.surface_geoms[0], 0] == pytest.approx(0.5 * task.surfaces[0].friction)
