"""Keyframes (.xml) of MuJoCo: a file to include in the model of the same robot on a free joint."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mcplan.files.outputs import write_whole

from .orders import order_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .source import Source


def write(source: Source, path: Path) -> None:
    """Write a keyframe an instant: qpos with the quaternion wxyz, qvel with the base's linear velocity in the world's axes."""
    motion = source.motion
    joint_pos, joint_vel = motion.in_order(order_of(motion.urdf_model, breadth_first=False).joints)
    lines = ["<mujoco>", f"  <!-- {source.robot.name}: base, then {joint_pos.shape[1]} joints, depth first -->"]
    lines.append("  <keyframe>")
    for n, time in enumerate(motion.times_s):
        qpos = np.concatenate([motion.configurations[n, :3], motion.quat_wxyz[n], joint_pos[n]])
        linear_W = _rotated(motion.quat_wxyz[n], motion.velocities[n, :3])
        qvel = np.concatenate([linear_W, motion.velocities[n, 3:6], joint_vel[n]])
        lines.append(f'    <key name="t{n}" time="{time:.17g}" qpos="{_text(qpos)}" qvel="{_text(qvel)}"/>')
    lines += ["  </keyframe>", "</mujoco>", ""]
    write_whole("\n".join(lines), path)


def _text(values: NDArray[np.float64]) -> str:
    return " ".join(f"{value:.17g}" for value in values)


def _rotated(quat_wxyz: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    w, axis = quat_wxyz[0], quat_wxyz[1:]
    return np.asarray(vector + 2.0 * np.cross(axis, np.cross(axis, vector) + w * vector))
