"""mcplan_bench.contact_measures: numbers of plans whose forces are known."""

from __future__ import annotations

import json

import numpy as np
import pytest

import mcplan as mp
from mcplan_bench.contact_measures import measure_contacts
from standing import standing_plan
from stepping import stepping_plan
from wrench_plans import (
    LEFT,
    LEFT_HAND,
    RIGHT,
    RIGHT_HAND,
    hanging_plan,
    leaning_plan,
    spinning_plan,
    standing_on_wrenches,
    tipping_plan,
    with_contact,
    with_knot,
)


def test_standing_on_two_feet():
    """A force from (0, 0.1, 0) to (0, 0, 0.7): half the weight upwards, 1/7 of that sideways."""
    plan = standing_plan()
    found = measure_contacts(plan)
    right, left, *hands = found.end_effectors
    half = 0.5 * plan.robot.mass * plan.scene.gravity
    for foot in (right, left):
        assert foot.peak_N == pytest.approx(half * np.hypot(1.0, 1.0 / 7.0))
        assert foot.peak == pytest.approx(0.5 * np.hypot(1.0, 1.0 / 7.0))
        assert foot.tangent == pytest.approx(1.0 / 7.0) and foot.tangent_circle == pytest.approx(1.0 / 7.0)
        assert foot.surfaces == ("ground",)
        for name in ("pull_N", "pressure_off_sole_m", "pressure_off_surface_m", "slip_m", "reach_m"):
            assert getattr(foot, name) == pytest.approx(0.0, abs=1e-12), name
    assert all(hand.peak_N == hand.swing_stiffness == 0.0 and hand.surfaces == () for hand in hands)
    assert found.momentum_peak_Nms < 1e-12 and found.roll_deg < 1e-9 and found.pitch_deg < 1e-9
    assert found.com_height_m == pytest.approx((0.7, 0.7)) and found.com_height_knots_m == pytest.approx((0.7, 0.7))
    assert found.flights == 0 and found.hands_only == () and found.feet_alternate
    assert found.surfaces("foot") == {"ground"} and found.surfaces("hand") == set()


def test_both_laws_say_the_same_of_forces_through_the_com():
    paper, wrench = measure_contacts(standing_plan(phases=2)), measure_contacts(standing_on_wrenches(phases=2))
    assert [end.peak_N for end in paper.end_effectors] == [end.peak_N for end in wrench.end_effectors]
    assert [end.tangent for end in paper.end_effectors] == [end.tangent for end in wrench.end_effectors]


def test_a_pendulum_that_tips_slides_more_and_more():
    """Ahead of the foot by x at the height h: tangent x / h, force m g sqrt(1 + x^2 / h^2); the reach box ends at 0.30 m."""
    plan = tipping_plan(ahead_m=0.05, duration_s=0.6)
    omega = np.sqrt(plan.scene.gravity / 0.7)
    ahead = 0.05 * np.cosh(omega * 0.6)
    foot = measure_contacts(plan).end_effectors[RIGHT]
    assert foot.tangent == pytest.approx(ahead / 0.7, abs=1e-9)
    assert foot.peak == pytest.approx(np.hypot(1.0, ahead / 0.7), abs=1e-9)
    # The right foot is below the CoM's middle: 0.05 m beyond its box to the left, and less than 0.30 m behind.
    assert ahead < 0.30 and foot.reach_m == pytest.approx(0.05)


def test_leaning_is_roll_and_momentum():
    plan = leaning_plan(duration_s=0.4)
    found = measure_contacts(plan)
    moment = 0.1 * plan.robot.mass * plan.scene.gravity
    assert found.momentum_peak_Nms == pytest.approx(moment * 0.4)
    assert found.roll_deg == pytest.approx(np.rad2deg(0.5 * moment * 0.4**2 / 5.0))
    assert found.pitch_deg < 1e-9
    right = found.end_effectors[RIGHT]
    assert right.tangent == pytest.approx(0.0, abs=1e-12) and right.peak == pytest.approx(1.0)
    assert right.pressure_off_sole_m == pytest.approx(0.0, abs=1e-12)


def test_the_apex_of_a_flight_lies_between_the_knots():
    plan = spinning_plan(np.zeros(3), np.array([5.0, 5.0, 5.0]), phases=1, duration_s=0.4)
    found = measure_contacts(plan)
    assert found.flights == 1
    assert found.com_height_m[1] == pytest.approx(0.7 + 2.0**2 / (2 * plan.scene.gravity), abs=1e-5)
    assert found.com_height_knots_m[1] == pytest.approx(0.7 + 2.0 * 0.4 - 0.5 * plan.scene.gravity * 0.4**2)


def test_hands_alone_bear_half_the_weight_each():
    plan = hanging_plan(duration_s=0.4, phases=2)
    found = measure_contacts(plan)
    assert [phase.phase for phase in found.hands_only] == [0, 1]
    assert found.hands_only[0].duration_s == 0.4
    assert found.hands_only[0].vertical == pytest.approx({"right_hand": 0.5, "left_hand": 0.5})
    assert found.flights == 0 and found.surfaces("hand") == {"right_pad", "left_pad"}
    assert found.momentum_peak_Nms < 1e-10  # the moments of the two hands about the CoM cancel
    assert found.end_effectors[LEFT_HAND].tangent < 1e-9 and found.end_effectors[LEFT_HAND].peak == pytest.approx(0.5)
    assert measure_contacts(standing_plan()).hands_only == ()


def test_the_centre_of_pressure_is_held_against_the_sole_that_has_a_heading():
    """0.07 m ahead is inside a sole of 0.10 x 0.05 m that heads forward, and 0.02 m beyond one that heads to the left."""
    plan = standing_on_wrenches(phases=1)
    place = plan.knots[0].end_effectors_W[LEFT]
    plan = with_contact(plan, 0, LEFT, center_of_pressure_W=place + [0.07, 0.0, 0.0])
    assert measure_contacts(plan).end_effectors[LEFT].pressure_off_sole_m == 0.0
    yaws = [0.0, np.pi / 2, 0.0, 0.0]
    plan = with_knot(with_knot(plan, 0, end_effector_yaw=yaws), 1, end_effector_yaw=yaws)
    assert measure_contacts(plan).end_effectors[LEFT].pressure_off_sole_m == pytest.approx(0.02)
    plan = with_contact(plan, 0, LEFT, center_of_pressure_W=place + [0.08, 0.14, 0.0])
    assert measure_contacts(plan).end_effectors[LEFT].pressure_off_sole_m == pytest.approx(np.hypot(0.03, 0.04))


def test_the_centre_of_pressure_is_held_against_the_surface():
    plan = hanging_plan()
    place = plan.knots[0].end_effectors_W[RIGHT_HAND]
    for offset, distance in (([0.04, 0.04, 0.0], 0.0), ([0.08, 0.09, 0.0], 0.05), ([0.0, 0.0, -0.003], 0.003)):
        moved = with_contact(hanging_plan(), 0, RIGHT_HAND, center_of_pressure_W=place + offset)
        assert measure_contacts(moved).end_effectors[RIGHT_HAND].pressure_off_surface_m == pytest.approx(
            distance, abs=1e-12
        )


def test_slip_is_counted_from_where_the_foot_touched_down():
    """0.2 mm at each of three knots is 0.6 mm."""
    plan = standing_on_wrenches(phases=3)
    for k in (1, 2, 3):
        ends = np.array(plan.knots[k].end_effectors_W)
        ends[RIGHT] += [2e-4 * k, 0.0, 0.0]
        plan = with_knot(plan, k, end_effectors_W=ends)
    assert measure_contacts(plan).end_effectors[RIGHT].slip_m == pytest.approx(6e-4)
    assert measure_contacts(plan).end_effectors[LEFT].slip_m == 0.0


def test_a_sole_that_turns_slips_at_its_corners():
    plan = standing_on_wrenches(phases=1)
    plan = with_knot(plan, 0, end_effector_yaw=[0.0] * 4)
    plan = with_knot(plan, 1, end_effector_yaw=[0.01, 0.0, 0.0, 0.0])
    assert measure_contacts(plan).end_effectors[RIGHT].slip_m == pytest.approx(0.01 * np.hypot(0.10, 0.05))


def test_the_pyramid_takes_the_tangents_apart_and_the_cone_does_not():
    """A line of force that leans by 0.3 in x and by 0.4 in y."""
    plan = with_contact(standing_on_wrenches(phases=1), 0, RIGHT, anchor_W=[-0.21, -0.28, 0.0])
    foot = measure_contacts(plan).end_effectors[RIGHT]
    # The CoM is carried off sideways meanwhile: the first sample is the least.
    assert foot.tangent >= 0.4 and foot.tangent_circle >= 0.5
    assert foot.tangent_circle == pytest.approx(foot.tangent * 0.5 / 0.4, rel=0.2)


def test_pulling_contacts_and_leaking_swings_show():
    plan = with_contact(standing_on_wrenches(phases=1), 0, RIGHT, anchor_W=[0.0, -0.1, 0.8])
    foot = measure_contacts(plan).end_effectors[RIGHT]
    assert foot.pull_N > 10.0 and foot.tangent == foot.tangent_circle == np.inf
    plan = with_contact(standing_plan(), 1, RIGHT_HAND, stiffness=1e-3 * 9.8 / 0.7)
    assert measure_contacts(plan).end_effectors[RIGHT_HAND].swing_stiffness == pytest.approx(1e-3)


def test_reach_is_that_of_the_turned_body():
    """The base pitched by 0.3 rad in flight and standing: the foot is then 0.7 sin 0.3 ahead in its box, which ends at 0.30."""
    plan = standing_on_wrenches(phases=1)
    for angle, beyond in ((0.3, 0.0), (0.6, 0.7 * np.sin(0.6) - 0.30)):
        pitched = with_knot(plan, 0, base_rpy=[0.0, angle, 0.0])
        foot = measure_contacts(pitched).end_effectors[RIGHT]
        # Upright the foot is 0.70 m below, pitched 0.7 cos 0.6 = 0.58: the box from -0.75 to -0.55 holds both.
        assert foot.reach_m == pytest.approx(beyond, abs=1e-9)


def test_reach_is_that_of_faces_that_cut_the_box():
    """The right foot stands 0.70 m below the CoM: a face that ends 0.72 m below it is missed by 2 cm."""
    plan = standing_on_wrenches(phases=1)
    ends = plan.robot.end_effectors
    for spare, beyond in ((0.01, 0.0), (-0.02, 0.02)):
        end = ends[RIGHT]
        end.reach_cut = mp.model.Polytope(A=[[0.0, 0.0, 1.0]], b=[-0.70 + spare])
        plan.robot.end_effectors = ends
        assert measure_contacts(plan).end_effectors[RIGHT].reach_m == pytest.approx(beyond, abs=1e-9)


def test_the_measures_become_json():
    content = json.loads(json.dumps(measure_contacts(hanging_plan()).to_dict()))
    assert content["end_effectors"][RIGHT_HAND]["surfaces"] == ["right_pad"]
    assert content["hands_only"][0]["vertical"]["left_hand"] == pytest.approx(0.5)


def test_plans_with_forces_at_points_are_refused():
    with pytest.raises(mp.InvalidInput, match="must have no forces at points"):
        measure_contacts(stepping_plan())


def test_largest_is_by_kind():
    found = measure_contacts(leaning_plan())
    assert found.largest("peak", "foot") == pytest.approx(1.0) and found.largest("peak", "hand") == 0.0
    assert found.largest("peak") == found.largest("peak", "foot") and found.largest("peak", "tail") == 0.0
