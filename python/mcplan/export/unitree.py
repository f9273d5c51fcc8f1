"""Motions (.csv) as the LAFAN1 retargeting data set for Unitree's robots has them.

A row an instant, without a header: root position x, y, z [m], root quaternion x, y, z, w, joints [rad] in the order of the
URDF, depth first, which for the G1 is Unitree's order of 29 motors.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mcplan.files.outputs import write_whole

from .orders import order_of

if TYPE_CHECKING:
    from .source import Source


def write(source: Source, path: Path) -> None:
    """Write the motion of a source. Numbers have 17 digits, so that reading gives them back exactly."""
    motion = source.motion
    joints, _ = motion.in_order(order_of(motion.urdf_model, breadth_first=False).joints)
    rows = np.concatenate([motion.configurations[:, :7], joints], axis=1)
    write_whole("".join(",".join(f"{value:.17g}" for value in row) + "\n" for row in rows), path)
