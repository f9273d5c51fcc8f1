"""Planar robots from and to TOML files and plain dicts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import PlanarRobot
from mcplan.errors import UnknownRobot
from mcplan.files import builtin
from mcplan.files.geometry import warn_of_geometry
from mcplan.files.outputs import write_whole
from mcplan.files.toml import toml_text


def list_planar_robots() -> list[str]:
    """Names of the built-in planar robots."""
    return builtin.names("planar_robots")


def load_planar_robot(source: str | Path) -> PlanarRobot:
    """Load a planar robot by its built-in name or from a TOML file; see mcplan.load_planar_robot."""
    path = builtin.find(source, "planar_robots", UnknownRobot)
    robot = _core.read_planar_robot(path)
    warn_of_geometry(robot, str(path))
    return robot


def save_planar_robot(robot: PlanarRobot, path: str | Path, header: str = "") -> None:
    """Write a planar robot to a TOML file.

    Args:
        robot: A valid robot.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidRobot: A field is out of range.
    """
    write_whole(toml_text(planar_robot_to_dict(robot), header), path)


def planar_robot_to_dict(robot: PlanarRobot) -> dict[str, Any]:
    """Plain data with the keys of a planar robot's file; what is at its default is left out.

    Raises:
        InvalidRobot: A field is out of range.
    """
    return _core.planar_robot_to_dict(robot)


def planar_robot_from_dict(data: Mapping[str, Any], source: str = "") -> PlanarRobot:
    """The planar robot of plain data with the keys of its file.

    Args:
        data: As from planar_robot_to_dict, or read from a file.
        source: Named in errors.

    Raises:
        InvalidRobot: A key is unknown or missing, a value has the wrong type or is out of range, or a name does not exist.
    """
    return _core.planar_robot_from_dict(data, source)
