"""mcplan.export.ros2: the node runs with stand-ins of rclpy and its messages, which take the fields and types that ROS takes."""

from __future__ import annotations

import importlib.util
import sys
import types

import numpy as np
import pytest

import mcplan as mp
from exports import plan


def record(title: str, /, **fields):
    """A message: only its own fields, each of its own type, as messages of rclpy in Python are."""

    class Message:
        __slots__ = tuple(fields)

        def __init__(self) -> None:
            for field, kind in fields.items():
                object.__setattr__(self, field, [] if isinstance(kind, list) else kind())

        def __setattr__(self, field, value):
            kind = fields[field]
            if isinstance(kind, list):
                assert type(value) is list and all(type(item) is kind[0] for item in value), (title, field)
            else:
                assert type(value) is kind, (title, field, value)
            object.__setattr__(self, field, value)

    Message.__name__ = title
    return Message


Time = record("Time", sec=int, nanosec=int)
Header = record("Header", stamp=Time, frame_id=str)
Vector3 = record("Vector3", x=float, y=float, z=float)
Quaternion = record("Quaternion", x=float, y=float, z=float, w=float)
Pose = record("Pose", position=Vector3, orientation=Quaternion)
PoseWithCovariance = record("PoseWithCovariance", pose=Pose, covariance=[float])
Twist = record("Twist", linear=Vector3, angular=Vector3)
TwistWithCovariance = record("TwistWithCovariance", twist=Twist, covariance=[float])
Wrench = record("Wrench", force=Vector3, torque=Vector3)
JointState = record("JointState", header=Header, name=[str], position=[float], velocity=[float], effort=[float])
Odometry = record("Odometry", header=Header, child_frame_id=str, pose=PoseWithCovariance, twist=TwistWithCovariance)
WrenchStamped = record("WrenchStamped", header=Header, wrench=Wrench)


class Node:
    """What the node uses of rclpy.node.Node."""

    loop = False

    def __init__(self, name):
        self.name, self.sent, self.cancelled = name, {}, False

    def declare_parameter(self, name, value):
        return types.SimpleNamespace(value=self.loop if name == "loop" else value)

    def create_publisher(self, kind, topic, depth):
        assert depth > 0
        messages = self.sent.setdefault(topic, [])

        def publish(message):
            assert type(message) is kind
            messages.append(message)

        return types.SimpleNamespace(publish=publish)

    def create_timer(self, period_s, callback):
        self.period_s, self.callback = period_s, callback
        return types.SimpleNamespace(cancel=lambda: setattr(self, "cancelled", True))

    def get_clock(self):
        return types.SimpleNamespace(now=lambda: types.SimpleNamespace(to_msg=Time))


@pytest.fixture
def script(tmp_path, monkeypatch):
    for name, content in {
        "rclpy": {},
        "rclpy.node": {"Node": Node},
        "sensor_msgs": {},
        "sensor_msgs.msg": {"JointState": JointState},
        "nav_msgs": {},
        "nav_msgs.msg": {"Odometry": Odometry},
        "geometry_msgs": {},
        "geometry_msgs.msg": {"WrenchStamped": WrenchStamped},
    }.items():
        module = types.ModuleType(name)
        module.__dict__.update(content)
        monkeypatch.setitem(sys.modules, name, module)
    path = mp.export(plan(), "ros2", tmp_path / "motion.py", rate_hz=20)
    spec = importlib.util.spec_from_file_location("motion_node", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_node_sends_the_motion_once(script, tmp_path):
    motion = np.load(mp.export(plan(), "mjlab", tmp_path / "motion.npz", rate_hz=20))
    node = script.make_node(script.load())
    assert node.period_s == 0.05
    while not node.cancelled:
        node.callback()
    joints, odometry = node.sent["joint_states"], node.sent["odom"]
    assert len(joints) == len(odometry) == len(motion["joint_pos"])
    for n, (joint, odom) in enumerate(zip(joints, odometry, strict=True)):
        assert joint.name == motion["joint_names"].tolist()
        assert joint.position == motion["joint_pos"][n].tolist()
        assert joint.velocity == motion["joint_vel"][n].tolist()
        position, quat = odom.pose.pose.position, odom.pose.pose.orientation
        np.testing.assert_allclose([position.x, position.y, position.z], motion["body_pos_w"][n, 0], atol=1e-12)
        wxyz = [quat.w, quat.x, quat.y, quat.z]
        assert abs(wxyz @ motion["body_quat_w"][n, 0]) == pytest.approx(1.0, abs=1e-12)
        assert (odom.header.frame_id, odom.child_frame_id) == ("world", "pelvis")


def test_the_twist_is_in_the_axes_of_the_base(script, tmp_path):
    import pinocchio as pin

    motion = np.load(mp.export(plan(), "mjlab", tmp_path / "motion.npz", rate_hz=20))
    data = script.load()
    for n, (w, x, y, z) in enumerate(motion["body_quat_w"][:, 0]):
        twist = script.odometry(data, n, Time()).twist.twist
        to_world = pin.Quaternion(w, x, y, z).matrix()
        linear = to_world @ [twist.linear.x, twist.linear.y, twist.linear.z]
        np.testing.assert_allclose(linear, motion["body_lin_vel_w"][n, 0], atol=1e-9)


def test_wrenches_are_the_forces_of_the_plan(script):
    node = script.make_node(script.load())
    for _ in range(10):
        node.callback()
    for e, end in enumerate(plan().robot.end_effectors):
        for n, message in enumerate(node.sent[f"wrench/{end.name}"]):
            force, state = message.wrench.force, plan().at(n / 20).end_effectors[e]
            np.testing.assert_array_equal([force.x, force.y, force.z], state.force_W)
            torque = message.wrench.torque
            np.testing.assert_allclose([torque.x, torque.y, torque.z], state.moment_W, atol=1e-9)


def test_a_node_in_a_loop_begins_again(script, monkeypatch):
    monkeypatch.setattr(Node, "loop", True)
    node = script.make_node(script.load())
    count = len(script.load()["position"])
    for _ in range(count + 1):
        node.callback()
    assert not node.cancelled
    assert node.sent["joint_states"][count].position == node.sent["joint_states"][0].position
