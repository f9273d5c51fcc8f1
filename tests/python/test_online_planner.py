"""The planner beside a controller: what is submitted comes back as a plan, in a thread, without a simulator."""

import gc
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
import mcplan.online.planner as planner_module
from mcplan import solve
from mcplan._core.online import com_shift_W
from mcplan.errors import InvalidArgument
from mcplan.online import FeltPush, MeasuredState, OnlineOptions, Planner, PushObserver
from mcplan.online.pacing import Pace, distances, steps_left
from mcplan.online.planner import Update, with_feet_kept_up
from mcplan.online.reach import widened
from mcplan.running import chosen_options
from planned_states import state_at


@pytest.fixture(scope="module")
def plan():
    return mp.plan("flat", "humanoid44").plan


def state(plan: mp.Plan, t: float, clock_s: float | None = None, push=(0.0, 0.0, 0.0)) -> MeasuredState:
    """The planned state, the CoM's velocity off by a push [m/s]."""
    knot, contacts = state_at(plan, t)
    knot.com_velocity_W = knot.com_velocity_W + np.array(push)
    return MeasuredState(t if clock_s is None else clock_s, knot, tuple(contacts))


def test_planning_needs_neither_a_simulator_nor_a_urdf():
    heavy = ("mujoco", "pinocchio", "proxsuite", "scipy")
    script = f"import sys, mcplan.online; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_what_is_submitted_comes_back_as_the_plan_that_replan_makes(plan):
    measured = state(plan, 1.0, push=(0.0, 0.2, 0.0))
    with Planner(plan) as planner:
        assert planner.poll() is None
        ticket = planner.submit(measured)
        update = planner.wait()
        assert planner.poll() is None and not planner.busy  # handed out once
    expected = mp.replan(plan, 1.0, measured.knot, contacts=list(measured.contacts), recovery_first=True)
    assert update.ticket == ticket == 1 and update.usable and update.begins_s == 1.0
    assert update.status == expected.report.status.name and update.plan.knots == expected.plan.knots
    assert update.kept_until_s == 1.0 + expected.report.kept_until_s and update.took_s > 0.0


def test_a_plan_for_a_robot_that_is_pushed_begins_beside_it_and_says_how_far(plan):
    measured = state(plan, 1.0)
    pushed = replace(measured, push=FeltPush(acceleration_W=[0.2, -0.5], lasted_s=0.1))
    before = measured.knot.__copy__()
    with Planner(plan) as planner:
        planner.submit(pushed)
        update = planner.wait()
    omega_squared = plan.scene.gravity / plan.robot.com_height
    shift_W = (1.0 - np.exp(-np.sqrt(omega_squared) * 0.2)) / omega_squared * np.array([0.2, -0.5, 0.0])
    np.testing.assert_allclose(update.com_shift_W, shift_W, rtol=1e-9)
    np.testing.assert_allclose(update.plan.at(0.0).com_W, measured.knot.com_W + shift_W, atol=1e-9)
    assert measured.knot == before  # what was submitted stays as it is


def test_an_observer_goes_on_beside_the_planner_and_changes_nothing_that_was_submitted(plan):
    observer, velocity_W = PushObserver(), np.zeros(2)
    for _ in range(100):
        velocity_W = velocity_W + 0.002 * np.array([0.5, 0.0])
        observer.update(velocity_W, np.zeros(2), 0.002)
    felt = observer.push
    told = FeltPush(acceleration_W=np.array(felt.acceleration_W), lasted_s=felt.lasted_s)
    own = FeltPush(acceleration_W=np.array(felt.acceleration_W), lasted_s=felt.lasted_s)
    with Planner(plan) as planner:
        planner.submit(replace(state(plan, 1.0), push=own))
        own.acceleration_W = [-2.0, 0.0]
        for _ in range(100):
            velocity_W = velocity_W - 0.002 * np.array([1.5, 0.0])
            observer.update(velocity_W, np.zeros(2), 0.002)
        update = planner.wait()
    assert felt == told != observer.push
    expected = com_shift_W(told, plan.robot.com_height, plan.scene.gravity)
    np.testing.assert_array_equal(update.com_shift_W, expected)


def test_a_push_that_no_robot_feels_is_refused_by_name(plan):
    with Planner(plan) as planner:
        planner.submit(replace(state(plan, 1.0), push=FeltPush(acceleration_W=[1e6, 0.0], lasted_s=0.1)))
        update = planner.wait()
    assert update.status == "error" and not update.usable
    assert "push.acceleration_W[0]: must lie in [-100, 100], got 1000000" in update.message


def test_a_robot_that_hangs_a_little_lower_than_planned_goes_on_from_the_planned_height(plan):
    exact, measured = state(plan, 1.0), state(plan, 1.0, push=(0.0, 0.05, -0.02))
    measured.knot.com_W = measured.knot.com_W - [0.0, 0.01, 0.015]
    begins = []
    for margin_m in (0.03, 0.0):
        with Planner(plan, height_margin_m=margin_m) as planner:
            planner.submit(measured)
            begins.append(planner.wait().plan.knots[0])
    assert begins[0].com_W[2] == exact.knot.com_W[2] and begins[0].com_velocity_W[2] == exact.knot.com_velocity_W[2]
    np.testing.assert_array_equal(begins[0].com_W[:2], measured.knot.com_W[:2])
    np.testing.assert_array_equal(begins[1].com_W, measured.knot.com_W)


def test_what_a_landing_turns_the_base_by_is_not_in_the_next_plan(plan):
    exact, measured = state(plan, 1.0), state(plan, 1.0)
    measured.knot.base_rpy_rate = measured.knot.base_rpy_rate + [0.2, 0.0, -0.1]
    measured.knot.angular_momentum_W = np.zeros(3)  # made from the rates
    begins = []
    for margin_rad_s in (0.3, 0.0):
        with Planner(plan, turn_margin_rad_s=margin_rad_s) as planner:
            planner.submit(measured)
            begins.append(planner.wait().plan.knots[0])
    np.testing.assert_allclose(begins[0].base_rpy_rate, exact.knot.base_rpy_rate, atol=1e-9)
    np.testing.assert_allclose(begins[1].base_rpy_rate, measured.knot.base_rpy_rate, atol=1e-9)


@pytest.mark.parametrize(
    ("outcomes", "chosen"),
    [
        (["infeasible", "acceptable"], 1),  # it keeps all limits for a while only, the other to the end
        (["infeasible", "iteration_limit"], 0),
        (["iteration_limit", "infeasible"], 1),
        (["infeasible", "infeasible"], 0),
        (["iteration_limit", "iteration_limit"], 0),
        (["solved", "solved"], 0),
        (["stand", "solved"], 1),  # it leads on
        (["stand", "infeasible"], 0),
    ],
)
def test_a_plan_that_leads_to_the_end_goes_before_one_that_does_so_for_a_while_or_stands(
    plan, monkeypatch, outcomes, chosen
):
    asked = []

    def replan(previous, t, knot, contacts, command, scene, robot, named):
        asked.append(robot)
        number = len(asked) - 1
        stands = outcomes[number] == "stand"
        report = SimpleNamespace(
            status=mp.Status.solved if stands else getattr(mp.Status, outcomes[number]),
            kept_until_s=0.5,
            message=str(number),
            plan_from=mp.model.PlanFrom.stop if stands else mp.model.PlanFrom.search,
        )
        return SimpleNamespace(plan=plan, report=report)

    # All that keep their limits for a while are usable: a report has no constructor.
    monkeypatch.setattr("mcplan.online.planner.follows", lambda report, _: report.status != mp.Status.iteration_limit)
    monkeypatch.setattr("mcplan.online.planner.replan", replan)
    with Planner(plan) as planner:
        planner.robots = [plan.robot, widened(plan.robot) or plan.robot]
        planner.submit(state(plan, 1.0))
        update = planner.wait()
    assert update.message == str(chosen)
    assert len(asked) == (1 if outcomes[0] == "solved" else 2)


def test_where_there_is_no_plan_the_planner_says_why(plan):
    scene = plan.scene.__copy__()
    scene.goal = scene.goal.__copy__()
    scene.goal.position_W = [2.0, 0.0, 1.5]
    with Planner(plan) as planner:
        planner.scene = scene
        planner.submit(state(plan, 1.0))
        update = planner.wait()
    expected = mp.replan(plan, 1.0, state(plan, 1.0).knot, scene=scene)
    assert not expected.plan.phases
    assert update.plan is None and not update.usable
    assert (update.status, update.message) == (expected.report.status.name, expected.report.message)


def test_the_next_plan_is_made_from_the_one_taken_over(plan):
    with Planner(plan, begins_s=-0.5) as planner:  # the plan began half a second before the clock
        planner.submit(state(plan, 1.0, clock_s=0.5))
        first = planner.wait()
        planner.take_over(first)
        assert planner.plan is first.plan and planner.begins_s == 0.5
        planner.submit(state(first.plan, 0.2, clock_s=0.7))
        second = planner.wait()
    assert second.usable and second.begins_s == 0.7
    assert second.plan.duration() == pytest.approx(plan.duration() - 1.2, abs=0.4)


def test_what_a_replan_keeps_of_an_accepted_plan_is_not_looked_at_again(monkeypatch):
    plan, looked_s = mp.plan("flat", "talos", phases=26).plan, []

    def noted(*given):
        result = solve.replan(*given)
        looked_s.append((result.report.checked_until_s, result.report.kept_until_s, result.plan.duration()))
        return result

    monkeypatch.setattr(planner_module, "replan", noted)
    with Planner(plan, horizon=6) as planner:
        for time_s in (0.6, 0.7):
            planner.submit(state(planner.plan, time_s - planner.begins_s, clock_s=time_s))
            update = planner.wait()
            assert update.status == "solved"
            planner.take_over(update)
    # The first plan came from a file or a search: the planner does not know what the checker says of it,
    first, second = looked_s
    assert first[0] == first[2] and second[0] < second[2]
    assert second[1] == second[2] and mp.check(update.plan).ok()
    # but where it is told, which says nothing of plans that it takes over later.
    with Planner(plan, horizon=6, previous_accepted=True) as planner:
        planner.submit(state(plan, 0.6, clock_s=0.6))
        update = planner.wait()
        planner.take_over(replace(update, status="acceptable"))
        planner.submit(state(update.plan, 0.1, clock_s=0.7))
        planner.wait()
    told, taken_over = looked_s[2:]
    assert told[0] < told[2] and taken_over[0] == taken_over[2]


def test_a_state_that_waits_is_replaced_by_a_later_one(plan):
    with Planner(plan) as planner:
        for t in (0.5, 0.6, 0.7, 0.8):
            last = planner.submit(state(plan, t))
        update = planner.wait()
    assert update.ticket == last and update.begins_s == 0.8


@pytest.mark.parametrize(
    ("wrong", "error", "named"),
    [
        ({"plan": "plan.npz"}, InvalidArgument, "update.plan"),
        ({"begins_s": np.nan}, mp.InvalidInput, "update.begins_s"),
        ({"begins_s": "now"}, InvalidArgument, "update.begins_s"),
    ],
)
def test_an_update_made_by_hand_is_refused_where_it_says_nothing(plan, wrong, error, named):
    good = Update(plan, 0.5, 0.01, "solved", True, 1.0, "", "same_sequence", 1)
    with Planner(plan) as planner:
        with pytest.raises(error, match=named):
            planner.take_over(replace(good, **wrong))
        assert planner.plan is plan and planner.begins_s == 0.0
        planner.take_over(good)
        assert planner.begins_s == 0.5


def threads():
    return [thread for thread in threading.enumerate() if thread.name == "mcplan.online"]


@pytest.mark.parametrize("submitted", [False, True])
def test_a_planner_that_nobody_uses_any_more_ends_its_thread_without_being_closed(plan, submitted):
    planner = Planner(plan)
    mine = planner._thread
    if submitted:
        planner.submit(state(plan, 1.0))
    del planner
    gc.collect()
    mine.join(timeout=60.0)
    assert not mine.is_alive() and mine not in threads()


def test_python_ends_while_a_planner_computes():
    script = """
import mcplan as mp
import mcplan.online.planner as planner_module
from planned_states import state_at
from mcplan.online import MeasuredState, Planner
plan = mp.plan("flat", "talos").plan
knot, contacts = state_at(plan, 1.0)
knot.com_velocity_W = knot.com_velocity_W + [0.0, 0.3, 0.0]
planner = Planner(plan)
planner.submit(MeasuredState(1.0, knot, tuple(contacts)))
while planner._mailbox._waiting:  # until the thread has taken it
    pass
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=Path(__file__).parent)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("raised", [KeyboardInterrupt, SystemExit])
def test_a_logger_that_raises_ends_no_thread(plan, raised):
    def log(*_):
        raise raised

    with Planner(plan, logger=log) as planner:
        for _ in range(2):
            planner.submit(state(plan, 1.0, push=(0.0, 0.2, 0.0)))
            update = planner.wait(60.0)
            assert update.status == "error" and not planner.busy


def test_a_state_from_before_the_plan_under_way_is_refused(plan):
    with Planner(plan, begins_s=100.0) as planner:
        planner.submit(state(plan, 1.0))
        assert "state.time_s: must be no earlier than the plan under way, 100, got 1.0" in planner.wait().message


def test_a_state_that_is_refused_leaves_the_plan_and_the_thread_alone(plan):
    bad = state(plan, 1.0)
    bad.knot.com_W = [np.nan, 0.0, 0.8]
    with Planner(plan) as planner:
        planner.submit(bad)
        update = planner.wait()
        assert not update.usable and update.plan is None and "com_W" in update.message
        with pytest.raises(mp.InvalidInput, match="must have a plan"):
            planner.take_over(update)
        planner.submit(state(plan, 1.0))
        assert planner.wait().usable and planner.plan is plan


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        (None, "state"),
        (MeasuredState(0.0, None, (0, 0)), "state.knot"),
        (MeasuredState(np.nan, mp.model.Knot(), (0, 0)), "state.time_s"),
        (MeasuredState(0.0, mp.model.Knot(), "left"), "state.contacts"),
        (MeasuredState(0.0, mp.model.Knot(), None), "state.contacts"),
        (MeasuredState(0.0, mp.model.Knot(), (0, 0), (1.0, 0.0)), "state.push"),
    ],
)
def test_what_is_no_state_is_refused_when_it_is_submitted(plan, wrong, field):
    with Planner(plan) as planner:
        with pytest.raises(mp.InvalidInput, match=f"^{field}: "):
            planner.submit(wrong)
        assert not planner.busy


def test_robots_without_joints_are_refused_before_a_plan_is_searched(monkeypatch):
    monkeypatch.setattr("mcplan.running.solve", lambda *_: pytest.fail("searched"))
    with pytest.raises(mp.InvalidInput, match="^humanoid44: urdf: must name a URDF"):
        mp.run("flat", "humanoid44")


def test_closing_ends_the_thread(plan):
    before = threading.active_count()
    planner = Planner(plan)
    planner.close()
    assert threading.active_count() == before
    with pytest.raises(mp.InvalidInput, match="must be open"):
        planner.submit(state(plan, 1.0))


def test_a_foot_that_is_about_to_land_is_not_kicked_up(plan):
    t = next(
        t
        for t in np.arange(0.3, 3.0, 0.01)
        if plan.at(t).end_effectors[0].surface < 0 or plan.at(t).end_effectors[1].surface < 0
    )
    foot = next(i for i in (0, 1) if plan.at(t).end_effectors[i].surface < 0)
    lands = next(s for s in np.arange(t, 5.0, 0.002) if plan.at(s).end_effectors[foot].surface >= 0)
    measured = state(plan, lands - 0.05)
    result = mp.replan(plan, lands - 0.05, measured.knot, contacts=list(measured.contacts)).plan
    swings = result.swings
    for swing in swings:
        assert swing.elapsed_s > 0.1 if (swing.end_effector, swing.first_phase) == (foot, 0) else swing.elapsed_s == 0.0
        swing.height, swing.elapsed_s = 0.1, 0.0  # lifted anew
    result.swings = swings
    kicked = max(abs(result.at(s).end_effectors[foot].velocity_W[2]) for s in np.arange(0.0, 0.045, 0.002))
    calm = max(
        abs(with_feet_kept_up(result).at(s).end_effectors[foot].velocity_W[2]) for s in np.arange(0.0, 0.045, 0.002)
    )
    planned = max(abs(plan.at(s).end_effectors[foot].velocity_W[2]) for s in np.arange(lands - 0.05, lands, 0.002))
    assert kicked > 3.0 and calm < planned + 0.6
    assert all(s.height == 0.1 for s in result.swings if s.first_phase > 0)


def test_replans_are_due_by_the_period_at_touchdowns_and_off_the_plan(plan):
    pace, now = Pace(OnlineOptions(period_s=0.1, pause_s=0.03)), plan.at(1.0)
    com, velocity = np.array(now.com_W), np.array(now.com_velocity_W)
    assert pace.due(0.05, False, plan, 1.0, com, velocity) is None
    assert pace.due(0.1, False, plan, 1.0, com, velocity) == "period"
    assert pace.due(0.05, True, plan, 1.0, com, velocity) == "touchdown"
    pace.asked(0.05)
    assert pace.due(0.06, True, plan, 1.0, com, velocity) is None  # too soon, but not forgotten
    assert pace.due(0.08, False, plan, 1.0, com, velocity) == "touchdown"
    pace.asked(0.08)
    assert pace.due(0.12, False, plan, 1.0, com + [0.0, 0.03, 0.0], velocity) == "CoM"
    assert pace.due(0.12, False, plan, 1.0, com, velocity + [0.0, 0.2, 0.0]) == "capture point"


def test_the_capture_point_is_that_of_the_pendulum(plan):
    now = plan.at(1.0)
    off, speed = np.array([0.01, -0.02, 0.0]), np.array([0.1, 0.2, 0.0])
    com_m, capture_m = distances(plan, 1.0, now.com_W + off, now.com_velocity_W + speed)
    time_s = np.sqrt(plan.robot.com_height / plan.scene.gravity)
    assert com_m == pytest.approx(np.linalg.norm(off)) and capture_m == pytest.approx(
        np.linalg.norm(off + time_s * speed)
    )
    assert distances(plan, plan.duration() + 5.0, plan.at(plan.duration()).com_W, np.zeros(3)) == (0.0, 0.0)


def test_nothing_is_replanned_where_only_standing_is_left(plan):
    assert steps_left(plan, 0.0) and not steps_left(plan, plan.duration() - 0.01)
    assert not steps_left(plan, plan.duration() + 1.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *(("period_s", 0.0), ("latency_s", -0.1), ("command", ((1.0, 0.0),)), ("com_margin_m", 0.0), ("pause_s", 2.0)),
        *(("command", ((1e12, 0.1, 0.0, 0.0),)), ("goal", ((3601.0, 1.0, 0.0, 0.0),))),
        *(("start_slack_s", 3.1), ("start_slack_s", 0.0), ("time_limit_s", 0.0), ("keep_s", 0.0)),
    ],
)
def test_options_out_of_range_are_refused_by_name(name, value):
    with pytest.raises(mp.errors.InvalidOptions, match=name):
        OnlineOptions(**{name: value}).validate()


@pytest.mark.parametrize("value", [5, "100", ["100"], [b"100"], np.zeros(()), (10**400, 0.0, 0.0), [(0.1, "0", 0.0)]])
def test_what_is_no_velocity_is_refused(value):
    for name in ("command", "goal"):
        with pytest.raises(mp.errors.InvalidOptions, match=f"{name}: must be numbers"):
            chosen_options({name: value})


@pytest.mark.parametrize(
    "named", [{"command": ((0.0, 0.1, 0.0, 0.0),)}, {"goal": ((0.0, 1.0, 0.0, 0.0),)}, {"told_at_s": 1.0}]
)
def test_a_robot_that_follows_one_plan_is_led_nowhere_else(named):
    OnlineOptions(**named).validate()
    with pytest.raises(mp.errors.InvalidOptions, match=f"{next(iter(named))}: must not be given without replanning"):
        OnlineOptions(replanning=False, **named).validate()


@pytest.mark.parametrize(
    ("named", "says"),
    [
        ({"command": ((0.0, 0.1, 0.0, 0.0), (6.0, 0.1, 0.0, 0.0))}, r"command\[1\] at_s: must not lie after the end"),
        ({"goal": ((6.0, 1.0, 0.0, 0.0),)}, r"goal\[0\] at_s: must not lie after the end of the run, 5 s, got 6"),
        ({"told_at_s": 6.0}, "told_at_s: must not lie after the end of the run"),
    ],
)
def test_what_would_never_come_to_pass_is_refused(named, says):
    OnlineOptions(**named).require_within(6.0)
    with pytest.raises(mp.errors.InvalidOptions, match=says):
        OnlineOptions(**named).require_within(5.0)


@pytest.mark.parametrize(
    ("named", "says"),
    [
        ({"begins_s": float("nan")}, "begins_s: must be finite"),
        ({"begins_s": "now"}, "begins_s: must be a number"),
        ({"period_s": -1.0}, "period_s: must be positive"),
        ({"command": (1.0,)}, "command: must be a ddp.VelocityCommand or three numbers"),
        ({"latensy": 3.0}, "latensy: no such option"),
        ({"start_slack_s": -1.0}, "start_slack_s"),
        ({"height_margin_m": -0.1}, "height_margin_m: must be 0 at least"),
        ({"turn_margin_rad_s": -0.1}, "turn_margin_rad_s: must be 0 at least"),
        ({"turn_margin_rad_s": "a"}, "turn_margin_rad_s: must be a number"),
        ({"height_margin_m": float("nan")}, "height_margin_m: must be 0 at least"),
        ({"height_margin_m": "a"}, "height_margin_m: must be a number"),
    ],
)
def test_a_planner_is_not_made_of_what_it_cannot_plan_with(plan, named, says):
    threads = threading.active_count()
    with pytest.raises((mp.errors.InvalidInput, mp.errors.InvalidOptions, mp.errors.InvalidArgument), match=says):
        Planner(plan, **named)
    assert threading.active_count() == threads
    with pytest.raises(mp.errors.InvalidArgument, match="plan: must be a Plan"):
        Planner(None)
    with Planner(plan) as planner, pytest.raises(mp.errors.InvalidArgument, match="update: must be an? Update"):
        planner.take_over(None)


def test_legs_that_catch_a_robot_reach_as_far_as_their_joints_let_them():
    robot = mp.load_robot("talos")
    before, wide = robot.__copy__(), widened(robot)
    assert robot == before and wide != robot
    for old, new in zip(robot.end_effectors, wide.end_effectors, strict=True):
        if old.kind != "foot":
            assert new == old
            continue
        assert (np.array(new.reach_min_B) <= old.reach_min_B).all() and (
            np.array(new.reach_max_B) >= old.reach_max_B
        ).all()
        assert new.limb == old.limb  # hips, knees and ankles stay as they are
        (row,), (bound,) = (
            new.partner_reach[{"right_foot": "left_foot", "left_foot": "right_foot"}[new.name]].A,
            [-0.14],
        )
        side = np.sign(new.nominal_B[1])
        assert (
            row @ [0.0, -side * 0.15, 0.0] < bound < row @ [0.0, -side * 0.13, 0.0]
        )  # 14 cm apart, on their own sides
    for name in ("humanoid44", "go2"):  # nothing is known of their joints, or they have four feet
        other = mp.load_robot(name)
        assert widened(other) is other
