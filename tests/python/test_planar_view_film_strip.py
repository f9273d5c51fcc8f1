"""Film strips: a frame for each instant, the robot and its forces where the plan has them, one scale."""

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import planar_kinematics
from mcplan.planar.view import film_strip, stroboscope
from mcplan.planar.view.figure import shapes_of, size_of
from reference_solutions import reference_plan

matplotlib = pytest.importorskip("matplotlib")
Image = pytest.importorskip("PIL.Image")


@pytest.fixture(scope="module")
def plan():
    return reference_plan("climbing", "optimised_per_point")


def patches(axes, zorder: float) -> list:
    return [patch for patch in axes.patches if patch.get_zorder() == zorder]


GROUND, CONES, ROBOT, FORCES = 1, 3, 4, 6


def test_a_frame_for_each_instant_with_its_time_below(plan):
    for frames, count in ((1, 1), (5, 5), ((0.1, 0.3, 1.0), 3)):
        figure = film_strip(plan, frames=frames)
        assert len(figure.axes) == count
    times = [axes.texts[0].get_text() for axes in film_strip(plan, frames=[0.1, 0.3, 1.0]).axes]
    assert times == ["0.10 s", "0.30 s", "1.00 s"]
    ends = [axes.texts[0].get_text() for axes in film_strip(plan, frames=4).axes]
    assert (ends[0], ends[-1]) == ("0.00 s", f"{plan.duration():.2f} s")


def test_frames_share_one_scale_and_equal_axes(plan):
    figure = film_strip(plan, frames=6, columns=3)
    limits = {(*axes.get_xlim(), *axes.get_ylim()) for axes in figure.axes}
    assert len(limits) == 1
    assert all(axes.get_aspect() == 1.0 for axes in figure.axes)
    assert len({round(axes.get_position().y0, 6) for axes in figure.axes}) == 2  # rows


def test_the_robot_stands_where_exact_kinematics_has_it(plan):
    t = 0.7
    (axes,) = film_strip(plan, frames=[t]).axes
    shapes, drawn = shapes_of(plan.task.robot), patches(axes, ROBOT)
    assert len(drawn) == len(shapes)
    frames = planar_kinematics(plan.task.robot, plan.at(t).configuration)
    for shape, patch in zip(shapes, drawn, strict=True):
        frame = frames[shape.body]
        cos, sin = np.cos(frame.angle), np.sin(frame.angle)
        expected = frame.position_W + shape.outline_B() @ np.array([[cos, sin], [-sin, cos]])
        assert patch.get_xy()[:-1] == pytest.approx(expected, abs=1e-9)


def test_arrows_and_cones_stand_at_the_points_in_contact(plan):
    t = 0.7
    (axes,) = film_strip(plan, frames=[t]).axes
    robot, forces = plan.task.robot, plan.at(t).forces
    scale = 0.55 * size_of(robot) / (robot.mass() * robot.gravity)
    cones = patches(axes, CONES)
    assert np.array([c.get_xy()[0] for c in cones]) == pytest.approx(np.array([f.position_W for f in forces]), abs=1e-9)
    strong = [f for f in forces if np.linalg.norm(f.force_W) * scale > 0.012 * size_of(robot)]
    arrows = patches(axes, FORCES)
    assert len(arrows) == len(strong) >= 2
    for arrow, force in zip(arrows, strong, strict=True):
        # The tip is the corner farthest along the force.
        corners = arrow.get_xy()
        tip = corners[np.argmax(corners @ force.force_W)]
        assert tip == pytest.approx(force.position_W + scale * force.force_W, abs=1e-9)


def test_forces_and_cones_can_be_left_out(plan):
    (axes,) = film_strip(plan, frames=1, forces=False, cones=False).axes
    assert not patches(axes, CONES) and not patches(axes, FORCES)
    names = [text.get_text() for text in film_strip(plan, frames=1, forces=False, cones=False).legends[0].texts]
    assert not any("force" in name or "cone" in name for name in names)


def test_surfaces_are_hatched(plan):
    (axes,) = film_strip(plan, frames=1).axes
    assert len(patches(axes, GROUND)) == len(plan.task.surfaces)
    assert all(patch.get_hatch() for patch in patches(axes, GROUND))


@pytest.mark.parametrize("name", ["cartwheel", "climbing", "climbing_steep", "walking"])
def test_nothing_is_outside_of_the_frames(name):
    plan = reference_plan(name, "feasible_per_point")
    figure = film_strip(plan, frames=4)
    for axes in figure.axes:
        corners = np.vstack([patch.get_xy() for patch in patches(axes, ROBOT) + patches(axes, CONES)])
        assert (corners[:, 0] > axes.get_xlim()[0]).all() and (corners[:, 0] < axes.get_xlim()[1]).all()
        assert (corners[:, 1] > axes.get_ylim()[0]).all() and (corners[:, 1] < axes.get_ylim()[1]).all()


def test_legend_fits_into_the_figure():
    for name in ("climbing", "walking"):
        plan = reference_plan(name, "feasible_per_point")
        for figure in (film_strip(plan), film_strip(plan, width=6.0), stroboscope(plan), stroboscope(plan, width=5.0)):
            figure.canvas.draw()
            box = figure.legends[0].get_window_extent()
            assert box.x0 >= 0.0 and box.x1 <= figure.bbox.width, (name, figure.get_size_inches())
            # Nor does it run into the time below the last frame.
            for axes in figure.axes:
                for text in axes.texts:
                    assert text.get_window_extent().y0 > box.y1 - 2.0


def test_postures_pale_towards_the_past(plan):
    (axes,) = stroboscope(plan, postures=3).axes
    count = len(shapes_of(plan.task.robot))
    robots = patches(axes, ROBOT)
    assert len(robots) == 3 * count
    lightness = [
        np.mean([patch.get_facecolor()[:3] for patch in robots[i * count : (i + 1) * count]]) for i in range(3)
    ]
    assert lightness[0] > lightness[1] > lightness[2]


def test_postures_show_every_cone_once(plan):
    (axes,) = stroboscope(plan, postures=20).axes
    apexes = np.array([cone.get_xy()[0] for cone in patches(axes, CONES)])
    places = {(c.end_effector, *np.round(c.position_W, 6)) for phase in plan.task.phases for c in phase.contacts}
    assert len(apexes) == 2 * len(places)


def test_strip_is_the_same_twice_and_not_blank(plan, tmp_path):
    for name in ("a.png", "b.png"):
        film_strip(plan, frames=4).savefig(tmp_path / name, metadata={"Software": None})
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    image = np.asarray(Image.open(tmp_path / "a.png").convert("RGB")).astype(int)
    for colour in ((0, 114, 178), (213, 94, 0), (0, 158, 115), (122, 31, 92)):  # three feet, CoM
        assert (np.abs(image - colour).max(axis=2) < 25).sum() > 50, colour


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        (0, "frames: must be at least 1, got 0"),
        ([], "frames: needs at least one instant, got none"),
        ([0.0, 99.0], r"frames\[1\]: must lie in the plan, from 0 to 2.0690\d s, got 99"),
    ],
)
def test_bad_instants_are_refused_by_name(plan, frames, message):
    with pytest.raises(mp.InvalidInput, match=message):
        film_strip(plan, frames=frames)
    with pytest.raises(mp.InvalidInput, match="postures"):
        stroboscope(plan, postures=frames)
