"""mcplan.files.planar_tasks: numbers, short and long form, errors as in the file, and stances that robots can take."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import malformed
import malformed_planar
import mcplan as mp
from mcplan.files.builtin import DATA
from mcplan.files.planar_robots import planar_robot_from_dict
from mcplan.files.planar_tasks import (
    list_planar_tasks,
    load_planar_task,
    planar_task_from_dict,
    planar_task_to_dict,
    save_planar_task,
)
from mcplan.files.toml import toml_text
from plain_toml import tomllib
from planar_statics import stand
from reference_solutions import reference_task

NEAR = {"rtol": 0.0, "atol": 1e-12}
PAPER = ["cartwheel", "climbing", "climbing_steep", "walking"]

#: Base x, y [m], angle [rad] in the first stance, from where the stances after it are found.
FIRST_BASE = {
    "cartwheel": (0.35, 0.75, 0.0),
    "chimney": (0.54, 0.70, 0.66),
    "climbing": (0.20, 0.85, 0.80),
    "climbing_steep": (0.20, 0.85, 0.80),
    "stairs": (0.0, 0.85, 0.0),
    "walking": (0.0, 0.85, 0.0),
}


def write(path: Path, data: dict) -> Path:
    path.write_text(toml_text(data))
    return path


def test_the_data_that_are_broken_below_are_valid(tmp_path):
    task = load_planar_task(write(tmp_path / "step.toml", malformed_planar.TASK))
    assert task.robot.name == "compass"
    assert [[contact.end_effector for contact in phase.contacts] for phase in task.phases] == [[0, 1], [1], [0, 1]]
    assert [phase.intervals for phase in task.phases] == [3, 4, 5]
    assert (task.phases[1].min_duration, task.phases[1].max_duration) == (0.2, 2.0)
    assert task.phases[2].contacts[0].angle == pytest.approx(2 * np.pi)
    np.testing.assert_array_equal(task.phases[1].poses[0].max, [0.2, np.inf, np.inf])
    first, second = task.phases[1].clearances
    assert (first.middle_height, first.first_interval, first.end_interval) == (0.02, 0, -1)
    assert (second.middle_height, second.first_interval, second.end_interval) == (-np.inf, 1, 2)


@pytest.mark.parametrize("case", malformed_planar.TASK_BREAKS, ids=malformed.label)
def test_a_broken_file_is_named_with_field_and_rule(case, tmp_path):
    path, value, field, rule = case
    file = write(tmp_path / "bad.toml", malformed.broken(malformed_planar.TASK, path, value))
    with pytest.raises(mp.errors.InvalidPlanarTask) as found:
        load_planar_task(file)
    message = str(found.value)
    assert message.startswith(f"{file}: {field}: "), message
    assert rule in message
    assert "\n" not in message


@pytest.mark.parametrize("case", malformed_planar.ROBOT_BREAKS, ids=malformed.label)
def test_a_broken_robot_in_a_task_is_named_as_such(case, tmp_path):
    path, value, field, _ = case
    robot = malformed.broken(malformed_planar.ROBOT, path, value)
    file = write(tmp_path / "bad.toml", {**malformed_planar.TASK, "robot": robot})
    with pytest.raises(mp.errors.InvalidRobot) as found:
        load_planar_task(file)
    assert str(found.value).startswith(f"{file}: robot.{field}: ")


def test_unknown_names_list_the_names_that_exist():
    with pytest.raises(
        mp.errors.UnknownPlanarTask, match=r"no planar task 'walkin' .* Did you mean 'walking'\? Built-in: cartwheel, "
    ):
        load_planar_task("walkin")
    with pytest.raises(mp.errors.UnknownRobot, match=r"no robot 'walker' .* Did you mean 'walker9'\?"):
        planar_task_from_dict({**malformed_planar.TASK, "robot": "walker"})


def test_a_robot_is_found_beside_the_task(tmp_path, monkeypatch):
    write(tmp_path / "compass.toml", malformed_planar.ROBOT)
    file = write(tmp_path / "step.toml", {**malformed_planar.TASK, "robot": "compass.toml"})
    monkeypatch.chdir("/")
    assert load_planar_task(file).robot.name == "compass"


def test_a_task_without_a_name_takes_the_name_of_its_file(tmp_path):
    data = malformed.broken(malformed_planar.TASK, ("name",), malformed.DELETE)
    assert load_planar_task(write(tmp_path / "hop.toml", data)).name == "hop"


def test_distances_along_a_surface_count_from_its_origin():
    data = copy.deepcopy(malformed_planar.TASK)
    data["surfaces"][0] |= {"origin": [1.0, 2.0], "angle": 0.3}
    data["phases"] = [{"contacts": [{"end_effector": "left_foot", "surface": "floor", "at": 0.5, "turns": -2}]}]
    (contact,) = planar_task_from_dict(data).phases[0].contacts
    np.testing.assert_allclose(contact.position_W, [1.0 + 0.5 * np.cos(0.3), 2.0 + 0.5 * np.sin(0.3)], **NEAR)
    assert contact.angle == pytest.approx(0.3 - 4 * np.pi, abs=1e-12)


def test_the_short_form_means_the_same_as_all_contacts_of_each_phase():
    short = copy.deepcopy(malformed_planar.TASK)
    long = copy.deepcopy(short)
    right, left = long["phases"][0]["contacts"]
    del long["phases"][1]["lift"]
    long["phases"][1]["contacts"] = [right]
    long["phases"][2]["contacts"] = [*long["phases"][2].pop("place"), right]
    assert repr(planar_task_from_dict(long)) == repr(planar_task_from_dict(short))


def test_a_foot_may_be_moved_within_one_phase_change():
    data = copy.deepcopy(malformed_planar.TASK)
    data["phases"][1:] = [{"lift": ["left_foot"]}, {"lift": ["right_foot"], "place": data["phases"][2]["place"]}]
    assert [contact.end_effector for contact in planar_task_from_dict(data).phases[2].contacts] == [0]


@pytest.mark.parametrize("name", PAPER)
def test_tasks_of_the_paper_have_the_numbers_of_the_reference(name):
    task, reference = mp.load_planar_task(name), reference_task(name)
    assert len(task.phases) == len(reference.phases)
    for phase, expected in zip(task.phases, reference.phases, strict=True):
        assert phase.intervals == expected.intervals
        assert (phase.min_duration, phase.max_duration, len(phase.poses)) == (0.0, float("inf"), 0)
        for contact, other in zip(phase.contacts, expected.contacts, strict=True):
            assert contact.end_effector == other.end_effector
            np.testing.assert_allclose(contact.position_W, other.position_W, **NEAR)
            np.testing.assert_allclose(contact.angle, other.angle, **NEAR)
            surface, same = task.surfaces[contact.surface], reference.surfaces[other.surface]
            assert surface.friction == same.friction == 2.0
            np.testing.assert_allclose(surface.normal_W, same.normal_W, **NEAR)
        for clearance, other in zip(phase.clearances, expected.clearances, strict=True):
            assert clearance.end_effector == other.end_effector
            assert clearance.middle_height == other.middle_height


@pytest.mark.parametrize("name", list_planar_tasks())
class TestBuiltIn:
    def test_survives_file_dict_pickle_and_copy(self, name, tmp_path):
        task = load_planar_task(name)
        save_planar_task(task, tmp_path / "copy.toml", header="a comment")
        for other in (
            load_planar_task(tmp_path / "copy.toml"),
            planar_task_from_dict(json.loads(json.dumps(planar_task_to_dict(task)))),
            pickle.loads(pickle.dumps(task)),
            copy.deepcopy(task),
        ):
            assert repr(other) == repr(task)

    def test_fits_its_json_schema(self, name):
        schema = json.loads((DATA / "schema" / "planar_task.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(tomllib.loads((DATA / "planar_tasks" / f"{name}.toml").read_text()), schema)
        jsonschema.validate(planar_task_to_dict(load_planar_task(name)), schema)

    def test_is_named_like_its_file_and_described(self, name):
        task = load_planar_task(name)
        assert task.name == name
        assert 10 < len(task.description) < 100

    def test_every_stance_is_reached_and_stands_still_at_two_thirds_of_the_torque_limits(self, name):
        task = load_planar_task(name)
        rest = np.zeros(task.robot.joint_count())
        posture = np.r_[FIRST_BASE[name], rest]
        for phase in range(len(task.phases)):
            standing = stand(task, phase, posture, rest)
            assert standing.error < 1e-6, (phase, standing)
            assert standing.load < 2 / 3, (phase, standing)
            posture = standing.posture


def test_a_stance_out_of_reach_is_not_reached():
    task = load_planar_task("walking")
    task.phases[2].contacts[1].position_W[0] += 1.2
    assert stand(task, 2, np.r_[0.1, 0.85, 0.0, np.zeros(9)], np.zeros(9)).error > 0.01


def test_walls_of_the_chimney_lean_outwards_and_both_are_touched_in_every_phase():
    task = load_planar_task("chimney")
    lean = np.radians(10.0)
    normals = [[np.cos(lean), np.sin(lean)], [-np.cos(lean), np.sin(lean)]]
    np.testing.assert_allclose([surface.normal_W for surface in task.surfaces], normals, atol=1e-12)
    assert all({contact.surface for contact in phase.contacts} == {0, 1} for phase in task.phases)
    for before, after in zip(task.phases[0].contacts, task.phases[-1].contacts, strict=True):
        assert after.position_W[1] - before.position_W[1] == pytest.approx(0.25, abs=2e-3)


def test_stairs_have_one_foot_on_each_tread_and_both_on_the_last():
    task = load_planar_task("stairs")
    treads = [[task.surfaces[contact.surface].name for contact in phase.contacts] for phase in task.phases[::2]]
    assert treads == [
        ["ground", "ground"],
        ["ground", "tread_1"],
        ["tread_2", "tread_1"],
        ["tread_2", "tread_3"],
        ["tread_3", "tread_3"],
    ]
    heights = {surface.name: surface.origin_W[1] for surface in task.surfaces}
    assert [heights[f"tread_{i}"] for i in (1, 2, 3)] == pytest.approx([0.12, 0.24, 0.36])


def test_swings_of_the_stairs_are_clear_of_each_step_throughout():
    """Every point that a swing's clearances allow in an interval is outside of the steps."""
    task = load_planar_task("stairs")
    xs, ys = np.meshgrid(np.linspace(-1.0, 2.0, 601), np.linspace(-0.2, 1.0, 241))
    solid = (ys < -1e-9) | ((xs > 0.18 + 1e-9) & (ys < 0.12 - 1e-9))
    solid |= ((xs > 0.48 + 1e-9) & (ys < 0.24 - 1e-9)) | ((xs > 0.78 + 1e-9) & (ys < 0.36 - 1e-9))
    for k, phase in enumerate(task.phases):
        for interval in range(phase.intervals if len(phase.contacts) == 1 else 0):
            allowed = np.ones_like(solid)
            for clearance in phase.clearances:
                end = phase.intervals if clearance.end_interval < 0 else clearance.end_interval
                if clearance.first_interval <= interval < end:
                    surface = task.surfaces[clearance.surface]
                    from_origin = np.stack([xs, ys], axis=-1) - surface.origin_W
                    allowed &= from_origin @ surface.normal_W >= 0.0
            near = allowed & solid & (xs < 0.48 if k < 3 else xs > -1.0)
            assert not near.any(), (k, interval, xs[near][:3], ys[near][:3])


def test_the_robot_and_the_task_of_the_documentation_are_valid():
    page = (Path(__file__).parents[2] / "docs" / "planar_tasks.md").read_text()
    robot, task = (tomllib.loads(text.split("```")[0]) for text in page.split("```toml\n")[1:])
    assert planar_robot_from_dict(robot).mass() == 9.0
    assert [len(phase.contacts) for phase in planar_task_from_dict(task).phases] == [2, 1, 2]
