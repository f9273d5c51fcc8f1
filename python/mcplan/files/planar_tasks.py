"""Planar tasks, a planar robot, ground and stances each, from and to TOML files and plain dicts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import PlanarTask
from mcplan.errors import UnknownPlanarTask
from mcplan.files import builtin
from mcplan.files.geometry import warn_of_geometry
from mcplan.files.outputs import write_whole
from mcplan.files.toml import toml_text


def list_planar_tasks() -> list[str]:
    """Names of the built-in planar tasks."""
    return builtin.names("planar_tasks")


def load_planar_task(source: str | Path) -> PlanarTask:
    """Load a planar task by its built-in name or from a TOML file; see mcplan.load_planar_task."""
    path = builtin.find(source, "planar_tasks", UnknownPlanarTask)
    task = _core.read_planar_task(path)
    warn_of_geometry(task.robot, str(path), "robot.")
    return task


def save_planar_task(task: PlanarTask, path: str | Path, header: str = "") -> None:
    """Write a planar task with its robot to a TOML file.

    Args:
        task: A valid planar task.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidPlanarTask, InvalidRobot: A field is out of range.
    """
    write_whole(toml_text(planar_task_to_dict(task), header), path)


def planar_task_to_dict(task: PlanarTask) -> dict[str, Any]:
    """Plain data with the keys of a planar task's file. The robot is inline, each phase has all its contacts; what is
    at its default is left out.

    Raises:
        InvalidPlanarTask, InvalidRobot: A field is out of range.
    """
    return _core.planar_task_to_dict(task)


def planar_task_from_dict(data: Mapping[str, Any], source: str = "", folder: Path | None = None) -> PlanarTask:
    """The planar task of plain data with the keys of its file.

    Args:
        data: As from planar_task_to_dict, or read from a file.
        source: Named in errors.
        folder: Where the robot's file is looked for; None: the working directory.

    Raises:
        InvalidPlanarTask: A key is unknown or missing, a value has the wrong type or is out of range, or a name does not exist.
        InvalidRobot: The robot is malformed.
        UnknownRobot: The robot is no built-in one and no file.
    """
    return _core.planar_task_from_dict(data, source, folder)
