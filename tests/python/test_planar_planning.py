"""mcplan.whole_body: what it takes, what comes out, how it ends."""

from __future__ import annotations

import os
import signal
import threading

import numpy as np
import pytest

import mcplan as mp
from mcplan.options import option_names
from mcplan.planar.planning import make_options


@pytest.fixture(scope="module")
def uniform():
    """Least torque with the forces of case 1."""
    return mp.whole_body("cartwheel", forces="uniform", certify=True)


def iterations_of(task="cartwheel", **options) -> list[str]:
    """Lines that the solver logs."""
    lines: list[str] = []
    mp.whole_body(task, logger=lambda level, line: lines.append(line), **options)
    return lines


def test_a_cartwheel_is_solved_certified_and_reports_its_size(uniform):
    assert uniform.report.status == mp.Status.solved, uniform.report
    assert mp.check(uniform.plan).ok() and uniform.certificate.proved()
    assert (uniform.parameters, uniform.plan.planner) == (84, "sip")  # 9 joints x 9 + 3 durations, as in the paper
    assert uniform.constraints > uniform.parameters
    drift = mp._core.largest_drift(uniform.plan)
    assert (uniform.drift_m, uniform.drift_rad) == (drift.position_m, drift.angle_rad)
    assert repr(uniform).startswith("<sip.Result: cartwheel, solved, ")


def test_the_cost_is_the_integral_of_the_squared_torques(uniform):
    plan = uniform.plan
    times = np.linspace(0.0, plan.duration(), 2001)
    squares = np.array([np.sum(plan.at(t).torque ** 2) for t in times])
    assert uniform.report.cost == pytest.approx(np.trapezoid(squares, times), rel=2e-3)
    assert uniform.report.cost_terms["torque"] == pytest.approx(uniform.report.cost)
    assert uniform.report.cost_terms["duration"] == pytest.approx(plan.duration())


def test_weights_for_each_point_start_from_uniform_ones_and_cost_less(uniform):
    free = mp.whole_body("cartwheel", warm_start=uniform.plan)  # case 3 has case 1 among its motions
    assert free.report.status == mp.Status.solved, free.report
    assert free.parameters == uniform.parameters + 7
    assert free.report.cost < 0.8 * uniform.report.cost  # 1405 and 628 were published for these stances


def test_a_saved_plan_starts_another_search_where_it_is(uniform, tmp_path):
    uniform.plan.save(tmp_path / "plan.npz")
    again = mp.whole_body("cartwheel", forces="uniform", warm_start=tmp_path / "plan.npz")
    assert again.report.status == mp.Status.solved and again.report.iterations < uniform.report.iterations
    assert again.report.cost == pytest.approx(uniform.report.cost, rel=1e-2)


def test_without_a_cost_the_motion_has_one_duration_and_with_one_each_phase_its_own(uniform):
    some = mp.whole_body("cartwheel", forces="uniform", minimise="none")
    assert some.report.status == mp.Status.solved and some.parameters == 82
    np.testing.assert_allclose(np.array(some.plan.durations) / [3, 4, 3], some.plan.duration() / 10)
    assert (
        len({round(duration / count, 3) for duration, count in zip(uniform.plan.durations, [3, 4, 3], strict=True)}) > 1
    )
    assert some.report.cost == 0.0 and some.certificate is None


def test_the_shortest_kinematic_motion_keeps_each_phase_at_its_least():
    fast = mp.whole_body("cartwheel", minimise="time", dynamics=False, order=5)
    assert fast.report.status == mp.Status.solved
    lowest = [max(phase.min_duration, 0.2) for phase in fast.plan.task.phases]
    np.testing.assert_allclose(fast.plan.durations, lowest, rtol=1e-2)


def test_a_search_out_of_time_keeps_the_feasible_motion_it_started_from(uniform):
    result = mp.whole_body("cartwheel", forces="uniform", warm_start=uniform.plan, time_limit=1e-3)
    assert result.report.status == mp.Status.time_limit
    assert mp.check(result.plan).ok(), result.report
    assert result.report.cost <= uniform.report.cost * (1.0 + 1e-3)


def test_a_search_out_of_time_says_what_is_violated_most_where_and_when():
    result = mp.whole_body("climbing", time_limit=1e-3)
    assert result.report.status == mp.Status.time_limit and not mp.check(result.plan).ok()
    assert len(result.plan.durations) == 9
    assert result.report.message.endswith(f"violated most: {result.report.worst_violation}")
    assert " in phase " in result.report.message and "t = " in result.report.message


def test_iterations_run_out():
    result = mp.whole_body("cartwheel", forces="uniform", minimise="none", max_iterations=1)
    assert result.report.status == mp.Status.iteration_limit and "max_iterations" in result.report.message


@pytest.mark.usefixtures("ctrl_c")
def test_an_interrupt_in_the_logger_ends_the_search_and_not_the_program():
    lines = 0

    def interrupt(level, line):
        nonlocal lines
        lines += 1
        if lines == 4:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(mp.Interrupted) as stop:
        mp.whole_body("cartwheel", logger=interrupt)
    result = stop.value.result
    assert result.report.status == mp.Status.interrupted and lines < 10
    result.plan.validate()


@pytest.mark.usefixtures("ctrl_c")
def test_an_interrupt_without_a_logger_ends_the_search():
    planner = mp.sip.Planner(mp.load_planar_task("climbing"))
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(mp.Interrupted) as stop:
        planner.solve()
    result = stop.value.result
    timer.join()
    assert result.report.status == mp.Status.interrupted
    result.plan.validate()


def test_an_error_in_the_logger_is_the_callers():
    def fail(level, line):
        raise RuntimeError("full disk")

    with pytest.raises(RuntimeError, match="full disk"):
        mp.whole_body("cartwheel", logger=fail)


def test_solves_let_other_threads_run():
    counted, stop = [0], threading.Event()

    def count():
        while not stop.wait(1e-3):
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    mp.whole_body("cartwheel", forces="uniform", minimise="none")
    during = counted[0] - before
    stop.set()
    thread.join()
    assert during > 10


def test_a_search_logs_a_table():
    lines = iterations_of(forces="uniform", minimise="none", dynamics=False)
    assert lines[0].split()[:2] == ["iter", "cost"] and any(line.split()[0] == "5" for line in lines)


def test_every_option_can_be_set_by_its_name():
    defaults = mp.sip.Options()
    names = option_names(mp.sip.Options)
    assert {"forces", "order", "tube_m", "time_limit_s", "hessian", "total_duration_s"} <= set(names)
    options = make_options("torque", {name: getattr(defaults, name) for name in names})
    assert all(getattr(options, name) == getattr(defaults, name) for name in names)


def test_criteria_set_weights_and_options_replace_them():
    def weights(minimise, **options):
        chosen = make_options(minimise, options)
        return chosen.torque_weight, chosen.duration_weight, chosen.jerk_weight, chosen.free_durations

    assert weights(None) == weights("torque") == (1.0, 0.0, 0.0, True)
    assert weights("time") == (0.0, 1.0, 0.0, True)
    assert weights("none") == weights(None, dynamics=False) == (0.0, 0.0, 0.0, False)
    assert weights("none", free_durations=True)[3] and not weights("torque", free_durations=False)[3]
    assert weights("torque", duration_weight=2.0, jerk_weight=0.1) == (1.0, 2.0, 0.1, True)


def test_enumerations_are_read_with_dashes_too():
    options = make_options(None, {"forces": "per-body", "hessian": "gauss-newton"})
    assert (options.forces, options.hessian) == (mp.sip.Forces.per_body, mp.sip.HessianChoice.gauss_newton)
    assert make_options(None, {"forces": mp.sip.Forces.uniform}).forces == mp.sip.Forces.uniform


WRONG = [
    ("cartweel", {}, mp.errors.UnknownPlanarTask, "Did you mean 'cartwheel'"),
    (
        "cartwheel",
        {"minimise": "energy"},
        mp.errors.InvalidOptions,
        'minimise: must be one of torque, time, none, got "energ',
    ),
    (
        "cartwheel",
        {"minimise": "torque", "dynamics": False},
        mp.errors.InvalidOptions,
        "minimise: must be time or none with",
    ),
    (
        "cartwheel",
        {"forces": "most"},
        mp.errors.InvalidOptions,
        "forces: must be one of uniform, per_body, per_point, param",
    ),
    (
        "cartwheel",
        {"contact": "glue"},
        mp.errors.InvalidOptions,
        'contact: must be one of tube, band, strict, got "glue"',
    ),
    ("cartwheel", {"free_flyer": "no"}, mp.errors.InvalidOptions, "free_flyer: must be one of computed, parameterised"),
    (
        "cartwheel",
        {"continuous": "no"},
        mp.errors.InvalidOptions,
        "continuous: must be one of hull, extremum, grid, got",
    ),
    ("cartwheel", {"order": 2}, mp.errors.InvalidOptions, r"order: must lie in \[3, 12\], got 2"),
    ("cartwheel", {"order": 7.5}, mp.errors.InvalidOptions, "order: must be of type int, got 7.5"),
    ("cartwheel", {"neq": 9}, mp.errors.InvalidOptions, r"neq: must lie in \[0, order\], got 9"),
    ("cartwheel", {"tube_m": 0.0}, mp.errors.InvalidOptions, "tube_m: must be a positive number, got 0"),
    ("cartwheel", {"time_limit": -1}, mp.errors.InvalidOptions, "time_limit_s: must be a positive number, got -1"),
    ("cartwheel", {"tube": 1e-3}, mp.errors.InvalidOptions, "tube: no such option. Did you mean 'tube_m'"),
    (
        "cartwheel",
        {"total_duration_s": (2, 1)},
        mp.errors.InvalidOptions,
        "total_duration_s: must be two positive numbers",
    ),
    ("cartwheel", {"certify": True, "dynamics": False}, mp.errors.InvalidOptions, "certify: needs dynamics"),
    ("cartwheel", {"certify": True, "torque_limits": False}, mp.errors.InvalidOptions, "certify: needs torque_limits"),
    ("cartwheel", {"warm_start": "nowhere.npz"}, FileNotFoundError, "nowhere.npz"),
]


@pytest.mark.parametrize(("task", "options", "error", "message"), WRONG, ids=lambda v: str(v)[:40])
def test_wrong_input_is_named(task, options, error, message):
    with pytest.raises(error, match=message):
        mp.whole_body(task, **options)


def test_a_warm_start_of_other_phases_or_joints_is_named(uniform):
    with pytest.raises(mp.errors.InvalidPlan):
        mp.whole_body("climbing", warm_start=uniform.plan)
    with pytest.raises(mp.errors.InvalidPlan):
        mp.whole_body("walking", warm_start=uniform.plan)


def test_a_stance_that_joint_limits_forbid_is_not_solved_and_named():
    task = mp.load_planar_task("cartwheel")
    task.phases[2].contacts[1].position_W = [2.55, 0.0]  # limbs stretch so far, but not with feet flat on the ground
    result = mp.whole_body(task, dynamics=False, max_iterations=30, order=5)
    assert result.report.status not in (mp.Status.solved, mp.Status.acceptable)
    worst = result.report.worst_violation
    assert (
        worst.name in ("position", "drift", "drift_angle") and worst.phase == 2 and str(worst) in result.report.message
    )
