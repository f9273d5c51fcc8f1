"""mcplan.export.ocs2: schedules and trajectories as OCS2's loaders of Boost property trees read them."""

from __future__ import annotations

import re

import numpy as np
import pytest

import mcplan as mp
from exports import plan
from mcplan.export.ocs2 import feet_of, joined, mode_name
from stepping import stepping_plan

#: ModeNumber of ocs2_legged_robot.
MODES = """FLY RH LH LH_RH RF RF_RH RF_LH RF_LH_RH LF LF_RH LF_LH LF_LH_RH LF_RF LF_RF_RH LF_RF_LH STANCE""".split()


def property_tree(text: str) -> dict:
    """What boost::property_tree::read_info makes of it: keys with a value or with children."""
    stack: list[dict] = [{}]
    last = ""
    for line in text.splitlines():
        words = line.split(";")[0].split()
        if not words:
            continue
        if words == ["{"]:
            stack[-1][last] = {}
            stack.append(stack[-1][last])
        elif words == ["}"]:
            stack.pop()
        else:
            last = words[0]
            assert last not in stack[-1]
            stack[-1][last] = words[1] if len(words) > 1 else ""
    assert len(stack) == 1
    return stack[0]


def std_vector(tree: dict) -> list[str]:
    """ocs2::loadData::loadStdVector: entries [0], [1], ... until one is missing."""
    found = []
    while f"[{len(found)}]" in tree:
        found.append(tree[f"[{len(found)}]"])
    assert len(found) == len(tree)
    return found


def eigen_matrix(tree: dict) -> np.ndarray:
    """ocs2::loadData::loadEigenMatrix: entries (row,column)."""
    places = [tuple(int(i) for i in re.fullmatch(r"\((\d+),(\d+)\)", key).groups()) for key in tree]
    matrix = np.full(np.max(places, axis=0) + 1, np.nan)
    for place, value in zip(places, tree.values(), strict=True):
        matrix[place] = float(value)
    assert np.isfinite(matrix).all()
    return matrix


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    path = tmp_path_factory.mktemp("ocs2") / "reference.info"
    return property_tree(mp.export(plan(), "ocs2", path).read_text())


def test_the_mode_schedule_is_the_contact_sequence(tree):
    schedule = tree["initialModeSchedule"]
    modes, events = std_vector(schedule["modeSequence"]), [float(t) for t in std_vector(schedule["eventTimes"])]
    assert len(modes) == len(events) + 1 and set(modes) <= set(MODES)
    right, left = (plan().robot.end_effector_index(f"{side}_foot") for side in ("right", "left"))
    for t in np.linspace(0.01, plan().duration() - 0.01, 200):
        down = [plan().at(t).end_effectors[foot].surface >= 0 for foot in (left, right)]
        mode = modes[int(np.searchsorted(events, t, "right"))]
        assert [mode == "STANCE" or side in mode.split("_") for side in ("LF", "RF")] == down


def test_the_template_has_a_time_more_than_modes(tree):
    template = tree["defaultModeSequenceTemplate"]
    times = [float(t) for t in std_vector(template["switchingTimes"])]
    assert len(times) == len(std_vector(template["modeSequence"])) + 1
    assert times[0] == 0.0 and times[-1] == plan().duration() and times == sorted(times)


def test_states_are_those_of_the_centroidal_model(tree, tmp_path):
    import pinocchio as pin

    targets = tree["targetTrajectories"]
    times = [float(t) for t in std_vector(targets["timeTrajectory"])]
    states, inputs = eigen_matrix(targets["stateTrajectory"]), eigen_matrix(targets["inputTrajectory"])
    motion = np.load(mp.export(plan(), "mjlab", tmp_path / "motion.npz", rate_hz=20))
    assert len(times) == len(states) == len(inputs) == len(motion["joint_pos"])
    np.testing.assert_array_equal(states[:, 12:], motion["joint_pos"])
    np.testing.assert_array_equal(inputs[:, -29:], motion["joint_vel"])
    np.testing.assert_allclose(states[:, 6:9], motion["body_pos_w"][:, 0], atol=1e-12)
    for row, (w, x, y, z) in zip(states, motion["body_quat_w"][:, 0], strict=True):
        yaw, pitch, roll = row[9:12]
        expected = pin.rpy.rpyToMatrix(roll, pitch, yaw)
        np.testing.assert_allclose(expected, pin.Quaternion(w, x, y, z).matrix(), atol=1e-9)
    for t, row, force in zip(times, states, inputs, strict=True):
        state = plan().at(t)
        np.testing.assert_allclose(row[:3], state.com_velocity_W, atol=0.06)
        total = force[0:3] + force[6:9]
        np.testing.assert_allclose(total, sum(np.array(end.force_W) for end in state.end_effectors), atol=1e-9)


def test_modes_have_the_names_and_numbers_of_ocs2():
    feet = ("LF", "RF", "LH", "RH")
    for number, name in enumerate(MODES):
        down = [bool(number & 8 >> bit) for bit in range(4)]
        assert mode_name(down, feet) == name
    assert list(feet_of(mp.load_robot("anymal"))) == list(feet_of(mp.load_robot("go2"))) == list(feet)
    assert joined(["a", "a", "b"], [0.0, 1.0, 2.0, 3.0]) == (["a", "b"], [0.0, 2.0, 3.0])


def test_a_robot_without_such_feet_is_refused(tmp_path):
    robot = mp.load_robot("g1")
    robot.end_effectors = [end for end in robot.end_effectors if end.name != "left_foot"]
    with pytest.raises(mp.errors.InvalidRobot, match="must have the feet left_foot and right_foot, or .*right_foot"):
        feet_of(robot)


def test_a_plan_with_forces_at_points_has_a_schedule_too(tmp_path):
    made = stepping_plan(steps=1, robot=mp.load_robot("g1"))
    tree = property_tree(mp.export(made, "ocs2", tmp_path / "a.info").read_text())
    assert std_vector(tree["initialModeSchedule"]["modeSequence"]) == ["STANCE", "RF", "STANCE", "STANCE"]
