"""The URDF of a robot as Pinocchio's model, with a frame for each end-effector's contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot, shown, written
from mcplan.extras import require
from mcplan.files.robots import PACKAGE, list_robots_with
from mcplan.files.urdf_packages import packaged_robot, packaged_visuals
from mcplan.files.urdf_reading import build_model, package_folders, read_urdf

from .srdf import srdf_beside

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]

#: Inertia of the rotor, seen at the joint, of joints for which URDF and SRDF give none [kg m^2]. Geared joints have
#: some, and without it light distal links accelerate too easily to be simulated.
ARMATURE = 0.01
#: Minimum mass of links that move [kg], and of their principal inertias [kg m^2]: some URDFs have links without any.
MIN_MASS, MIN_INERTIA = 1e-6, 1e-9


@dataclass(frozen=True)
class UrdfModel:
    """A robot's URDF, read.

    Attributes:
        robot: What it was read for.
        model: Pinocchio model with a free-flyer, and the contact frames among its frames. Every joint has the inertia
            of a rotor, `model.armature`, and every link one that a rigid body can have.
        read_visual: Gives its visual geometry; of a robot of example-robot-data it is read when asked for.
        neutral: (nq,) configuration: free-flyer at the origin, joints in the robot's posture.
        frames: Index of the contact frame of each end-effector: at its contact point, axes those of the base when the
            robot is in its posture. The z axis of a sole's frame is the normal of the ground on which it lies flat.
        path: The URDF file.
    """

    robot: Robot
    model: Any
    read_visual: Callable[[], Any]
    neutral: Array
    frames: list[int]
    path: Path

    @property
    def visual(self) -> Any:
        """Its visual geometry; what is returned is not to be changed."""
        return self.read_visual()


def _others() -> str:
    """Which robots to plan for instead of one without joints."""
    return f"; plan for one that has, such as {', '.join(list_robots_with((), joints=True))}"


def require_urdf(robot: Robot) -> None:
    """Refuse a robot without joints.

    Raises:
        InvalidRobot: The robot names no URDF.
    """
    if not robot.urdf:
        raise InvalidRobot("urdf", f"must name a URDF: this robot has no joints{_others()}", "", robot.name)


def load_model(robot: Robot) -> UrdfModel:
    """Read the URDF of a robot.

    Raises:
        MissingExtra: Pinocchio, or example-robot-data that the robot asks for, is not installed.
        InvalidRobot: The robot names no URDF, it cannot be read, or it lacks a frame or joint that the robot names.
    """
    require_urdf(robot)
    require(f"the joints of {robot.name}", "view", "pinocchio")
    import pinocchio as pin  # type: ignore[import-untyped]

    source = robot.urdf
    if source.startswith(PACKAGE):
        require(f"the joints of {robot.name}", "view", "example_robot_data")
    try:
        if source.startswith(PACKAGE):
            name = source[len(PACKAGE) :]
            packaged = packaged_robot(name)
            model, neutral, path = pin.Model(packaged.model), packaged.posture.copy(), packaged.path
            read_visual: Callable[[], Any] = partial(packaged_visuals, name)
        else:
            path = Path(source).resolve(strict=True)
            xml = read_urdf(path, InvalidRobot)
            model = build_model(xml, InvalidRobot, str(path))
            kind, folders = pin.GeometryType.VISUAL, package_folders(path)
            visual = pin.buildGeomFromUrdfString(model, xml.text, kind, None, folders)
            read_visual = lambda: visual  # noqa: E731
            srdf = srdf_beside(path)
            if srdf is not None and "rotor_params" in srdf.read_text(errors="replace"):
                pin.loadRotorParameters(model, str(srdf), False)
            neutral = pin.neutral(model)
    except Exception as error:  # loaders of robots raise what the file system or the parser happen to raise
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise InvalidRobot("urdf", "must be a readable URDF", f"{shown(source, 200)} ({reason})", robot.name) from error
    if neutral.shape != (model.nq,) or not np.isfinite(neutral).all():
        neutral = pin.neutral(model)
    neutral[:7] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    for joint, angle in robot.posture.items():
        if not model.existJointName(joint):
            raise InvalidRobot("posture", "must name joints of the URDF", written(joint), robot.name)
        neutral[model.joints[model.getJointId(joint)].idx_q] = angle
    armature = model.armature.copy()
    armature[6:] = np.where(armature[6:] > 0.0, armature[6:], ARMATURE)
    model.armature = armature
    for joint in range(1, model.njoints):
        _make_physical(model, joint)
    return UrdfModel(robot, model, read_visual, neutral, _contact_frames(model, neutral, robot), path)


def _make_physical(model: Any, joint: int) -> None:
    """Mend a mass or an inertia that no rigid body has: zero, or one principal moment above the sum of the others."""
    import pinocchio as pin

    inertia = model.inertias[joint]
    moments, axes = np.linalg.eigh(inertia.inertia)
    mended = np.maximum(moments, MIN_INERTIA)
    mended[2] = min(mended[2], mended[0] + mended[1])
    mass = max(inertia.mass, MIN_MASS)
    if mass != inertia.mass or not np.allclose(mended, moments, rtol=0.0, atol=1e-12):
        model.inertias[joint] = pin.Inertia(mass, inertia.lever, axes @ np.diag(mended) @ axes.T)


def _contact_frames(model: Any, neutral: Array, robot: Robot) -> list[int]:
    import pinocchio as pin

    for number, end in enumerate(robot.end_effectors):
        if not model.existFrame(end.frame):
            field = f"end_effectors[{number}].frame"
            raise InvalidRobot(field, "must name a frame of the URDF", written(end.frame), robot.name)
    data = model.createData()
    pin.framesForwardKinematics(model, data, neutral)
    frames = []
    for end in robot.end_effectors:
        # Links and joints may have one name: the link's frame is meant where there is one.
        link = model.getBodyId(end.frame) if model.existBodyName(end.frame) else model.getFrameId(end.frame)
        joint = model.frames[link].parentJoint
        placement_W = pin.SE3(np.eye(3), data.oMf[link].act(np.asarray(end.frame_offset, float)))
        placement = data.oMi[joint].actInv(placement_W)
        contact = pin.Frame(f"mcplan/{end.name}", joint, link, placement, pin.FrameType.OP_FRAME)
        frames.append(model.addFrame(contact, False))
    return frames


def own_joints(urdf_model: UrdfModel, end: int) -> list[int]:
    """Joints between the base and one end-effector that move no other end-effector, from the base outwards."""
    supports = [list(urdf_model.model.supports[urdf_model.model.frames[f].parentJoint]) for f in urdf_model.frames]
    others = {joint for i, chain in enumerate(supports) if i != end for joint in chain}
    return [joint for joint in supports[end] if joint > 1 and joint not in others]


def leg_velocities(urdf_model: UrdfModel) -> NDArray[np.bool_]:
    """(nv - 6,) whether a joint's velocity is one of a leg: of joints that move one foot and no other end-effector."""
    model, found = urdf_model.model, np.zeros(urdf_model.model.nv, bool)
    for end, end_effector in enumerate(urdf_model.robot.end_effectors):
        if end_effector.kind == "foot":
            for joint in own_joints(urdf_model, end):
                found[model.joints[joint].idx_v : model.joints[joint].idx_v + model.joints[joint].nv] = True
    return found[6:]
