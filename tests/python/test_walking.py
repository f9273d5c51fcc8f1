"""mcplan.walk and mcplan.receding_horizon: what they take, what comes out, how they end."""

from __future__ import annotations

import numpy as np
import pytest

import mcplan as mp
from mcplan.options import option_names
from mcplan.walking import cycles_of, make_options


@pytest.fixture(scope="module")
def walk():
    return mp.walk("flat", cycles=2)


@pytest.fixture(scope="module")
def stairs_sequence():
    return mp.plan("stairs", "humanoid44").plan


def test_a_walk_on_flat_ground_is_solved_and_keeps_to_the_checker(walk):
    assert walk.success and [cycle.executed for cycle in walk.cycles] == [True, True]
    assert walk.report.status == mp.Status.solved, walk.report
    assert mp.check(walk.plan).ok()
    assert [len(walk.plan.phases), walk.plan.robot.name] == [6, "talos_wang"]


def test_totals_are_those_of_the_cycles_and_of_the_plan(walk):
    travelled = walk.plan.at(walk.plan.duration()).com_W[0] - walk.plan.at(0.0).com_W[0]
    assert walk.distance_m() == pytest.approx(travelled, abs=1e-9)
    assert sum(cycle.duration_s for cycle in walk.cycles) == pytest.approx(walk.plan.duration(), abs=1e-9)
    # The cost as the plan has it: |acceleration|^2 integrated by differences of the velocity.
    times = np.linspace(0.0, walk.plan.duration(), 4001)
    velocities = np.array([walk.plan.at(t).com_velocity_W for t in times])
    accelerations = np.diff(velocities, axis=0) / np.diff(times)[:, None]
    cost = np.sum(accelerations**2) * (times[1] - times[0])
    assert walk.acc_per_m() * walk.distance_m() == pytest.approx(cost, rel=1e-2)


def test_a_saved_walk_is_the_same_plan_and_passes_the_checker(walk, tmp_path):
    walk.plan.save(tmp_path / "walk.npz")
    loaded = mp.Plan.load(tmp_path / "walk.npz")
    for t in np.linspace(0.0, walk.plan.duration(), 7):
        np.testing.assert_array_equal(loaded.at(t).com_W, walk.plan.at(t).com_W)
        np.testing.assert_array_equal(loaded.at(t).angular_momentum_W, walk.plan.at(t).angular_momentum_W)
    assert mp.check(loaded).ok()


def test_the_same_walk_twice_gives_the_same_bytes(walk, tmp_path):
    walk.plan.save(tmp_path / "one.npz")
    mp.walk("flat", cycles=2).plan.save(tmp_path / "two.npz")
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()


def test_cycle_by_cycle_is_the_walk(walk):
    planner = mp.receding_horizon("flat")
    assert [cycle.cost for cycle in cycles_of(planner, 2)] == [cycle.cost for cycle in walk.cycles]
    np.testing.assert_allclose(planner.state().com_W, walk.plan.at(walk.plan.duration()).com_W, atol=1e-12)
    assert planner.executed().duration() == pytest.approx(walk.cycles[1].duration_s)


def test_a_measured_state_is_where_the_next_step_starts():
    planner = mp.receding_horizon("flat")
    measured = planner.state()
    measured.com_W = measured.com_W + [0.01, -0.005, 0.0]
    measured.com_velocity_W = [0.05, 0.0, 0.0]
    assert planner.step(measured).executed
    np.testing.assert_allclose(planner.executed().at(0.0).com_W, measured.com_W, atol=1e-9)
    np.testing.assert_allclose(planner.executed().at(0.0).com_velocity_W, [0.05, 0.0, 0.0], atol=1e-9)


def test_a_cycle_out_of_time_is_named_and_not_executed():
    planner = mp.receding_horizon("rubbles", lookahead=6, time_limit=1e-3)
    cycle = planner.step()
    assert cycle.status == mp.Status.time_limit and not cycle.executed
    assert not planner.result().success and not planner.result().plan.phases


def test_a_cycle_that_was_cut_short_is_gone_on_with_and_says_where_its_step_is_from():
    planner = mp.receding_horizon("flat", solver="ipm", max_iterations=4)
    cycles = [planner.step()]
    assert cycles[0].step_from == mp.rhp.StepFrom.none and not cycles[0].executed
    while not cycles[-1].executed:
        assert len(cycles) < 30 and cycles[-1].status == mp.Status.iteration_limit
        cycles.append(planner.step())
    assert cycles[-1].step_from in (mp.rhp.StepFrom.iterate, mp.rhp.StepFrom.converged)
    worst = mp.check(planner.executed()).worst()
    assert worst.value <= 10.0 * worst.tolerance
    # The step was found; the walk's status is that of the cycle which found it.
    walk = planner.result()
    assert (len(walk.plan.phases), walk.success, walk.report.status) == (3, True, cycles[-1].status)


def test_a_failed_cycle_leaves_the_steps_before_it():
    planner = mp.receding_horizon("flat", max_iterations=60)
    assert planner.step().executed
    far = planner.state()
    far.com_W = far.com_W + [1.0, 0.0, 0.0]  # out of every reach
    duration_s = planner.executed().duration()
    cycle = planner.step(far)
    assert not cycle.executed and cycle.status not in (mp.Status.solved, mp.Status.acceptable)
    assert planner.executed().duration() == duration_s


def test_the_sequence_of_a_plan_is_walked_to_its_end(stairs_sequence, tmp_path):
    stairs_sequence.save(tmp_path / "plan.npz")
    walk = mp.walk("stairs", sequence=tmp_path / "plan.npz")
    assert walk.success and walk.plan.robot.name == "humanoid44"
    assert len(walk.cycles) == 6 < 14  # as many steps as the sequence has
    assert list(walk.plan.final_contacts) == list(stairs_sequence.final_contacts)
    end, goal = walk.plan.at(walk.plan.duration()), stairs_sequence.at(stairs_sequence.duration())
    np.testing.assert_allclose(end.com_velocity_W, 0.0, atol=1e-6)
    np.testing.assert_allclose(end.com_W[:2], goal.com_W[:2], atol=0.05)


def test_a_sequence_out_of_reach_ends_without_a_step():
    # TALOS, which reaches 0.34 m from foot to foot, would have to step 0.45 m to set whole soles on the treads. (A sequence
    # that does so itself flies.)
    walk = mp.walk("stairs", sequence=mp.plan("stairs", "talos", sole_inside=0.0).plan, time_limit=20.0)
    assert walk.report.status in (mp.Status.infeasible, mp.Status.iteration_limit) and not walk.success
    assert [cycle.executed for cycle in walk.cycles] == [False] and not walk.plan.phases


def flying_plan():
    return mp.plan("gap", "humanoid44").plan


WRONG = [
    (("rubles",), {}, mp.errors.UnknownScene, "Did you mean 'rubbles'"),
    (("gap",), {}, mp.errors.InvalidScene, "steps: must list at least one step"),
    (("flat", "anymal"), {}, mp.errors.InvalidRobot, 'must have exactly two of kind "foot"'),
    (("flat", "talis"), {}, mp.errors.UnknownRobot, "Did you mean 'talos'"),
    (
        ("flat",),
        {"fidelity": "pont"},
        mp.errors.InvalidOptions,
        "fidelity: must be one of single, com, rectangle, point",
    ),
    (("flat",), {"fidelty": "point"}, mp.errors.InvalidOptions, "fidelty: no such option. Did you mean 'fidelity'"),
    (("flat",), {"transcription": "rk4"}, mp.errors.InvalidOptions, 'must be one of trapezoidal, euler, got "rk4"'),
    (("flat",), {"lookahead": 0}, mp.errors.InvalidOptions, r"lookahead: must lie in \[1, 10\], got 0"),
    (("flat",), {"lookahead": 11}, mp.errors.InvalidOptions, r"lookahead: must lie in \[1, 10\], got 11"),
    (("flat",), {"lookahead": 2.5}, mp.errors.InvalidOptions, "lookahead: must be of type int, got 2.5"),
    (("flat",), {"cycles": 0}, mp.errors.InvalidOptions, "cycles: must lie in"),
    (("flat",), {"time_limit": -1}, mp.errors.InvalidOptions, "time_limit_s: must be a positive number, got -1"),
    (
        ("flat",),
        {"time_limit": float("nan")},
        mp.errors.InvalidOptions,
        "time_limit_s: must be a positive number, got nan",
    ),
    (
        ("flat",),
        {"single_support_s": (1.2, 0.8)},
        mp.errors.InvalidOptions,
        "single_support_s: must be two positive numbers",
    ),
    (("flat",), {"com_height": 0.9}, mp.errors.InvalidOptions, "com_height: must be of type tuple, got 0.9"),
    (("flat",), {"sequence": "nowhere.npz"}, FileNotFoundError, "nowhere.npz"),
    (("gap",), {"sequence": flying_plan}, mp.errors.InvalidPlan, "must have a foot on the ground for rhp, got flight"),
    (("v_shape",), {"sequence": flying_plan}, mp.errors.InvalidPlan, "must exist in scene v_shape"),
]


@pytest.mark.parametrize(("given", "options", "error", "message"), WRONG)
def test_wrong_input_is_named(given, options, error, message):
    options = {name: value() if callable(value) else value for name, value in options.items()}
    with pytest.raises(error, match=message):
        mp.walk(*given, **options)


def test_hands_in_contact_are_no_walk():
    with pytest.raises(mp.errors.InvalidPlan, match="must have feet alone in contact for rhp, got (right|left)_hand"):
        mp.walk("gap_with_handle", sequence=mp.plan("gap_with_handle").plan)


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("com_W", [np.nan, 0.0, 0.75], "measured: must be finite numbers"),
        ("feet_W", [[0.0, 0.1, 0.0]], "measured.feet_W: must have two feet"),
        ("surfaces", [0, 99], "measured.surfaces: must be indices of surfaces, got 99"),
    ],
)
def test_a_measured_state_that_does_not_fit_is_named(field, value, message):
    planner = mp.receding_horizon("flat")
    state = planner.state()
    setattr(state, field, value)
    with pytest.raises(mp.InvalidInput, match=message):
        planner.step(state)


def test_every_option_can_be_set_by_its_name():
    defaults = mp.rhp.Options()
    names = option_names(mp.rhp.Options)
    assert {"fidelity", "lookahead", "cycles", "transcription", "paper", "time_limit_s"} <= set(names)
    options = make_options({name: getattr(defaults, name) for name in names})
    assert all(getattr(options, name) == getattr(defaults, name) for name in names)
    assert make_options({"time_limit": None}).time_limit_s == np.inf


@pytest.mark.parametrize("fidelity", ["point", "single"])
def test_the_kernel_finds_the_walk_that_ipopt_finds(fidelity):
    walks = {
        solver: mp.walk("v_shape", "talos_wang", fidelity=fidelity, lookahead=2, cycles=2, solver=solver)
        for solver in ("ipopt", "ipm", "auto")
    }
    reference = walks["ipopt"]
    for solver, found in walks.items():
        assert found.report.status == mp.Status.solved, (solver, found.report)
        assert mp.check(found.plan).ok()
        for ours, its in zip(found.cycles, reference.cycles, strict=True):
            assert ours.cost == pytest.approx(its.cost, rel=1e-5)
        assert {cycle.solver.name for cycle in found.cycles} == {"ipopt" if solver == "ipopt" else "ipm"}


def test_a_walk_by_the_kernel_has_the_same_bytes_twice():
    first, second = (mp.walk("rubbles", cycles=1, solver="ipm") for _ in range(2))
    assert first.plan == second.plan and first.cycles[0].iterations == second.cycles[0].iterations


def test_an_unknown_solver_is_refused():
    with pytest.raises(mp.errors.InvalidOptions, match=r'solver: must be one of ipopt, ipm, auto, got "fatrop"'):
        mp.walk("flat", solver="fatrop")
