"""Pages stand alone, say what they show, and are the same from run to run."""

import hashlib
import itertools
import json
import re
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.view import show, show_scene
from mcplan.view.pages.overlay import force_text
from mcplan.view.pages.snapshot import find_browser
from page_contents import clips_of, commands_of, floats, track
from stepping import stepping_plan
from wrenches import standing_wrenches, turning

pytest.importorskip("umsgpack")
pytest.importorskip("meshcat")
Image = pytest.importorskip("PIL.Image")


@pytest.fixture(scope="module")
def plan():
    return by_hand.walk(by_hand.stairs(), by_hand.humanoid())


@pytest.fixture(scope="module")
def html(plan):
    return show(plan).html()


def test_page_refers_to_nothing_outside(html):
    # The one address is the name of a namespace inside the viewer, which browsers do not fetch.
    assert set(re.findall(r"https?://[^\"'\s)\\]+", html)) <= {"http://www.w3.org/1999/xhtml"}
    assert not re.search(
        r"<script[^>]+src=|<link|@import|url\(\s*['\"]?(?!data:)[a-z]", html.replace("createObjectURL(", "")
    )
    assert "viewer.connect(" not in html


def test_same_plan_gives_the_same_page(plan, html):
    assert show(plan).html() == html


def test_page_is_the_same_from_another_process(html):
    script = (
        "import hashlib, plans_by_hand as h, mcplan.view as v; "
        "html = v.show(h.walk(h.stairs(), h.humanoid())).html(); "
        "print(hashlib.sha256(html.encode()).hexdigest())"
    )
    found = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": ":".join(sys.path), "PYTHONHASHSEED": "7"},
    )
    assert found.stdout.split()[-1] == hashlib.sha256(html.encode()).hexdigest()


def test_animated_com_ball_follows_the_plan(plan, html):
    ball = track(clips_of(html)["com/ball"], "position")
    times, positions = floats(ball["times"]), floats(ball["values"]).reshape(-1, 3)
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(plan.duration(), abs=1e-6)
    assert len(times) >= 30 * plan.duration()
    for t, position in zip(times, positions, strict=True):
        assert position == pytest.approx(plan.at(min(float(t), plan.duration())).com_W, abs=2e-5)


def test_contact_lights_up_exactly_while_it_is_made(plan, html):
    clips = clips_of(html)
    times = np.array(plan.knot_times())
    lit = {
        name: [c for path, c in clips.items() if re.fullmatch(rf"contacts/{name}/\d+/active", path)]
        for name in ("right_foot", "left_foot", "right_hand")
    }
    assert lit["right_hand"] == []
    for end, name in enumerate(("right_foot", "left_foot")):
        for k, (start, stop) in enumerate(itertools.pairwise(times)):
            for t in (start + 1e-3, 0.5 * (start + stop), stop - 1e-3):
                shown = 0
                for clip in lit[name]:
                    visible = track(clip, "visible")
                    shown += visible["values"][np.searchsorted(visible["times"], t, side="right") - 1]
                assert shown == int(plan.contact_sequence()[k][end] >= 0), (name, t)


def test_force_arrows_are_as_long_as_the_forces(plan, html):
    clips = clips_of(html)
    shaft = clips["forces/left_foot/shaft"]
    times, base = (
        floats(track(shaft, "position")["times"]),
        floats(track(shaft, "position")["values"]).reshape(-1, 3),
    )
    tip = floats(track(clips["forces/left_foot/head"], "position")["values"]).reshape(-1, 3)
    length_per_newton = 0.55 * 0.7 / (44.0 * plan.scene.gravity)
    checked = 0
    for t, start, end in zip(times, base, tip, strict=True):
        force = plan.at(min(float(t), plan.duration())).end_effectors[1].force_W
        length = np.linalg.norm(force) * length_per_newton
        if length < 0.15 or np.abs(t - np.array(plan.knot_times())).min() < 1e-3:  # forces jump at knots
            continue
        assert end - start == pytest.approx((length - 0.085 * 0.7) * force / np.linalg.norm(force), abs=1e-3)
        checked += 1
    assert checked > 50


def test_caption_and_timeline_name_what_is_shown(html):
    for text in ("stairs", "humanoid44", "right foot", "left hand", "13 phases", "5.00 s", "tread_3"):
        assert text in html
    assert json.loads(re.search(r'id="settings">([^<]*)<', html)[1])["duration"] == pytest.approx(5.0)


def test_names_cannot_break_out_of_the_page(plan):
    scene = by_hand.stairs()
    scene.name = "<script>alert(1)</script>"
    assert "<script>alert" not in show(plan, scene).html()


def test_control_characters_of_names_are_written_out(plan):
    scene = by_hand.stairs()
    scene.name = "\x1b[31m\u202eevil"
    page = show(plan, scene).html()
    assert "\x1b" not in page and "\u202e" not in page
    assert r"\x1b[31m\u202eevil" in page


def test_what_is_no_plan_is_named(plan):
    scene, robot = by_hand.stairs(), by_hand.humanoid()
    with pytest.raises(
        mp.errors.InvalidArgument,
        match=r"plan: must be a Plan, a PlanarPlan, a Motion, a run or a path, got a SimpleNamespace; its plan is result\.plan",
    ):
        mp.show(SimpleNamespace(plan=plan), scene, robot)
    with pytest.raises(mp.errors.InvalidArgument, match="scene: must be a Scene, a name, a path or None, got a Robot"):
        mp.show(plan, robot, scene)
    with pytest.raises(mp.errors.InvalidArgument, match="robot: must be a Robot, a name, a path or None, got 44"):
        mp.show(plan, scene, 44)


@pytest.mark.parametrize(("height", "length"), [(0.005, "1 mm"), (0.7, "10 cm"), (20.0, "10 m")])
def test_arrows_are_measured_in_lengths_of_the_robots_size(height, length):
    assert force_text("force", 1e3, height).endswith(f"N: {length})")


def test_scene_page_has_no_animation():
    html = show_scene(mp.load_scene("gap_with_handle"), mp.load_robot("humanoid44")).html()
    assert "may be held" in html
    assert not [c for c in commands_of(html) if c["type"] == "set_animation"]


browser = pytest.mark.skipif(find_browser() is None, reason="needs Chromium")


def pixels(page, tmp_path, **options) -> np.ndarray:
    return np.asarray(
        Image.open(page.save_png(tmp_path / "page.png", size=(900, 600), **options)).convert("RGB")
    ).astype(int)


def near(picture: np.ndarray, colour: tuple[int, int, int], tolerance: int = 40) -> int:
    return int((np.abs(picture - colour).max(axis=2) < tolerance).sum())


@browser
def test_browser_draws_the_plan(plan, tmp_path):
    picture = pixels(show(plan), tmp_path, time_s=1.7)
    drawn = picture[60:470, 290:]  # right of the caption, above the timeline
    assert len(np.unique(drawn[::4, ::4].reshape(-1, 3), axis=0)) > 500
    assert 0.08 < np.mean(drawn.min(axis=2) < 245) < 0.8
    assert (drawn[:40].min(axis=2) == 255).mean() > 0.9  # a white background
    assert near(drawn, (213, 94, 0)) > 100  # right foot
    assert near(drawn, (0, 114, 178)) > 100  # left foot
    assert near(drawn, (122, 31, 92)) > 100  # CoM


@browser
def test_browser_shows_the_time_asked_for(plan, tmp_path):
    early, late = (pixels(show(plan), tmp_path, time_s=t) for t in (0.3, 4.7))
    # The head, at the top of the drawing, moves from left to right.
    columns = [np.flatnonzero((p[20:130, 290:].min(axis=2) < 235).any(axis=0)).mean() for p in (early, late)]
    assert columns[1] - columns[0] > 100


def test_missing_browser_is_named(plan, tmp_path, monkeypatch):
    monkeypatch.setattr("mcplan.view.pages.snapshot.BROWSERS", ())
    with pytest.raises(mp.errors.MissingExtra, match="apt-get install chromium") as error:
        show(plan).save_png(tmp_path / "page.png")
    assert "\n" not in str(error.value)


def test_forces_at_points_start_at_the_centre_of_pressure():
    plan = stepping_plan()
    clips = clips_of(show(plan).html())
    shaft = track(clips["forces/right_foot/shaft"], "position")
    for t, start in list(zip(floats(shaft["times"]), floats(shaft["values"]).reshape(-1, 3), strict=True))[::7]:
        end = plan.at(min(float(t), plan.duration())).end_effectors[0]
        weights = end.point_forces_W[:, 2]
        assert start == pytest.approx(weights @ end.points_W / weights.sum(), abs=1e-4)
    assert np.ptp(floats(shaft["values"]).reshape(-1, 3)[:, 1]) > 0.01


def test_forces_of_wrenches_start_at_the_planned_centre_of_pressure():
    plan = standing_wrenches()
    clips = clips_of(show(plan).html())
    for end, contact in zip(plan.robot.end_effectors, plan.phases[0].contacts, strict=True):
        if contact.surface < 0:
            assert f"forces/{end.name}/shaft" not in clips
            continue
        starts = floats(track(clips[f"forces/{end.name}/shaft"], "position")["values"]).reshape(-1, 3)
        assert starts == pytest.approx(np.tile(contact.center_of_pressure_W, (len(starts), 1)), abs=1e-4)


def test_feet_turn_on_their_own_and_bodies_with_the_base():
    plan = turning(by_hand.humanoid())
    clips = clips_of(show(plan).html())
    for path, heading in (
        ("robot/left_foot_tip", lambda s: s.end_effectors[1].yaw),
        ("robot/base", lambda s: s.base_rpy[2]),
    ):
        found = track(clips[path], "quaternion")
        for t, quat in list(zip(floats(found["times"]), floats(found["values"]).reshape(-1, 4), strict=True))[::5]:
            x, y, z, w = quat
            yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
            assert yaw == pytest.approx(heading(plan.at(min(float(t), plan.duration()))), abs=1e-4)


def test_captions_of_wrenches_say_how_much_the_body_swings():
    assert "angular momentum up to 1.3 kg m" in show(turning(by_hand.humanoid())).html()
    assert "angular momentum" not in show(by_hand.walk(by_hand.stairs(), by_hand.humanoid())).html()


@pytest.mark.parametrize("size", [1e-3, 5e-3, 0.4, 1.0, 30.0, 4e3])
@pytest.mark.parametrize("count", [1, 3, 200])
def test_scenes_of_any_size_and_number_of_surfaces_are_drawn_in_proportion(size, count):
    """Marks are no larger than a fifth of the scene, whatever its size, and nothing is not a number."""
    scene = mp.Scene(name="field")
    square = 0.17 * size * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    scene.surfaces = [
        mp.model.Surface(
            name=f"s{i}", vertices_W=square + 0.4 * size * np.array([i % 25, i // 25, 0.0]), thickness=0.01 * size
        )
        for i in range(count)
    ]
    scene.start, scene.goal = mp.model.Stance(), mp.model.Stance(position_W=[0.1 * size, 0, 0])
    page = show_scene(scene)
    extent = np.linalg.norm(np.ptp(page.points_W, axis=0))
    corners = {}
    for command in commands_of(page.html()):
        if command["type"] == "set_object":
            values = floats(command["object"]["geometries"][0]["data"]["attributes"]["position"]["array"])
            assert np.isfinite(values).all()
            corners[command["path"].removeprefix("/meshcat/")] = values.reshape(-1, 3)
    assert sum(path.endswith("/solid") for path in corners) == count
    for path in ("marks/start", "marks/goal"):
        assert 0.005 * extent < np.linalg.norm(np.ptp(corners[path], axis=0)) < 0.5 * extent
    assert 0.05 * extent < np.ptp(corners["scale"], axis=0).max() < 0.9 * extent


def test_pads_for_hands_have_a_colour_of_their_own():
    scene = mp.load_scene("gap_with_rail")
    html = show_scene(scene).html()
    assert "for hands" in html
    colours = {
        c["path"].split("/")[3]: c["object"]["materials"][0]["color"]
        for c in commands_of(html)
        if c["type"] == "set_object" and c["path"].endswith("/solid")
    }
    assert colours["right_pad"] == colours["left_pad"] != colours["before"] == colours["after"]
