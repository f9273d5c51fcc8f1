"""Which joints of a robot move in a motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mcplan.errors import InvalidInput, shown

if TYPE_CHECKING:
    from mcplan.kinematics.urdf_model import UrdfModel

#: Words in names of joints that a motion leaves alone where they carry no contact.
STILL = ("gripper", "finger", "head", "neck", "hand")


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
        given = [part.strip() for part in which.split(",")] if isinstance(which, str) else list(which)
        for i, name in enumerate(given):
            if name not in names:
                rule = "must be all, default, legs, or name joints of the URDF"
                raise InvalidInput("joints" if len(given) == 1 else f"joints[{i}]", rule, shown(name))
        chosen = set(given)
    locked = {
        name: float(urdf_model.neutral[model.idx_qs[model.getJointId(name)]]) for name in names if name not in chosen
    }
    return tuple(name for name in names if name in chosen), locked


def _carrying(urdf_model: UrdfModel, feet: bool) -> set[str]:
    """Joints between the base and end-effectors, or feet alone."""
    model, found = urdf_model.model, set()
    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        if end.kind == "foot" or not feet:
            found |= {model.names[joint] for joint in model.supports[model.frames[frame].parentJoint] if joint > 1}
    return found
