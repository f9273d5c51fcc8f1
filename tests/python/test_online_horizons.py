"""Walking with rhp replanning at touchdowns: steps stay those that are given, time is honest, what cannot be is named."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan.online import HorizonPlanner, MeasuredState, OnlineOptions, RunResult
from mcplan.online.horizon_planner import online_options, steps_made, steps_of
from mcplan.online.pacing import TouchdownPace

LATENCY = 0.1


@pytest.fixture(scope="module")
def plan():
    """Two steps on the flat, to rest."""
    options = online_options(LATENCY, {"cycles": 2})
    steps = mp.walk("flat", "talos", options).plan
    return mp.walk("flat", "talos", options, sequence=steps).plan


def state_at(plan, t, contacts):
    planned = plan.at(t)
    knot = mp.model.Knot(
        com_W=planned.com_W,
        com_velocity_W=planned.com_velocity_W,
        base_rpy=planned.base_rpy,
        angular_momentum_W=planned.angular_momentum_W,
        end_effectors_W=[end.position_W for end in planned.end_effectors],
    )
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


def test_a_horizon_begins_at_the_measured_state_and_goes_on_with_the_steps_left(plan):
    standing = plan.final_contacts
    landed = plan.knot_times()[2]
    with HorizonPlanner(plan, computing_s=LATENCY) as planner:
        planner.submit(state_at(plan, landed, standing))
        update = planner.wait()
        assert update is not None and update.usable and update.begins_s == landed, update
        assert update.plan.knots[0].com_W == pytest.approx(plan.at(landed).com_W)
        planner.take_over(update)
        assert planner.first_step == 1 and len(update.plan.phases) == 3
        swinging = [[c.surface >= 0 for c in p.phases[k].contacts] for p, k in ((plan, 4), (update.plan, 1))]
        assert swinging[0] == swinging[1]
        assert update.plan.phases[0].duration > LATENCY
        free = state_at(plan, landed, tuple(-1 for _ in standing))
        planner.submit(free)
        refused = planner.wait()
    assert refused is not None and not refused.usable and "must have both feet on surfaces" in refused.message


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
    with pytest.raises(mp.errors.InvalidPlan, match="must be one of rhp"):
        HorizonPlanner(SimpleNamespace(planner="ddp", phases=[0, 0, 0]))


def test_a_run_is_planned_anew_at_a_touchdown_and_repeats_to_the_byte(plan, tmp_path):
    for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
        pytest.importorskip(name)
    told = {"engine": "rhp", "latency": LATENCY, "duration": 2.0, "self_contacts": False}
    first, second = (mp.run(plan, **told) for _ in range(2))
    assert first.online.reasons == {"touchdown": 1} and first.online.replans_used == 1 and not first.measures.fell
    followed = first.plans[1]
    assert followed.from_s >= followed.begins_s + LATENCY - 1e-9
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
