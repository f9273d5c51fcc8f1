"""Plots of whole-body plans: the plan's own curves, against the robot's own limits."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.planar.view import (
    plot_base,
    plot_drift,
    plot_joint_velocities,
    plot_joints,
    plot_torques,
    save_whole_body_plots,
)
from reference_solutions import reference_plan

pytest.importorskip("matplotlib")
Image = pytest.importorskip("PIL.Image")


@pytest.fixture(scope="module")
def plan():
    return reference_plan("walking", "optimised_per_point")


def panels(figure) -> dict:
    """Axes by the body named in their title."""
    return {axes.get_title(loc="left").split(":")[0]: axes for axes in figure.axes if axes.get_visible()}


@pytest.mark.parametrize(
    ("plot", "value"),
    [
        (plot_joints, lambda state: state.configuration.q),
        (plot_joint_velocities, lambda state: state.configuration.velocity),
        (plot_torques, lambda state: state.torque),
    ],
)
def test_curves_are_the_plans(plan, plot, value):
    drawn = panels(plot(plan))
    assert len(drawn) == plan.task.robot.joint_count()
    knots = np.array(plan.knot_times())
    for joint, body in enumerate(plan.task.robot.bodies[1:]):
        times, values = drawn[body.name.replace("_", " ")].lines[0].get_data()
        checked = 0
        for t, y in list(zip(times, values, strict=True))[::37]:
            if np.isnan(t) or np.abs(t - knots).min() < 1e-9:
                continue
            assert y == pytest.approx(value(plan.at(t))[joint], abs=1e-9)
            checked += 1
        assert checked > 20


def test_limits_are_the_robots(plan):
    for plot, limits in (
        (plot_joints, lambda b: (b.position_min, b.position_max)),
        (plot_joint_velocities, lambda b: (-b.velocity_max, b.velocity_max)),
        (plot_torques, lambda b: (-b.torque_max, b.torque_max)),
    ):
        drawn = panels(plot(plan))
        for body in plan.task.robot.bodies[1:]:
            axes = drawn[body.name.replace("_", " ")]
            edges = sorted(line.get_ydata()[0] for line in axes.lines[1:])
            assert edges == pytest.approx(limits(body))
            assert axes.get_ylim()[0] < edges[0] and edges[1] < axes.get_ylim()[1]


def test_titles_say_how_much_of_the_torque_is_used(plan):
    largest = np.max([np.abs(plan.at(t).torque) for t in np.linspace(0.0, plan.duration(), 4000)], axis=0)
    for axes in plot_torques(plan).axes:
        name, _, used = axes.get_title(loc="left").partition(": ")
        joint = [b.name.replace("_", " ") for b in plan.task.robot.bodies].index(name) - 1
        limit = plan.task.robot.bodies[joint + 1].torque_max
        share, _, rest = used.partition(" % of ")
        assert float(share) == pytest.approx(100.0 * largest[joint] / limit, abs=1.0)
        assert rest == f"{limit:g} N m"


def test_joints_without_limits_are_drawn_without():
    plan = reference_plan("walking", "optimised_per_point")
    task = plan.task
    robot = task.robot
    bodies = list(robot.bodies)
    bodies[1].torque_max = np.inf
    robot.bodies = bodies
    task.robot = robot
    plan.task = task
    axes = panels(plot_torques(plan))[bodies[1].name.replace("_", " ")]
    assert len(axes.lines) == 1
    assert np.isfinite(axes.get_ylim()).all()


def test_jumps_between_phases_are_not_joined(plan):
    for axes in plot_torques(plan).axes:
        times, values = axes.lines[0].get_data()
        assert np.isnan(times).sum() == np.isnan(values).sum() == len(plan.durations) - 1


def test_base_is_the_plans(plan):
    figure = plot_base(plan)
    knots = np.array(plan.knot_times())
    for i, axes in enumerate(figure.axes):
        times, values = axes.lines[0].get_data()
        for t, y in list(zip(times, values, strict=True))[::53]:
            if np.isnan(t) or np.abs(t - knots).min() < 1e-9:
                continue
            assert y == pytest.approx(plan.at(t).configuration.base[i], abs=1e-12)


def test_drift_is_that_of_the_contacts_and_stands_below_the_tolerance(plan):
    distance, angle = plot_drift(plan).axes
    largest_m = largest_rad = 0.0
    for k, duration in enumerate(plan.durations):
        for t in np.linspace(0.0, duration, 300):
            for x, y, turn in plan.at_phase(k, t).contact_error:
                largest_m, largest_rad = max(largest_m, np.hypot(x, y)), max(largest_rad, abs(turn))
    feet = [np.nanmax(line.get_ydata()) for line in distance.lines[:2]]
    assert max(feet) == pytest.approx(1e3 * largest_m, rel=0.02)
    assert max(np.nanmax(line.get_ydata()) for line in angle.lines[:2]) == pytest.approx(1e3 * largest_rad, rel=0.02)
    assert distance.lines[2].get_ydata()[0] == pytest.approx(1e3 * mp.PlanarTolerances().drift)
    assert f"at most {max(feet):.2f} mm" in distance.get_title(loc="left")


def test_a_foot_in_the_air_has_no_drift(plan):
    left = plot_drift(plan).axes[0].lines[0]
    times, values = left.get_data()
    knots, phases = plan.knot_times(), plan.task.phases
    for k, phase in enumerate(phases):
        touching = any(plan.task.robot.end_effectors[c.end_effector].name == "left_foot" for c in phase.contacts)
        inside = (times > knots[k] + 1e-6) & (times < knots[k + 1] - 1e-6)
        assert np.isfinite(values[inside]).all() == touching
        assert np.isfinite(values[inside]).any() == touching


@pytest.mark.parametrize("name", ["cartwheel", pytest.param("walking", marks=pytest.mark.slow)])
def test_all_plots_are_written_and_not_blank(name, tmp_path):
    written = save_whole_body_plots(reference_plan(name, "optimised_per_point"), tmp_path / "plots")
    assert {path.stem for path in written} == {
        "strip",
        "postures",
        "joints",
        "velocities",
        "torques",
        "forces",
        "cones",
        "base",
        "drift",
    }
    for path in written:
        image = np.asarray(Image.open(path).convert("RGB")).astype(int)
        assert min(image.shape[:2]) > 200, path.name
        assert 0.01 < np.mean(image.min(axis=2) < 250) < 0.9, path.name
