"""The rigid-body model of a motion: the robot's URDF with the joints that do not move held."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidPlan, shown
from mcplan.files.robots import PACKAGE
from mcplan.files.urdf_setups import SETUPS
from mcplan.kinematics.urdf_model import UrdfModel, load_model

if TYPE_CHECKING:
    from mcplan._core import Plan

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MotionModel:
    """The robot of a motion.

    Attributes:
        complete: Its URDF with all joints.
        model: Pinocchio's model with those that move, and the contact frames.
        frames: Index of the contact frame of each end-effector in `model`.
        neutral: (nq,) configuration of `model`: free-flyer at the origin, joints in the robot's posture.
        locked: (complete nq,) configuration of the complete model with the locked joints at their positions.
        effort: (nv - 6,) torque limits of the joints [N m], inf where there is none.
        speed: (nv - 6,) their speed limits [rad/s].
    """

    complete: UrdfModel
    model: Any
    frames: list[int]
    neutral: Array
    locked: Array
    effort: Array
    speed: Array

    def configurations(self, base_q: Array, angles: Array) -> Array:
        """(k, nq) of the free-flyer's coordinates (k, 7) and the joints' positions (k, nv - 6)."""
        q = np.zeros((len(angles), self.model.nq))
        q[:, :7] = base_q
        for joint in range(2, self.model.njoints):
            at, angle = self.model.idx_qs[joint], angles[:, self.model.idx_vs[joint] - 6]
            if self.model.nqs[joint] == 2:  # a joint without limits: Pinocchio holds cosine and sine
                q[:, at], q[:, at + 1] = np.cos(angle), np.sin(angle)
            else:
                q[:, at] = angle
        return q

    def complete_configurations(self, q: Array) -> Array:
        """Configurations (k, nq) of the complete model, the locked joints at their positions."""
        full = np.repeat(self.locked[None], len(q), axis=0)
        full[:, :7] = q[:, :7]
        whole = self.complete.model
        for joint in range(2, self.model.njoints):
            to, at, size = (
                whole.idx_qs[whole.getJointId(self.model.names[joint])],
                self.model.idx_qs[joint],
                self.model.nqs[joint],
            )
            full[:, to : to + size] = q[:, at : at + size]
        return full

    def complete_velocities(self, v: Array) -> Array:
        """Velocities or accelerations (k, nv) of the complete model, zero where joints are locked."""
        whole = self.complete.model
        full = np.zeros((len(v), whole.nv))
        full[:, :6] = v[:, :6]
        for joint in range(2, self.model.njoints):
            to = whole.idx_vs[whole.getJointId(self.model.names[joint])]
            full[:, to] = v[:, self.model.idx_vs[joint]]
        return full


def motion_model(
    plan: Plan, urdf: str, joints: Sequence[str], locked: Mapping[str, float], complete: UrdfModel | None = None
) -> MotionModel:
    """The model of a motion.

    Args:
        plan: Its robot's end-effectors have the contact frames, its scene has the gravity.
        urdf: Name of a built-in setup, or as a robot names its URDF.
        joints: Those that move, in Pinocchio's order.
        locked: Positions of the others [rad or m].
        complete: The plan's robot with that URDF, read before; None: it is read.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidRobot: The URDF cannot be read.
        InvalidPlan: The joints are not those of the URDF.
    """
    robot = copy.deepcopy(plan.robot)
    robot.urdf = PACKAGE + urdf if urdf in SETUPS else urdf
    complete = complete or load_model(robot)
    import pinocchio as pin  # type: ignore[import-untyped]

    whole = complete.model
    _require_joints(whole, joints, locked)
    configuration = complete.neutral.copy()
    for name, position in locked.items():
        joint = whole.getJointId(name)
        pair = [np.cos(position), np.sin(position)] if whole.nqs[joint] == 2 else [position]
        configuration[whole.idx_qs[joint] : whole.idx_qs[joint] + whole.nqs[joint]] = pair
    model = pin.buildReducedModel(whole, [whole.getJointId(name) for name in locked], configuration)
    armature, neutral = np.zeros(model.nv), np.zeros(model.nq)
    neutral[:7] = complete.neutral[:7]
    for name in joints:
        old, new = whole.getJointId(name), model.getJointId(name)
        armature[model.idx_vs[new]] = whole.armature[whole.idx_vs[old]]
        size = model.nqs[new]
        neutral[model.idx_qs[new] : model.idx_qs[new] + size] = complete.neutral[whole.idx_qs[old] :][:size]
    model.armature = armature
    model.gravity.linear = np.array([0.0, 0.0, -plan.scene.gravity])
    frames = [model.getFrameId(f"mcplan/{end.name}") for end in robot.end_effectors]
    limits = [np.where(limit[6:] > 0.0, limit[6:], np.inf) for limit in (model.effortLimit, model.velocityLimit)]
    return MotionModel(complete, model, frames, neutral, configuration, *limits)


def _require_joints(whole: Any, joints: Sequence[str], locked: Mapping[str, float]) -> None:
    names = list(whole.names)[2:]
    for i, name in enumerate(joints):
        if name not in names:
            raise InvalidPlan(f"joints[{i}]", "must name a joint of the URDF", shown(name))
    for name in locked:
        if name not in names:
            raise InvalidPlan("locked", "must name joints of the URDF", shown(name))
    moving = [name for name in names if name not in locked]
    if list(joints) != moving:
        first = next((i for i, (a, b) in enumerate(zip(joints, moving, strict=False)) if a != b), len(joints))
        rule = "must be all joints of the URDF that are not locked, in its order"
        raise InvalidPlan("joints", rule, f"{shown(joints[first]) if first < len(joints) else 'an end'} at {first}")
    for name in moving:
        if whole.nvs[whole.getJointId(name)] != 1:
            raise InvalidPlan("joints", "must have one degree of freedom each", shown(name))
