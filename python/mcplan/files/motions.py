"""Motions of planar robots from and to TOML files and plain dicts."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan._core import PlanarClearance, PlanarPhase, PlanarPose, PlanarRobot, PlanarSurface, PlanarTask
from mcplan.errors import InvalidInput, InvalidMotion, InvalidRobot, UnknownMotion, shown, together
from mcplan.files import builtin
from mcplan.files.geometry import require_planar_robot_meant
from mcplan.files.outputs import write_whole
from mcplan.files.planar_robots import (
    field_in_file,
    index_of,
    list_planar_robots,
    load_planar_robot,
    planar_robot_from_dict,
    planar_robot_to_dict,
)
from mcplan.files.reading import MOST_TOML, referenced, require_regular_file
from mcplan.files.stances import Stances, contact_to_dict
from mcplan.files.toml import read_toml, toml_text

_END_INTERVALS, _MIDDLE_INTERVALS = 3, 4  # of the first and last phase, and of those between


def list_motions() -> list[str]:
    """Names of the built-in motions."""
    return builtin.names("motions")


def load_motion(source: str | Path) -> PlanarTask:
    """Load a motion by its built-in name or from a TOML file; see mcplan.load_motion."""
    path = builtin.find(source, "motions", UnknownMotion)
    data = read_toml(path, InvalidMotion)
    data.setdefault("name", path.stem)
    return motion_from_dict(data, source=str(path), folder=path.parent)


def save_motion(motion: PlanarTask, path: str | Path, header: str = "") -> None:
    """Write a motion with its robot to a TOML file.

    Args:
        motion: A valid motion.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidMotion, InvalidRobot: A field is out of range.
    """
    motion.validate()
    write_whole(toml_text(motion_to_dict(motion), header), path)


def motion_to_dict(motion: PlanarTask) -> dict[str, Any]:
    """Plain data with the keys of a motion file. The robot is inline, each phase has all its contacts; what is at its
    default is left out."""
    data: dict[str, Any] = {"name": motion.name}
    if motion.description:
        data["description"] = motion.description
    data["robot"] = planar_robot_to_dict(motion.robot)
    data["surfaces"] = [_surface_to_dict(surface) for surface in motion.surfaces]
    data["phases"] = [_phase_to_dict(phase, motion) for phase in motion.phases]
    return data


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
    from mcplan.files.fields import validated
    from mcplan.files.planar_models import MotionModel

    plain, robot, findings = dict(data), None, list[InvalidInput]()
    if isinstance(plain.get("robot"), Mapping):
        try:
            robot = planar_robot_from_dict({"name": "robot", **plain["robot"]}, source, "robot")
            require_planar_robot_meant(robot, source, "robot.")
        except InvalidRobot as found:
            findings.append(found)
        plain["robot"] = "robot"
    elif "robot" in plain and not (isinstance(plain["robot"], str) and plain["robot"]):
        findings.append(InvalidMotion("robot", "must be a name, a path or a table", shown(plain["robot"]), source))
        plain["robot"] = "robot"
    try:
        plain = validated(MotionModel, plain, InvalidMotion, source).model_dump()
    except InvalidMotion as found:
        findings.append(found)
    if findings:
        raise together(findings) from None
    robot = robot or _load_robot(plain["robot"], folder, source)
    try:
        stances = Stances(robot, plain["surfaces"])
        motion = _motion_from_plain(plain, robot, stances)
        _validate(motion, stances)
    except InvalidMotion as found:
        raise found.moved(source=source) from None
    return motion


def _load_robot(name: str, folder: Path | None, source: str) -> PlanarRobot:
    """The robot that a motion names: a built-in one, or a file which, if a file names it, lies beside it or below."""
    if folder is None or name in list_planar_robots():
        return load_planar_robot(name)
    path = folder / name
    if not builtin.exists(path) and builtin.exists(name):
        path = Path(name)
    if not builtin.exists(path):
        return load_planar_robot(name)  # which says that there is none
    path = referenced(folder, str(path.absolute()), InvalidMotion, "robot", source)
    require_regular_file(path, MOST_TOML, InvalidMotion, "robot", source)
    return load_planar_robot(path)


def _validate(motion: PlanarTask, stances: Stances) -> None:
    """validate() of the C++ class; its errors name fields as the file does."""
    try:
        motion.validate()
    except InvalidMotion as found:
        field, rule = field_in_file(found.field), found.rule
        field = re.sub(r"^(surfaces\[\d+\])\.(from|to)$", r"\1.extent", field)
        contact = re.fullmatch(r"phases\[(\d+)\]\.contacts\[(\d+)\]\.(\w+)", field)
        if contact:
            field, rule = stances.locate(int(contact[1]), int(contact[2]), contact[3], rule)
        raise InvalidMotion(field, rule, found.value) from None


def _motion_from_plain(plain: Mapping[str, Any], robot: PlanarRobot, stances: Stances) -> PlanarTask:
    phases = []
    for k, phase in enumerate(plain["phases"]):
        at_an_end = k in (0, len(plain["phases"]) - 1)
        limit = phase["max_duration"]
        phases.append(
            PlanarPhase(
                intervals=phase["intervals"] or (_END_INTERVALS if at_an_end else _MIDDLE_INTERVALS),
                min_duration=phase["min_duration"],
                max_duration=math.inf if limit is None else limit,
                contacts=stances.next(phase),
                clearances=[
                    _clearance_from_plain(entry, stances, f"phases[{k}].clearances[{i}]")
                    for i, entry in enumerate(phase["clearances"])
                ],
                poses=[
                    _pose_from_plain(entry, robot, f"phases[{k}].poses[{i}]") for i, entry in enumerate(phase["poses"])
                ],
            )
        )
    return PlanarTask(
        name=plain["name"] or "",
        description=plain["description"],
        robot=robot,
        surfaces=[_surface_from_plain(surface) for surface in plain["surfaces"]],
        phases=phases,
    )


def _surface_from_plain(surface: Mapping[str, Any]) -> PlanarSurface:
    begin, end = surface["extent"] or (-math.inf, math.inf)
    return PlanarSurface(
        name=surface["name"],
        origin_W=surface["origin"],
        angle=surface["angle"],
        friction=surface["friction"],
        from_=begin,
        to=end,
    )


def _clearance_from_plain(entry: Mapping[str, Any], stances: Stances, field: str) -> PlanarClearance:
    height = entry["middle_height"]
    return PlanarClearance(
        end_effector=stances.end_effector(entry["end_effector"], f"{field}.end_effector"),
        surface=stances.surface(entry["surface"], f"{field}.surface"),
        first_interval=entry["first_interval"],
        end_interval=entry["end_interval"],
        middle_height=-math.inf if height is None else height,
    )


def _pose_from_plain(entry: Mapping[str, Any], robot: PlanarRobot, field: str) -> PlanarPose:
    names = [body.name for body in robot.bodies]
    bounds = []
    for key in ("x", "y", "angle"):
        low, high = entry[key] or (-math.inf, math.inf)
        if not low <= high:
            raise InvalidMotion(f"{field}.{key}", "must read [from, to], with from not above to", shown(entry[key]))
        bounds.append((low, high))
    return PlanarPose(
        body=index_of(entry["body"], names, f"{field}.body", "a body of the robot", InvalidMotion),
        fraction=entry["fraction"],
        min=[low for low, _ in bounds],
        max=[high for _, high in bounds],
    )


def _surface_to_dict(surface: PlanarSurface) -> dict[str, Any]:
    data: dict[str, Any] = {
        "name": surface.name,
        "origin": surface.origin_W.tolist(),
        "angle": surface.angle,
        "friction": surface.friction,
    }
    if math.isfinite(surface.from_) or math.isfinite(surface.to):
        data["extent"] = [surface.from_, surface.to]
    return data


def _phase_to_dict(phase: PlanarPhase, motion: PlanarTask) -> dict[str, Any]:
    data: dict[str, Any] = {"intervals": phase.intervals}
    if phase.min_duration:
        data["min_duration"] = phase.min_duration
    if math.isfinite(phase.max_duration):
        data["max_duration"] = phase.max_duration
    data["contacts"] = [contact_to_dict(contact, motion) for contact in phase.contacts]
    if phase.clearances:
        data["clearances"] = [_clearance_to_dict(entry, motion) for entry in phase.clearances]
    if phase.poses:
        data["poses"] = [_pose_to_dict(pose, motion) for pose in phase.poses]
    return data


def _clearance_to_dict(entry: PlanarClearance, motion: PlanarTask) -> dict[str, Any]:
    data = {
        "end_effector": motion.robot.end_effectors[entry.end_effector].name,
        "surface": motion.surfaces[entry.surface].name,
    }
    rest = {
        "first_interval": (entry.first_interval, 0),
        "end_interval": (entry.end_interval, -1),
        "middle_height": (entry.middle_height, -math.inf),
    }
    return {**data, **{key: value for key, (value, default) in rest.items() if value != default}}


def _pose_to_dict(pose: PlanarPose, motion: PlanarTask) -> dict[str, Any]:
    data = {"body": motion.robot.bodies[pose.body].name, "fraction": pose.fraction}
    bounds = zip(("x", "y", "angle"), pose.min.tolist(), pose.max.tolist(), strict=True)
    return {**data, **{key: [low, high] for key, low, high in bounds if math.isfinite(low) or math.isfinite(high)}}
