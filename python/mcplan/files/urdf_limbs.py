"""Limbs of a URDF: the joints that carry an end-effector and no other one, and the frame of its contact."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from mcplan.errors import InvalidInput, shown
from mcplan.files.reach import Limb
from mcplan.files.urdf_setups import End

_CONTINUOUS = 2.0 * np.pi  # a joint with limits wider than this turns freely
_FREE_RANGE = 1.2  # [rad] about the nominal posture, kept on joints that turn freely, so that no knee flips


def contact_frame(model: Any, end: End) -> int:
    """Index of the frame at an end-effector's contact point, with the axes of its link; added if it is not the link's."""
    import pinocchio as pin

    link = model.getBodyId(end.frame)  # joints, which have frames too, may bear the same name
    if not any(end.frame_offset):
        return link
    name = f"mcplan/{end.name}"
    if not model.existFrame(name):
        joint, placement = model.frames[link].parentJoint, model.frames[link].placement
        placement = placement * pin.SE3(np.eye(3), np.asarray(end.frame_offset, float))
        model.addFrame(pin.Frame(name, joint, link, placement, pin.FrameType.OP_FRAME), False)
    return model.getFrameId(name)


def limb_of(model: Any, posture: np.ndarray, end: End, ends: tuple[End, ...], source: str = "") -> Limb:
    """The limb that carries an end-effector: the joints on the way to it that carry no other one.

    Raises:
        InvalidInput: There is no such joint, or one has more than an angle: the message names the source, the URDF.
    """
    import pinocchio as pin

    own = own_joints(model, end, ends)
    if not own:
        raise InvalidInput(f"ends.{end.name}", "must be moved by a joint that moves no other one", shown(end.frame))
    for joint in own:
        if model.nqs[joint] != 1:
            raise InvalidInput(f"joint {model.names[joint]}", "must have one angle and limits", "", source)
    locked = [j for j in range(2, model.njoints) if j not in own]  # joint 1 is the free base: its mass counts
    try:
        reduced = pin.buildReducedModel(model, locked, posture)
    except ValueError:
        names = Counter(str(frame.name) for frame in model.frames)
        several = ", ".join(name for name, count in names.items() if count > 1)
        raise InvalidInput("urdf", "must give every link and joint a name of its own", shown(several), source) from None
    nominal = np.array([posture[model.idx_qs[j]] for j in own])
    lower, upper = reduced.lowerPositionLimit[7:].copy(), reduced.upperPositionLimit[7:].copy()
    free = upper - lower > _CONTINUOUS
    lower[free], upper[free] = (nominal - _FREE_RANGE)[free], (nominal + _FREE_RANGE)[free]
    return Limb(
        reduced,
        posture[:7].copy(),
        contact_frame(reduced, end),
        nominal,
        lower,
        upper,
        flat=any(end.half_size),
    )


def own_joints(model: Any, end: End, ends: tuple[End, ...]) -> list[int]:
    """Joints on the way to an end-effector that carry no other one, from the trunk on."""

    def carriers(frame: str) -> list[int]:
        return [j for j in model.supports[model.frames[model.getBodyId(frame)].parentJoint] if j > 1]

    shared = {j for other in ends if other.name != end.name for j in carriers(other.frame)}
    return [j for j in carriers(end.frame) if j not in shared]
