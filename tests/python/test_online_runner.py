"""Walking with replanning in simulation: time is honest, runs repeat, and pushes that were falls are survived."""

import dataclasses
import json

import numpy as np
import pytest

import mcplan as mp

for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
    pytest.importorskip(name)

from mcplan.cli import main  # noqa: E402
from mcplan.online.result import RunResult  # noqa: E402
from mcplan.tracking import Measures  # noqa: E402

LATENCY = 0.02


@pytest.fixture(scope="module")
def plan():
    return mp.plan("flat", "talos").plan


def test_runs_with_a_fixed_latency_are_the_same_to_the_byte(plan):
    first, second = (mp.run(plan, latency=LATENCY, duration=0.4, self_contacts=False) for _ in range(2))
    for item in dataclasses.fields(first.recording):
        value = getattr(first.recording, item.name)
        if isinstance(value, np.ndarray):
            assert value.tobytes() == getattr(second.recording, item.name).tobytes(), item.name
    assert first.online.replans == second.online.replans >= 3
    assert [f.plan.knots for f in first.plans] == [f.plan.knots for f in second.plans]


def test_no_plan_is_followed_before_its_computation_would_have_ended(plan):
    fixed = mp.run(plan, latency=LATENCY, duration=0.4, self_contacts=False)
    assert len(fixed.plans) > 2
    for followed in fixed.plans[1:]:
        assert followed.from_s >= followed.begins_s + LATENCY - 1e-9
    assert fixed.online.latency_ms == pytest.approx(1e3 * LATENCY)
    true = mp.run(plan, duration=0.4, self_contacts=False)
    for followed in true.plans[1:]:
        assert followed.from_s >= followed.begins_s + followed.took_s - 1e-9
    assert true.online.replans_late is None and true.online.latency_ms > 0.0


def test_references_go_on_without_jumps(plan):
    run = mp.run(plan, latency=LATENCY, duration=0.6, self_contacts=False).recording
    step = run.times_s[1]
    fastest = np.linalg.norm(np.diff(run.com_plan_W, axis=0), axis=1).max() / step
    assert fastest < 0.5  # a jump of 2 mm would be 1 m/s
    assert np.linalg.norm(np.diff(run.com_plan_W, n=2, axis=0), axis=1).max() / step**2 < 50.0


@pytest.mark.parametrize("mass_scale", [1.1, 0.9])
def test_a_robot_of_another_mass_than_its_model_keeps_its_height(plan, mass_scale):
    """Plan after plan from the measured height it came down by 0.13 m in these 3 s, or rose by 43 mm."""
    told = {"mass_scale": mass_scale, "latency": LATENCY, "command": (0.0, 0.0, 0.0), "self_contacts": False}
    run = mp.run(plan, duration=3.0, **told)
    height_m = run.recording.com_W[:, 2]
    assert not run.measures.fell and np.ptp(height_m) < 0.015


def test_a_push_that_is_a_fall_open_loop_is_survived(plan):
    """250 N to the left for 0.2 s as the left foot has left the ground."""
    told = {"push": (250.0, 0.2, 1.4, 90.0), "latency": LATENCY, "self_contacts": False, "duration": 3.2}
    followed = mp.run(plan, replanning=False, **told)
    assert followed.measures.fell and followed.online.replans == 0
    replanned = mp.run(plan, **told)
    assert not replanned.measures.fell and replanned.online.contact_changes > 0
    assert replanned.online.replans_used > 20 and replanned.online.oldest_plan_s < 0.5
    assert "error" not in replanned.online.statuses  # as replans from a stand had, which nobody saw


@pytest.mark.parametrize(("at_s", "direction_deg"), [(2.17, 270.0), (2.44, 90.0)])
def test_a_push_is_caught_by_steps_that_the_plan_did_not_have(plan, at_s, direction_deg):
    """As a foot lifts, to the side on which it is; and in the middle of a swing, outward over the foot that stands."""
    told = {"push": (250.0, 0.2, at_s, direction_deg), "latency": LATENCY, "self_contacts": False}
    run = mp.run(plan, duration=at_s + 2.0, **told)
    assert not run.measures.fell and "error" not in run.online.statuses
    assert any("steps that catch a push" in followed.message for followed in run.plans)


def test_the_command_prints_what_track_prints_and_how_planning_went(plan, tmp_path, capsys):
    file, run = tmp_path / "plan.npz", tmp_path / "run.npz"
    plan.save(file)
    words = ["run", file, "--latency", LATENCY, "--duration", 0.3, "--push", "50,0.1,0.1,90", "--json", "--save", run]
    code = main([str(word) for word in words])
    out = json.loads(capsys.readouterr().out)
    assert code == 0 and out["followed"] and out["options"]["pushes"][0]["force_N"] == 50.0
    keys = {"replans", "replans_used", "replan_ms_median", "replan_ms_p99", "latency_ms", "oldest_plan_s"}
    assert keys | {"contact_changes", "replans_late"} <= set(out)
    assert {item.name for item in dataclasses.fields(Measures)} <= set(out)
    assert out["latency_ms"] == pytest.approx(20.0) and out["replans"] >= 2
    assert mp.track is not None and len(run.read_bytes()) > 1000


def test_a_run_says_what_it_reached_of_a_velocity_that_no_robot_walks_at(plan, tmp_path, capsys):
    file = tmp_path / "plan.npz"
    plan.save(file)
    words = ["run", str(file), "--latency", str(LATENCY), "--duration", "0.5", "--command", "5,0,0"]
    assert main([*words, "--json"]) == 0
    (out,) = json.loads(capsys.readouterr().out)["command_reached"]
    assert out["commanded"] == [5.0, 0.0, 0.0] and (out["from_s"], out["to_s"]) == (0.0, 0.5)
    assert 0.0 < out["reached"][0] < 0.5
    assert main(words) == 0
    assert f"velocity reached            ahead {out['reached'][0]:.3f}" in capsys.readouterr().out


def test_another_robot_that_cannot_follow_the_plan_is_warned_of_as_track_does(plan, tmp_path, capsys):
    light = plan.__copy__()
    robot = plan.robot.__copy__()
    robot.mass *= 0.8
    light.robot = robot
    file = tmp_path / "plan.npz"
    light.save(file)
    words = ["run", str(file), "--latency", str(LATENCY), "--duration", "0.1"]
    assert main([*words, "--push", "10,0.1,9,0"]) == 2
    assert capsys.readouterr().err.startswith("error: --push: at: must lie before the end of the run")
    assert main([*words, "--robot", "talos"]) == 0
    assert capsys.readouterr().err.startswith("warning: talos cannot follow the plan: mass at 0.00 s: 0.2, limit 0.1")
    assert main([*words, "--robot", "talos", "--quiet"]) == main(words) == 0
    assert "warning" not in capsys.readouterr().err


@pytest.mark.parametrize(("robot", "duration"), [("g1", 1.75), pytest.param("talos", 5.0, marks=pytest.mark.slow)])
def test_legs_and_arms_that_swing_do_not_turn_the_base_in_replans(robot, duration):
    """They carry momentum that the base does not have: every plan has to lead on to the goal."""
    run = mp.run("flat", robot, latency=LATENCY, duration=duration, self_contacts=False)
    assert not run.measures.fell and run.online.replans_used == run.online.replans >= 15
    for followed in run.plans:
        assert followed.plan.knots[-1].com_W[:2] == pytest.approx((2.0, 0.0), abs=0.01)
        assert max(abs(knot.base_rpy[2]) for knot in followed.plan.knots) < 0.06


@pytest.mark.slow
def test_a_goal_that_is_turned_is_reached_with_straight_knees(plan):
    goal = (0.4, 0.2, np.pi / 2)
    run = mp.run(plan, goal=(*goal, 0.5), latency=LATENCY, self_contacts=False)
    assert not run.measures.fell
    x, y, z, w = run.recording.configurations[-1, 3:7]
    assert run.recording.com_W[-1, :2] == pytest.approx(goal[:2], abs=0.03)
    assert np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)) == pytest.approx(goal[2], abs=0.05)
    assert run.recording.com_W[:, 2].min() > 0.92 * plan.robot.com_height


def test_a_goal_that_changes_while_walking_is_planned_to_from_its_time_on(plan):
    run = mp.run(plan, goal=(1.2, 0.3, 0.0, 0.5), latency=LATENCY, self_contacts=False, duration=1.2)
    assert not run.measures.fell and run.online.reasons["goal"] >= 1 and run.online.stops == 0
    for followed in run.plans:
        goal = (1.2, 0.3) if followed.begins_s >= 0.5 - 1e-9 else plan.scene.goal.position_W[:2]
        assert followed.plan.scene.goal.position_W[:2] == pytest.approx(goal)
        end = followed.plan.at(followed.plan.duration())
        assert end.com_W[:2] == pytest.approx(goal, abs=0.02)
    assert {tuple(f.plan.scene.goal.position_W[:2]) for f in run.plans} == {(2.0, 0.0), (1.2, 0.3)}


@pytest.fixture(scope="module")
def near():
    """A walk of 0.4 m."""
    scene = mp.load_scene("flat")
    goal = scene.goal.__copy__()
    goal.position_W = [0.4, 0.0, 0.0]
    scene.goal = goal
    return mp.plan(scene, "talos").plan


def refuse(monkeypatch, refused):
    """Let replans fail by whether they are refused: a function of how many were asked for and of the command."""
    from mcplan.online import planner

    asked = []

    def replan(*arguments):
        asked.append(arguments[4])
        if refused(len(asked), arguments[4]):
            raise mp.InvalidInput("test", "must not be planned")
        return real(*arguments)

    real = planner.replan
    monkeypatch.setattr(planner, "replan", replan)


@pytest.mark.slow
def test_a_robot_that_had_to_stand_walks_on_to_its_goal(near, monkeypatch):
    from mcplan.online.loop import STAND

    refuse(monkeypatch, lambda count, command: count <= 14 and command != STAND)
    run = mp.run(near, latency=LATENCY, stop_after_s=0.25, self_contacts=False)
    assert run.online.stops >= 1 and not run.measures.fell
    assert run.recording.com_W[-1, :2] == pytest.approx((0.4, 0.0), abs=0.02)
    assert run.online.goal_off_m < 0.02 and run.followed and "to the end" in str(run)


def test_a_run_goes_on_until_its_last_push_is_over_and_its_end_was_held(near):
    at_s = near.duration() + 1.5
    run = mp.run(near, latency=LATENCY, push=(20.0, 0.1, at_s, 90.0), hold_s=0.3, self_contacts=False)
    recording = run.recording
    assert recording.times_s[-1] == pytest.approx(at_s + 0.1 + 0.3, abs=0.01)
    impulse_W = np.diff(recording.times_s)[0] * recording.pushes_W.sum(axis=0)
    np.testing.assert_allclose(impulse_W, [0.0, 2.0, 0.0], rtol=1e-5, atol=1e-12)
    assert not run.measures.fell


@pytest.mark.slow
def test_a_robot_that_does_not_come_to_its_goal_says_so(near, monkeypatch):
    from mcplan.online.loop import STAND

    refuse(monkeypatch, lambda _, command: command != STAND)
    run = mp.run(near, latency=LATENCY, stop_after_s=0.25, self_contacts=False)
    off_m = np.linalg.norm(run.recording.com_W[-1, :2] - (0.4, 0.0))
    assert not run.measures.fell and off_m > 0.2 and run.online.goal_off_m == pytest.approx(off_m, abs=1e-3)
    assert not run.followed and f"{off_m:.2f} m off its goal" in str(run)


@pytest.mark.parametrize(
    ("told", "field"),
    [
        ({"goal": (1.0,)}, "goal"),
        ({"goal": (1.0, np.nan)}, "goal"),
        ({"goal": 3.0}, "goal"),
        ({"goal": "here"}, "goal"),
        ({"goal": [(1.0, 0.0, 0.0, 2.0), (1.0, 0.0, 0.0, 1.0)]}, "goal"),
        ({"goal": (1.0, 0.0, 0.0, -1.0)}, "goal"),
        ({"goal": (1.0, 0.0), "command": (0.1, 0.0, 0.0)}, "goal"),
    ],
)
def test_wrong_goals_are_refused_by_name(plan, told, field):
    with pytest.raises(mp.errors.InvalidOptions, match=field):
        mp.run(plan, **told)


def test_of_goals_and_commands_what_began_last_holds():
    from mcplan.online import OnlineOptions

    options = OnlineOptions(command=((1.0, 0.1, 0.0, 0.0),), goal=((0.0, 1.0, 0.0, 0.0), (2.0, 1.5, 0.3, 0.5)))
    options.validate()
    assert [options.command_at(t) for t in (0.5, 1.5, 2.5)] == [None, (0.1, 0.0, 0.0), None]
    assert options.goal_at(0.5) == (1.0, 0.0, 0.0) and options.goal_at(2.0) == (1.5, 0.3, 0.5)


def test_a_robot_for_which_no_plan_comes_is_brought_to_a_stand(plan, monkeypatch):
    from mcplan.online import loop, planner

    asked = []

    def only_to_stand(*arguments):
        asked.append(arguments[4])
        if arguments[4] != loop.STAND:
            raise mp.InvalidInput("test", "must stand")
        return replan(*arguments)

    replan = planner.replan
    monkeypatch.setattr(planner, "replan", only_to_stand)
    run = mp.run(plan, latency=LATENCY, duration=0.6, stop_after_s=0.25, self_contacts=False)
    assert run.online.stops >= 1 and run.online.replans_used >= 1 and not run.measures.fell
    assert asked[0] is None and loop.STAND in asked
    assert run.online.statuses["error"] >= 2


def test_commands_change_while_the_robot_walks(plan):
    command = [(0.1, 0.0, 0.0), (0.3, 0.0, 0.05, 0.2)]
    run = mp.run(plan, command=command, latency=LATENCY, duration=0.5, self_contacts=False)
    assert run.online_options.command == ((0.0, 0.1, 0.0, 0.0), (0.3, 0.0, 0.05, 0.2))
    assert run.online_options.command_at(0.2) == (0.1, 0.0, 0.0) and run.online_options.command_at(0.31) == (
        0.0,
        0.05,
        0.2,
    )
    turns = [followed.plan.knots[-1].base_rpy[2] for followed in run.plans]
    assert abs(turns[2]) < 0.05 < turns[-1] and not run.measures.fell


@pytest.mark.slow
def test_a_velocity_to_the_side_is_walked_at(plan):
    """Boxes of reach let Talos follow 0.075 m/s: its joints let it step farther out."""
    run = mp.run(plan, command=(0.0, 0.1, 0.0), latency=LATENCY, duration=7.0, self_contacts=False).recording
    late = run.times_s > 3.0
    assert np.polyfit(run.times_s[late], run.com_W[late, 1], 1)[0] > 0.09
    assert run.com_W[:, 2].min() > 0.95 * plan.robot.com_height


def test_a_velocity_is_walked_at(plan):
    run = mp.run(plan, command=(0.1, 0.0, 0.0), latency=LATENCY, duration=0.4, self_contacts=False)
    assert not run.measures.fell and run.online.replans_used >= 3
    assert all("m/s" in followed.message or followed.message for followed in run.plans[1:])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"latencies": 1}, "latencies: no such option"),
        ({"assist": True}, "assist: no such option"),
        ({"latency": "soon"}, "latency_s: must be a number"),
        ({"command": (1.0, 2.0)}, "command: must be three finite numbers, or four with a time before them, got 1, 2"),
        ({"command": (float("nan"), 0.0, 0.0)}, r"command: must be finite numbers, got \(nan, 0.0, 0.0\)"),
        ({"command": (50.0, 0.0, 0.0)}, "command: must have velocities of at most 10 .*, got 50, 0, 0"),
        (
            {"latency": 3.0},
            r"latency_s: must lie in 0 to 1 s, or be left out \(nan\): as long as its computation takes, got 3",
        ),
        (
            {"duration": -1.0},
            r"duration_s: must lie in 0.01 to 3600 s, or be left out \(nan\): as long as the walk takes, got -1",
        ),
        ({"push": (250.0, 0.2, 99.0, 0.0)}, r"pushes\[0\].at_s: must lie before the end"),
    ],
)
def test_wrong_options_are_named(plan, options, message):
    with pytest.raises(mp.InvalidInput, match=message):
        mp.run(plan, **options)


def test_a_scene_needs_a_robot():
    with pytest.raises(mp.InvalidInput, match="robot: must be given with a scene"):
        mp.run("flat")


@pytest.mark.slow
def test_pages_and_plots_show_what_was_followed(plan, tmp_path):
    """The timeline's planned contacts are those of the plans in turn; footholds are drawn as first planned and as made."""
    pytest.importorskip("meshcat")
    pytest.importorskip("matplotlib")
    from mcplan.showing import save_plots
    from mcplan.view.pages.show_run import _followed_contacts

    run = mp.run(plan, latency=LATENCY, duration=0.4, push=(60.0, 0.1, 0.1, 90.0), self_contacts=False)
    intervals = _followed_contacts(run.recording)
    assert {i.end_effector for i in intervals} == {0, 1}
    assert all(i.end_s == pytest.approx(0.4, abs=0.01) and i.start_s == 0.0 for i in intervals)
    page = tmp_path / "run.html"
    mp.show(run).save_html(page)
    assert "as first planned: footholds" in page.read_text()
    names = [path.name for path in save_plots(run, None, tmp_path)]
    assert "footholds.png" in names
    alone = mp.run(plan, replanning=False, duration=0.1, self_contacts=False)
    assert "footholds.png" not in [path.name for path in save_plots(alone, None, tmp_path)]


def test_plans_with_needless_steps_are_longer_than_what_is_left(plan):
    from mcplan.online.choice import longer

    t = 0.5 * (plan.knot_times()[-4] + plan.knot_times()[-3])  # three phases are left
    assert not longer(plan, plan, 0.0)
    assert longer(plan, plan, t) and len(plan.phases) > 4


def stairs(edit, planned):
    """The scene of a plan with its surfaces edited, by name."""
    scene = planned.scene.__copy__()
    surfaces = [surface.__copy__() for surface in planned.scene.surfaces]
    for surface in surfaces:
        edit(surface)
    scene.surfaces = surfaces
    return scene


@pytest.fixture(scope="module")
def stairs_plan():
    return mp.plan("stairs_broad", "talos").plan


def lower(surface):
    if surface.name.startswith("tread"):
        surface.vertices_W = np.asarray(surface.vertices_W) - [0.0, 0.0, 0.03]


def slippery(surface):
    if surface.name == "tread_1":
        surface.friction = 0.1


def test_a_foot_finds_a_tread_that_is_lower_and_plans_go_on_from_there(stairs_plan):
    run = mp.run(stairs_plan, true_scene=stairs(lower, stairs_plan), latency=LATENCY, duration=2.5, self_contacts=False)
    assert not run.measures.fell and run.online.ground_felt >= 1
    known = [max(np.asarray(f.plan.scene.surfaces[1].vertices_W)[:, 2]) for f in run.plans]
    assert known[0] == pytest.approx(0.1) and known[-1] == pytest.approx(0.07, abs=0.004)
    assert run.recording.true_scene is not None and run.recording.scene.surfaces[2] != stairs_plan.scene.surfaces[2]


@pytest.mark.slow
@pytest.mark.parametrize("edit", [lower, slippery])
def test_stairs_that_are_not_as_planned_are_climbed(stairs_plan, edit):
    """Three centimetres lower, or with a tread of friction 0.1 that is found by slipping."""
    true = stairs(edit, stairs_plan)
    run = mp.run(stairs_plan, true_scene=true, latency=LATENCY)
    assert not run.measures.fell and run.online.ground_felt >= 1 and run.online.stops == 0
    end = run.recording.com_W[-1] - np.asarray(stairs_plan.at(stairs_plan.duration()).com_W)
    assert np.linalg.norm(end[:2]) < 0.03


def test_saved_runs_keep_their_planning(plan, tmp_path):
    run = mp.run(plan, latency=LATENCY, duration=0.35, self_contacts=False, command=(0.1, 0.0, 0.0))
    run.save(tmp_path / "run.npz")
    again = RunResult.load(tmp_path / "run.npz")
    assert isinstance(again, RunResult) and str(again) == str(run)
    assert again.online == run.online and again.options == run.options
    assert again.online_options.command == run.online_options.command
    assert len(again.plans) == len(run.plans) > 2
    for one, other in zip(again.plans, run.plans, strict=True):
        assert (one.begins_s, one.from_s, one.took_s, one.message) == (
            other.begins_s,
            other.from_s,
            other.took_s,
            other.message,
        )
        assert one.plan.knots == other.plan.knots
    dataclasses.replace(run, plans=run.plans * 100).save(tmp_path / "long.npz")
    assert len(RunResult.load(tmp_path / "long.npz").plans) == 100 * len(run.plans)


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"told_at_s": 1.0}, "told_at_s: must be given with a true scene"),
        ({"true_scene": "turn_jump"}, r"true_scene\.surfaces\[\d\]\.name: must be the name of a surface"),
        ({"true_scene": "no_such"}, "no scene 'no_such'"),
        ({"true_scene": 3}, "true_scene: must be a Scene"),
    ],
)
def test_ground_that_cannot_be_simulated_is_refused(plan, told, message):
    with pytest.raises((ValueError, TypeError), match=message):
        mp.run(plan, **told)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_push_of_a_seed_acts_in_the_run_that_its_options_repeat(plan, seed):
    run = mp.run(plan, latency=LATENCY, duration=0.3, seed=seed, self_contacts=False)
    assert len(run.options.pushes) == 1 and run.options.pushes[0].at_s < 0.3
    drawn = ("mass_scale", "friction_scale", "ground_shift_m", "torque_delay_s", "torque_bandwidth_hz")
    options = {name: getattr(run.options, name) for name in (*drawn, "noise_seed", "sensor_noise", "pushes")}
    again = mp.run(plan, latency=LATENCY, duration=0.3, self_contacts=False, **options)
    np.testing.assert_array_equal(again.recording.configurations, run.recording.configurations)


def test_what_the_planner_refuses_is_told_and_saved(plan, tmp_path, monkeypatch):
    from mcplan.online import planner

    def refuse(*_: object) -> None:
        raise mp.errors.InvalidPlan("measured.com_W", "must be finite", "nan")

    monkeypatch.setattr(planner, "replan", refuse)
    run = mp.run(plan, latency=LATENCY, duration=0.3, self_contacts=False)
    assert run.online.statuses == {"error": run.online.replans} and run.online.replans > 0
    assert run.online.first_error == "InvalidPlan: measured.com_W: must be finite, got nan"
    assert run.online.first_error in str(run)
    run.save(tmp_path / "run.npz")
    assert RunResult.load(tmp_path / "run.npz").online.first_error == run.online.first_error


def test_more_plans_than_a_file_can_have_are_refused_when_they_are_saved(plan, tmp_path, monkeypatch):
    from mcplan.tracking import run_files

    run = mp.run(plan, latency=LATENCY, duration=0.3, self_contacts=False)
    most = len(run.plans)
    run.save(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz") as saved:
        monkeypatch.setattr(run_files, "MAX_ARRAYS", len(saved.files))
    run.save(tmp_path / "full.npz")
    assert len(RunResult.load(tmp_path / "full.npz").plans) == most
    monkeypatch.setattr(run_files, "MAX_ARRAYS", run_files.MAX_ARRAYS - 1)
    with pytest.raises(mp.errors.InvalidInput, match=f"plans: must be at most {most - 1}, which a file can have"):
        run.save(tmp_path / "more.npz")
    assert not (tmp_path / "more.npz").exists()


def test_a_robot_that_is_turned_from_its_goal_says_so(plan):
    run = mp.run(plan, replanning=False, duration=0.1, self_contacts=False)
    assert abs(run.online.goal_turned_rad) < 0.01
    ended = dataclasses.replace(run.online_options, duration_s=float("nan"))
    there = dataclasses.replace(run, online=dataclasses.replace(run.online, goal_off_m=0.02), online_options=ended)
    assert there.followed
    turned = dataclasses.replace(there, online=dataclasses.replace(there.online, goal_turned_rad=-0.33))
    assert not turned.followed
    assert "0.02 m and 0.33 rad off its goal after 0.10 s, without a fall" in str(turned)
    assert turned.online.as_dict()["goal_turned_rad"] == -0.33
