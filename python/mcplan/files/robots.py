"""Robots from and to TOML files and plain dicts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from mcplan._core import EndEffector, Robot
from mcplan.errors import InvalidInput, InvalidRobot, UnknownRobot, apart
from mcplan.files import builtin
from mcplan.files.builtin import exists
from mcplan.files.geometry import require_robot_meant
from mcplan.files.outputs import write_whole
from mcplan.files.polytopes import polytope_from_dict, polytope_to_dict, read_polytope
from mcplan.files.reading import referenced
from mcplan.files.sound_parts import elsewhere, name_of, replaced
from mcplan.files.toml import read_toml, toml_text

#: How a robot names a URDF of the package example-robot-data.
PACKAGE = "example-robot-data:"
_POSITIONS = {"nominal": "nominal_B", "reach_min": "reach_min_B", "reach_max": "reach_max_B"}


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
    data = read_toml(path, InvalidRobot)
    data.setdefault("name", path.stem)
    robot = robot_from_dict(data, source=str(path), folder=path.parent)
    require_robot_meant(robot, str(path))
    return robot


def _find(source: str | Path) -> Path:
    try:
        return builtin.find(source, "robots", UnknownRobot)
    except UnknownRobot as error:
        if str(source) in builtin.names("planar_robots"):
            error.hint = f"{source} is a planar robot: it comes with its motions, for mcplan sip. "
        raise


def save_robot(robot: Robot, path: str | Path, header: str = "") -> None:
    """Write a robot to a TOML file.

    Args:
        robot: A valid robot.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidRobot: A field is out of range.
    """
    robot.validate()
    write_whole(toml_text(robot_to_dict(robot), header), path)


def robot_to_dict(robot: Robot) -> dict[str, Any]:
    """Plain data with the keys of a robot file; what is at its default is left out, reach polytopes are inline."""
    data: dict[str, Any] = {"name": robot.name}
    if robot.description:
        data["description"] = robot.description
    data["mass"] = robot.mass
    data["inertia"] = robot.inertia.tolist()
    data["com_height"] = robot.com_height
    data["swing_height"] = robot.swing_height
    if robot.phase_duration.tolist() != Robot().phase_duration.tolist():
        data["phase_duration"] = robot.phase_duration.tolist()
    if robot.sole_support:
        data["sole_support"] = robot.sole_support
    if robot.pressure_share != 1.0:
        data["pressure_share"] = robot.pressure_share
    if robot.tracked:
        data["tracked"] = True
    if robot.urdf:
        data["urdf"] = robot.urdf
    data["end_effectors"] = [_end_effector_to_dict(end) for end in robot.end_effectors]
    if robot.posture:
        data["posture"] = dict(robot.posture)
    return data


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
    from mcplan.files.fields import validated
    from mcplan.files.models import RobotModel

    model = validated(RobotModel, dict(data), InvalidRobot, source, _besides)
    plain = model.model_dump()
    for i, end in enumerate(plain["end_effectors"]):
        field = f"end_effectors[{i}]"
        if end["com_reach"] is not None:
            end["com_reach"] = read_polytope(end["com_reach"], folder, f"{field}.com_reach", source)
        for partner, reach in end["partner_reach"].items():
            end["partner_reach"][partner] = read_polytope(reach, folder, f"{field}.partner_reach.{partner}", source)
    if folder is not None:
        plain["urdf"] = _urdf_of(plain["urdf"], folder, source)
    robot = rebuild_robot(plain)
    try:
        robot.validate()
    except InvalidRobot as found:
        raise found.moved(source=source) from None
    return robot


def _urdf_of(urdf: str, folder: Path, source: str) -> str:
    """The URDF that a file names, as the working directory sees it.

    Relative paths count from the folder of the file; where there is none, from the working directory, as older files do.
    """
    if not urdf or urdf.startswith(PACKAGE):
        return urdf
    beside = folder / urdf
    named = Path(urdf) if exists(urdf) and not exists(beside) else beside
    referenced(folder, str(named.absolute()), InvalidRobot, "urdf", source)
    return str(beside) if exists(beside) else urdf


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


def _besides(data: Any, locations: list[tuple[Any, ...]]) -> list[InvalidInput]:
    """What is wrong with the parts of a robot that have their keys and types right; reach polytopes are left out."""
    from pydantic import ValidationError

    from mcplan.files.models import RobotModel

    box = {"nominal": [0.0, 0.0, 0.0], "reach_min": [-1.0, -1.0, -1.0], "reach_max": [1.0, 1.0, 1.0]}
    sound, fields = replaced(
        data,
        locations,
        {
            "mass": lambda value, i: 1.0,
            "inertia": lambda value, i: 1.0 if i >= 0 else [1.0, 1.0, 1.0],
            "com_height": lambda value, i: 1.0,
            "end_effectors": lambda value, i: (
                {"name": name_of(value, i), **box} if i >= 0 else [{"name": "foot", **box}]
            ),
        },
    )
    try:
        plain = RobotModel.model_validate(sound).model_dump()
        for end in plain["end_effectors"]:
            end["com_reach"], end["partner_reach"] = None, {}
        rebuild_robot(plain).validate()
    except InvalidRobot as found:
        return [each for each in apart(found) if elsewhere(each, fields)]
    except ValidationError:
        pass
    return []


def rebuild_robot(data: Mapping[str, Any]) -> Robot:
    """Inverse of robot_to_dict without checks, for pickles."""
    rest = {key: value for key, value in data.items() if key not in ("name", "end_effectors")}
    ends = [_end_effector_from_dict(end) for end in data["end_effectors"]]
    return Robot(name=data.get("name") or "", end_effectors=ends, **rest)


def _end_effector_to_dict(end: EndEffector) -> dict[str, Any]:
    data: dict[str, Any] = {"name": end.name, "kind": end.kind}
    if end.frame:
        data["frame"] = end.frame
    if end.frame_offset.any():
        data["frame_offset"] = end.frame_offset.tolist()
    if end.half_size.any():
        data["half_size"] = end.half_size.tolist()
    data.update({key: getattr(end, attribute).tolist() for key, attribute in _POSITIONS.items()})
    if math.isfinite(end.max_force):  # JSON knows no infinity; it is the default
        data["max_force"] = end.max_force
    if end.max_moment.any():
        data["max_moment"] = end.max_moment.tolist()
    if end.yaw_range.tolist() != [-math.inf, math.inf]:
        data["yaw_range"] = end.yaw_range.tolist()
    if end.com_reach.given:
        data["com_reach"] = polytope_to_dict(end.com_reach)
    if end.partner_reach:
        data["partner_reach"] = {name: polytope_to_dict(reach) for name, reach in end.partner_reach.items()}
    return data


def _end_effector_from_dict(data: Mapping[str, Any]) -> EndEffector:
    rest = {_POSITIONS.get(key, key): value for key, value in data.items() if not key.endswith("_reach")}
    if rest.get("yaw_range") is None:
        rest.pop("yaw_range", None)
    partners = {name: polytope_from_dict(reach) for name, reach in data.get("partner_reach", {}).items()}
    return EndEffector(com_reach=polytope_from_dict(data.get("com_reach")), partner_reach=partners, **rest)
