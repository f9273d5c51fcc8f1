"""Reference motions (.npz) as the motion-tracking tasks of mjlab and IsaacLab load them.

Keys and conventions are those of mjlab's csv_to_npz and BeyondMimic's whole_body_tracking: fps (1,), joint_pos and joint_vel
(n, nj), body_pos_w (n, nb, 3) and body_quat_w (n, nb, 4) wxyz of the links' frames, body_lin_vel_w and body_ang_vel_w (n, nb, 3)
in the world's axes. Linear velocities are those of the origins of these frames for mjlab (its body_link_lin_vel_w), and those of
the bodies' centres of mass for IsaacLab, whose body_lin_vel_w is body_com_lin_vel_w. joint_names and body_names, which no loader
reads, say the order.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, shown
from mcplan.files.outputs import write_whole
from mcplan.kinematics.rotations import quat_xyzw

from .orders import Order, order_of

if TYPE_CHECKING:
    from .motion import Motion
    from .source import Source

Array = NDArray[np.float64]


def write(source: Source, path: Path) -> None:
    """Write the motion of a source, breadth first if IsaacLab is to read it."""
    require_whole_rate(source.rate_hz)
    isaac = source.order == "isaaclab"
    order = order_of(source.motion.urdf_model, breadth_first=isaac)
    buffer = io.BytesIO()
    np.savez(buffer, **arrays(source.motion, order, source.rate_hz, at_com=isaac))
    write_whole(buffer.getvalue(), path)


def arrays(motion: Motion, order: Order, rate_hz: float, at_com: bool) -> dict[str, Any]:
    """The file's arrays.

    Raises:
        InvalidInput: The rate is no whole number.
    """
    require_whole_rate(rate_hz)
    joint_pos, joint_vel = motion.in_order(order.joints)
    positions, quats, linear, angular = body_states(motion, order, at_com)
    return {
        "fps": np.array([round(rate_hz)]),
        "joint_pos": joint_pos,
        "joint_vel": joint_vel,
        "body_pos_w": positions,
        "body_quat_w": quats,
        "body_lin_vel_w": linear,
        "body_ang_vel_w": angular,
        "joint_names": np.array(order.joints),
        "body_names": np.array(order.bodies),
    }


def require_whole_rate(rate_hz: float) -> None:
    """Raise InvalidInput for a rate that is no whole number, which the loaders take fps to be."""
    if rate_hz != round(rate_hz):
        raise InvalidInput("rate_hz", "must be a whole number in this format", shown(rate_hz))


def body_states(motion: Motion, order: Order, at_com: bool) -> tuple[Array, Array, Array, Array]:
    """Positions (n, nb, 3), quaternions wxyz (n, nb, 4), linear and angular velocities (n, nb, 3) of bodies, world frame.

    Args:
        motion: Joints.
        order: Which bodies.
        at_com: Whether linear velocities are those of centres of mass; positions are those of the links' frames.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    model = motion.urdf_model.model
    data = model.createData()
    frames = [model.getBodyId(name) for name in order.bodies]
    # In the axes of the link's frame; what hangs on it by fixed joints counts.
    to_com = [
        model.frames[frame].placement.actInv(model.inertias[model.frames[frame].parentJoint].lever) for frame in frames
    ]
    shape = (len(motion.times_s), len(frames), 3)
    positions, linear, angular = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    rotations = np.zeros((*shape, 3))
    for n, (q, v) in enumerate(zip(motion.configurations, motion.velocities, strict=True)):
        pin.forwardKinematics(model, data, q, v)
        pin.updateFramePlacements(model, data)
        for b, frame in enumerate(frames):
            velocity = pin.getFrameVelocity(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
            positions[n, b], rotations[n, b] = data.oMf[frame].translation, data.oMf[frame].rotation
            linear[n, b], angular[n, b] = velocity.linear, velocity.angular
            if at_com:
                linear[n, b] += np.cross(velocity.angular, rotations[n, b] @ to_com[b])
    quats = np.stack([quat_xyzw(rotations[:, b])[:, [3, 0, 1, 2]] for b in range(len(frames))], axis=1)
    return positions, quats, linear, angular
