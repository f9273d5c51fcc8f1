"""Contact wrenches of plans, against SciPy's integration and one broken property at a time."""

from __future__ import annotations

import copy

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import mcplan as mp
from turning import integrate, spin, turning_axes, turning_plan


@pytest.fixture
def plan() -> mp.Plan:
    return turning_plan()


def broken(plan: mp.Plan) -> set[str]:
    return {violation.name for violation in mp.check(plan).violations()}


def test_the_checker_accepts_feet_that_turn_the_base_and_tilt_it(plan):
    result = mp.check(plan)
    assert result.ok(), str(result)
    margins = {found.name: found for found in result.constraints}
    assert margins["dynamics"].value < 1e-9 and margins["at_consistency"].value < 1e-9
    assert margins["orientation"].tolerance == pytest.approx(np.deg2rad(1.0))
    # 3 N m for 0.4 s each way on 5 kg m^2 turn by 0.4^2 3 / 5; 4 mm of 44 kg g likewise.
    assert plan.knots[2].base_rpy[2] == pytest.approx(0.16 * 3.0 / 5.0, rel=1e-9)
    assert plan.knots[4].base_rpy[1] == pytest.approx(-0.16 * 0.004 * 44 * plan.scene.gravity / 5.0, rel=1e-2)


@pytest.mark.parametrize("phase", range(4))
@pytest.mark.parametrize("since", [0.0, 0.13, 0.4])
def test_a_plan_at_any_instant_is_what_scipy_integrates(plan, phase, since):
    plan.knots[phase].com_velocity_W = [0.3, -0.2, 0.1]  # not at rest, so that p(t) is curved
    plan.phases[phase].contacts[1].moment_W = [0.0, 0.0, 0.7]
    state = plan.at_phase(phase, since)
    com, velocity, momentum, turned = integrate(plan, phase, since)
    np.testing.assert_allclose(state.com_W, com, atol=1e-10)
    np.testing.assert_allclose(state.com_velocity_W, velocity, atol=1e-10)
    np.testing.assert_allclose(state.angular_momentum_W, momentum, atol=1e-10)
    stated = Rotation.from_quat(np.roll(state.base_quat_wxyz, -1))
    assert (stated.inv() * turned).magnitude() < 1e-4
    omega = turning_axes(state.base_rpy) @ state.base_rpy_rate
    np.testing.assert_allclose(omega, spin(plan.robot, stated, state.angular_momentum_W), atol=1e-12)


def move_pressure(plan, by):
    plan.phases[3].contacts[0].center_of_pressure_W += by


def follow(plan):
    """Let the last knot follow the last phase's changed forces, and the plan end anywhere."""
    plan.open_end = True
    com, velocity, momentum, turned = integrate(plan, 3, 0.4)
    knot = plan.knots[4]
    knot.com_W, knot.com_velocity_W, knot.angular_momentum_W = com, velocity, momentum
    knot.base_rpy = turned.as_euler("ZYX")[::-1]
    knot.base_rpy_rate = np.linalg.solve(turning_axes(knot.base_rpy), spin(plan.robot, turned, momentum))
    for end in plan.robot.end_effectors:  # the base may tilt as far as it likes
        end.reach_min_B, end.reach_max_B = [-2.0] * 3, [2.0] * 3


BREAKS = {
    "momentum": (lambda p: np.add.at(p.knots[2].angular_momentum_W, 0, 1e-7), False, {"dynamics"}),
    "centre of pressure off the sole": (lambda p: move_pressure(p, [0.0, 0.052, 0.0]), True, {"center_of_pressure"}),
    "centre of pressure off the plane": (lambda p: move_pressure(p, [0.0, 0.0, 0.002]), True, {"center_of_pressure"}),
    "torsion": (lambda p: np.add.at(p.phases[3].contacts[0].moment_W, 2, 1.1), True, {"moment"}),
    "moment along the surface": (lambda p: np.add.at(p.phases[3].contacts[0].moment_W, 0, 1e-4), True, {"moment"}),
    "friction": (lambda p: setattr(p.scene.surfaces[0], "friction", 0.05), False, {"friction"}),
    "cap": (lambda p: setattr(p.robot.end_effectors[0], "max_force", 200.0), False, {"force_cap"}),
    "heading slips": (
        lambda p: setattr(p.knots[4], "end_effector_yaw", [0.02, 0.0, 0.0, 0.0]),
        False,
        {"slip"},
    ),
    "heading out of range": (
        lambda p: setattr(p.robot.end_effectors[0], "yaw_range", [-0.05, 0.05]),
        False,
        {"reach"},
    ),
}


@pytest.mark.parametrize("name", BREAKS)
def test_what_is_broken_is_named_and_nothing_else(name, plan):
    change, replay, expected = BREAKS[name]
    change(plan)
    if replay:
        follow(plan)
    assert broken(plan) == expected


def test_an_orientation_two_degrees_off_is_named_and_the_tolerance_is_an_option(plan):
    knot = plan.knots[2]  # at rest between turning and tilting
    knot.base_rpy += [0.0, np.deg2rad(2.0), 0.0]
    knot.base_rpy_rate = [0.0, 0.0, 0.0]
    knot.angular_momentum_W = integrate(plan, 1, 0.4)[2]
    assert broken(plan) == {"orientation"}
    assert mp.check(plan, tolerances=mp.Tolerances(orientation=np.deg2rad(2.5))).ok()


def test_a_line_of_force_that_passes_beside_the_foot_is_no_error(plan):
    # s = a + r with r along the line to the CoM, at a stiffness that gives the same force.
    for phase in plan.phases:
        for contact in phase.contacts[:2]:
            down = contact.anchor_W - np.array([0.0, 0.0, 0.7])
            contact.anchor_W = contact.anchor_W + 0.25 * down
            contact.stiffness = contact.stiffness / 1.25
    follow(plan)  # the same forces at rest, so the same knots
    assert mp.check(plan).ok(), str(mp.check(plan))
    assert np.linalg.norm(plan.phases[0].contacts[0].anchor_W - plan.knots[0].end_effectors_W[0]) > 0.15


def test_headings_read_as_a_tuple_so_that_nobody_changes_a_copy(plan):
    assert plan.knots[0].end_effector_yaw == (0.0, 0.0, 0.0, 0.0)
    other = copy.deepcopy(plan)
    other.knots[0].end_effector_yaw = [0.5] * 4
    assert plan.knots[0].end_effector_yaw[0] == 0.0
