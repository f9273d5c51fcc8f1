"""Stances on two point feet: the rotation about the line between them by exact dynamics, and a quadruped's certificate."""

from __future__ import annotations

import copy
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("scipy.optimize")
pin = pytest.importorskip("pinocchio")

import mcplan as mp  # noqa: E402
from mcplan.wb import Motion, MotionStatus, MotionTolerances  # noqa: E402
from mcplan.wb.certificate.robot import certified_robot  # noqa: E402
from mcplan.wb.certificate.stances import _rotated, stances  # noqa: E402


@pytest.fixture(scope="module")
def walk() -> Motion:
    """Go2 walks half a metre; three times it stands on two feet for a quarter of a second."""
    scene = mp.load_scene("flat")
    goal = scene.goal
    goal.position_W = [0.5, 0.0, 0.0]
    scene.goal = goal
    result = mp.motion(mp.plan(scene, "go2", time_limit=20.0).plan)
    assert result.status is MotionStatus.SOLVED, result.report
    return result.motion


def violated(motion: Motion) -> set[str]:
    return {violation.name for violation in motion.check().violations()}


def test_a_walk_on_point_feet_is_certified(walk: Motion) -> None:
    result = walk.check()
    result.raise_if_violated()
    found = stances(walk, certified_robot(walk))
    assert found
    for stance in found:
        assert stance.points.any(axis=1).sum() == 2
    assert 1e-4 < result.measures["line_residual_Nm"] < 0.1
    assert 0.0 < result.of("landing_angle").value < 0.01


def test_wrenches_joints_and_footholds_that_are_off_are_seen(walk: Motion) -> None:
    assert "residual_force" in violated(replace(walk, corner_forces_S=1.01 * walk.corner_forces_S))
    coefficients = walk.coefficients.copy()
    coefficients[:, 6 + walk.joints.index("FL_calf_joint")] += 1e-3
    assert "drift" in violated(replace(walk, coefficients=coefficients))
    plan = copy.deepcopy(walk.plan)
    knots = list(plan.knots)
    for knot in knots:
        ends_W = knot.end_effectors_W.copy()
        ends_W[0, 0] += 2e-3
        knot.end_effectors_W = ends_W
    plan.knots = knots
    assert "drift" in violated(replace(walk, plan=plan))


def test_a_base_that_leans_on_two_feet_is_seen(walk: Motion) -> None:
    """The CoM 5 mm beside the line of two feet for a quarter of a second: what that missing moment does is too much."""
    stance = stances(walk, certified_robot(walk))[0]
    start, end = walk.times_s[[stance.first, stance.last]]
    coefficients, across = walk.coefficients.copy(), np.zeros(3)
    centres = np.concatenate([walk.times_s[:1], walk.times_s, walk.times_s[-1:]])
    ratio = np.clip((centres - start) / (end - start), 0.0, 1.0)
    point, along = stance.line(states_at(walk, start).corners_W)
    across = np.cross(along[0], [0.0, 0.0, 1.0])
    coefficients[:, :3] += 5e-3 * (64.0 * (ratio * (1.0 - ratio)) ** 3)[:, None] * across
    assert {"landing_speed", "landing_angle"} & violated(replace(walk, coefficients=coefficients))


def states_at(motion: Motion, time: float):
    from mcplan.wb.certificate.states import states_of

    return states_of(motion, certified_robot(motion), np.array([time]))


def rotated(motion: Motion, stance, gravity: float):
    """The certificate's angle and rate, then the base turned about the line by them: configuration and velocity."""
    robot = certified_robot(motion)
    angle, rate, (point, along), states = _rotated(motion, robot, stance)
    matrix = pin.exp3(angle * along)
    base = pin.SE3(pin.Quaternion(states.q[-1, 3:7]), states.q[-1, :3])
    turned = pin.SE3(matrix, point - matrix @ point) * base
    q, v = states.q[-1].copy(), states.v[-1].copy()
    q[:3], q[3:7] = turned.translation, pin.Quaternion(turned.rotation).coeffs()
    v[:3] += turned.rotation.T @ (rate * np.cross(along, turned.translation - point))
    v[3:6] += turned.rotation.T @ (rate * along)
    return robot, states, point, along, q, v


def with_gravity(motion: Motion, gravity: float) -> Motion:
    plan = copy.deepcopy(motion.plan)
    scene = plan.scene
    scene.gravity = gravity
    plan.scene = scene
    return replace(motion, plan=plan)


def test_without_gravity_the_momentum_about_the_line_stays(walk: Motion) -> None:
    """Of the integrated rotation, with legs that swing: by Pinocchio's centroidal momentum at both ends."""
    motion = with_gravity(walk, 1e-9)
    for stance in stances(motion, certified_robot(motion)):
        robot, states, point, along, q, v = rotated(motion, stance, 0.0)
        assert np.linalg.norm(q[:3] - states.q[-1, :3]) > 1e-5
        model, data, momenta = robot.model, robot.model.createData(), []
        for configuration, velocity in ((states.q[0], states.v[0]), (q, v)):
            momentum = pin.computeCentroidalMomentum(model, data, configuration, velocity)
            momenta.append(along @ (momentum.angular + np.cross(data.com[0] - point, momentum.linear)))
        assert momenta[1] == pytest.approx(momenta[0], abs=1e-6)


def test_a_robot_that_falls_over_its_line_keeps_its_energy(walk: Motion) -> None:
    """A posture that is held, its CoM beside the line: a pendulum upside down."""
    stance = stances(walk, certified_robot(walk))[0]
    coefficients = np.repeat(walk.coefficients[:1], len(walk.coefficients), axis=0)
    coefficients[:, 1] += 0.02
    motion = replace(walk, coefficients=coefficients)
    robot, states, point, along, q, v = rotated(motion, stance, 9.8)
    model, data = robot.model, robot.model.createData()
    model.gravity.linear = np.array([0.0, 0.0, -motion.plan.scene.gravity])
    energies = []
    for configuration, velocity in ((states.q[0], states.v[0]), (q, v)):
        kinetic = pin.computeKineticEnergy(model, data, configuration, velocity)
        energies.append((kinetic, pin.computePotentialEnergy(model, data, configuration)))
    assert energies[1][0] > 0.05
    assert sum(energies[1]) == pytest.approx(sum(energies[0]), abs=1e-6)
    assert {"landing", "landing_angle", "landing_speed"} <= {
        violation.name for violation in motion.check(MotionTolerances(com_rms_m=1.0)).violations()
    }
