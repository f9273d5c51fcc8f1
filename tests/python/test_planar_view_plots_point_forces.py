"""Plots of contact forces: those of the plan, at every point, in the cone of what the point touches."""

import numpy as np
import pytest

from mcplan.planar.view import plot_cones, plot_point_forces
from reference_solutions import reference_plan

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def plan():
    return reference_plan("climbing", "optimised_per_point")


def drawn(axes, name: str):
    return next(line for line in axes.lines if line.get_label() == name)


def test_forces_at_every_point_are_the_plans(plan):
    figure = plot_point_forces(plan)
    ends = plan.task.robot.end_effectors
    knots = np.array(plan.knot_times())
    assert len(figure.axes) == sum(len(end.points) for end in ends)
    for number, axes in enumerate(figure.axes):
        e, point = divmod(number, 2)
        assert axes.get_title(loc="left") == f"{ends[e].name}, point at {1e3 * ends[e].points[point]:+.0f} mm"
        times, normal = drawn(axes, "normal").get_data()
        tangential = drawn(axes, "tangential").get_ydata()
        for n in range(0, len(times), 19):
            if np.isnan(times[n]) or np.abs(times[n] - knots).min() < 1e-9:
                continue
            mine = [f for f in plan.at(times[n]).forces if (f.end_effector, f.point) == (e, point)]
            if mine:
                assert (normal[n], tangential[n]) == pytest.approx((mine[0].normal, mine[0].tangential), abs=1e-9)
            else:
                assert np.isnan(normal[n]) and np.isnan(tangential[n])


def test_the_band_is_friction_times_normal(plan):
    for axes in plot_point_forces(plan).axes:
        normal = drawn(axes, "normal").get_ydata()
        (band,) = [c for c in axes.collections if c.get_label() == "friction cone"]
        corners = np.vstack([path.vertices for path in band.get_paths()])
        assert corners[:, 1].max() == pytest.approx(2.0 * np.nanmax(normal), rel=1e-9)
        assert corners[:, 1].min() == pytest.approx(-2.0 * np.nanmax(normal), rel=1e-9)


@pytest.mark.parametrize("task", ["cartwheel", "climbing", "walking"])
def test_forces_are_drawn_within_their_cones(task):
    plan = reference_plan(task, "optimised_per_point")
    weight = plan.task.robot.mass() * plan.task.robot.gravity
    figure = plot_cones(plan)
    assert len(figure.axes) == len(plan.task.robot.end_effectors)
    for axes in figure.axes:
        assert axes.get_aspect() == 1.0
        edge_x, edge_y = drawn(axes, "friction cone").get_data()
        friction = edge_x[-1] / edge_y[-1]
        assert friction == pytest.approx(2.0)
        for line in axes.lines:
            if line.get_label().startswith("point"):
                tangential, normal = line.get_data()
                assert np.nanmax(np.abs(tangential) - friction * normal) < 1e-3 * weight
                # All of it is seen.
                assert np.nanmax(normal) <= axes.get_ylim()[1] and np.nanmax(np.abs(tangential)) <= axes.get_xlim()[1]
