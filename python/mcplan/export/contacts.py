"""Contact labels and forces (.npz) beside a reference motion of the same rate."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mcplan.files.outputs import write_whole

if TYPE_CHECKING:
    from .source import Source


def write(source: Source, path: Path) -> None:
    """Write labels, surfaces, forces and positions of a source.

    n instants, e end-effectors, world frame, SI: fps (1,), times_s (n,), end_effectors (e,) and surfaces (s,) names,
    contact (n, e) bool, of a run by the simulator's forces; contact_planned (n, e) bool; surface (n, e) index of the planned
    surface or -1; force_w (n, e, 3) [N] on the robot; position_w (n, e, 3) [m] of the contact points.
    """
    buffer = io.BytesIO()
    np.savez(
        buffer,
        fps=np.array([source.rate_hz]),
        times_s=source.times_s,
        end_effectors=np.array(source.end_effector_names),
        surfaces=np.array([surface.name for surface in source.plan.scene.surfaces]),
        contact=source.in_contact,
        contact_planned=source.surfaces >= 0,
        surface=source.surfaces,
        force_w=source.forces_W,
        position_w=source.end_effectors_W,
    )
    write_whole(buffer.getvalue(), path)
