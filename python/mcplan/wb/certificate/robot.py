"""The robot of a motion, with all joints of its URDF: those that are locked stand still and are not looked at."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidPlan, shown
from mcplan.files.robots import PACKAGE, robot_from_dict, robot_to_dict
from mcplan.files.urdf_setups import SETUPS
from mcplan.kinematics.urdf_model import UrdfModel, load_model

from .inputs import CertifiedMotion

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CertifiedRobot:
    """A robot in Pinocchio. Motions of the same robot and joints have the same one; nobody changes it.

    Attributes:
        urdf_model: Model with all joints, and the contact frames.
        moving: (J,) indices of velocity of the joints that move.
        names: (J,) their names.
        locked: Positions of the other joints.
        low, high: (J,) limits of their positions.
        speed, effort: (J,) limits of speed and torque, inf where the URDF has none.
    """

    urdf_model: UrdfModel
    moving: NDArray[np.int64]
    names: tuple[str, ...]
    locked: Mapping[str, float]
    low: Array
    high: Array
    speed: Array
    effort: Array

    @property
    def model(self) -> Any:
        """Pinocchio's model."""
        return self.urdf_model.model

    def bounds(self, joint: str) -> tuple[float, float]:
        """Lowest and highest position of a joint by its name, moving or locked; infinite where it has no end."""
        return _bounds(self.model, joint)


def certified_robot(motion: CertifiedMotion) -> CertifiedRobot:
    """The robot of a motion.

    Raises:
        InvalidRobot: The URDF cannot be read.
        InvalidPlan: The joints are not those of the URDF.
    """
    return _robot_of(_Source.of(motion))


@dataclass(frozen=True)
class _Source:
    """What a robot is read from: it as JSON, its URDF and when that file was changed, gravity [m/s^2], and the joints."""

    robot: str
    urdf: str
    changed_ns: int
    gravity: float
    joints: tuple[str, ...]
    locked: tuple[tuple[str, float], ...]

    @staticmethod
    def of(motion: CertifiedMotion) -> _Source:
        urdf = PACKAGE + motion.urdf if motion.urdf in SETUPS else motion.urdf
        return _Source(
            robot=json.dumps(robot_to_dict(motion.plan.robot)),
            urdf=urdf,
            changed_ns=os.stat(urdf).st_mtime_ns if os.path.isfile(urdf) else 0,
            gravity=float(motion.plan.scene.gravity),
            joints=tuple(motion.joints),
            locked=tuple(motion.locked.items()),
        )


@lru_cache(maxsize=4)
def _robot_of(source: _Source) -> CertifiedRobot:
    robot = robot_from_dict(json.loads(source.robot))
    robot.urdf = source.urdf
    urdf_model = load_model(robot)
    model, joints, locked = urdf_model.model, source.joints, dict(source.locked)
    model.gravity.linear = np.array([0.0, 0.0, -source.gravity])
    moving, low, high = [], [], []
    known = set(list(model.names)[2:])
    for name in (*joints, *locked):
        if name not in known:
            raise InvalidPlan("joints", "must be those of the URDF", shown(name))
    if known - {*joints, *locked}:
        missing = min(known - {*joints, *locked})
        raise InvalidPlan("joints", "must be, with the locked ones, all of the URDF", f"none named {shown(missing)}")
    for name in joints:
        moving.append(model.joints[model.getJointId(name)].idx_v)
        least, most = _bounds(model, name)
        low.append(least)
        high.append(most)
    at = np.array(moving, dtype=np.int64)
    speed, effort = (np.where(limit[at] > 0.0, limit[at], np.inf) for limit in (model.velocityLimit, model.effortLimit))
    return CertifiedRobot(urdf_model, at, joints, locked, np.array(low), np.array(high), speed, effort)


def _bounds(model: Any, name: str) -> tuple[float, float]:
    joint = model.joints[model.getJointId(name)]
    if joint.nq != 1:
        return -np.inf, np.inf
    return float(model.lowerPositionLimit[joint.idx_q]), float(model.upperPositionLimit[joint.idx_q])


def configurations(robot: CertifiedRobot, base: Array, angles: Array) -> Array:
    """(k, nq) configurations of a base (k, 7) and moving joints (k, J)."""
    model = robot.model
    q = np.repeat(robot.urdf_model.neutral[None], len(base), axis=0)
    q[:, :7] = base
    columns = dict(zip(robot.names, angles.T, strict=True))
    for name in (*robot.names, *robot.locked):
        joint = model.joints[model.getJointId(name)]
        angle = columns[name] if name in columns else np.full(len(base), robot.locked[name])
        if joint.nq == 2:
            q[:, joint.idx_q], q[:, joint.idx_q + 1] = np.cos(angle), np.sin(angle)
        else:
            q[:, joint.idx_q] = angle
    return q
