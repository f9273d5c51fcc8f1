"""mcplan.files.scenes: what files say is what comes back, and what is wrong in them is named."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import malformed
import mcplan as mp
from mcplan._core import Polygon, resolve_stance
from mcplan.files.builtin import DATA
from mcplan.files.scenes import list_scenes, load_scene, save_scene, scaled, scene_from_dict, scene_to_dict
from mcplan.files.toml import toml_text
from plain_toml import tomllib


def write(path: Path, data: dict) -> Path:
    path.write_text(toml_text(data))
    return path


def test_the_data_that_are_broken_below_are_valid(tmp_path):
    scene = load_scene(write(tmp_path / "room.toml", malformed.SCENE))
    assert [surface.name for surface in scene.surfaces] == ["floor", "pad"]
    assert scene.surfaces[1].grasp and scene.goal.yaw == 0.1
    np.testing.assert_array_equal(scene.surfaces[0].vertices_W, malformed.SQUARE)


@pytest.mark.parametrize("case", malformed.SCENE_BREAKS, ids=malformed.label)
def test_a_broken_scene_file_is_named_with_field_and_rule(case, tmp_path):
    path, value, field, rule = case
    file = write(tmp_path / "bad.toml", malformed.broken(malformed.SCENE, path, value))
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(file)
    message = str(found.value)
    assert message.startswith(f"{file}: {field}"), message
    assert rule in message
    assert "\n" not in message
    assert found.value.source == str(file)


@pytest.mark.parametrize(("content", "rule"), malformed.NOT_SCENE_FILES, ids=lambda v: repr(v)[:40])
def test_a_file_that_is_no_scene_at_all_is_named(content, rule, tmp_path):
    file = tmp_path / "bad.toml"
    file.write_bytes(content)
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(file)
    assert str(found.value).startswith(f"{file}: {rule}")


def test_a_folder_is_not_a_scene(tmp_path):
    with pytest.raises(mp.errors.InvalidScene, match="cannot be read: Is a directory"):
        load_scene(tmp_path)


@pytest.mark.parametrize("name", ["stares", "stares.toml", "", "x" * 5000, "a\0b"])
def test_an_unknown_name_lists_the_names_that_exist(name):
    with pytest.raises(mp.errors.UnknownScene) as found:
        load_scene(name)
    assert "Built-in: chimney, flat, gap, " in str(found.value)
    assert ("Did you mean 'stairs'?" in str(found.value)) == (name == "stares")


def test_a_byte_order_mark_is_no_error(tmp_path):
    file = tmp_path / "room.toml"
    file.write_text("\ufeff" + toml_text(malformed.SCENE), encoding="utf-8")
    assert load_scene(file).name == "room"


def test_clockwise_corners_only_turn_the_normal(tmp_path):
    data = malformed.broken(malformed.SCENE, ("surfaces", 0, "vertices"), malformed.SQUARE[::-1])
    scene = load_scene(write(tmp_path / "room.toml", data))
    np.testing.assert_allclose(Polygon(scene.surfaces[0].vertices_W).normal_W, [0, 0, -1])


def test_a_scene_without_a_name_takes_the_name_of_its_file(tmp_path):
    file = write(tmp_path / "hall.toml", malformed.broken(malformed.SCENE, ("name",), malformed.DELETE))
    assert load_scene(file).name == "hall"


def test_integers_serve_as_numbers(tmp_path):
    scene = load_scene(write(tmp_path / "r.toml", malformed.broken(malformed.SCENE, ("gravity",), 10)))
    assert scene.gravity == 10.0


@pytest.mark.parametrize("name", list_scenes())
class TestBuiltIn:
    def test_survives_file_dict_pickle_and_copy(self, name, tmp_path):
        scene = load_scene(name)
        data = scene_to_dict(scene)
        save_scene(scene, tmp_path / "copy.toml", header="a comment\nof two lines")
        for other in (
            load_scene(tmp_path / "copy.toml"),
            scene_from_dict(json.loads(json.dumps(data))),
            pickle.loads(pickle.dumps(scene)),
            copy.deepcopy(scene),
            eval(repr(scene), {**vars(mp), **vars(mp.model)}),  # a repr can be pasted back
        ):
            assert scene_to_dict(other) == data

    def test_fits_its_json_schema(self, name):
        schema = json.loads((DATA / "schema" / "scene.json").read_text())
        data = tomllib.loads((DATA / "scenes" / f"{name}.toml").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(data, schema)

    def test_is_named_like_its_file_and_described(self, name):
        scene = load_scene(name)
        assert scene.name == name
        assert 10 < len(scene.description) < 100

    def test_starts_and_ends_within_the_reach_of_humanoid44(self, name):
        scene, robot = load_scene(name), mp.load_robot("humanoid44")
        for field in ("start", "goal"):
            stance = getattr(scene, field)
            resolved = resolve_stance(scene, robot, stance, field)
            turn = np.array(
                [
                    [np.cos(stance.yaw), -np.sin(stance.yaw), 0],
                    [np.sin(stance.yaw), np.cos(stance.yaw), 0],
                    [0, 0, 1],
                ]
            )
            for end, position_W, surface in zip(
                robot.end_effectors, resolved.end_effectors_W, resolved.contacts, strict=True
            ):
                relative = turn.T @ (position_W - resolved.com_W)
                assert (relative >= end.reach_min_B - 1e-9).all() and (relative <= end.reach_max_B + 1e-9).all()
                assert (surface >= 0) == (end.kind == "foot" or name == "chimney")


def test_stairs_gap_and_rail_have_the_published_sizes():
    treads = {s.name: s.vertices_W for s in load_scene("stairs").surfaces}
    assert [treads[f"tread_{i}"][:, 2].max() for i in (1, 2, 3)] == [0.1, 0.2, 0.3]
    assert [treads[f"tread_{i}"][:, 0].min() for i in (1, 2, 3)] == [0.4, 0.9, 1.4]
    rail = load_scene("gap_with_rail")
    before, after, right, left = (s.vertices_W for s in rail.surfaces)
    assert after[:, 0].min() - before[:, 0].max() == pytest.approx(0.8)
    np.testing.assert_allclose(right, (left * [1, -1, 1])[[3, 2, 1, 0]])  # mirror images
    handle = load_scene("gap_with_handle")
    for pad, grip in zip(rail.surfaces[2:], handle.surfaces[2:], strict=True):
        assert (pad.grasp, pad.friction, grip.grasp) == (False, 0.7, True)
        np.testing.assert_array_equal(pad.vertices_W, grip.vertices_W)
    assert rail.rules[0].when_free == ("foot",) and rail.rules[0].require == ("right_hand", "left_hand")


SIDES = (("right", 1.0), ("left", -1.0))


def test_slope_is_20_degrees_and_walls_face_each_other():
    normal = Polygon(load_scene("slope").surfaces[1].vertices_W).normal_W
    assert np.degrees(np.arccos(normal[2])) == pytest.approx(20.0, abs=1e-3)
    walls = [("gap_with_wall", "wall"), ("chimney", "wall"), ("chimney", "rib")]
    for name, wall, sign in [(name, f"{side}_{wall}", sign) for name, wall in walls for side, sign in SIDES]:
        scene = load_scene(name)
        polygon = Polygon(scene.surfaces[scene.surface_index(wall)].vertices_W)
        np.testing.assert_allclose(polygon.normal_W, [0.0, sign, 0.0], atol=1e-12)


coordinates = st.floats(-100, 100, allow_subnormal=False)
names = st.text(st.characters(codec="utf-8"), min_size=1, max_size=12)


@st.composite
def scenes(draw):
    """Scenes of random convex polygons in random planes, with names that need quoting."""
    surfaces = []
    for name in draw(st.lists(names, min_size=1, max_size=4, unique=True)):
        rng = np.random.default_rng(draw(st.integers(0, 2**32)))
        count = int(rng.integers(3, 9))
        angles = 2 * np.pi * (np.arange(count) + rng.uniform(-0.3, 0.3, count)) / count
        circle = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1) * rng.uniform(0.05, 5.0)
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        surfaces.append(
            mp.model.Surface(
                name=name,
                vertices_W=circle @ turn.T + rng.uniform(-10, 10, 3),
                friction=draw(st.floats(1e-3, 2.0)),
                grasp=draw(st.booleans()),
                end_effectors=draw(st.lists(names, max_size=2)),
                thickness=draw(st.floats(1e-3, 1.0)),
            )
        )
    stances = [
        mp.model.Stance(
            position_W=draw(st.tuples(coordinates, coordinates, coordinates)),
            yaw=draw(st.floats(-6.28, 6.28)),
            contacts={draw(names): draw(st.sampled_from([s.name for s in surfaces]))},
        )
        for _ in range(2)
    ]
    rules = draw(
        st.lists(st.builds(mp.model.ContactRule, when_free=st.just(["foot"]), require=st.lists(names, min_size=1)))
    )
    return mp.Scene(
        name=draw(names),
        description=draw(st.text(st.characters(codec="utf-8"), max_size=20)),
        gravity=draw(st.floats(0.1, 30)),
        surfaces=surfaces,
        start=stances[0],
        goal=stances[1],
        rules=rules,
        steps=[
            mp.model.Step(end_effector=draw(names), surface=surface.name)
            for surface in surfaces[: draw(st.integers(0, 4))]
        ],
    )


@given(scenes())
def test_every_scene_survives_toml(scene):
    data = scene_to_dict(scene)
    assert scene_to_dict(scene_from_dict(tomllib.loads(toml_text(data)))) == data


def test_the_scene_of_the_documentation_is_valid():
    page = (Path(__file__).parents[2] / "docs" / "scenes_and_robots.md").read_text()
    scene = scene_from_dict(tomllib.loads(page.split("```toml\n")[1].split("```")[0]))
    assert [surface.name for surface in scene.surfaces] == ["ground", "ledge"]


@pytest.mark.parametrize("name", list_scenes())
def test_a_scaled_scene_has_all_its_lengths_scaled_and_nothing_else(name):
    scene = load_scene(name)
    half = scaled(scene, 0.5)
    half.validate()
    for whole, part in zip(scene.surfaces, half.surfaces, strict=True):
        np.testing.assert_allclose(part.vertices_W, 0.5 * whole.vertices_W)
        assert part.thickness == pytest.approx(0.5 * whole.thickness)
        assert (part.name, part.friction, part.grasp) == (whole.name, whole.friction, whole.grasp)
        assert tuple(part.end_effectors) == tuple(whole.end_effectors)
    for whole, part in ((scene.start, half.start), (scene.goal, half.goal)):
        np.testing.assert_allclose(part.position_W, 0.5 * whole.position_W)
        assert (part.yaw, dict(part.contacts)) == (whole.yaw, dict(whole.contacts))
    assert half.gravity == scene.gravity
    assert scene_to_dict(scaled(half, 2.0)) == scene_to_dict(scene)
    assert [step.surface for step in half.steps] == [step.surface for step in scene.steps]


@pytest.mark.parametrize("factor", [0.0, -1.0, 1e-300, 1001.0, float("nan"), float("inf")])
def test_a_scene_is_scaled_within_a_range_that_is_told(factor):
    with pytest.raises(mp.errors.InvalidOptions, match=r"scale: must lie in \[0.001, 1000\], got "):
        scaled(load_scene("flat"), factor)
