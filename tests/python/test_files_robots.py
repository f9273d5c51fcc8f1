"""mcplan.files.robots: round trips, and errors that name field and rule."""

from __future__ import annotations

import copy
import json
import pickle

import jsonschema
import numpy as np
import pytest

import malformed
import mcplan as mp
from mcplan.files.builtin import DATA
from mcplan.files.robots import list_robots, load_robot, robot_from_dict, robot_to_dict, save_robot
from mcplan.files.toml import toml_text
from plain_toml import tomllib
from standing import standing_plan


def test_the_data_that_are_broken_below_are_valid(tmp_path):
    (tmp_path / "hopper.toml").write_text(toml_text(malformed.ROBOT))
    robot = load_robot(tmp_path / "hopper.toml")
    assert [end.kind for end in robot.end_effectors] == ["foot", "hand"]
    assert robot.end_effectors[1].max_force == float("inf")
    assert dict(robot.posture) == {"knee": 0.3}
    assert [end.yaw_range.tolist() for end in robot.end_effectors] == [[-0.4, 0.6], [-np.inf, np.inf]]


@pytest.mark.parametrize("case", malformed.ROBOT_BREAKS, ids=malformed.label)
def test_a_broken_robot_file_is_named_with_field_and_rule(case, tmp_path):
    path, value, field, rule = case
    file = tmp_path / "bad.toml"
    file.write_text(toml_text(malformed.broken(malformed.ROBOT, path, value)))
    with pytest.raises(mp.errors.InvalidRobot) as found:
        load_robot(file)
    message = str(found.value)
    assert message.startswith(f"{file}: {field}"), message
    assert rule in message
    assert "\n" not in message


def test_an_unknown_name_lists_the_names_that_exist():
    with pytest.raises(
        mp.errors.UnknownRobot, match=r"no robot 'talus' and no file of that name. Did you mean 'talos'\?"
    ):
        load_robot("talus")


@pytest.mark.parametrize("name", list_robots())
class TestBuiltIn:
    def test_survives_file_dict_pickle_and_copy(self, name, tmp_path):
        robot = load_robot(name)
        data = robot_to_dict(robot)
        save_robot(robot, tmp_path / "copy.toml", header="a comment")
        for other in (
            load_robot(tmp_path / "copy.toml"),
            robot_from_dict(json.loads(json.dumps(data))),
            pickle.loads(pickle.dumps(robot)),
            copy.deepcopy(robot),
            eval(repr(robot), {**vars(mp), **vars(mp.model)}),
        ):
            assert robot_to_dict(other) == data

    def test_fits_its_json_schema(self, name):
        schema = json.loads((DATA / "schema" / "robot.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(tomllib.loads((DATA / "robots" / f"{name}.toml").read_text()), schema)

    def test_is_the_same_on_both_sides(self, name):
        flip = np.array([1.0, -1.0, 1.0])
        ends = {end.name: end for end in load_robot(name).end_effectors}
        for end_name, end in ends.items():
            twin = ends[
                end_name.replace("right", "left")
                if "right" in end_name
                else end_name.replace("left", "right")
                if "left" in end_name
                else {"r": "l", "l": "r"}[end_name[0]] + end_name[1:]
            ]
            np.testing.assert_allclose(twin.nominal_B, end.nominal_B * flip)
            np.testing.assert_allclose(twin.reach_min_B[[0, 2]], end.reach_min_B[[0, 2]])
            np.testing.assert_allclose(twin.reach_min_B[1], -end.reach_max_B[1])

    def test_stands_on_its_feet_and_can_bear_its_weight(self, name):
        robot = load_robot(name)
        feet = [end for end in robot.end_effectors if end.kind == "foot"]
        for foot in feet:
            assert foot.nominal_B[2] == pytest.approx(-robot.com_height)
            assert foot.reach_min_B[2] < foot.nominal_B[2] < foot.reach_max_B[2]  # it can bend and stretch
        assert sum(foot.max_force for foot in feet) > 2 * robot.mass * 9.81


def test_humanoid44_has_the_published_numbers():
    robot = load_robot("humanoid44")
    assert (robot.mass, robot.com_height) == (44.0, 0.70)
    assert [end.name for end in robot.end_effectors] == ["right_foot", "left_foot", "right_hand", "left_hand"]
    np.testing.assert_allclose(robot.end_effectors[0].reach_min_B, [-0.3, -0.15, -0.75])
    np.testing.assert_allclose(robot.end_effectors[0].reach_max_B, [0.3, -0.05, -0.55])
    assert robot.end_effectors[2].max_force == pytest.approx(4.06 * 44.0 * 9.8, rel=1e-3)


def test_phase_durations_and_sole_support_are_written_where_they_are_not_the_defaults(tmp_path):
    robot = load_robot("humanoid44")
    assert not {"phase_duration", "sole_support"} & set(robot_to_dict(robot))
    assert (robot.phase_duration.tolist(), robot.sole_support) == ([0.15, 0.5], 0.0)
    robot.phase_duration, robot.sole_support = [0.25, 0.75], 0.6
    save_robot(robot, tmp_path / "slow.toml")
    again = load_robot(tmp_path / "slow.toml")
    assert (again.phase_duration.tolist(), again.sole_support) == ([0.25, 0.75], 0.6)
    assert tomllib.loads((tmp_path / "slow.toml").read_text())["phase_duration"] == [0.25, 0.75]


def test_that_plans_are_tracked_survives_file_dict_pickle_and_repr_and_is_left_out_where_they_are_not(tmp_path):
    assert [load_robot(name).tracked for name in ("humanoid44", "talos_wang", "talos", "anymal")] == [
        *(False, False, True, True)
    ]
    robot = load_robot("humanoid44")
    assert "tracked" not in robot_to_dict(robot)
    robot.tracked = True
    save_robot(robot, tmp_path / "followed.toml")
    for other in (
        load_robot(tmp_path / "followed.toml"),
        pickle.loads(pickle.dumps(robot)),
        eval(repr(robot), {**vars(mp), **vars(mp.model)}),
    ):
        assert other.tracked and robot_to_dict(other) == robot_to_dict(robot)


def test_the_range_of_a_soles_heading_survives_file_dict_pickle_and_repr_and_is_left_out_where_it_is_any(tmp_path):
    robot = load_robot("humanoid44")
    foot, hand = robot.end_effectors[0], robot.end_effectors[2]
    foot.yaw_range = [-0.25, 0.5]
    data = robot_to_dict(robot)
    assert data["end_effectors"][0]["yaw_range"] == [-0.25, 0.5]
    assert "yaw_range" not in data["end_effectors"][2] and hand.yaw_range.tolist() == [-np.inf, np.inf]
    save_robot(robot, tmp_path / "turning.toml")
    assert tomllib.loads((tmp_path / "turning.toml").read_text())["end_effectors"][0]["yaw_range"] == [-0.25, 0.5]
    for other in (
        load_robot(tmp_path / "turning.toml"),
        robot_from_dict(json.loads(json.dumps(data))),
        pickle.loads(pickle.dumps(robot)),
        eval(repr(robot), {**vars(mp), **vars(mp.model)}),
    ):
        assert robot_to_dict(other) == data
        assert other.end_effectors[2].yaw_range.tolist() == [-np.inf, np.inf]


def test_a_plan_keeps_phase_durations_and_sole_support_of_its_robot(tmp_path):
    robot = load_robot("talos")
    assert (robot.phase_duration.tolist(), robot.sole_support) == ([0.3, 0.6], 1.0)
    robot.phase_duration, robot.sole_support = [0.35, 0.65], 0.4
    standing_plan(robot=robot).save(tmp_path / "plan.npz")
    again = mp.Plan.load(tmp_path / "plan.npz").robot
    assert (again.phase_duration.tolist(), again.sole_support) == ([0.35, 0.65], 0.4)


@pytest.mark.parametrize(
    ("field", "value", "rule"),
    [
        ("phase_duration", [0.5, 0.3], "must be two positive numbers, the shorter first"),
        ("phase_duration[0]", [0.0, 0.3], "must be a positive number"),
        ("sole_support", 1.5, "must be at most 1"),
        ("sole_support", -0.5, "must be at least 0"),
    ],
)
def test_a_robot_made_in_python_is_held_to_the_same_ranges(field, value, rule):
    robot = load_robot("humanoid44")
    setattr(robot, field.split("[")[0], value)
    with pytest.raises(mp.errors.InvalidRobot, match=rule) as found:
        robot.validate()
    assert found.value.field == field
