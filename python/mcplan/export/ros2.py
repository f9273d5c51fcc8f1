"""A node of ROS 2 (.py) that publishes a motion: a script for an environment with rclpy, without mcplan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.files.outputs import write_whole

from .orders import order_of
from .scripts import script

if TYPE_CHECKING:
    from .source import Source


def write(source: Source, path: Path) -> None:
    """Write the node of a source; its own text says what it publishes."""
    write_whole(script("ros2_script.py", arrays(source)), path)


def arrays(source: Source) -> dict[str, Any]:
    """What the node carries: n instants, nj joints, e end-effectors."""
    motion = source.motion
    order = order_of(motion.urdf_model, breadth_first=False)
    position, velocity = motion.in_order(order.joints)
    return {
        "rate_hz": np.array(source.rate_hz),
        "base": np.array(order.bodies[0]),
        "joints": np.array(order.joints),
        "position": position,
        "velocity": velocity,
        "base_position_W": motion.configurations[:, :3],
        "base_quat_xyzw": motion.configurations[:, 3:7],
        "base_velocity_B": motion.velocities[:, :6],
        "end_effectors": np.array(source.end_effector_names),
        "force_W": source.forces_W,
        "moment_W": source.moments_W,
        "contact": source.in_contact,
    }
