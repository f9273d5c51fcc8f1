"""mcplan.files.planar_robots: numbers, round trips, and errors that name field and rule."""

from __future__ import annotations

import json

import jsonschema
import numpy as np
import pytest

import malformed
import malformed_planar
import mcplan as mp
from mcplan.files.builtin import DATA
from mcplan.files.planar_robots import (
    list_planar_robots,
    load_planar_robot,
    planar_robot_from_dict,
    planar_robot_to_dict,
    save_planar_robot,
)
from mcplan.files.toml import toml_text
from plain_toml import tomllib
from reference_solutions import reference_task

NEAR = {"rtol": 0.0, "atol": 1e-12}


def test_the_data_that_are_broken_below_are_valid(tmp_path):
    (tmp_path / "compass.toml").write_text(toml_text(malformed_planar.ROBOT))
    robot = load_planar_robot(tmp_path / "compass.toml")
    assert [body.parent for body in robot.bodies] == [-1, 0, 0]
    assert robot.bodies[1].torque_max == 40.0 and robot.bodies[2].torque_max == float("inf")
    assert robot.bodies[2].position_min == -float("inf")
    assert robot.collision_pairs == ((1, 2),)
    np.testing.assert_array_equal(robot.bodies[1].capsules[0].to_B, [0.0, -0.5])


@pytest.mark.parametrize("case", malformed_planar.ROBOT_BREAKS, ids=malformed.label)
def test_a_broken_file_is_named_with_field_and_rule(case, tmp_path):
    path, value, field, rule = case
    file = tmp_path / "bad.toml"
    file.write_text(toml_text(malformed.broken(malformed_planar.ROBOT, path, value)))
    with pytest.raises(mp.errors.InvalidRobot) as found:
        load_planar_robot(file)
    message = str(found.value)
    assert message.startswith(f"{file}: {field}: "), message
    assert rule in message
    assert "\n" not in message


def test_an_unknown_name_lists_the_planar_robots():
    with pytest.raises(
        mp.errors.UnknownRobot, match=r"no robot 'climber' .* Did you mean 'climber9'\? Built-in: climber9, "
    ):
        load_planar_robot("climber")


def test_a_robot_without_a_name_takes_the_name_of_its_file(tmp_path):
    data = malformed.broken(malformed_planar.ROBOT, ("name",), malformed.DELETE)
    (tmp_path / "rover.toml").write_text(toml_text(data))
    assert load_planar_robot(tmp_path / "rover.toml").name == "rover"


@pytest.mark.parametrize("name", list_planar_robots())
class TestBuiltIn:
    def test_survives_file_and_dict(self, name, tmp_path):
        robot = mp.load_planar_robot(name)
        data = planar_robot_to_dict(robot)
        save_planar_robot(robot, tmp_path / "copy.toml", header="a comment")
        assert repr(load_planar_robot(tmp_path / "copy.toml")) == repr(robot)
        assert repr(planar_robot_from_dict(json.loads(json.dumps(data)))) == repr(robot)

    def test_fits_its_json_schema(self, name):
        schema = json.loads((DATA / "schema" / "planar_robot.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(tomllib.loads((DATA / "planar_robots" / f"{name}.toml").read_text()), schema)

    def test_is_named_like_its_file_and_described(self, name):
        robot = load_planar_robot(name)
        assert robot.name == name
        assert 10 < len(robot.description) < 100

    def test_capsules_of_feet_end_where_their_soles_are(self, name):
        robot = load_planar_robot(name)
        for end in robot.end_effectors:
            (foot,) = robot.bodies[end.body].capsules
            assert min(foot.from_B[1], foot.to_B[1]) - foot.radius == pytest.approx(end.position_B[1])
            ends = sorted((foot.from_B[0], foot.to_B[0]))
            assert [ends[0] - foot.radius, ends[1] + foot.radius] == pytest.approx(sorted(end.points))


@pytest.mark.parametrize(("name", "task"), [("climber9", "cartwheel"), ("walker9", "walking")])
def test_built_in_robots_have_the_numbers_of_the_reference(name, task):
    robot, reference = load_planar_robot(name), reference_task(task).robot
    for body, expected in zip(robot.bodies, reference.bodies, strict=True):
        assert body.parent == expected.parent
        for key in ("joint_P", "offset", "mass", "com_B", "inertia"):
            np.testing.assert_allclose(getattr(body, key), getattr(expected, key), **NEAR)
        for key in ("position_min", "position_max", "velocity_max", "torque_max"):
            np.testing.assert_allclose(getattr(body, key), getattr(expected, key), **NEAR)
    for end, expected in zip(robot.end_effectors, reference.end_effectors, strict=True):
        assert end.body == expected.body
        for key in ("position_B", "angle_B", "points"):
            np.testing.assert_allclose(getattr(end, key), getattr(expected, key), **NEAR)


def test_masses_are_those_published():
    assert load_planar_robot("climber9").mass() == pytest.approx(24.5)
    assert load_planar_robot("walker9").mass() == pytest.approx(48.4)
