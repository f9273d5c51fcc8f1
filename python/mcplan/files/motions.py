"""Motions of planar robots from and to TOML files and plain dicts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import PlanarTask
from mcplan.errors import UnknownMotion
from mcplan.files import builtin
from mcplan.files.geometry import warn_of_geometry
from mcplan.files.outputs import write_whole
from mcplan.files.toml import toml_text


def list_motions() -> list[str]:
    """Names of the built-in motions."""
    return builtin.names("motions")


def load_motion(source: str | Path) -> PlanarTask:
    """Load a motion by its built-in name or from a TOML file; see mcplan.load_motion."""
    path = builtin.find(source, "motions", UnknownMotion)
    motion = _core.read_planar_task(path)
    warn_of_geometry(motion.robot, str(path), "robot.")
    return motion


def save_motion(motion: PlanarTask, path: str | Path, header: str = "") -> None:
    """Write a motion with its robot to a TOML file.

    Args:
        motion: A valid motion.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidMotion, InvalidRobot: A field is out of range.
    """
    write_whole(toml_text(motion_to_dict(motion), header), path)


def motion_to_dict(motion: PlanarTask) -> dict[str, Any]:
    """Plain data with the keys of a motion file. The robot is inline, each phase has all its contacts; what is at its
    default is left out.

    Raises:
        InvalidMotion, InvalidRobot: A field is out of range.
    """
    return _core.planar_task_to_dict(motion)


def motion_from_dict(data: Mapping[str, Any], source: str = "", folder: Path | None = None) -> PlanarTask:
    """The motion of plain data with the keys of a motion file.

    Args:
        data: As from motion_to_dict, or read from a file.
        source: Named in errors.
        folder: Where the robot's file is looked for; None: the working directory.

    Raises:
        InvalidMotion: A key is unknown or missing, a value has the wrong type or is out of range, or a name does not exist.
        InvalidRobot: The robot is malformed.
        UnknownRobot: The robot is no built-in one and no file.
    """
    return _core.planar_task_from_dict(data, source, folder)
