"""A URDF's contact frames lie where the robot says, turned as its base is in its posture; bad ones are named."""

from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.kinematics.urdf_model import leg_velocities, load_model, own_joints
from two_link_arm import LENGTHS, MASSES, arm_robot

pin = pytest.importorskip("pinocchio")


def contact_pose(urdf_model, q, end=0):
    data = urdf_model.model.createData()
    pin.framesForwardKinematics(urdf_model.model, data, q)
    return data.oMf[urdf_model.frames[end]]


def configuration(urdf_model, angles, base=(0.0, 0.0, 0.0), turn=None) -> np.ndarray:
    quaternion = np.array([0.0, 0.0, 0.0, 1.0]) if turn is None else pin.Quaternion(turn).coeffs()
    return np.concatenate([base, quaternion, angles])


def test_contact_point_of_two_links_is_where_trigonometry_puts_it(tmp_path):
    urdf_model = load_model(arm_robot(tmp_path))
    for a, b in ((0.0, 0.0), (0.3, 0.5), (-1.0, 2.0)):
        found = contact_pose(urdf_model, configuration(urdf_model, [a, b], base=(1.0, 2.0, 3.0)))
        x = LENGTHS[0] * np.cos(a) + LENGTHS[1] * np.cos(a + b)
        z = -LENGTHS[0] * np.sin(a) - LENGTHS[1] * np.sin(a + b)
        assert found.translation == pytest.approx([1.0 + x, 2.0, 3.0 + z])


def test_contact_frame_has_the_bases_axes_in_the_posture_and_turns_with_its_link(tmp_path):
    robot = arm_robot(tmp_path)
    robot.posture = {"shoulder": 0.4, "elbow": 0.7}
    urdf_model = load_model(robot)
    assert urdf_model.neutral[7:] == pytest.approx([0.4, 0.7])
    assert contact_pose(urdf_model, urdf_model.neutral).rotation == pytest.approx(np.eye(3), abs=1e-12)
    turned = contact_pose(urdf_model, configuration(urdf_model, [0.4, 0.9])).rotation
    assert turned == pytest.approx(pin.rpy.rpyToMatrix(0.0, 0.2, 0.0), abs=1e-12)
    yaw = pin.rpy.rpyToMatrix(0.0, 0.0, 1.1)
    assert contact_pose(urdf_model, configuration(urdf_model, [0.4, 0.7], turn=yaw)).rotation == pytest.approx(
        yaw, abs=1e-12
    )


def test_offset_is_in_the_axes_of_the_urdfs_frame(tmp_path):
    """Posture: the last link points down (pi/2 about y), its x axis is -z of the world and its z axis is x."""
    robot = arm_robot(tmp_path)
    robot.posture = {"shoulder": np.pi / 2}
    plain = contact_pose(load_model(robot), load_model(robot).neutral).translation
    robot.end_effectors[0].frame_offset = [0.05, 0.02, 0.01]
    urdf_model = load_model(robot)
    found = contact_pose(urdf_model, urdf_model.neutral)
    assert found.translation - plain == pytest.approx([0.01, 0.02, -0.05], abs=1e-12)
    assert found.rotation == pytest.approx(np.eye(3), abs=1e-12)


def test_base_stands_at_the_origin_and_masses_are_the_urdfs(tmp_path):
    urdf_model = load_model(arm_robot(tmp_path))
    assert urdf_model.neutral[:7] == pytest.approx([0, 0, 0, 0, 0, 0, 1])
    assert sum(inertia.mass for inertia in urdf_model.model.inertias) == pytest.approx(50.0 + sum(MASSES))
    assert urdf_model.path == (tmp_path / "arm.urdf").resolve()
    assert [urdf_model.model.frames[f].name for f in urdf_model.frames] == ["mcplan/hand"]


def test_link_is_meant_where_a_joint_bears_its_name(tmp_path):
    """The joint "tip" sits at the elbow, the link "tip" at the end of the arm."""
    robot = arm_robot(tmp_path)
    file = tmp_path / "arm.urdf"
    file.write_text(file.read_text().replace('joint name="elbow"', 'joint name="tip"'))
    urdf_model = load_model(robot)
    assert contact_pose(urdf_model, urdf_model.neutral).translation == pytest.approx([sum(LENGTHS), 0.0, 0.0])


def test_talos_feet_are_flat_and_apart_in_its_posture():
    pytest.importorskip("example_robot_data")
    robot = mp.load_robot("talos")
    urdf_model = load_model(robot)
    com = pin.centerOfMass(urdf_model.model, urdf_model.model.createData(), urdf_model.neutral)
    for end in range(2):
        found = contact_pose(urdf_model, urdf_model.neutral, end)
        assert found.rotation == pytest.approx(np.eye(3), abs=1e-9)
        assert found.translation - com == pytest.approx(robot.end_effectors[end].nominal_B, abs=2e-3)
    assert sum(inertia.mass for inertia in urdf_model.model.inertias) == pytest.approx(robot.mass, abs=1e-3)


def test_bad_urdf_robots_are_named(tmp_path):
    pytest.importorskip("example_robot_data")
    broken = tmp_path / "broken.urdf"
    broken.write_text("<robot name='x'><link")
    cases = [
        ({"urdf": ""}, "talos: urdf: must name a URDF: this robot has no joints"),
        ({"urdf": "/nowhere/robot.urdf"}, "talos: urdf: must be a readable URDF"),
        ({"urdf": str(broken)}, "talos: urdf: must be a readable URDF"),
        ({"urdf": "example-robot-data:nobody"}, "talos: urdf: must be a readable URDF"),
        ({"posture": {"third_arm": 0.1}}, 'talos: posture: must name joints of the URDF, got "third_arm"'),
    ]
    for change, message in cases:
        robot = by_hand.talos()
        for field, value in change.items():
            setattr(robot, field, value)
        with pytest.raises(mp.errors.InvalidRobot) as error:
            load_model(robot)
        assert str(error.value).startswith(message)


def test_frame_that_the_urdf_lacks_is_named(tmp_path):
    robot = arm_robot(tmp_path)
    robot.end_effectors[0].frame = "thumb"
    message = r'arm: end_effectors\[0\].frame: must name a frame of the URDF, got "thumb"'
    with pytest.raises(mp.errors.InvalidRobot, match=message):
        load_model(robot)


def test_relative_paths_are_those_of_the_working_folder(tmp_path, monkeypatch):
    robot = arm_robot(tmp_path)
    monkeypatch.chdir(tmp_path)
    robot.urdf = "arm.urdf"
    assert load_model(robot).path == Path(tmp_path, "arm.urdf").resolve()


def test_own_joints_are_those_that_move_one_end_effector_alone():
    pytest.importorskip("example_robot_data")
    urdf_model = load_model(mp.load_robot("talos"))
    hand = urdf_model.robot.end_effector_index("right_hand")
    names = [urdf_model.model.names[joint] for joint in own_joints(urdf_model, hand)]
    assert names == [f"arm_right_{i}_joint" for i in range(1, 8)]


@pytest.mark.parametrize(("robot", "part", "count"), [("talos", "leg_", 12), ("anymal", "", 12)])
def test_velocities_of_legs_are_those_of_the_joints_of_feet(robot, part, count):
    pytest.importorskip("example_robot_data")
    urdf_model = load_model(mp.load_robot(robot))
    legs = leg_velocities(urdf_model)
    model = urdf_model.model
    assert legs.shape == (model.nv - 6,)
    found = {name for name, joint in zip(model.names[2:], model.joints[2:], strict=True) if legs[joint.idx_v - 6]}
    assert len(found) == legs.sum() == count and all(name.startswith(part) for name in found)
