"""Walking with rhp replanning at touchdowns: steps stay those that are given, time is honest, what cannot be is named."""

import dataclasses

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import rhp
from mcplan.online import HorizonPlanner, MeasuredState, OnlineOptions, RunResult
from mcplan.online.horizon_loop import ITERATIONS, TIME_LIMIT_S, limits
from mcplan.online.horizon_planner import (
    LEAST_S,
    REACH_SLACK_M,
    online_options,
    predicted,
    reaching,
    steps_made,
    steps_of,
)
from mcplan.online.pacing import TouchdownPace
from planned_states import state_at

LATENCY = 0.1


@pytest.fixture(scope="module")
def plan():
    """Two steps on the flat, to rest."""
    options = online_options(LATENCY, {"cycles": 2})
    steps = mp.walk("flat", "talos", options).plan
    return mp.walk("flat", "talos", options, sequence=steps).plan


def measured_at(plan, t, contacts, off_m=(0.0, 0.0, 0.0)):
    """The planned state with the CoM off."""
    knot, _ = state_at(plan, t)
    knot.com_W = knot.com_W + np.array(off_m)
    return MeasuredState(t, knot, contacts)


def test_steps_of_a_plan_are_those_that_lie_there(plan):
    second = steps_of(plan, 1, 2)
    second.validate()
    assert second.duration() == pytest.approx(sum(phase.duration for phase in plan.phases[3:]))
    assert list(second.knots) == list(plan.knots)[3:] and second.final_contacts == plan.final_contacts
    first = steps_of(plan, 0, 1)
    first.validate()
    assert first.at(first.duration()).com_W == pytest.approx(plan.knots[3].com_W)
    for part in (first, second):
        assert all(0 <= swing.first_phase < swing.end_phase <= 3 for swing in part.swings)
        assert len({swing.end_effector for swing in part.swings}) == len(part.swings) == 3  # a foot and both hands


def test_a_step_is_made_once_its_foot_has_landed_early_or_late(plan):
    times = plan.knot_times()
    assert steps_made(plan, times[1] + 0.1) == 0 and steps_made(plan, times[2] - 0.05) == 1
    assert steps_made(plan, times[2] + 0.01) == steps_made(plan, times[4] + 0.01) == 1
    assert steps_made(plan, plan.duration() + 1.0) == 2


def test_a_horizon_begins_where_it_is_taken_over_and_goes_on_with_the_steps_left(plan):
    standing, off_m = plan.final_contacts, (0.002, -0.003, 0.001)
    landed = plan.knot_times()[2]
    with HorizonPlanner(plan, computing_s=LATENCY) as planner:
        planner.submit(measured_at(plan, landed, standing, off_m))
        update = planner.wait()
        assert update is not None and update.usable and update.begins_s == pytest.approx(landed + LATENCY), update
        assert update.plan.knots[0].com_W == pytest.approx(plan.at(landed + LATENCY).com_W + off_m)
        planner.take_over(update)
        assert planner.first_step == 1 and len(update.plan.phases) == 3
        swinging = [[c.surface >= 0 for c in p.phases[k].contacts] for p, k in ((plan, 4), (update.plan, 1))]
        assert swinging[0] == swinging[1]
        for knot, first in zip(update.plan.knots, list(plan.knots)[3:], strict=True):
            assert list(knot.base_rpy) == list(first.base_rpy)
        free = measured_at(plan, landed, tuple(-1 for _ in standing))
        planner.submit(free)
        refused = planner.wait()
    assert refused is not None and not refused.usable and "must have both feet on surfaces" in refused.message


def test_a_prediction_goes_on_beside_the_plan_until_shortly_before_a_foot_leaves(plan):
    times, off_m = plan.knot_times(), np.array([0.01, 0.02, -0.01])
    landed, lifts = times[2], times[4]
    for ahead_s, until in ((0.1, landed + 0.1), (10.0, lifts - LEAST_S)):
        then = predicted(measured_at(plan, landed, plan.final_contacts, off_m), plan, 0.0, ahead_s)
        assert then.time_s == pytest.approx(until)
        assert then.knot.com_W == pytest.approx(plan.at(until).com_W + off_m)
        assert then.knot.com_velocity_W == pytest.approx(plan.at(until).com_velocity_W)
        for place_W, now in zip(then.knot.end_effectors_W, plan.at(landed).end_effectors, strict=True):
            assert np.array_equal(place_W, now.position_W)
    early = predicted(measured_at(plan, landed - 0.05, plan.final_contacts), plan, 0.0, 10.0)
    assert early.time_s == pytest.approx(lifts - LEAST_S)
    for t in (lifts - 0.5 * LEAST_S, plan.duration(), plan.duration() + 1.0):  # too late to wait
        assert predicted(MeasuredState(t, state_at(plan, min(t, plan.duration()))[0], ()), plan, 0.0, 0.1).time_s == t


@pytest.mark.parametrize("robot", ["talos", "talos_wang"])
def test_reach_gives_way_to_a_measured_start_and_no_further(robot):
    """Boxes and polytopes, looked at by their definition alone."""
    robot = mp.load_robot(robot)
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    height, beyond = float(robot.com_height), np.array([0.4, 0.0, 0.0])

    def start(ahead_W):
        feet_W = [np.asarray(robot.end_effectors[i].nominal_B) + [0, 0, height] for i in feet]
        return rhp.State(com_W=np.array([0.0, 0.0, height]) + ahead_W, feet_W=feet_W, surfaces=[0, 0])

    def excess(of, state):
        found = []
        for foot, place in zip(feet, state.feet_W, strict=True):
            end, from_com = of.end_effectors[foot], np.asarray(place) - state.com_W
            if end.com_reach.given:
                found.append((np.asarray(end.com_reach.A) @ -from_com - end.com_reach.b).max())
            else:
                found.append(max((end.reach_min_B - from_com).max(), (from_com - end.reach_max_B).max()))
        return max(found)

    inside, outside = start(np.zeros(3)), start(beyond if robot.name == "talos" else 2 * beyond)
    assert excess(robot, inside) <= 0.0 < excess(robot, outside)
    assert excess(reaching(robot, outside, 0.0), outside) == pytest.approx(-REACH_SLACK_M, abs=1e-9)
    farther = start(1.5 * beyond if robot.name == "talos" else 2.5 * beyond)
    assert excess(reaching(robot, outside, 0.0), farther) > 0.0
    same = reaching(robot, inside, 0.0)
    for foot in feet:
        one, other = robot.end_effectors[foot], same.end_effectors[foot]
        np.testing.assert_array_equal(one.usual_box(), other.usual_box())
        assert np.array_equal(one.com_reach.b, other.com_reach.b)


def test_horizons_with_a_fixed_latency_have_a_limit_on_iterations_and_others_on_time():
    assert limits(OnlineOptions(engine="rhp", latency_s=0.1)) == {"max_iterations": ITERATIONS}
    assert limits(OnlineOptions(engine="rhp")) == {"time_limit": TIME_LIMIT_S}
    assert limits(OnlineOptions(engine="rhp", latency_s=0.1, time_limit_s=0.2)) == {"time_limit": 0.2}


def test_horizons_are_asked_for_at_touchdowns_and_again_until_there_is_one():
    pace = TouchdownPace(OnlineOptions(engine="rhp", period_s=0.1))
    assert pace.due_standing(1.0, False, True) is None
    assert pace.due_standing(1.0, True, False) is None
    assert pace.due_standing(1.01, False, True) == "touchdown"
    pace.asked(1.01)
    pace.failed = True
    assert pace.due_standing(1.05, False, True) is None and pace.due_standing(1.11, False, True) == "again"
    pace.failed = False
    assert pace.due_standing(1.3, False, True) is None


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"engine": "sip"}, "engine: must be 'ddp' or 'rhp'"),
        ({"engine": 3}, "engine: must be a str"),
        ({"engine": "rhp", "command": (0.1, 0.0, 0.0)}, "command: must not be given with engine 'rhp'.*'ddp'"),
        ({"engine": "rhp", "goal": (1.0, 0.0)}, "goal: must not be given with engine 'rhp'.*'ddp'"),
        ({"engine": "rhp", "at_touchdowns": False}, "at_touchdowns: must be true with engine 'rhp'"),
    ],
)
def test_what_given_steps_cannot_follow_is_refused_by_name(plan, told, message):
    pytest.importorskip("mujoco")
    with pytest.raises(mp.errors.InvalidOptions, match=message):
        mp.run(plan, **told)


def test_plans_are_replanned_by_the_engine_that_can(plan):
    pytest.importorskip("mujoco")
    with pytest.raises(mp.InvalidInput, match="engine 'rhp'"):
        mp.run(plan)
    other = plan.__copy__()
    other.planner = "ddp"
    with pytest.raises(mp.errors.InvalidPlan, match="must be one of rhp"):
        HorizonPlanner(other)


@pytest.mark.parametrize(
    ("given", "named", "message"),
    [
        ("no plan", {}, "plan: must be a Plan"),
        ("plan", {"computing_s": "soon"}, "computing_s: must be a number"),
        ("plan", {"computing_s": -0.05}, "computing_s: must be finite and at least 0, got -0.05"),
        ("plan", {"computing_s": float("nan")}, "computing_s: must be finite and at least 0, got nan"),
        ("plan", {"colour": 3}, "colour: no such option"),
        ("nan", {}, "knots\\[3\\]: must be finite numbers"),
    ],
)
def test_what_no_horizons_can_be_planned_with_is_refused_by_name(plan, given, named, message):
    spoiled, knots = plan.__copy__(), list(plan.knots)
    knots[3] = knots[3].__copy__()
    knots[3].com_W = [float("nan")] * 3
    spoiled.knots = knots
    with pytest.raises(mp.InvalidInput, match=message):
        HorizonPlanner({"no plan": None, "plan": plan, "nan": spoiled}[given], **named)


def test_states_that_do_not_fit_are_named_and_the_plan_under_way_stays(plan):
    landed = plan.knot_times()[2]
    far = tuple(99 if surface >= 0 else -1 for surface in plan.final_contacts)
    with HorizonPlanner(plan, computing_s=LATENCY) as planner:
        for state, message in (
            (MeasuredState(landed, mp.model.Knot(), (0, 0)), "state: must have a place and a contact for each"),
            (measured_at(plan, landed, far), "state.contacts: must be indices of surfaces"),
            (measured_at(plan, plan.duration(), plan.final_contacts), "must be measured before the last step"),
        ):
            planner.submit(state)
            update = planner.wait()
            assert update.status == "error" and not update.usable and message in update.message
        assert planner.plan is plan and planner.first_step == 0


def test_a_run_is_planned_anew_at_a_touchdown_and_repeats_to_the_byte(plan, tmp_path):
    for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
        pytest.importorskip(name)
    told = {"engine": "rhp", "latency": LATENCY, "duration": 2.0, "self_contacts": False}
    first, second = (mp.run(plan, **told) for _ in range(2))
    assert first.online.reasons == {"touchdown": 1} and first.online.replans_used == 1 and not first.measures.fell
    followed = first.plans[1]
    assert followed.from_s >= followed.begins_s - 1e-9 and first.online.latency_ms == pytest.approx(1e3 * LATENCY)
    assert first.measures.com_max_m < 0.01
    first.save(tmp_path / "run.npz")
    again = RunResult.load(tmp_path / "run.npz")
    assert isinstance(again, RunResult) and str(again) == str(first) and again.online_options.engine == "rhp"
    for item in dataclasses.fields(first.recording):
        value = getattr(first.recording, item.name)
        if isinstance(value, np.ndarray):
            assert value.tobytes() == getattr(second.recording, item.name).tobytes(), item.name


def test_where_no_horizon_comes_the_plan_under_way_goes_on(plan, monkeypatch):
    for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
        pytest.importorskip(name)
    from mcplan.online import horizon_planner

    def refuse(*_):
        raise mp.InvalidInput("test", "must fail")

    monkeypatch.setattr(horizon_planner, "start_state", refuse)
    run = mp.run(plan, engine="rhp", latency=LATENCY, duration=2.0, self_contacts=False)
    assert not run.measures.fell and run.online.replans_used == 0 and len(run.plans) == 1
    assert run.online.statuses == {"error": run.online.replans} and run.online.reasons["again"] >= 1


def test_slopes_are_walked_with_a_base_that_turns_as_for_whole_plans():
    for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
        pytest.importorskip(name)
    from mcplan.kinematics.rotations import from_rpy, rotation_vector, rotations_of
    from mcplan.kinematics.urdf_model import load_model
    from mcplan.online.horizon_bases import with_bases
    from mcplan.tracking.postures import postures_along

    options = online_options(LATENCY, {"cycles": 4})
    steps = mp.walk("up_and_down", "talos", options).plan
    walk = mp.walk("up_and_down", "talos", options, sequence=steps).plan
    urdf_model, dt_s = load_model(walk.robot), 0.05
    times = np.arange(int(walk.duration() / dt_s)) * dt_s
    planned = from_rpy(with_bases(walk, urdf_model).sample(times).base_rpy)
    tracked = rotations_of(postures_along(urdf_model, walk, len(times), dt_s)[:, 3:7])
    off = [np.linalg.norm(rotation_vector(a @ b.T)) for a, b in zip(planned, tracked, strict=True)]
    turned = [np.linalg.norm(rotation_vector(b)) for b in tracked]
    assert max(turned) > 0.05 and max(off) < max(turned) and np.mean(off) < 0.25 * np.mean(turned)
    run = mp.run(walk, engine="rhp", latency=LATENCY, self_contacts=False)
    assert not run.measures.fell and run.online.replans_used == 3 and run.measures.com_max_m < 0.02
