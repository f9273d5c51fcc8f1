"""Pages of runs show what the simulator did: meshes, contacts and forces are the recording's, not the plan's."""

import dataclasses
import json
import re

import numpy as np
import pytest

import plans_by_hand as by_hand
import recordings
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Options, TrackingResult
from mcplan.view import show_run
from page_contents import clips_of, commands_of, floats, track

pin = pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")


@pytest.fixture(scope="module")
def recording():
    return recordings.walking()


@pytest.fixture(scope="module")
def html(recording):
    return show_run(recording).html()


def placed(clip):
    """Times (n,) and positions (n, 3) of a node."""
    positions = track(clip, "position")
    return floats(positions["times"]), floats(positions["values"]).reshape(-1, 3)


def bars(page: str) -> list[str]:
    """What the bars of the timeline say of contacts, in their order."""
    return re.findall(r'title="([^"]*) to [0-9.]+ s"', page)


def test_the_timeline_names_surfaces_as_the_plan_does_whatever_ground_is_simulated(recording, html):
    planned, plan = recording.plan.scene.__copy__(), recording.plan.__copy__()
    other = planned.surfaces[0].__copy__()
    other.name = "elsewhere"
    other.vertices_W = np.asarray(other.vertices_W) + [50.0, 0.0, 1.0]
    planned.surfaces = [*planned.surfaces, other]
    plan.scene = planned
    expected = bars(html)
    assert expected and all(recording.plan.scene.surfaces[0].name in bar for bar in expected)
    for surfaces in (planned.surfaces[::-1], planned.surfaces[:1]):
        true = planned.__copy__()
        true.surfaces = surfaces
        assert bars(show_run(dataclasses.replace(recording, plan=plan, true_scene=true)).html()) == expected


def test_meshes_are_where_the_recorded_configurations_put_them(recording, html):
    urdf_model = load_model(recording.plan.robot)
    data = urdf_model.model.createData()
    clips = clips_of(html)
    for joint in ("leg_left_6_joint", "arm_right_7_joint"):
        times, positions = placed(clips[f"robot/{joint}"])
        for t, position in list(zip(times, positions, strict=True))[::10]:
            q = recording.configurations[np.argmin(np.abs(recording.times_s - t))]
            pin.forwardKinematics(urdf_model.model, data, q)
            assert position == pytest.approx(data.oMi[urdf_model.model.getJointId(joint)].translation, abs=2e-5)


def test_com_ball_is_the_simulated_one(recording, html):
    times, positions = placed(clips_of(html)["com/ball"])
    assert times[-1] == pytest.approx(recording.times_s[-1])
    assert len(times) == pytest.approx(30 * recording.times_s[-1], abs=2)
    n = [np.argmin(np.abs(recording.times_s - t)) for t in times]
    assert positions == pytest.approx(recording.com_W[n], abs=2e-5)
    assert np.linalg.norm(positions - recording.com_plan_W[n], axis=1).min() > 3e-3  # and not the planned one


def test_contacts_light_up_when_the_simulator_has_them(recording, html):
    clips = clips_of(html)
    lit = [track(c, "visible") for p, c in clips.items() if re.fullmatch(r"contacts/left_foot/\d+/active", p)]
    assert len(lit) >= 2
    for n, t in enumerate(recording.times_s):
        shown = any(clip["values"][np.searchsorted(clip["times"], t + 1e-9, "right") - 1] for clip in lit)
        assert shown == recording.contacts[n, 1] or n == len(recording.times_s) - 1
    assert (
        recording.contacts[:, 1] != (recording.contacts_plan[:, 1] >= 0)
    ).any()  # they differ, so this says something


def test_a_push_is_seen_exactly_while_it_acts(recording, html):
    seen = track(clips_of(html)["pushes/shaft"], "visible")
    on = [t for t, visible in zip(seen["times"], seen["values"], strict=True) if visible]
    off = [t for t, visible in zip(seen["times"], seen["values"], strict=True) if not visible and t > 0]
    assert on == pytest.approx([recordings.PUSH_AT], abs=1 / 30)
    assert off == pytest.approx([recordings.PUSH_AT + recordings.PUSH_FOR], abs=1 / 30)
    assert "push (up to 40 N)" in html
    still = dataclasses.replace(recording, pushes_W=np.zeros_like(recording.pushes_W))
    assert "push" not in re.sub(r"<script.*?</script>", "", show_run(still).html(), flags=re.DOTALL)


def test_feet_and_hands_take_their_end_effectors_colour(html):
    colours = {
        c["path"].removeprefix("/meshcat/"): c["object"]["materials"][0]["color"]
        for c in commands_of(html)
        if c["type"] == "set_object"
    }

    def of(joint):
        return next(v for path, v in colours.items() if path.startswith(f"robot/{joint}/"))

    blue, orange = of("leg_left_6_joint"), of("leg_right_6_joint")
    assert blue & 0xFF > blue >> 16  # more blue than red
    assert orange & 0xFF < orange >> 16
    assert of("leg_left_4_joint") == of("leg_right_4_joint")


def test_caption_names_measures_and_page_stays_small(recording):
    result = TrackingResult(recording, recordings.measures(), Options(ground_shift_m=0.05))
    html = show_run(result).html()
    for text in ("without a fall", "CoM off by 7.8 mm rms", "torques up to 61 % of limits", "unassisted"):
        assert text in html
    assert len(html) < 15e6
    # The simulated ground lies 5 cm higher than the planned one: it is drawn where it was.
    solids = [c for c in commands_of(html) if c["type"] == "set_object" and c["path"].endswith("/solid")]
    tops = [
        floats(c["object"]["geometries"][0]["data"]["attributes"]["position"]["array"]).reshape(-1, 3)[:, 2].max()
        for c in solids
    ]
    assert max(tops) == pytest.approx(0.05, abs=1e-5)


def test_a_fall_is_told(recording):
    n = 180
    cut = {
        f.name: getattr(recording, f.name)[:n]
        for f in dataclasses.fields(recording)
        if isinstance(getattr(recording, f.name), np.ndarray) and f.name != "torque_limits"
    }
    fallen = dataclasses.replace(recording, **cut, fell_at_s=float(recording.times_s[n - 1]))
    html = show_run(fallen).html()
    assert "talos: fell at 1.79 s" in html
    duration = json.loads(re.search(r'id="settings">([^<]*)<', html)[1])["duration"]
    assert duration == pytest.approx(1.79)
    # Planned contacts beyond the fall stay within the timeline.
    for left, width in re.findall(r'class="planned" style="left: ([\d.]+)%; width: ([\d.]+)%', html):
        assert float(left) + float(width) < 100.01


def test_the_robot_that_was_simulated_is_drawn(recording):
    planned_for = by_hand.walk(by_hand.flat(), by_hand.humanoid())  # no URDF: it could not be drawn
    other = dataclasses.replace(recording, plan=planned_for, robot=recording.plan.robot)
    assert "talos: " in show_run(other).overlay
