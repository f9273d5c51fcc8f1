"""A node of ROS 2 that publishes a motion planned by mcplan, which made this file.

It runs where ROS 2 is sourced: python3 motion.py --ros-args -p loop:=true

    joint_states        sensor_msgs/JointState, joints [rad, rad/s] by their names in the URDF
    odom                nav_msgs/Odometry, pose of the base in `world`, twist in the axes of the base
    wrench/END_EFFECTOR geometry_msgs/WrenchStamped, force and moment on the robot about the contact point, axes of `world`
"""

from __future__ import annotations

import base64
import io
from typing import Any

import numpy as np

DATA = ""

#: Frame in which the motion is.
WORLD = "world"


def load() -> dict[str, Any]:
    """The arrays that this file carries."""
    return dict(np.load(io.BytesIO(base64.b64decode(DATA))))


def fill(message: Any, **values: float) -> None:
    """Set fields of a message; they take Python's own numbers."""
    for name, value in values.items():
        setattr(message, name, float(value))


def joint_state(data: dict[str, Any], n: int, stamp: Any) -> Any:
    """Joints at an instant."""
    from sensor_msgs.msg import JointState

    message = JointState()
    message.header.stamp = stamp
    message.name = [str(name) for name in data["joints"]]
    message.position = data["position"][n].tolist()
    message.velocity = data["velocity"][n].tolist()
    return message


def odometry(data: dict[str, Any], n: int, stamp: Any) -> Any:
    """Pose and twist of the base at an instant."""
    from nav_msgs.msg import Odometry

    message = Odometry()
    message.header.stamp = stamp
    message.header.frame_id, message.child_frame_id = WORLD, str(data["base"])
    fill(message.pose.pose.position, **dict(zip("xyz", data["base_position_W"][n], strict=True)))
    fill(message.pose.pose.orientation, **dict(zip("xyzw", data["base_quat_xyzw"][n], strict=True)))
    fill(message.twist.twist.linear, **dict(zip("xyz", data["base_velocity_B"][n, :3], strict=True)))
    fill(message.twist.twist.angular, **dict(zip("xyz", data["base_velocity_B"][n, 3:], strict=True)))
    return message


def wrench(data: dict[str, Any], n: int, end: int, stamp: Any) -> Any:
    """Force and moment of an end-effector at an instant."""
    from geometry_msgs.msg import WrenchStamped

    message = WrenchStamped()
    message.header.stamp, message.header.frame_id = stamp, WORLD
    fill(message.wrench.force, **dict(zip("xyz", data["force_W"][n, end], strict=True)))
    fill(message.wrench.torque, **dict(zip("xyz", data["moment_W"][n, end], strict=True)))
    return message


def make_node(data: dict[str, Any]) -> Any:
    """The node; each call of its `publish` sends the next instant, and it is called at the motion's rate."""
    from geometry_msgs.msg import WrenchStamped
    from nav_msgs.msg import Odometry
    from rclpy.node import Node
    from sensor_msgs.msg import JointState

    class Motion(Node):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__("mcplan_motion")
            self.loop = bool(self.declare_parameter("loop", False).value)
            self.next = 0
            self.joints = self.create_publisher(JointState, "joint_states", 10)
            self.odometry = self.create_publisher(Odometry, "odom", 10)
            self.wrenches = [
                self.create_publisher(WrenchStamped, f"wrench/{name}", 10) for name in data["end_effectors"]
            ]
            self.timer = self.create_timer(1.0 / float(data["rate_hz"]), self.publish)

        def publish(self) -> None:
            """Send the next instant; after the last one the first, or the timer stops."""
            n, stamp = self.next, self.get_clock().now().to_msg()
            self.joints.publish(joint_state(data, n, stamp))
            self.odometry.publish(odometry(data, n, stamp))
            for end, publisher in enumerate(self.wrenches):
                publisher.publish(wrench(data, n, end, stamp))
            self.next = n + 1
            if self.next == len(data["position"]):
                self.next = 0
                if not self.loop:
                    self.timer.cancel()

    return Motion()


def main() -> None:
    """Publish the motion until the process is ended."""
    import rclpy

    rclpy.init()
    rclpy.spin(make_node(load()))
    rclpy.shutdown()


if __name__ == "__main__":
    main()
