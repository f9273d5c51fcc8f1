"""Joint limits of legs from URDFs, against Pinocchio."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand

pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.files.leg_geometry import (  # noqa: E402
    hip_place,
    leg_torques,
    legs_of,
    limits_of,
    max_length,
    postures,
    virtual_leg,
)
from mcplan.files.limb_limits import draw  # noqa: E402
from mcplan.files.urdf import load_model  # noqa: E402
from mcplan.files.urdf_limbs import contact_frame, limb_of  # noqa: E402
from mcplan.files.urdf_setups import SETUPS  # noqa: E402

POSTURES = 1000


def setup(name):
    model, nominal, _ = load_model(name)
    ends = SETUPS[name].ends
    for end in ends:
        contact_frame(model, end)
    limbs = {end.name: limb_of(model, nominal, end, ends) for end in ends}
    return legs_of(model, nominal, ends, limbs)


@pytest.mark.parametrize("name", [pytest.param("talos", marks=pytest.mark.slow), "g1"])
def test_what_limits_allow_asks_no_joint_for_more_than_105_percent_of_its_own_limit(name):
    """Largest force of a random direction and place, largest speed of the CoM in a random direction, random postures."""
    urdf = setup(name)
    model = urdf.model
    robot, data, rng = mp.load_robot(name), model.createData(), np.random.default_rng(99)
    drawn = postures(urdf, robot, POSTURES, seed=77)
    assert len(drawn) == POSTURES
    draws = [d for p in drawn for leg in urdf.legs if (d := draw(urdf, data, robot, leg, p, rng)) is not None]
    assert len(draws) > 1.9 * POSTURES  # legs that are too long are few
    torques = np.array([d.torques for d in draws])
    limited = np.isfinite(limits_of(robot.end_effectors[0].limb))
    assert limited[0] and limited.sum() >= 3
    assert np.nanmax(torques[:, limited]) <= 1.05, "seeds 77, 99"
    assert max(d.speed for d in draws) <= 1.05
    # They are not much tighter than the joints either: most forces are four fifths of the largest.
    assert np.median([d.force_ratio for d in draws]) > 0.75
    assert np.median([d.speed for d in draws]) > 0.6


def test_the_virtual_leg_of_talos_is_its_leg():
    """With the hip where it is, torques are those of the transposed Jacobian, whatever the force and where it acts."""
    urdf = setup("talos")
    model, legs = urdf.model, urdf.legs
    robot, data, rng = mp.load_robot("talos"), model.createData(), np.random.default_rng(5)
    for posture in postures(urdf, robot, 50, seed=6):
        pin.computeJointJacobians(model, data, posture.configuration)
        pin.updateFramePlacements(model, data)
        for number, (name, leg) in enumerate(legs.items()):
            limb = robot.end_effectors[robot.end_effector_index(name)].limb
            limb.margin = 0.0
            angle, foot = posture.headings[number], posture.feet[number]
            heading = np.array([np.cos(angle), np.sin(angle), 0.0])
            force, acting = rng.normal(size=3) * 500.0, foot + [*rng.uniform(-0.1, 0.1, 2), 0.0]
            hip, ankle = (data.oMi[leg.joints[i]].translation for i in (2, 4))
            expected = -pin.getFrameJacobian(model, data, leg.frame, pin.LOCAL_WORLD_ALIGNED).T @ np.concatenate(
                [force, np.cross(acting - foot, force)]
            )
            columns = [model.joints[joint].idx_v for joint in leg.joints]
            torques = leg_torques(limb, hip, ankle, heading, acting, force)
            # Inverse kinematics leaves up to 5 mrad of tilt.
            np.testing.assert_allclose(np.abs(torques), np.abs(expected[columns]), atol=6.0)
            knee = data.oMi[leg.joints[0]].translation
            np.testing.assert_allclose(ankle + virtual_leg(limb, hip, ankle, heading, 0.0)[3], knee, atol=4e-3)


@pytest.mark.slow
def test_the_checker_says_the_torques_that_the_limits_are_fitted_with():
    robot = mp.load_robot("talos")
    plan = by_hand.walk(by_hand.flat(), robot)
    largest, longest = 0.0, 0.0
    for time in np.arange(0.0, plan.duration(), 1e-3):
        state = plan.at(float(time))
        np.testing.assert_allclose(state.base_rpy, 0.0, atol=1e-12)
        feet = {e.name: s.position_W for e, s in zip(robot.end_effectors, state.end_effectors, strict=True)}
        for end, at in zip(robot.end_effectors, state.end_effectors, strict=True):
            if end.limb.given and at.surface >= 0:
                hip, ankle = hip_place(robot, end, state.com_W, feet), at.position_W + end.limb.ankle
                # The force acts where the pendulum's anchor is, of which the state says the moment about the sole.
                acting = at.position_W + np.cross(at.force_W, at.moment_W) / np.dot(at.force_W, at.force_W)
                use = leg_torques(end.limb, hip, ankle, np.eye(3)[0], acting, at.force_W) / limits_of(end.limb)
                largest = max(largest, np.abs(use).max())
                longest = max(longest, np.linalg.norm(hip - ankle) + end.limb.margin - max_length(end.limb))
    found = {v.name: v for v in mp.check(plan).constraints}
    assert found["joint_torque"].value == pytest.approx(largest - 1.0, abs=2e-3)


def test_point_feet_and_robots_without_knees_have_no_limits():
    assert setup("anymal") is None
    assert not any(end.limb.given for end in mp.load_robot("anymal").end_effectors)
