"""Which joints of a robot move in a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mcplan.errors import InvalidInput, shown
from mcplan.files.robots import PACKAGE
from mcplan.files.urdf_setups import SETUPS

from .motion_model import MotionModel, motion_model

if TYPE_CHECKING:
    from mcplan._core import Plan
    from mcplan.kinematics.urdf_model import UrdfModel

#: Words in names of joints that a motion leaves alone where they carry no contact.
STILL = ("gripper", "finger", "head", "neck", "hand")


@dataclass(frozen=True)
class MovingRobot:
    """A plan, its robot's model, and which of its joints move.

    Attributes:
        plan: The plan.
        urdf: As a Motion has it.
        joints: Those that move, in Pinocchio's order.
        locked: Positions of the others [rad or m].
        model: The robot's model.
    """

    plan: Plan
    urdf: str
    joints: tuple[str, ...]
    locked: dict[str, float]
    model: MotionModel

    @staticmethod
    def of(plan: Plan, which: str | Sequence[str]) -> MovingRobot:
        """The robot of a plan, with the joints that `moving_joints` chooses.

        Raises:
            InvalidInput: No such joint.
            InvalidRobot: The URDF cannot be read.
        """
        from mcplan.kinematics.urdf_model import load_model

        urdf = plan.robot.urdf.removeprefix(PACKAGE)
        urdf = urdf if urdf in SETUPS else plan.robot.urdf
        complete = load_model(plan.robot)
        joints, locked = moving_joints(complete, which)
        return MovingRobot(plan, urdf, joints, locked, motion_model(plan, urdf, joints, locked, complete))


def moving_joints(urdf_model: UrdfModel, which: str | Sequence[str]) -> tuple[tuple[str, ...], dict[str, float]]:
    """Joints that move, in Pinocchio's order, and the positions of all others [rad].

    Args:
        urdf_model: The robot.
        which: "all"; "default": all but grippers, fingers and head; "legs"; or names, with commas between or as a list.

    Raises:
        InvalidInput: No such joint.
    """
    model = urdf_model.model
    names = list(model.names)[2:]
    legs, limbs = _carrying(urdf_model, feet=True), _carrying(urdf_model, feet=False)
    if which == "all":
        chosen = set(names)
    elif which == "default":
        chosen = {name for name in names if name in limbs or not any(word in name.lower() for word in STILL)}
    elif which == "legs":
        chosen = legs
    else:
        chosen = set(_named(which, names))
    locked = {
        name: float(urdf_model.neutral[model.idx_qs[model.getJointId(name)]]) for name in names if name not in chosen
    }
    return tuple(name for name in names if name in chosen), locked


def _named(which: str | Sequence[str], names: Sequence[str]) -> list[str]:
    """Joints by their names, with commas between or as a list."""
    given = [part.strip() for part in which.split(",")] if isinstance(which, str) else list(which)
    if not given:
        raise InvalidInput("joints", "must name a joint at least", "[]")
    for i, name in enumerate(given):
        # A list has indices; in a text with commas the name says which.
        field = "joints" if isinstance(which, str) or len(given) == 1 else f"joints[{i}]"
        if name not in names:
            raise InvalidInput(field, "must be all, default, legs, or name joints of the URDF", shown(name))
        if name in given[:i]:
            raise InvalidInput(field, "must name each joint once", shown(name))
    return given


def _carrying(urdf_model: UrdfModel, feet: bool) -> set[str]:
    """Joints between the base and end-effectors, or feet alone."""
    model, found = urdf_model.model, set()
    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        if end.kind == "foot" or not feet:
            found |= {model.names[joint] for joint in model.supports[model.frames[frame].parentJoint] if joint > 1}
    return found
