"""A shooting problem of Crocoddyl with its warm start (.py): a script for an environment with crocoddyl, without mcplan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.files.outputs import write_whole
from mcplan.kinematics.inverse_kinematics import has_sole

from .scripts import script

if TYPE_CHECKING:
    from .source import Source


def write(source: Source, path: Path) -> None:
    """Write the script of a source; its own text says what the problem is."""
    write_whole(script("crocoddyl_script.py", arrays(source)), path)


def arrays(source: Source) -> dict[str, Any]:
    """What the script carries: n instants, e end-effectors, Pinocchio's order and conventions."""
    motion, samples = source.motion, source.samples
    model, frames = motion.urdf_model.model, motion.urdf_model.frames
    placements = [model.frames[frame].placement for frame in frames]
    ends = source.robot.end_effectors
    frictions = np.array([surface.friction for surface in source.plan.scene.surfaces])
    return {
        "urdf": np.array(str(motion.urdf_model.path)),
        "gravity": np.array(source.plan.scene.gravity),
        "rate_hz": np.array(source.rate_hz),
        "joints": np.array(motion.joints),
        "armature": np.asarray(model.armature[6:]),
        "q": motion.configurations,
        "v": motion.velocities,
        "com_W": samples.com_W,
        "end_effectors": np.array(source.end_effector_names),
        "parents": np.array([model.names[model.frames[frame].parentJoint] for frame in frames]),
        "frame_rotations": np.array([placement.rotation for placement in placements]),
        "frame_positions": np.array([placement.translation for placement in placements]),
        "half_sizes": np.array([end.half_size if has_sole(end) else [0.0, 0.0] for end in ends], float),
        "feet": np.array([end.kind == "foot" for end in ends]),
        "contacts": source.surfaces >= 0,
        "frictions": frictions[np.maximum(source.surfaces, 0)],
        "positions_W": samples.positions_W,
        "rotations_W": samples.rotations_W,
    }
