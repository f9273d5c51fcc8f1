"""Pages of whole-body plans: bodies, forces and cones are where exact kinematics has them."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan._core import planar_kinematics
from mcplan.planar.view.pages import show_whole_body
from mcplan.view.pages.snapshot import find_browser
from page_contents import clips_of, commands_of, floats, track
from reference_solutions import reference_plan

pytest.importorskip("umsgpack")
pytest.importorskip("meshcat")
Image = pytest.importorskip("PIL.Image")

#: [m] length of a leg of either robot with its hip or ankle, by which arrows are scaled.
SIZE = {"climbing": 0.96, "walking": 0.88}


@pytest.fixture(scope="module", params=["climbing", "walking"])
def plan(request):
    return reference_plan(request.param, "optimised_per_point")


@pytest.fixture(scope="module")
def html(plan):
    return mp.show(plan).html()


def test_every_body_moves_as_exact_kinematics_says(plan, html):
    clips = clips_of(html)
    bodies = plan.task.robot.bodies
    moving = {path.removeprefix("robot/") for path in clips if path.startswith("robot/")}
    assert moving == {body.name for body in bodies}
    for i, body in enumerate(bodies):
        position, turning = (track(clips[f"robot/{body.name}"], name) for name in ("position", "quaternion"))
        times, places = floats(position["times"]), floats(position["values"]).reshape(-1, 3)
        turns = floats(turning["values"]).reshape(-1, 4)
        for n in range(0, len(times), 7):
            state = plan.at(min(float(times[n]), plan.duration()))
            expected = planar_kinematics(plan.task.robot, state.configuration)[i]
            # The plane is x forward, z up: counter-clockwise there is about -y.
            assert places[n] == pytest.approx([expected.position_W[0], 0.0, expected.position_W[1]], abs=2e-5)
            half = 0.5 * expected.angle
            quaternion_xyzw = np.array([0.0, -np.sin(half), 0.0, np.cos(half)])
            assert turns[n] * np.sign(turns[n] @ quaternion_xyzw) == pytest.approx(quaternion_xyzw, abs=2e-5)


def test_com_ball_follows_the_plan(plan, html):
    ball = track(clips_of(html)["com/ball"], "position")
    times, places = floats(ball["times"]), floats(ball["values"]).reshape(-1, 3)
    assert len(times) >= 60 * plan.duration()
    assert times[-1] == pytest.approx(plan.duration(), abs=1e-6)
    for t, place in list(zip(times, places, strict=True))[::5]:
        x, y = plan.at(min(float(t), plan.duration())).com_W
        assert place == pytest.approx([x, 0.0, y], abs=2e-5)


def test_arrows_start_at_the_points_and_are_as_long_as_the_forces(plan, html):
    clips = clips_of(html)
    robot, size = plan.task.robot, SIZE[plan.task.name]
    length_per_newton = 0.55 * size / (robot.mass() * robot.gravity)
    knots, checked = np.array(plan.knot_times()), 0
    for e, end in enumerate(robot.end_effectors):
        for point in range(len(end.points)):
            path = f"forces/{end.name}/{point}"
            shaft, head = clips[f"{path}/shaft"], clips[f"{path}/head"]
            start, tip = (floats(track(clip, "position")["values"]).reshape(-1, 3) for clip in (shaft, head))
            for n, t in enumerate(floats(track(shaft, "position")["times"])):
                if np.abs(t - knots).min() < 1e-3:  # forces jump at knots
                    continue
                forces = plan.at(min(float(t), plan.duration())).forces
                mine = [f for f in forces if (f.end_effector, f.point) == (e, point)]
                seen = visible(shaft, t)
                if not mine:
                    assert not seen
                    continue
                force, at = mine[0].force_W, mine[0].position_W
                length = np.linalg.norm(force) * length_per_newton
                if length < 0.18 * size:  # short ones shrink as a whole
                    continue
                assert seen
                assert start[n][[0, 2]] == pytest.approx(at, abs=2e-5)
                drawn = (tip[n] - start[n])[[0, 2]]
                assert drawn == pytest.approx((length - 0.085 * size) * force / np.linalg.norm(force), abs=2e-5)
                checked += 1
    assert checked > 50


def visible(clip: dict, t: float) -> bool:
    shown = track(clip, "visible")
    return shown["values"][np.searchsorted(shown["times"], t + 1e-6, side="right") - 1]


def test_cones_stand_exactly_while_there_is_contact(plan, html):
    clips = clips_of(html)
    knots = np.array(plan.knot_times())
    for k, phase in enumerate(plan.task.phases):
        for t in (knots[k] + 1e-3, 0.5 * (knots[k] + knots[k + 1]), knots[k + 1] - 1e-3):
            for e, end in enumerate(plan.task.robot.end_effectors):
                own = [c for path, c in clips.items() if path.startswith(f"cones/{end.name}/")]
                expected = len(end.points) * any(c.end_effector == e for c in phase.contacts)
                assert sum(visible(c, t) for c in own) == expected, (end.name, t)


def test_cones_are_as_wide_as_friction_says():
    plan = reference_plan("climbing", "optimised_per_point")
    meshes = {c["path"]: c["object"] for c in commands_of(mp.show(plan).html()) if c["type"] == "set_object"}
    (wall,) = [s for s in plan.task.surfaces if s.name == "wall"]
    end = next(c.end_effector for c in plan.task.phases[0].contacts if plan.task.surfaces[c.surface] == wall)
    name = plan.task.robot.end_effectors[end].name
    path = next(p for p in meshes if p.startswith(f"/meshcat/cones/{name}/"))
    array = meshes[path]["geometries"][0]["data"]["attributes"]["position"]["array"]
    corners = floats(array).reshape(-1, 3)[:, [0, 2]]
    directions = corners - corners[0]
    across, out = directions @ wall.tangent_W, directions @ wall.normal_W
    outward = out > 1e-3
    assert np.abs(across[outward] / out[outward]).max() == pytest.approx(wall.friction, rel=1e-3)


def test_ground_lies_under_the_feet(plan, html):
    """No corner of a slab lies outside of its surface."""
    meshes = {c["path"]: c["object"] for c in commands_of(html) if c["type"] == "set_object"}
    for surface in plan.task.surfaces:
        solid = meshes[f"/meshcat/scene/{surface.name}/solid"]["geometries"][0]["data"]["attributes"]["position"]
        corners = floats(solid["array"]).reshape(-1, 3)[:, [0, 2]]
        height = (corners - surface.origin_W) @ surface.normal_W
        assert height.max() == pytest.approx(0.0, abs=2e-5)
        assert height.min() < -0.05


def test_caption_tells_how_the_plan_was_found(plan):
    report = SimpleNamespace(status="solved", iterations=73, time_s=1.25, cost=808.51)
    html = show_whole_body(plan, report).html()
    robot, seconds = plan.task.robot, f"{plan.duration():.2f} s"
    for text in (
        plan.task.name,
        f"{robot.name}: 9 phases, {seconds}",
        "73 iterations, 1.25 s",
        "cost 808.5",
        "solved",
    ):
        assert text in html
    for end in robot.end_effectors:
        assert end.name.replace("_", " ") in html


def test_page_stands_alone_and_is_the_same_twice(plan, html):
    assert mp.show(plan).html() == html
    assert set(re.findall(r"https?://[^\"'\s)\\]+", html)) <= {"http://www.w3.org/1999/xhtml"}


def test_names_cannot_break_out_of_the_page():
    plan = reference_plan("walking", "optimised_per_point")
    task = plan.task
    task.name = "<script>alert(1)</script>"
    plan.task = task
    assert "<script>alert" not in mp.show(plan).html()


def test_a_scene_for_a_whole_body_plan_is_refused(plan):
    with pytest.raises(mp.InvalidInput, match='scene: a whole-body plan is drawn with its own task, got "flat"'):
        mp.show(plan, mp.load_scene("flat"))


@pytest.mark.skipif(find_browser() is None, reason="needs Chromium")
def test_browser_draws_robot_ground_and_forces(tmp_path):
    page = mp.show(reference_plan("walking", "optimised_per_point"))
    path = page.save_png(tmp_path / "page.png", time_s=2.0, size=(900, 600))
    picture = np.asarray(Image.open(path).convert("RGB")).astype(int)[40:480, 290:]
    left, right, com = (0, 114, 178), (213, 94, 0), (122, 31, 92)
    for colour in (left, right, com):
        assert (np.abs(picture - colour).max(axis=2) < 45).sum() > 100, colour
    assert 0.05 < np.mean(picture.min(axis=2) < 245) < 0.7
