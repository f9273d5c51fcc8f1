"""mcplan.files.fields: unknown keys are told from those of the table in which they stand, wherever that is."""

from __future__ import annotations

import pytest

import malformed
import malformed_planar
import mcplan as mp
from mcplan.files.planar_robots import planar_robot_from_dict
from mcplan.files.planar_tasks import planar_task_from_dict
from mcplan.files.robots import robot_from_dict


def test_keys_of_a_table_under_a_free_name_are_known():
    data = malformed.broken(malformed.ROBOT, ("end_effectors", 0, "partner_reach", "arm", "name_"), "x")
    with pytest.raises(mp.errors.InvalidRobot) as found:
        robot_from_dict(data)
    message = "end_effectors[0].partner_reach.arm.name_: no such key. Did you mean 'name'? Keys: A, b, file, name"
    assert str(found.value) == message


def test_keys_of_an_optional_table_are_known():
    data = malformed.broken(malformed.ROBOT, ("end_effectors", 0, "com_reach", "flie"), "x")
    with pytest.raises(mp.errors.InvalidRobot, match=r"com_reach.flie: no such key. Did you mean 'file'\?"):
        robot_from_dict(data)


def test_a_key_that_goes_by_another_name_in_python_is_known_by_its_own():
    data = malformed.broken(
        malformed_planar.ROBOT, ("bodies", 0, "capsules"), [{"form": [0.0, 0.0], "to": [0.1, 0.0], "radius": 0.1}]
    )
    with pytest.raises(
        mp.errors.InvalidRobot, match=r"capsules\[0\].form: no such key. Did you mean 'from'\? Keys: from, to, radius"
    ):
        planar_robot_from_dict(data)


def test_findings_of_a_robot_within_a_task_have_its_place():
    robot = malformed.broken(malformed_planar.ROBOT, ("gravity",), "down")
    robot = malformed.broken(robot, ("bodies", 0, "mass"), -1.0)
    data = {**malformed_planar.TASK, "robot": robot, "phases": []}
    with pytest.raises(mp.InvalidInput) as found:
        planar_task_from_dict(data)
    fields = [each.field for each in (found.value, *found.value.others)]
    assert fields == ["robot.gravity", "robot.bodies[0].mass", "phases"]
