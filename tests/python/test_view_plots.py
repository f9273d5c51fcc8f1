"""Plots and pictures: written, not blank, true to the plan."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
import wrenches
from mcplan.kinematics.rotations import pose
from mcplan.kinematics.samples import sample
from mcplan.view import (
    picture,
    plot_com,
    plot_contact_sequence,
    plot_cost,
    plot_forces,
    plot_friction,
    plot_gait,
    plot_momentum,
    plot_pressure,
    plot_timing,
    plot_turning,
    save_plots,
)
from mcplan.view.colours import GRASP, SURFACES, end_effector_colours, surface_colours
from mcplan.view.extent import extent_of
from mcplan.view.figure import Part
from mcplan.view.pictures.picture import paint
from mcplan.view.robot_stick import stick_robot
from mcplan.view.scene_drawing import for_hands, surface_drawings
from mcplan.view.shapes import box
from stepping import LEFT, RIGHT, stepping_plan

pytest.importorskip("matplotlib")
Image = pytest.importorskip("PIL.Image")


@pytest.fixture(scope="module")
def plan():
    return by_hand.walk(by_hand.stairs(), by_hand.humanoid())


def history(plan) -> SimpleNamespace:
    """Three iterations: standing on the first tread, then half, then all of the plan's sequence."""
    final = np.array(plan.contact_sequence())
    standing = np.tile([0, 0, -1, -1], (len(final), 1))
    half = standing.copy()
    half[len(final) // 2 :] = final[len(final) // 2 :]
    rows = [(standing, 0, 0.01), (half, 3, 1.0), (half, 0, 10.0), (final, 2, 100.0)]
    iterations = [
        SimpleNamespace(
            index=i, cost=10.0 / (i + 1), contact_weight=weight, switches=switches, sequence=sequence.tolist()
        )
        for i, (sequence, switches, weight) in enumerate(rows)
    ]
    return SimpleNamespace(history=iterations)


def pixels(path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def test_save_plots_writes_pictures_that_are_not_blank(plan, tmp_path):
    written = save_plots(plan, history(plan), tmp_path / "plots")
    assert {p.name for p in written} == {
        "picture.png",
        "gait.png",
        "com.png",
        "momentum.png",
        "forces.png",
        "friction.png",
        "cost.png",
        "contact_sequence.png",
    }
    for path in written:
        image = pixels(path)
        assert min(image.shape[:2]) > 200, path.name
        assert len(np.unique(image[::4, ::4].reshape(-1, 3), axis=0)) > 50, path.name
        assert 0.01 < np.mean(image.min(axis=2) < 250) < 0.9, path.name


def test_without_a_report_only_the_plan_is_plotted(plan, tmp_path):
    assert {p.name for p in save_plots(plan, None, tmp_path)} == {
        "picture.png",
        "gait.png",
        "com.png",
        "momentum.png",
        "forces.png",
        "friction.png",
    }


def test_picture_is_the_same_twice(plan, tmp_path):
    first, second = (picture(plan, path=tmp_path / name).read_bytes() for name in ("a.png", "b.png"))
    assert first == second


def test_picture_shows_feet_and_com_in_their_colours(plan, tmp_path):
    image = pixels(picture(plan, path=tmp_path / "picture.png"))
    for colour in ((213, 94, 0), (0, 114, 178), (122, 31, 92)):
        assert (np.abs(image - colour).max(axis=2) < 25).sum() > 500, colour


def test_a_robot_that_reaches_above_its_usual_height_is_seen_whole(plan, tmp_path):
    """Heads of TALOS that leaned ahead were cut off."""
    samples = sample(plan, plan.scene, plan.robot, 10.0)
    figure = stick_robot(samples, plan.robot, end_effector_colours(plan.robot))
    poses = pose(np.eye(3), samples.com_W + [0.0, 0.0, 1.2])
    mast = Part("mast", box((0.1, 0.1, 0.4)), "#c00000", poses)
    path = paint(plan.scene, plan.robot, samples, replace(figure, parts=[*figure.parts, mast]), tmp_path / "mast.png")
    assert (pixels(path)[0] > 250).all()


def test_surfaces_of_a_gait_have_colours_of_their_own():
    """Every ninth surface of a scene had the colour of the first, though the plan stepped on two of them alone."""
    surfaces = [by_hand.rectangle(f"s_{i}", (i, i + 0.9), (0.0, 1.0), 0.0) for i in range(30)]
    surfaces[4].grasp = True
    scene = SimpleNamespace(surfaces=surfaces)
    two = surface_colours(scene, [9, 0, 4])
    assert two[0] != two[9] and two[4] == GRASP and [two[0], two[9]] == list(SURFACES[:2])
    assert len(set(surface_colours(scene)[:28])) == 28


def test_legends_name_surfaces_for_hands_in_the_colours_in_which_they_are_drawn():
    for name, text in (("gap_with_wall", "walls for hands"), ("gap_with_rail", "for hands")):
        scene = mp.load_scene(name)
        drawn = {
            drawing.name: drawing.colour for drawing in surface_drawings(scene, extent_of(scene, None, None, 1.0, 1.0))
        }
        ((names, colour, said),) = for_hands(scene)
        assert said == text and {drawn[own] for own in names} == {colour}
    assert for_hands(mp.load_scene("flat")) == []


def test_com_curve_is_the_plans(plan):
    position = plot_com(plan).axes[4].lines[0]  # z
    for t, z in zip(*position.get_data(), strict=True):
        assert z == pytest.approx(plan.at(min(t, plan.duration())).com_W[2], abs=1e-12)


def test_gait_bars_are_the_contacts(plan):
    bars = plot_gait(plan).axes[0].patches
    times, sequence = plan.knot_times(), plan.contact_sequence()
    for end in range(4):
        own = sum(bar.get_width() for bar in bars if abs(bar.get_y() + 0.5 * bar.get_height() - end) < 1e-6)
        contact = sum(times[k + 1] - times[k] for k in range(len(sequence)) if sequence[k][end] >= 0)
        assert own == pytest.approx(contact, abs=1e-9)


def test_normal_forces_carry_the_robot(plan):
    # On level treads the normals are vertical: their sum is m (g + z'').
    panels = plot_forces(plan).axes
    right, left = (next(line for line in panel.lines if line.get_label() == "normal") for panel in panels)
    times = right.get_xdata()
    total = np.nan_to_num(right.get_ydata()) + np.nan_to_num(left.get_ydata())
    for t, force in zip(times, total, strict=True):
        state = plan.at(min(t, plan.duration()))
        assert force == pytest.approx(44.0 * (plan.scene.gravity + state.com_acceleration_W[2]), rel=1e-9)


def test_friction_of_a_slope_is_measured_in_its_own_frame():
    scene, robot = by_hand.flat(), by_hand.humanoid()
    plan = by_hand.walk(scene, robot)
    level = next(line for line in plot_friction(plan).axes[0].lines if "normal" in line.get_label()).get_ydata()
    tilt = np.array([[np.cos(0.2), 0.0, np.sin(0.2)], [0.0, 1.0, 0.0], [-np.sin(0.2), 0.0, np.cos(0.2)]])
    slope = by_hand.flat()
    surface = slope.surfaces[0]
    surface.vertices_W = np.asarray(surface.vertices_W) @ tilt.T
    slope.surfaces = [surface]
    plan.scene = slope
    tilted = next(line for line in plot_friction(plan).axes[0].lines if "normal" in line.get_label()).get_ydata()
    state = plan.at(0.0).end_effectors[0]
    normal = state.force_W @ tilt[:, 2]
    assert tilted[0] == pytest.approx(np.linalg.norm(state.force_W - normal * tilt[:, 2]) / normal)
    assert tilted[0] > level[0] + 0.05


def test_contact_sequence_is_drawn_over_switches(plan):
    report = history(plan)
    figure = plot_contact_sequence(report, plan)
    for end, axes in enumerate(figure.axes):
        drawn = np.ma.filled(axes.collections[0].get_array(), -9).reshape(len(plan.phases), 3)
        for column, row in zip(range(3), (0, 2, 3), strict=True):
            assert (drawn[:, column] == np.array(report.history[row].sequence)[:, end]).all()
        assert axes.get_xlim()[1] == pytest.approx(5.5)  # 0 + 3 + 2 switches


def test_cost_is_drawn_on_logarithmic_axes(plan):
    figure = plot_cost(history(plan))
    assert [axes.get_yscale() for axes in figure.axes] == ["log", "log"]
    assert figure.axes[1].lines[0].get_ydata() == pytest.approx([10.0, 5.0, 10.0 / 3.0, 2.5])


def test_reports_without_data_are_refused_by_name():
    empty = SimpleNamespace(history=[])
    for plot in (plot_cost, plot_contact_sequence):
        with pytest.raises(ValueError, match=r"report\.history"):
            plot(empty)


@pytest.fixture(scope="module")
def steps():
    return stepping_plan(2)


def drawn(axes, name: str) -> tuple[np.ndarray, np.ndarray]:
    line = next(line for line in axes.lines if line.get_label() == name)
    return line.get_xdata(), line.get_ydata()


def test_a_plan_with_points_gets_pressure_and_timing_too(steps, tmp_path):
    names = {path.stem for path in save_plots(steps, None, tmp_path)}
    assert names == {"picture", "gait", "com", "momentum", "forces", "friction", "pressure", "timing"}
    for name in names:
        assert (pixels(tmp_path / f"{name}.png") < 250).any(axis=2).sum() > 500, name


def test_momentum_is_drawn_about_every_axis(plan, steps):
    for each in (plan, steps):
        for axis, axes in enumerate(plot_momentum(each).axes):
            times, values = axes.lines[-1].get_data()
            for t, value in zip(times[::40], values[::40], strict=True):
                assert value == pytest.approx(each.at(min(t, each.duration())).angular_momentum_W[axis], abs=1e-12)
    assert np.abs(plot_momentum(steps).axes[1].lines[-1].get_ydata()).max() > 0.1


def test_forces_at_the_corners_add_up_to_the_foots(steps):
    for axes in plot_forces(steps).axes:
        corners = [line.get_ydata() for line in axes.lines if line.get_linewidth() == 0.8]
        assert len(corners) == 4
        assert np.nan_to_num(np.sum(corners, axis=0)) == pytest.approx(np.nan_to_num(drawn(axes, "normal")[1]))


def test_centre_of_pressure_is_where_the_foot_has_no_moment(steps):
    panels = plot_pressure(steps).axes
    assert [axes.get_title(loc="left") for axes in panels[:2]] == [
        "right foot, along its length",
        "right foot, along its width",
    ]
    for row, foot in enumerate((RIGHT, LEFT)):
        times, along = drawn(panels[2 * row], "centre of pressure")
        _, across = drawn(panels[2 * row + 1], "centre of pressure")
        for t, x, y in list(zip(times, along, across, strict=True))[::23]:
            end = steps.at(min(t, steps.duration())).end_effectors[foot]
            if end.surface < 0:
                assert np.isnan(x) and np.isnan(y)
                continue
            # moment about the sole's centre = cop x f, whose level components see the normal force alone
            assert end.moment_W[:2] == pytest.approx([y * end.force_W[2], -x * end.force_W[2]], abs=1e-6)


def test_timing_bars_are_the_durations(steps):
    axes = plot_timing(steps).axes[0]
    assert [bar.get_height() for bar in axes.patches] == pytest.approx([phase.duration for phase in steps.phases])
    colours = [bar.get_facecolor() for bar in axes.patches]
    assert colours[0] == colours[2] != colours[1] != colours[4]


@pytest.fixture(scope="module")
def turn():
    return wrenches.turning(by_hand.humanoid())


def test_a_plan_with_wrenches_gets_pressure_and_turning_too(turn, tmp_path):
    names = {path.stem for path in save_plots(turn, None, tmp_path)}
    assert names == {"picture", "gait", "com", "momentum", "forces", "friction", "pressure", "turning"}
    for name in names:
        assert (pixels(tmp_path / f"{name}.png") < 250).any(axis=2).sum() > 500, name


@pytest.mark.slow
def test_a_plan_on_point_feet_has_every_plot_but_that_of_pressure(tmp_path):
    result = mp.plan("flat", "go2")
    names = {path.name for path in save_plots(result.plan, result.report, tmp_path)}
    assert {"turning.png", "friction.png", "forces.png"} <= names and "pressure.png" not in names
    plot_pressure(result.plan)  # asked for by itself, it is empty


def test_planned_centres_of_pressure_are_drawn_in_parts_of_the_sole():
    panels = plot_pressure(wrenches.standing_wrenches()).axes
    for row, (length, width) in enumerate(((-0.4, -0.5), (0.4, 0.5))):
        for column, share in enumerate((length, width)):
            _, values = drawn(panels[2 * row + column], "centre of pressure")
            assert values == pytest.approx(np.full(len(values), share), abs=1e-9)
            edges = [line.get_ydata()[0] for line in panels[2 * row + column].lines[:2]]
            assert edges == [-1.0, 1.0]


def test_turning_shows_the_base_and_the_headings_of_soles_on_the_ground(turn):
    axes = plot_turning(turn).axes
    times, yaw = drawn(axes[2], "base")
    _, right = drawn(axes[2], "right foot")
    for t, of_base, of_foot in list(zip(times, yaw, right, strict=True))[::61]:
        state = turn.at(min(t, turn.duration()))
        assert of_base == pytest.approx(np.degrees(state.base_rpy[2]), abs=1e-9)
        if state.end_effectors[RIGHT].surface < 0:
            assert np.isnan(of_foot)
        else:
            assert of_foot == pytest.approx(np.degrees(state.end_effectors[RIGHT].yaw), abs=1e-9)
    assert yaw[-1] == pytest.approx(90.0) and right[-1] == pytest.approx(90.0)


def test_friction_of_wrenches_is_that_of_their_forces():
    """Both feet push along x by m mu squeeze, 0.02 m of 0.7 m of height."""
    plan = wrenches.standing_wrenches(squeeze_m=0.02)
    contacts = [c for c in plan.phases[0].contacts if c.surface >= 0]
    for axes, contact in zip(plot_friction(plan).axes, contacts, strict=True):
        arm = plan.knots[0].com_W - contact.anchor_W
        assert drawn(axes, "tangential / normal")[1] == pytest.approx(np.hypot(*arm[:2]) / arm[2])


def test_names_with_dollars_are_names_and_no_formulas(tmp_path):
    plan = by_hand.walk(by_hand.stairs(), by_hand.humanoid())
    scene, robot = plan.scene, plan.robot
    scene.surfaces[0].name = robot.end_effectors[0].name = robot.name = "$a^{b$ \\frac{"
    plan.scene, plan.robot = scene, robot
    assert len(save_plots(plan, None, tmp_path / "plots")) == 6
