"""mcplan.files.sound_parts: one reading says what is wrong with types and with geometry, and nothing that is not so."""

from __future__ import annotations

import pytest

import malformed
import mcplan as mp
from mcplan.files.robots import robot_from_dict
from mcplan.files.scenes import scene_from_dict


def fields_of(found: mp.InvalidInput) -> list[str]:
    return [each.field for each in (found, *found.others)]


def test_types_geometry_and_names_of_a_scene_are_said_at_once():
    data = malformed.broken(malformed.SCENE, ("surfaces", 0, "verticies"), malformed.SQUARE)
    data = malformed.broken(data, ("surfaces", 0, "vertices"), malformed.DELETE)
    data = malformed.broken(data, ("surfaces", 1, "vertices"), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]])
    data = malformed.broken(data, ("goal", "contacts"), {"foot": "roof"})
    data = malformed.broken(data, ("gravity",), "heavy")
    data = malformed.broken(data, ("steps", 0, "surface"), "roof")
    with pytest.raises(mp.errors.InvalidScene) as found:
        scene_from_dict(data, "my.toml")
    expected = ["gravity", "surfaces[0].verticies", "surfaces[1].vertices", "goal.contacts.foot", "steps[0].surface"]
    assert sorted(fields_of(found.value)) == sorted(expected)
    assert {each.source for each in (found.value, *found.value.others)} == {"my.toml"}


def test_both_of_two_wrong_polygons_are_said():
    line = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
    data = malformed.broken(malformed.SCENE, ("surfaces", 0, "vertices"), line)
    data = malformed.broken(data, ("surfaces", 1, "vertices"), line)
    with pytest.raises(mp.errors.InvalidScene) as found:
        scene_from_dict(data)
    assert fields_of(found.value) == ["surfaces[0].vertices", "surfaces[1].vertices"]


def test_types_and_ranges_of_a_robot_are_said_at_once():
    data = malformed.broken(malformed.ROBOT, ("mass",), malformed.DELETE)
    data = malformed.broken(data, ("end_effectors", 1, "kind"), 3)
    data = malformed.broken(data, ("end_effectors", 0, "nominal"), [0.0, 0.0, -0.9])
    data = malformed.broken(data, ("phase_duration",), [0.5, 0.3])
    with pytest.raises(mp.errors.InvalidRobot) as found:
        robot_from_dict(data)
    expected = ["mass", "end_effectors[1].kind", "end_effectors[0].nominal", "phase_duration"]
    assert sorted(fields_of(found.value)) == sorted(expected)


@pytest.mark.parametrize("case", malformed.SCENE_BREAKS, ids=malformed.label)
def test_nothing_is_found_in_the_parts_of_a_scene_that_are_right(case):
    path, value, field, _ = case
    with pytest.raises(mp.errors.InvalidScene) as found:
        scene_from_dict(malformed.broken(malformed.SCENE, path, value))
    assert all(each.startswith(field) for each in fields_of(found.value))


@pytest.mark.parametrize("case", malformed.ROBOT_BREAKS, ids=malformed.label)
def test_nothing_is_found_in_the_parts_of_a_robot_that_are_right(case):
    path, value, field, _ = case
    with pytest.raises(mp.errors.InvalidRobot) as found:
        robot_from_dict(malformed.broken(malformed.ROBOT, path, value))
    assert all(each.startswith(field) for each in fields_of(found.value))
