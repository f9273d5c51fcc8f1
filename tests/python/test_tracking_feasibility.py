"""A plan that a robot cannot follow is told, and what is wrong is named: reach, torque, speed, clearance, hands, mass."""

import copy

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.tracking.feasibility import assess
from standing import standing_plan

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")
pytest.importorskip("scipy")


@pytest.fixture(scope="module")
def talos():
    return by_hand.talos()


@pytest.fixture(scope="module")
def walking(talos):
    return by_hand.walk(by_hand.flat(), talos)


@pytest.fixture(scope="module")
def standing():
    return standing_plan(robot=mp.load_robot("talos"))


@pytest.fixture(scope="module")
def walked(walking):
    return assess(walking)


@pytest.fixture(scope="module")
def stairs():
    return mp.plan("stairs", mp.load_robot("talos"), joint_limits=False).plan


def beyond(feasibility) -> set[str]:
    return {found.name for found in feasibility.violations()}


def test_a_quiet_walk_can_be_followed(walked):
    assert walked.ok(), str(walked)
    assert "can follow" in walked.verdict
    names = [found.name for found in walked.worst_of_each()]
    assert names == ["reach", "sole", "balance", "torque", "joint_velocity", "clearance", "mass"]
    assert set(walked.of("reach")) == {"com", "right_foot", "left_foot"}
    assert {f"leg_{side}_{i}_joint" for side in ("left", "right") for i in range(1, 7)} < set(walked.of("torque"))


def test_torques_of_a_walk_are_of_the_size_of_one_leg_standing(walked, talos):
    """The knee: the weight over a lever of some centimetres; the hip's roll: over half the width of the stance."""
    weight = 9.81 * talos.mass
    lateral = weight * talos.end_effectors[1].nominal_B[1]
    roll = max(walked.of("torque")[f"leg_{side}_2_joint"].value for side in ("left", "right"))
    assert 0.3 * lateral < roll < 2.0 * lateral


@pytest.mark.slow
def test_a_com_20_cm_higher_is_out_of_reach_with_straight_knees(talos):
    tall = copy.copy(talos)
    tall.com_height += 0.2
    found = assess(by_hand.walk(by_hand.flat(), tall), talos)
    assert "reach" in beyond(found)
    worst = max(found.of("reach").values(), key=lambda f: f.value)
    assert worst.value > 0.05
    assert "leg_left_4_joint" in worst.note or "leg_right_4_joint" in worst.note
    assert "reach" in found.verdict


def test_steps_that_are_too_far_are_named_with_foot_and_time(talos):
    """Treads half a metre apart: a leg is stretched while the feet are on different ones."""
    plan = by_hand.walk(by_hand.stairs(), talos)
    found = assess(plan)
    assert "reach" in beyond(found) and found.of("reach")["com"].value > 0.015
    worst = found.of("reach")["left_foot"]
    assert worst.value > worst.limit and "leg_left_4_joint" in worst.note  # the knee, straight
    ends = np.array([e.position_W for e in plan.at(worst.time_s).end_effectors[:2]])
    assert np.linalg.norm(ends[0] - ends[1]) > 0.3


def test_a_payload_of_the_robots_mass_and_more_is_too_much_for_its_knees(standing):
    """Standing, a knee's torque grows with the weight above it: feet and shanks are 15 kg of the 90."""
    payload = 150.0
    found, before = assess(standing, payload_kg=payload), assess(standing)
    assert before.ok() and "reach" not in beyond(found) and "mass" in beyond(found)
    for side in ("left", "right"):
        knee = f"leg_{side}_4_joint"
        ratio = found.of("torque")[knee].value / before.of("torque")[knee].value
        above = standing.robot.mass - 15.0
        # The CoM of the payload is not that of the robot, and postures change a little.
        assert ratio == pytest.approx((above + payload) / above, rel=0.35)
        assert ratio > 2.0
    crushed = assess(standing, payload_kg=600.0)
    assert {f"leg_{side}_4_joint" for side in ("left", "right")} <= {
        f.where for f in crushed.violations() if f.name == "torque"
    }


def test_three_times_the_mass_is_no_robot_of_that_urdf():
    heavy = mp.load_robot("talos")
    heavy.mass *= 3.0
    found = assess(standing_plan(robot=heavy))
    assert beyond(found) == {"mass"}
    assert found.of("mass")[""].value == pytest.approx(2.0, rel=1e-4)


@pytest.mark.slow
def test_a_swing_through_a_stair_is_named_with_its_tread(stairs):
    assert "clearance" not in beyond(assess(stairs))
    low = copy.deepcopy(stairs)
    for swing in low.swings:
        swing.height = 0.01
    found = assess(low)
    assert "clearance" in beyond(found)
    worst = max(found.of("clearance").values(), key=lambda f: f.value)
    assert worst.note.startswith("surface tread_")
    state = low.at(worst.time_s)
    foot = low.robot.end_effector_index(worst.where)
    assert state.end_effectors[foot].surface == -1


def test_a_hasty_step_is_too_fast_for_the_knee(talos):
    plan = by_hand.walk(by_hand.flat(), talos)
    for swing in plan.swings:
        swing.height = 0.3
    found = assess(plan)
    fast = [f for f in found.violations() if f.name == "joint_velocity"]
    assert any("_4_joint" in f.where for f in fast)
    times = np.array(plan.knot_times())
    for f in fast:
        phase = min(np.searchsorted(times, f.time_s, side="right") - 1, len(plan.phases) - 1)
        near = [phase, phase - 1, min(phase + 1, len(plan.phases) - 1)]
        assert any(min(c.surface for c in plan.phases[k].contacts[:2]) < 0 for k in near)


def test_hands_are_held_against_their_arms():
    """A table bears 2 and 30 % of Talos's weight at each hand; no arm of his bears the latter."""
    robot = mp.load_robot("talos")
    for share, bears in ((0.02, True), (0.3, False)):
        plan = leaning(robot, share)
        hand = assess(plan).of("hand_force")["right_hand"]
        slant = np.array(plan.knots[0].com_W) - plan.knots[0].end_effectors_W[robot.end_effector_index("right_hand")]
        assert hand.value == pytest.approx(share * robot.mass * 9.81 * np.linalg.norm(slant) / slant[2], rel=0.05)
        assert (hand.value <= hand.limit) == bears, hand
        assert 10.0 < hand.limit < 400.0 and "arm_right_" in hand.note


def leaning(robot: mp.Robot, share: float) -> mp.Plan:
    """Standing with both hands on a table beside the robot, which bears this share of the weight at each hand.

    Forces point at the CoM; the feet's are chosen so that all four sum to the weight.
    """
    plan = standing_plan(phases=2, duration_s=0.1, robot=robot)
    com = plan.knots[0].com_W
    hands = [i for i, end in enumerate(robot.end_effectors) if end.kind == "hand"]
    plan.scene.surfaces = [
        *plan.scene.surfaces,
        by_hand.rectangle("table", (-1.0, 1.0), (-1.0, 1.0), 0.6, thickness=0.02),
    ]
    table = len(plan.scene.surfaces) - 1
    gravity = plan.scene.gravity
    for knot in plan.knots:
        for i in hands:
            knot.end_effectors_W[i, 2] = 0.6
    phases = []
    for phase in plan.phases:
        contacts = list(phase.contacts)
        for i in hands:
            place = np.array(plan.knots[0].end_effectors_W[i])
            contacts[i] = mp.model.Contact(surface=table, stiffness=share * gravity / (com[2] - 0.6), anchor_W=place)
        for i, contact in enumerate(contacts):
            if i not in hands:
                contact.stiffness *= 1.0 - len(hands) * share
        phases.append(mp.model.Phase(duration=phase.duration, contacts=contacts))
    plan.phases = phases
    plan.final_contacts = [table if i in hands else 0 for i in range(len(robot.end_effectors))]
    plan.swings = []
    return plan


def test_end_effectors_are_matched_by_name(walking, walked, talos):
    turned = copy.copy(talos)
    turned.end_effectors = list(reversed(talos.end_effectors))
    found = assess(walking, turned)
    for name in ("reach", "torque", "joint_velocity", "clearance"):
        for where, finding in walked.of(name).items():
            assert found.of(name)[where].value == pytest.approx(finding.value, rel=0.02, abs=1e-3)


def test_a_plan_without_hands_is_followed_by_a_robot_with_hands():
    plan = mp.walk("flat", cycles=2).plan
    assert [end.name for end in plan.robot.end_effectors] == ["left_foot", "right_foot"]
    found = assess(plan, mp.load_robot("talos"))
    assert found.robot == "talos" and set(found.of("reach")) == {"com", "left_foot", "right_foot"}
    assert max(f.value for f in found.of("reach").values()) < 0.02
    assert found.of("mass")[""].value == pytest.approx(95.0 / 90.272 - 1.0, abs=1e-4)


def test_a_robot_without_a_foot_that_the_plan_puts_down_is_refused(standing, talos):
    lame = copy.copy(talos)
    lame.end_effectors = [end for end in talos.end_effectors if end.name != "left_foot"]
    with pytest.raises(
        mp.errors.InvalidRobot, match="talos: end_effectors: must have 'left_foot', which the plan puts down"
    ):
        assess(standing, lame)


def test_a_robot_without_joints_is_refused(standing):
    with pytest.raises(mp.errors.InvalidRobot, match="humanoid44: urdf: must name a URDF"):
        assess(standing, mp.load_robot("humanoid44"))


@pytest.mark.parametrize("payload", [-1.0, float("nan"), float("inf")])
def test_a_payload_is_a_mass(standing, payload):
    with pytest.raises(mp.InvalidInput, match="payload_kg: must be 0 or more"):
        assess(standing, payload_kg=payload)
