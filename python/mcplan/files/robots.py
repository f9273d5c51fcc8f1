"""Robots from and to TOML files and plain dicts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import Robot
from mcplan.errors import UnknownRobot
from mcplan.files import builtin
from mcplan.files.geometry import warn_of_geometry
from mcplan.files.outputs import TOML, require_suffix, write_whole
from mcplan.files.toml import toml_text

#: How a robot names a URDF of the package example-robot-data.
PACKAGE = "example-robot-data:"


def list_robots() -> list[str]:
    """Names of the built-in robots."""
    return builtin.names("robots")


def list_robots_with(end_effectors: Iterable[str], joints: bool) -> list[str]:
    """Names of the built-in robots that have end-effectors of these names, and, if asked for, a URDF."""
    wanted = set(end_effectors)
    robots = {name: load_robot(name) for name in list_robots()}
    return [
        name
        for name, robot in robots.items()
        if wanted <= {end.name for end in robot.end_effectors} and (robot.urdf or not joints)
    ]


def load_robot(source: str | Path) -> Robot:
    """Load a robot by its built-in name or from a TOML file; see mcplan.load_robot."""
    path = _find(source)
    robot = _core.read_robot(path)
    warn_of_geometry(robot, str(path))
    return robot


def _find(source: str | Path) -> Path:
    try:
        return builtin.find(source, "robots", UnknownRobot)
    except UnknownRobot as error:
        if str(source) in builtin.names("planar_robots"):
            error.hint = f"{source} is a planar robot: it comes with its planar tasks, for mcplan sip. "
        raise


def save_robot(robot: Robot, path: str | Path, header: str = "") -> None:
    """Write a robot to a TOML file.

    Args:
        robot: A valid robot.
        path: Where to; it ends in .toml.
        header: Comment to put on top.

    Raises:
        InvalidInput: The path has another ending.
        InvalidRobot: A field is out of range.
    """
    require_suffix("path", path, TOML)
    robot.validate()
    write_whole(toml_text(robot_to_dict(robot), header), path)


def robot_to_dict(robot: Robot) -> dict[str, Any]:
    """Plain data with the keys of a robot file; what is at its default is left out, reach polytopes are inline."""
    return _core.robot_to_dict(robot)


def robot_from_dict(data: Mapping[str, Any], source: str = "", folder: Path | None = None) -> Robot:
    """The robot of plain data with the keys of a robot file.

    Args:
        data: As from robot_to_dict, or read from a file.
        source: Named in errors.
        folder: Where the URDF and the files of reach polytopes are looked for, all of which must lie there or below; None:
            polytopes must be inline, and the path of the URDF is taken as it is.

    Raises:
        InvalidRobot: A key is unknown or missing, or a value has the wrong type or is out of range.
    """
    return _core.robot_from_dict(data, source, folder)


def urdf_beside(urdf: str, path: str | Path) -> str | None:
    """What to write as `urdf` into a robot's file so that it can be read there: the path relative to the file's folder.

    Args:
        urdf: As the working directory sees it, or "example-robot-data:NAME".
        path: The robot's file.

    Returns:
        None: it lies neither in that folder nor below.
    """
    if not urdf or urdf.startswith(PACKAGE):
        return urdf
    target, root = Path(urdf).resolve(), Path(path).resolve().parent
    return target.relative_to(root).as_posix() if target.is_relative_to(root) else None
