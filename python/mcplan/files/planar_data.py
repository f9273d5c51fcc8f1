"""Planar robots and motions as plain data, exactly: for the headers of plan files and for pickles.

A dict for each object, with its attributes as keys. Numbers that JSON cannot hold (limits that are infinite) are the
strings "inf" and "-inf". What people write and read stands in TOML files with keys of their own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from mcplan._core import (
    Capsule,
    PlanarBody,
    PlanarClearance,
    PlanarContact,
    PlanarEndEffector,
    PlanarPhase,
    PlanarPose,
    PlanarRobot,
    PlanarSurface,
    PlanarTask,
)
from mcplan.errors import InvalidInput, InvalidMotion, shown

_Read = Callable[[Any, str], Any]
_MOST_ENTRIES = 10_000  # of a list


def robot_to_plain(robot: PlanarRobot) -> dict[str, Any]:
    """All that a planar robot holds."""
    return _write(robot, _ROBOT)


def robot_from_plain(data: Mapping[str, Any]) -> PlanarRobot:
    """Inverse of robot_to_plain; says nothing of ranges.

    Raises:
        InvalidMotion: A key is missing or unknown, or a value has the wrong type.
    """
    return _robot(data, "robot")


def motion_to_plain(motion: PlanarTask) -> dict[str, Any]:
    """All that a motion holds, its robot included."""
    return _write(motion, _MOTION)


def motion_from_plain(data: Mapping[str, Any], field: str = "") -> PlanarTask:
    """Inverse of motion_to_plain; says nothing of ranges.

    Args:
        data: As from motion_to_plain.
        field: Where the data stand, for errors.

    Raises:
        InvalidMotion: A key is missing or unknown, or a value has the wrong type.
    """
    return _object(PlanarTask, _MOTION)(data, field)


def _write(value: Any, keys: Mapping[str, _Read]) -> dict[str, Any]:
    return {key: _plain(getattr(value, key)) for key in keys}


def _plain(value: Any) -> Any:
    if type(value) in _KEYS:
        return _write(value, _KEYS[type(value)])
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return value


def _fail(field: str, rule: str, value: Any) -> InvalidInput:
    return InvalidMotion(field, rule, shown(value))


def _number(value: Any, field: str) -> float:
    if isinstance(value, str) and value in ("inf", "-inf"):
        return float(value)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _fail(field, "must be a number", value)
    try:
        return float(value)
    except OverflowError:
        raise _fail(field, "must be a number of 64 bits", value) from None


def _integer(value: Any, field: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or abs(value) >= 2**31:
        raise _fail(field, "must be a whole number of 32 bits", value)
    return value


def _text(value: Any, field: str) -> str:
    if not isinstance(value, str):
        raise _fail(field, "must be a string", value)
    return value


def _list(read: _Read, size: int | None = None) -> _Read:
    def read_list(value: Any, field: str) -> list[Any]:
        if not isinstance(value, list) or (size is not None and len(value) != size):
            raise _fail(field, "must be a list" + ("" if size is None else f" of {size}"), value)
        if len(value) > _MOST_ENTRIES:
            raise InvalidMotion(field, f"may have {_MOST_ENTRIES} entries at most", str(len(value)))
        return [read(item, f"{field}[{i}]") for i, item in enumerate(value)]

    return read_list


def _object(kind: type[Any], keys: Mapping[str, _Read]) -> _Read:
    def read_object(value: Any, field: str) -> Any:
        if not isinstance(value, Mapping):
            raise _fail(field, "must be a table", value)
        prefix = f"{field}." if field else ""
        for key in sorted(value.keys() - keys.keys()):
            raise _fail(f"{prefix}{key}", f"no such key. Keys: {', '.join(keys)}", key)
        for key in keys:
            if key not in value:
                raise InvalidMotion(f"{prefix}{key}", "is required")
        return kind(**{key: read(value[key], f"{prefix}{key}") for key, read in keys.items()})

    return read_object


_VECTOR = _list(_number, 2)

_CAPSULE = {"from_B": _VECTOR, "to_B": _VECTOR, "radius": _number}
_BODY = {
    "name": _text,
    "parent": _integer,
    "joint_P": _VECTOR,
    "offset": _number,
    "mass": _number,
    "com_B": _VECTOR,
    "inertia": _number,
    "position_min": _number,
    "position_max": _number,
    "velocity_max": _number,
    "torque_max": _number,
    "capsules": _list(_object(Capsule, _CAPSULE)),
}
_END_EFFECTOR = {
    "name": _text,
    "body": _integer,
    "position_B": _VECTOR,
    "angle_B": _number,
    "points": _list(_number),
}
_ROBOT = {
    "name": _text,
    "description": _text,
    "bodies": _list(_object(PlanarBody, _BODY)),
    "end_effectors": _list(_object(PlanarEndEffector, _END_EFFECTOR)),
    "collision_pairs": _list(_list(_integer, 2)),
    "gravity": _number,
}
_robot = _object(PlanarRobot, _ROBOT)
_SURFACE = {
    "name": _text,
    "origin_W": _VECTOR,
    "angle": _number,
    "friction": _number,
    "from_": _number,
    "to": _number,
}
_CONTACT = {"end_effector": _integer, "surface": _integer, "position_W": _VECTOR, "angle": _number}
_CLEARANCE = {
    "end_effector": _integer,
    "surface": _integer,
    "first_interval": _integer,
    "end_interval": _integer,
    "middle_height": _number,
}
_POSE = {"body": _integer, "fraction": _number, "min": _list(_number, 3), "max": _list(_number, 3)}
_PHASE = {
    "intervals": _integer,
    "min_duration": _number,
    "max_duration": _number,
    "contacts": _list(_object(PlanarContact, _CONTACT)),
    "clearances": _list(_object(PlanarClearance, _CLEARANCE)),
    "poses": _list(_object(PlanarPose, _POSE)),
}
_MOTION = {
    "name": _text,
    "description": _text,
    "robot": _robot,
    "surfaces": _list(_object(PlanarSurface, _SURFACE)),
    "phases": _list(_object(PlanarPhase, _PHASE)),
}
_KEYS: dict[type[Any], Mapping[str, _Read]] = {
    Capsule: _CAPSULE,
    PlanarBody: _BODY,
    PlanarEndEffector: _END_EFFECTOR,
    PlanarRobot: _ROBOT,
    PlanarSurface: _SURFACE,
    PlanarContact: _CONTACT,
    PlanarClearance: _CLEARANCE,
    PlanarPose: _POSE,
    PlanarPhase: _PHASE,
    PlanarTask: _MOTION,
}
