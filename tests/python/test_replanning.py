"""mcplan.replan as a controller calls it: from states that are off, with contacts early and late, on and on."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import mcplan as mp
from mcplan import ddp
from planned_states import state_at


@pytest.fixture(scope="module")
def flat() -> mp.Plan:
    return mp.plan("flat").plan


@pytest.fixture(scope="module")
def stairs() -> mp.Plan:
    return mp.plan("stairs").plan


def time_of_phase(plan: mp.Plan, free: int, fraction: float = 0.5) -> float:
    """A time in the middle of a phase of the walk with so many feet in the air."""
    times = plan.knot_times()
    for k in range(4, len(plan.phases)):
        if sum(contact.surface < 0 for contact in plan.phases[k].contacts[:2]) == free:
            return times[k] + fraction * plan.phases[k].duration
    raise AssertionError("no such phase")


def footholds(plan: mp.Plan) -> list[tuple[int, int, np.ndarray]]:
    """End-effector, surface and place of every contact that begins after the start."""
    out = []
    for k in range(1, len(plan.phases)):
        for e, contact in enumerate(plan.phases[k].contacts):
            if contact.surface >= 0 and plan.phases[k - 1].contacts[e].surface < 0:
                out.append((e, contact.surface, np.array(plan.knots[k].end_effectors_W[e])))
    return out


@pytest.mark.parametrize("scene", ["flat", "stairs"])
@pytest.mark.parametrize("fraction", [0.03, 0.21, 0.38, 0.56, 0.71, 0.88])
def test_undisturbed_a_replan_keeps_its_sequence_and_its_footholds(scene, fraction, request):
    plan = request.getfixturevalue(scene)
    t = fraction * plan.duration()
    result = mp.replan(plan, t, state_at(plan, t)[0])
    assert result.report.status == mp.Status.solved
    assert result.report.plan_from == mp.model.PlanFrom.same_sequence
    assert result.report.start_violations == ()
    planned = footholds(plan)[-len(footholds(result.plan)) or len(footholds(plan)) :]
    for (e, surface, place), (was_e, was_surface, was_place) in zip(footholds(result.plan), planned, strict=False):
        assert (e, surface) == (was_e, was_surface)
        assert np.linalg.norm(place - was_place) < 1e-3


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_in_flight_what_is_left_of_the_flight_may_be_as_short_as_it_is(fraction):
    plan = mp.plan("gap").plan
    flight = next(k for k, phase in enumerate(plan.phases) if all(contact.surface < 0 for contact in phase.contacts))
    t = plan.knot_times()[flight] + fraction * plan.phases[flight].duration
    knot, contacts = state_at(plan, t)
    result = mp.replan(plan, t, knot, contacts=contacts)
    assert result.report.status == mp.Status.solved, result.report
    found = footholds(result.plan)
    for (e, surface, place), planned in zip(found, footholds(plan)[-len(found) :], strict=True):
        assert (e, surface) == planned[:2]
        np.testing.assert_allclose(place, planned[2], atol=1e-3)


def test_a_plan_that_asks_too_much_of_a_joint_is_solved_on_with_rows_for_it():
    plan = mp.plan("flat", "talos", phases=26).plan
    knot, contacts = state_at(plan, 6.46)
    knot.com_velocity_W = knot.com_velocity_W + np.array([-0.216, -0.268, 0.0])
    lines: list[str] = []
    result = mp.replan(plan, 6.46, knot, contacts=contacts, logger=lambda _, line: lines.append(line))
    told = [line for line in lines if line.startswith("replan, the plan's own sequence")]
    assert len(told) == 2 and "joint_torque" in told[0] and told[1].endswith("accepted")
    assert result.report.status == mp.Status.solved
    torque = next(v for v in mp.check(result.plan).constraints if v.name == "joint_torque")
    assert torque.value <= torque.tolerance


@pytest.mark.parametrize("free", [0, 1])
def test_a_replan_begins_at_the_measured_state_and_goes_on_with_its_swing(flat, free):
    t = time_of_phase(flat, free)
    knot, contacts = state_at(flat, t)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + [0.05, 0.1, 0.0]
    result = mp.replan(flat, t, knot, contacts=contacts)
    start = result.plan.at(0.0)
    assert result.plan.measured_start
    assert np.allclose(start.com_W, knot.com_W, atol=1e-9)
    assert np.allclose(start.com_velocity_W, knot.com_velocity_W, atol=1e-9)
    for e, end in enumerate(start.end_effectors):
        assert end.surface == contacts[e]
        if e < 2:  # feet: the hands have nothing to touch here
            assert np.allclose(end.position_W, knot.end_effectors_W[e], atol=1e-3)
            assert np.allclose(end.velocity_W, knot.end_effector_velocities_W[e], atol=1e-2)


@pytest.mark.parametrize("late_s", [-0.04, -0.02, 0.02, 0.04])
@pytest.mark.parametrize("touchdown", [True, False])
def test_contacts_that_are_early_or_late_are_taken_as_they_are(stairs, late_s, touchdown):
    times, sequence = stairs.knot_times(), np.array(stairs.contact_sequence())
    k = next(
        k
        for k in range(4, len(sequence))
        if any(
            (sequence[k - 1][e] < 0 <= sequence[k][e]) == touchdown and sequence[k - 1][e] != sequence[k][e]
            for e in (0, 1)
        )
    )
    # At t the robot still has, or already has, the contacts of the other side of the switch.
    t, other = times[k] + late_s, times[k] - 0.2 * late_s
    knot, _ = state_at(stairs, t)
    elsewhere, contacts = state_at(stairs, other)
    knot.end_effectors_W, knot.end_effector_velocities_W = (
        elsewhere.end_effectors_W,
        elsewhere.end_effector_velocities_W,
    )
    result = mp.replan(stairs, t, knot, contacts=contacts)
    assert result.report.status == mp.Status.solved
    assert [end.surface for end in result.plan.at(0.0).end_effectors] == contacts
    # No step is lost: what remains to be touched is touched, in the same order.
    assert footholds(result.plan)[-1][:2] == footholds(stairs)[-1][:2]
    assert abs(len(footholds(result.plan)) - sum(touched > times[k] for touched in touchdown_times(stairs))) <= 1


def touchdown_times(plan: mp.Plan) -> list[float]:
    times, sequence = plan.knot_times(), plan.contact_sequence()
    return [
        times[k]
        for k in range(1, len(sequence))
        for was, now in zip(sequence[k - 1], sequence[k], strict=True)
        if was < 0 <= now
    ]


def test_a_start_out_of_reach_is_named_and_made_good(flat):
    t = time_of_phase(flat, 1)
    knot, contacts = state_at(flat, t)
    knot.com_W = np.array(knot.com_W) + [0.0, 0.05 if contacts[0] >= 0 else -0.05, 0.0]
    result = mp.replan(flat, t, knot, contacts=contacts)
    assert result.report.status == mp.Status.solved
    assert result.report.start_violations[0].name == "reach"
    assert result.plan.start_slack_s > 0.0
    assert mp.check(result.plan).ok()
    result.plan.start_slack_s = 0.0
    assert "reach" in {violation.name for violation in mp.check(result.plan).violations()}


def beyond_reach(robot: mp.Robot, e: int, com_W, rotation_WB, end_W) -> float:
    end = robot.end_effectors[e]
    relative = rotation_WB.T @ (np.array(end_W) - com_W)
    return max((np.array(end.reach_min_B) - relative).max(), (relative - np.array(end.reach_max_B)).max())


def rotation_of(rpy) -> np.ndarray:
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler("xyz", rpy).as_matrix()


def test_what_the_checker_forgives_is_the_straight_motion_of_the_start_fading_out(flat):
    from scipy.spatial.transform import Rotation

    t0 = time_of_phase(flat, 1, 0.3)
    knot, contacts = state_at(flat, t0)
    e = 0 if contacts[0] >= 0 else 1
    outward = np.array([0.0, -1.0 if e == 0 else 1.0, 0.0])
    knot.com_W = np.array(knot.com_W) + 0.02 * outward
    knot.com_velocity_W = np.array(knot.com_velocity_W) + 0.1 * outward
    plan = mp.replan(flat, t0, knot, contacts=contacts).plan
    first, slack_s = plan.knots[0], plan.start_slack_s
    start, spin = rotation_of(first.base_rpy), np.array([0.0, 0.0, 1.0]) * first.base_rpy_rate[2]
    times = np.arange(0.0, 0.95 * slack_s, 0.002)
    straight, worst, outside = -1.0, -1.0, -1.0
    for t in times:
        com_W = np.array(first.com_W) + t * np.array(first.com_velocity_W)
        moved = beyond_reach(
            plan.robot, e, com_W, Rotation.from_rotvec(t * spin).as_matrix() @ start, first.end_effectors_W[e]
        )
        straight = max(straight, moved, 0.0)
        now = plan.at(t)
        if now.end_effectors[e].surface != contacts[e]:
            break
        value = beyond_reach(
            plan.robot, e, np.array(now.com_W), rotation_of(now.base_rpy), now.end_effectors[e].position_W
        )
        outside, worst = max(outside, value), max(worst, value - straight * (1.0 - (t / slack_s) ** 2))
    assert outside > 1.5e-3  # the push does lead out of reach
    assert worst < 1e-3
    assert mp.check(plan).ok()
    plan.start_slack_s = 0.0
    reach = next(found for found in mp.check(plan).constraints if found.name == "reach")
    assert reach.value >= outside - 1e-6


def test_what_is_committed_is_kept_under_a_push(flat):
    touchdown = touchdown_times(flat)[2]
    t = touchdown - 0.06
    knot, contacts = state_at(flat, t)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + [0.2, 0.2, 0.0]
    result = mp.replan(flat, t, knot, contacts=contacts)
    first = footholds(result.plan)[0]
    planned = next(f for f, time in zip(footholds(flat), touchdown_times(flat), strict=False) if time == touchdown)
    assert first[:2] == planned[:2]
    assert np.linalg.norm(first[2] - planned[2]) < 1e-3
    assert abs(touchdown_times(result.plan)[0] - 0.06) < 0.003
    free = mp.replan(flat, t, knot, contacts=contacts, committed_s=0.0)
    assert np.linalg.norm(footholds(free.plan)[0][2] - planned[2]) > 1e-3


def test_the_horizon_never_gets_shorter_than_asked_and_ends_at_the_goal(flat):
    plan, t = flat, 0.0
    goal = np.array(flat.knots[-1].com_W)
    for _ in range(40):
        result = mp.replan(plan, min(t, plan.duration()), state_at(plan, min(t, plan.duration()))[0], phases_min=5)
        assert result.report.status == mp.Status.solved
        assert len(result.plan.phases) >= 5
        plan, t = result.plan, 0.25
    assert np.linalg.norm(np.array(plan.knots[0].com_W) - goal) < 0.02
    assert np.linalg.norm(plan.knots[0].com_velocity_W) < 0.02


@pytest.mark.parametrize(("command", "moved"), [((0.25, 0.0, 0.0), (1.0, 0.0)), ((0.0, 0.06, 0.0), (0.0, 1.0))])
def test_a_velocity_command_is_followed_for_as_long_as_one_likes(flat, command, moved):
    plan, t, time_s = flat, 0.1, 0.0
    speed = math.hypot(*command[:2])
    for i in range(70):
        knot, contacts = state_at(plan, t)
        if i == 30:
            begin = np.array(knot.com_W)
        result = mp.replan(plan, t, knot, contacts=contacts, command=command, horizon=12)
        assert result.report.status == mp.Status.solved
        assert 9 <= len(result.plan.phases) <= 12
        time_s += t if i >= 30 else 0.0
        plan = result.plan
    went = (np.array(plan.knots[0].com_W) - begin)[:2] / time_s
    assert went @ np.array(moved) == pytest.approx(speed, rel=0.2)
    assert abs(went @ np.array([-moved[1], moved[0]])) < 0.2 * speed


def test_a_command_to_turn_turns_the_base_and_the_soles(flat):
    plan = flat
    for i in range(70):
        knot, contacts = state_at(plan, 0.1)
        if i == 30:
            begin = knot.base_rpy[2]
        result = mp.replan(plan, 0.1, knot, contacts=contacts, command=ddp.VelocityCommand(yaw_rate=0.3))
        assert result.report.status == mp.Status.solved
        plan = result.plan
    assert plan.knots[0].base_rpy[2] - begin == pytest.approx(0.3 * 4.0, rel=0.2)
    assert all(abs(yaw - plan.knots[0].base_rpy[2]) < 0.35 for yaw in plan.knots[0].end_effector_yaw[:2])


def test_a_command_beyond_the_robots_strides_is_followed_in_part(flat):
    result = mp.replan(flat, 0.1, state_at(flat, 0.1)[0], command=(3.0, 0.0, 0.0))
    assert result.report.status == mp.Status.solved
    assert "of the velocity command is followed" in result.report.message


def test_a_command_stops_where_the_ground_ends():
    plan = mp.plan("gap").plan  # ground ends at the gap: no step leads over it
    edge = max(v[0] for v in plan.scene.surfaces[plan.contact_sequence()[0][0]].vertices_W)
    for _ in range(60):
        knot, contacts = state_at(plan, 0.1)
        result = mp.replan(plan, 0.1, knot, contacts=contacts, command=(0.3, 0.0, 0.0))
        if result.report.status == mp.Status.solved:
            plan = result.plan
    assert plan.knots[0].com_W[0] < edge + 0.1 or plan.knots[0].com_W[0] > edge + 0.3


def test_names_of_contacts_are_taken_as_well_as_indices(flat):
    t = time_of_phase(flat, 1)
    knot, contacts = state_at(flat, t)
    ends, surfaces = flat.robot.end_effectors, flat.scene.surfaces
    named = {ends[e].name: surfaces[surface].name for e, surface in enumerate(contacts) if surface >= 0}
    one, other = (mp.replan(flat, t, knot, contacts=given) for given in (contacts, named))
    assert np.array_equal(one.plan.knots[5].com_W, other.plan.knots[5].com_W)


def test_the_result_does_not_depend_on_the_number_of_threads_or_on_what_was_replanned_before(flat):
    knot, contacts = state_at(flat, 1.0)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + [0.1, 0.1, 0.0]
    plans = [mp.replan(flat, 1.0, knot, contacts=contacts, threads=threads).plan for threads in (1, 2, 1)]
    for plan in plans[1:]:
        assert repr(list(plan.knots)) == repr(list(plans[0].knots))
        assert repr(list(plan.phases)) == repr(list(plans[0].phases))


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        ({"contacts": [0, 0]}, mp.errors.InvalidPlan, r"measured.contacts: must be one per end-effector \(4\), got 2"),
        (
            {"contacts": [0, 7, -1, -1]},
            mp.errors.InvalidPlan,
            r"measured.contacts\[1\]: must be -1 or the index of a surface",
        ),
        ({"contacts": {"left_hoof": "floor"}}, mp.errors.InvalidPlan, "measured.contacts: must name end-effectors"),
        ({"contacts": {"left_foot": "flor"}}, mp.errors.InvalidPlan, "measured.contacts.left_foot: must be a surface"),
        ({"contacts": 3}, mp.errors.InvalidArgument, "contacts: must be indices of surfaces, or a mapping"),
        ({"command": (1.0, 2.0)}, mp.errors.InvalidArgument, "command: must be a ddp.VelocityCommand or three numbers"),
        ({"command": (math.nan, 0.0, 0.0)}, mp.errors.InvalidOptions, "command.velocity_B"),
        ({"committed_s": -1.0}, mp.errors.InvalidOptions, "committed_s: must"),
        ({"crossings": True}, mp.errors.InvalidOptions, "crossings: no such option. .*crossing.*max_work.*phases"),
        ({"start_slack_s": 6.0}, mp.errors.InvalidOptions, "start_slack_s: must be at most 5, got 6"),
        ({"max_work": -1}, mp.errors.InvalidOptions, "max_work: must"),
        ({"phases_min": 0}, mp.errors.InvalidOptions, "phases_min: must"),
        ({"horizon": 1}, mp.errors.InvalidOptions, "horizon: must"),
        ({"method": "paper"}, mp.errors.InvalidOptions, "method: must be standard"),
    ],
)
def test_what_is_wrong_is_named(flat, given: dict[str, Any], error, message):
    with pytest.raises(error, match=message):
        mp.replan(flat, 1.0, state_at(flat, 1.0)[0], **given)


def test_what_stands_far_off_its_surface_is_refused(flat):
    knot, contacts = state_at(flat, 1.0)
    places = np.array(knot.end_effectors_W)
    places[contacts.index(0)] += [0.0, 0.0, 0.5]
    knot.end_effectors_W = places
    with pytest.raises(mp.errors.InvalidPlan, match="must lie within 0.1 m of the surface"):
        mp.replan(flat, 1.0, knot, contacts=contacts)


def test_the_log_says_why_a_replan_was_refused(flat):
    t = time_of_phase(flat, 1)
    knot, contacts = state_at(flat, t)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + [0.0, 3.0, 0.0]
    lines: list[str] = []
    result = mp.replan(flat, t, knot, contacts=contacts, logger=lambda _, line: lines.append(line))
    assert result.report.status in (mp.Status.infeasible, mp.Status.acceptable)
    told = [line for line in lines if line.startswith("replan, ")]
    assert told[0].startswith("replan, the plan's own sequence: ")
    assert "over the limit" in told[0]
    assert "all limits are kept until" in result.report.message


def test_out_of_time_there_is_a_plan_whose_next_two_steps_can_be_followed(flat):
    t = time_of_phase(flat, 0)
    knot, contacts = state_at(flat, t)
    result = mp.replan(flat, t, knot, contacts=contacts, time_limit=1e-4)
    assert result.report.status == mp.Status.time_limit
    assert result.report.plan_from == mp.model.PlanFrom.previous_plan
    two_steps = touchdown_times(result.plan)[1]
    assert result.report.kept_until_s >= two_steps
    assert mp.check(result.plan, until_s=two_steps).ok()


def test_steps_that_catch_a_push_come_first_where_that_is_asked_for(flat):
    t = time_of_phase(flat, 1)
    knot, contacts = state_at(flat, t)
    knot.com_velocity_W = knot.com_velocity_W + [0.15, 0.0, 0.0]
    usually = mp.replan(flat, t, knot, contacts=contacts)
    first = mp.replan(flat, t, knot, contacts=contacts, recovery_first=True)
    assert usually.report.plan_from == mp.model.PlanFrom.same_sequence
    assert first.report.plan_from == mp.model.PlanFrom.recovery
    end = first.plan.knots[-1]
    assert mp.check(first.plan).ok() and np.linalg.norm(end.com_velocity_W) < 0.01
    assert end.com_W[0] < usually.plan.knots[-1].com_W[0] - 0.3  # it stands on the way, not at the goal


def test_what_only_a_step_across_the_standing_foot_catches_is_caught_by_one():
    """0.75 m/s outward over the foot that stands, in the middle of a swing of TALOS."""
    from mcplan.online.reach import widened

    plan = mp.plan("flat", "talos").plan
    t = time_of_phase(plan, 1)
    knot, contacts = state_at(plan, t)
    swings, stands = (0, 1) if contacts[0] < 0 else (1, 0)
    outward = math.copysign(1.0, plan.robot.end_effectors[stands].nominal_B[1])
    knot.com_velocity_W = knot.com_velocity_W + [0.0, 0.75 * outward, 0.0]
    robot = widened(plan.robot)
    without = mp.replan(plan, t, knot, contacts=contacts, robot=robot)
    crossed = mp.replan(plan, t, knot, contacts=contacts, robot=robot, crossing=True)
    assert without.report.status == mp.Status.infeasible
    assert crossed.report.status == mp.Status.solved and mp.check(crossed.plan).ok()
    lands = next(k for k, row in enumerate(crossed.plan.contact_sequence()) if row[swings] >= 0)
    places = crossed.plan.knots[lands].end_effectors_W
    apart = np.array(places[swings]) - np.array(places[stands])
    lengths = [plan.robot.end_effectors[e].half_size[0] for e in (swings, stands)]
    assert outward * apart[1] > 0.0 and abs(apart[0]) > sum(lengths)  # across, one sole behind the other


@pytest.mark.parametrize("ratio", [0.2, 0.8])
def test_steps_that_do_not_catch_a_push_hide_nothing_that_does(ratio):
    """0.4 m/s ahead in a swing of TALOS, its legs as long as they are: no recovery is solved, other ways are."""
    from mcplan.online.reach import widened

    plan = mp.plan("flat", "talos").plan
    t = time_of_phase(plan, 1, ratio)
    knot, contacts = state_at(plan, t)
    knot.com_velocity_W = knot.com_velocity_W + [0.4, 0.0, 0.0]
    lines: list[str] = []
    result = mp.replan(
        plan,
        t,
        knot,
        contacts=contacts,
        robot=widened(plan.robot),
        recovery_first=True,
        logger=lambda _, line: lines.append(line),
    )
    recoveries = [line for line in lines if line.startswith("replan, steps that catch a push")]
    assert recoveries and not any(line.endswith("accepted") for line in recoveries)
    assert result.report.plan_from != mp.model.PlanFrom.recovery
    assert result.report.status == mp.Status.solved and mp.check(result.plan).ok()


def test_what_is_said_of_a_plan_is_what_the_checker_says_of_it():
    """Pushes outward over the foot that stands, from such as steps across catch to such as nothing catches."""
    from mcplan.online.reach import widened

    plan = mp.plan("flat", "talos").plan
    statuses, kinds = set(), set()
    for ratio, push in ((0.3, 0.45), (0.3, 0.5), (0.3, 0.55), (0.6, 0.6), (0.2, 0.5), (0.8, 0.8), (0.3, 1.2)):
        t = time_of_phase(plan, 1, ratio)
        knot, contacts = state_at(plan, t)
        outward = math.copysign(1.0, plan.robot.end_effectors[0 if contacts[0] >= 0 else 1].nominal_B[1])
        knot.com_velocity_W = knot.com_velocity_W + [0.1, push * outward, 0.0]
        found = mp.replan(
            plan, t, knot, contacts=contacts, robot=widened(plan.robot), recovery_first=True, crossing=True
        )
        report, checked = found.report, mp.check(found.plan)
        statuses.add(report.status)
        kinds.add(report.plan_from)
        assert (report.status == mp.Status.solved) == checked.ok(), (report.status, report.message)
        if "could not be made exact" in report.message:
            continue
        assert report.kept_until_s == pytest.approx(checked.kept_until_s, abs=1e-9), (ratio, push)
        if not checked.ok():
            assert report.worst_violation == checked.worst(), (ratio, push)
    assert {mp.Status.solved, mp.Status.infeasible} <= statuses and mp.model.PlanFrom.recovery in kinds


def test_what_a_start_is_forgiven_is_what_the_checker_forgives():
    """The CoM is off and moves: steps that catch a push are planned in smaller boxes of reach, whose excess is not the plan's."""
    plan = mp.plan("stairs_broad", "talos").plan
    given, recoveries = 0, 0
    for seed in (*range(60), 119, 122):
        draws = np.random.default_rng(seed)
        t = draws.uniform(0.05, 0.9) * plan.duration()
        knot, contacts = state_at(plan, t)
        angle, speed = draws.uniform(0.0, 2.0 * np.pi), draws.uniform(0.0, 0.6)
        knot.com_velocity_W = knot.com_velocity_W + speed * np.array([np.cos(angle), np.sin(angle), 0.0])
        knot.com_W = knot.com_W + plan.robot.com_height * draws.uniform(-0.06, 0.06, 3)
        found = mp.replan(plan, t, knot, contacts=contacts, recovery_first=True, horizon=400)
        report, checked = found.report, mp.check(found.plan)
        assert (report.status == mp.Status.solved) == checked.ok(), seed
        assert report.start_violations == checked.start, seed
        if "could not be made exact" not in report.message:
            assert report.kept_until_s == pytest.approx(checked.kept_until_s, abs=1e-9), seed
        given += bool(checked.start)
        recoveries += report.plan_from == mp.model.PlanFrom.recovery
    assert given > 5 and recoveries > 2


@pytest.mark.parametrize("scene", ["stairs_broad", "flat"])
def test_without_any_time_there_is_a_plan(scene):
    plan = mp.plan(scene, "talos").plan
    for t in np.linspace(0.0, plan.duration(), 400, endpoint=False):
        knot, contacts = state_at(plan, t)
        found = mp.replan(plan, t, knot, contacts=contacts, time_limit=1e-5)
        assert found.plan.phases and found.plan.at(0.0), t


def test_a_limit_of_time_that_does_not_strike_changes_no_replan(flat):
    """Pushes that the plan's own sequence catches, that it misses by little, and that nothing catches."""
    statuses = set()
    for free, push in ((0, 0.0), (1, 0.15), (1, 0.5), (0, 0.7), (1, 1.0), (0, 3.0)):
        t = time_of_phase(flat, free)
        found = []
        for limit in ({}, {"time_limit": 1e4}):
            knot, contacts = state_at(flat, t)
            knot.com_velocity_W = knot.com_velocity_W + [0.3 * push, push, 0.0]
            result = mp.replan(flat, t, knot, contacts=contacts, recovery_first=True, crossing=True, **limit)
            report = result.report
            found.append((report.status, report.plan_from, report.kept_until_s, result.plan.knots, result.plan.phases))
        assert found[0] == found[1], push
        statuses.add(found[0][0])
    assert {mp.Status.solved, mp.Status.infeasible} <= statuses


def test_without_work_for_them_no_other_sequences_are_tried(flat):
    t = time_of_phase(flat, 0)
    knot, contacts = state_at(flat, t)
    knot.com_velocity_W = np.array(knot.com_velocity_W) + [0.0, 0.5, 0.0]

    def tried(**options: Any) -> int:
        lines: list[str] = []
        mp.replan(flat, t, knot, contacts=contacts, logger=lambda _, line: lines.append(line), **options)
        return sum(line.startswith("replan, ") for line in lines)

    assert tried(max_work=0) == 1 < tried(max_work=100_000)


@pytest.mark.parametrize("before_s", [0.003, 0.008, 0.015])
def test_a_foot_that_is_about_to_land_is_not_swung_up_again(before_s):
    """A phase gets 20 ms at least, so that the foot lands late: it may sink a little, and not fly about."""
    plan = mp.plan("flat", "talos").plan
    for touchdown in touchdown_times(plan)[:6]:
        knot, contacts = state_at(plan, touchdown - before_s)
        new = mp.replan(plan, touchdown - before_s, knot, contacts=contacts).plan
        states = new.sample(np.arange(0.0, 0.02, 1e-3))
        free = np.flatnonzero(states.surfaces[0, :2] < 0)
        assert (
            np.abs(states.end_effector_velocities_W[:, free, 2]).max() < 1.6
        )  # the steepest arc, 1.5 m/s, and its own


@pytest.mark.slow
def test_ten_thousand_replans_take_no_more_memory(flat):
    import resource

    knot, contacts = state_at(flat, 4.0)
    for i in range(10_000):
        mp.replan(flat, 4.0, knot, contacts=contacts)
        if i == 500:
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4096  # [KiB]


def test_a_foot_that_lies_on_a_slope_and_is_said_to_touch_nothing_is_not_in_the_slope():
    """Contacts flicker. The sole was taken for level there, with its toe in the ramp, and the replan was rejected."""
    plan = mp.plan("ramp", "g1").plan
    times, slope = plan.knot_times(), [surface.name for surface in plan.scene.surfaces].index("slope")
    seen = 0
    for k, phase in enumerate(plan.phases[:-2]):
        landed = [e for e in (0, 1) if plan.phases[k - 1].contacts[e].surface < 0 <= phase.contacts[e].surface]
        if k == 0 or not landed or min(phase.contacts[e].surface for e in (0, 1)) != slope:
            continue
        # It has landed when the first replan begins, and is in the air again for the second.
        knot, contacts = state_at(plan, times[k] + 0.02)
        under_way = mp.replan(plan, times[k] + 0.02, knot, contacts=contacts).plan
        knot, contacts = state_at(under_way, 0.1)
        contacts = [-1 if e == landed[0] else surface for e, surface in enumerate(contacts)]
        places = np.array(knot.end_effectors_W)
        places[landed[0], 2] += 0.001
        knot.end_effectors_W = places
        report = mp.replan(under_way, 0.1, knot, contacts=contacts).report
        assert report.status.name == "solved", report.message
        seen += 1
    assert seen >= 2


def test_a_velocity_leads_onto_a_block_under_which_the_floor_goes_on():
    scene = mp.load_scene("flat")
    block = scene.surfaces[0].__copy__()
    block.name, block.thickness = "block", 0.1
    block.vertices_W = [[0.25, -1, 0.1], [2, -1, 0.1], [2, 1, 0.1], [0.25, 1, 0.1]]
    scene.surfaces = [*scene.surfaces, block]
    goal = scene.goal
    goal.position_W, goal.contacts = [0.9, 0, 0.1], {"foot": "block"}
    scene.goal = goal
    plan = mp.plan(scene, "humanoid44").plan
    knot, contacts = state_at(plan, 0.0)
    result = mp.replan(plan, 0.0, knot, contacts=contacts, command=(0.25, 0.0, 0.0))
    assert result.report.status == mp.Status.solved
    left, right = (scene.surfaces[result.plan.final_contacts[foot]].name for foot in (0, 1))
    assert left == right == "block"
