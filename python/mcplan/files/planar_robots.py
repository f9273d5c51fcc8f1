"""Planar robots from and to TOML files and plain dicts."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mcplan._core import Capsule, PlanarBody, PlanarEndEffector, PlanarRobot
from mcplan.errors import InvalidInput, InvalidRobot, UnknownRobot, did_you_mean, shown, together
from mcplan.files import builtin
from mcplan.files.geometry import require_planar_robot_meant
from mcplan.files.outputs import write_whole
from mcplan.files.toml import read_toml, toml_text

_LIMITS = {"position_min": -math.inf, "position_max": math.inf, "velocity_max": math.inf, "torque_max": math.inf}


def list_planar_robots() -> list[str]:
    """Names of the built-in planar robots."""
    return builtin.names("planar_robots")


def load_planar_robot(source: str | Path) -> PlanarRobot:
    """Load a planar robot by its built-in name or from a TOML file; see mcplan.load_planar_robot."""
    path = builtin.find(source, "planar_robots", UnknownRobot)
    data = read_toml(path, InvalidRobot)
    data.setdefault("name", path.stem)
    robot = planar_robot_from_dict(data, source=str(path))
    require_planar_robot_meant(robot, str(path))
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
    robot.validate()
    write_whole(toml_text(planar_robot_to_dict(robot), header), path)


def planar_robot_to_dict(robot: PlanarRobot) -> dict[str, Any]:
    """Plain data with the keys of a planar robot's file; what is at its default is left out."""
    names = [body.name for body in robot.bodies]
    data: dict[str, Any] = {"name": robot.name}
    if robot.description:
        data["description"] = robot.description
    data["gravity"] = robot.gravity
    data["bodies"] = [_body_to_dict(body, names) for body in robot.bodies]
    data["end_effectors"] = [_end_effector_to_dict(end, names) for end in robot.end_effectors]
    if robot.collision_pairs:
        data["collision_pairs"] = [[names[a], names[b]] for a, b in robot.collision_pairs]
    return data


def planar_robot_from_dict(data: Mapping[str, Any], source: str = "", field: str = "") -> PlanarRobot:
    """The planar robot of plain data with the keys of its file.

    Args:
        data: As from planar_robot_to_dict, or read from a file.
        source: Named in errors.
        field: Where the data stand in that file, for errors: "" or e.g. "robot".

    Raises:
        InvalidRobot: A key is unknown or missing, a value has the wrong type or is out of range, or a name does not exist.
    """
    from mcplan.files.fields import validated
    from mcplan.files.planar_models import PlanarRobotModel

    try:
        plain = validated(PlanarRobotModel, dict(data), InvalidRobot).model_dump(by_alias=True)
        robot = _robot_from_plain(plain)
        robot.validate()
    except InvalidRobot as found:
        raise together([_in_file(finding, field, source) for finding in (found, *found.others)]) from None
    return robot


def _in_file(finding: InvalidInput, field: str, source: str) -> InvalidRobot:
    where = [part for part in (field, field_in_file(finding.field)) if part]
    return InvalidRobot(".".join(where), finding.rule, finding.value, source)


def field_in_file(field: str) -> str:
    """Field of a C++ struct as it is called in files: without the frame, e.g. "bodies[1].com_B" -> "bodies[1].com"."""
    return re.sub(r"_[BPW]\b", "", field)


def index_of(name: str, legal: Sequence[str], field: str, what: str, error: type[InvalidInput]) -> int:
    """Place of a name in a list.

    Raises:
        InvalidInput: Of the given class; the name is not in the list. The message lists the names that exist.
    """
    if name in legal:
        return list(legal).index(name)
    rule = f"must name {what}. {did_you_mean(name, legal)}There are: {', '.join(legal) or 'none'}"
    raise error(field, rule, shown(name))


def require_unique(names: Sequence[str], field: str, error: type[InvalidInput]) -> None:
    """Names that are looked up have to be unique first: InvalidInput of the given class names the second of a pair."""
    for i, name in enumerate(names):
        if name in names[:i]:
            raise error(f"{field}[{i}].name", "must be unique", shown(name))


def _body_to_dict(body: PlanarBody, names: Sequence[str]) -> dict[str, Any]:
    data: dict[str, Any] = {"name": body.name}
    if body.parent >= 0:
        data["parent"] = names[body.parent]
        data["joint"] = body.joint_P.tolist()
        data["offset"] = body.offset
    data["mass"] = body.mass
    data["com"] = body.com_B.tolist()
    data["inertia"] = body.inertia
    data.update({key: getattr(body, key) for key in _LIMITS if math.isfinite(getattr(body, key))})
    if body.capsules:
        data["capsules"] = [
            {"from": c.from_B.tolist(), "to": c.to_B.tolist(), "radius": c.radius} for c in body.capsules
        ]
    return data


def _end_effector_to_dict(end: PlanarEndEffector, names: Sequence[str]) -> dict[str, Any]:
    data = {"name": end.name, "body": names[end.body], "position": end.position_B.tolist()}
    if end.angle_B:
        data["angle"] = end.angle_B
    return {**data, "points": list(end.points)}


def _robot_from_plain(plain: Mapping[str, Any]) -> PlanarRobot:
    names = [body["name"] for body in plain["bodies"]]
    require_unique(names, "bodies", InvalidRobot)
    return PlanarRobot(
        name=plain["name"] or "",
        description=plain["description"],
        gravity=plain["gravity"],
        bodies=[_body_from_plain(body, i, names) for i, body in enumerate(plain["bodies"])],
        end_effectors=[
            PlanarEndEffector(
                name=end["name"],
                body=index_of(end["body"], names, f"end_effectors[{i}].body", "a body", InvalidRobot),
                position_B=end["position"],
                angle_B=end["angle"],
                points=end["points"],
            )
            for i, end in enumerate(plain["end_effectors"])
        ],
        collision_pairs=[
            _pair(pair, f"collision_pairs[{i}]", names) for i, pair in enumerate(plain["collision_pairs"])
        ],
    )


def _pair(pair: Sequence[str], field: str, names: Sequence[str]) -> tuple[int, int]:
    first, second = (index_of(name, names, f"{field}[{i}]", "a body", InvalidRobot) for i, name in enumerate(pair))
    return first, second


def _body_from_plain(body: Mapping[str, Any], i: int, names: Sequence[str]) -> PlanarBody:
    limits = {key: free if body[key] is None else body[key] for key, free in _LIMITS.items()}
    return PlanarBody(
        name=body["name"],
        parent=_parent(body["parent"], i, names),
        joint_P=body["joint"],
        offset=body["offset"],
        mass=body["mass"],
        com_B=body["com"],
        inertia=body["inertia"],
        capsules=[Capsule(from_B=c["from"], to_B=c["to"], radius=c["radius"]) for c in body["capsules"]],
        **limits,
    )


def _parent(name: str | None, i: int, names: Sequence[str]) -> int:
    field = f"bodies[{i}].parent"
    if name is None:
        if i > 0:
            raise InvalidRobot(field, "is required of every body but the first, the base")
        return -1
    if i == 0:
        raise InvalidRobot(field, "must be left out for the first body, the base", shown(name))
    if name in names[i:]:
        raise InvalidRobot(field, "must come before its children, and no body may be its own ancestor", shown(name))
    return index_of(name, names[:i], field, "a body above this one", InvalidRobot)
