"""A planar robot from a URDF whose joints all turn about one axis.

    mcplan robots --planar --from-urdf leg.urdf --end foot=sole:-0.08,0.14 -o leg.toml

The plane is the one across that axis. Where the axis is horizontal, z is up and x (for an axis along x: y) forward; where
it is vertical, the URDF is taken to be drawn in its x-y plane. What lies off the plane is projected on it, which changes
neither the motion in the plane nor the torques. Links behind fixed joints are part of the link that carries them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import Capsule, PlanarBody, PlanarEndEffector, PlanarRobot
from mcplan.errors import InvalidInput, InvalidRobot, did_you_mean, shown
from mcplan.extras import require
from mcplan.files.urdf_reading import build_model, read_urdf

_DIGITS = 12
_PARALLEL = 1e-6  # sine of the largest angle between axes that count as one


@dataclass(frozen=True)
class PlanarEnd:
    """What to make an end-effector of.

    Attributes:
        name: Of the end-effector.
        frame: URDF link; its z axis (y, where the joints turn about z) points from the ground into the robot.
        points: Where forces act [m], along the sole.
    """

    name: str
    frame: str
    points: tuple[float, ...] = (0.0,)


@dataclass(frozen=True)
class _Plane:
    """Unit vectors in the axes of the URDF's root link, in its zero posture; normal = forward x up."""

    forward: np.ndarray
    up: np.ndarray
    normal: np.ndarray

    def project(self, vector: np.ndarray) -> np.ndarray:
        """Components forward and up, without the last digits' noise of frames multiplied with each other."""
        return np.array([self.forward @ vector, self.up @ vector]).round(_DIGITS) + 0.0


def planar_robot_from_urdf(
    path: str | Path, ends: Sequence[PlanarEnd], name: str = "", radius: float = 0.03
) -> PlanarRobot:
    """Read a planar robot from a URDF.

    Args:
        path: URDF file.
        ends: End-effectors, one at least.
        name: Of the robot; "": that of the file.
        radius: Of the capsules between joints [m]; the URDF's own shapes are not read.

    Returns:
        The robot: bodies named after links, joint position 0 where the URDF's is. Joints turn anti-clockwise, so those
        about the opposite axis change sign.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidInput: There are no ends, or one's link does not exist or is turned out of the plane.
        InvalidRobot: A joint is about another axis, slides or mimics another one, joints form a loop, or a link has no mass
            or no inertia; the message names the file.
    """
    require("mcplan robots --planar --from-urdf", "view", "pinocchio")
    source = str(path)
    try:
        xml = read_urdf(path, InvalidRobot)
        _require_no_mimics(xml.root)
        model = build_model(xml, InvalidRobot, source)
        robot = _robot(model, ends, radius)
        robot.name = name or Path(source).stem
        robot.description = f"From {Path(source).name}"
        robot.validate()
    except InvalidRobot as found:
        raise found.moved(source=source) from None
    return robot


def _require_no_mimics(root: Any) -> None:
    """Pinocchio passes over joints that mimic others."""
    for joint in root.findall("joint"):
        if joint.find("mimic") is not None:
            raise InvalidRobot(f"joint {joint.get('name')}", "may not mimic another joint")


def _robot(model: Any, ends: Sequence[PlanarEnd], radius: float) -> PlanarRobot:
    import pinocchio as pin

    if not ends:
        raise InvalidInput("ends", "needs one at least")
    data, neutral = model.createData(), pin.neutral(model)
    pin.computeJointJacobians(model, data, neutral)
    pin.framesForwardKinematics(model, data, neutral)
    axes = {joint: _axis(model, data, joint) for joint in range(2, model.njoints)}  # joint 1 is the free base
    plane = _plane(model, axes)
    bodies = [_body(model, data, joint, plane, axes.get(joint)) for joint in range(1, model.njoints)]
    end_effectors = [_end_effector(model, data, end, plane) for end in ends]
    for body in bodies[1:]:
        _add_capsule(bodies[body.parent], body.joint_P, radius)
    for end in end_effectors:
        _add_capsule(bodies[end.body], end.position_B, radius)
    return PlanarRobot(bodies=bodies, end_effectors=end_effectors)


def _axis(model: Any, data: Any, joint: int) -> np.ndarray:
    """Unit vector that a joint turns about, in the root's axes."""
    first, count = model.idx_vs[joint], model.nvs[joint]
    axis = data.J[3:, first]
    if count != 1 or np.linalg.norm(axis) < 0.5:
        kind = model.joints[joint].shortname().removeprefix("JointModel")
        raise InvalidRobot(_joint(model, joint), "must be revolute, continuous or fixed", kind)
    return axis.copy()


def _joint(model: Any, joint: int) -> str:
    return f"joint {model.names[joint]}"


def _plane(model: Any, axes: dict[int, np.ndarray]) -> _Plane:
    """The plane across the axis of all joints."""
    if not axes:
        raise InvalidRobot("joints", "needs one that turns, about the normal of the plane")
    first, axis = next(iter(axes.items()))
    for joint, other in axes.items():
        if np.linalg.norm(np.cross(axis, other)) > _PARALLEL:
            rule = f"must turn about the axis of {_joint(model, first)}, {_numbers(axis)}"
            raise InvalidRobot(_joint(model, joint), rule, _numbers(other))
    if abs(abs(axis[2]) - 1.0) < _PARALLEL:
        return _Plane(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    if abs(axis[2]) > _PARALLEL:
        rule = "must turn about a horizontal axis or about z: gravity would point out of the plane"
        raise InvalidRobot(_joint(model, first), rule, _numbers(axis))
    up = np.array([0.0, 0.0, 1.0])
    forward = np.cross(up, axis)
    along_x = abs(forward[0]) > _PARALLEL
    forward *= np.sign(forward[0] if along_x else forward[1])
    return _Plane(forward, up, np.cross(forward, up))


def _body(model: Any, data: Any, joint: int, plane: _Plane, axis: np.ndarray | None) -> PlanarBody:
    """The links that move with a joint; axis None: the base. Frames of all bodies are parallel at joint position 0."""
    inertia, rotation = model.inertias[joint], data.oMi[joint].rotation
    name = _link(model, joint)
    if not inertia.mass > 0.0:
        raise InvalidRobot(f"link {name}", "must have a mass, with what is fixed to it", f"{inertia.mass:g} kg")
    about_normal = float(plane.normal @ rotation @ inertia.inertia @ rotation.T @ plane.normal)
    if not about_normal > 0.0:
        rule = "must have an inertia about the normal of the plane"
        raise InvalidRobot(f"link {name}", rule, f"{about_normal:g} kg m^2")
    body = PlanarBody(name=name, mass=inertia.mass, com_B=plane.project(rotation @ inertia.lever), inertia=about_normal)
    if axis is not None:
        parent = model.parents[joint]
        body.parent = parent - 1
        body.joint_P = plane.project(data.oMi[joint].translation - data.oMi[parent].translation)
        _set_limits(body, model, joint, anticlockwise=bool(axis @ plane.normal > 0.0))
    return body


def _set_limits(body: PlanarBody, model: Any, joint: int, anticlockwise: bool) -> None:
    body.velocity_max = float(model.velocityLimit[model.idx_vs[joint]])
    body.torque_max = float(model.effortLimit[model.idx_vs[joint]])
    if model.nqs[joint] == 1:  # otherwise it is continuous
        low, high = (
            float(limit[model.idx_qs[joint]]) for limit in (model.lowerPositionLimit, model.upperPositionLimit)
        )
        body.position_min, body.position_max = (low, high) if anticlockwise else (-high, -low)


def _link(model: Any, joint: int) -> str:
    """Name of the link that a joint carries; those fixed to it come later in the list."""
    import pinocchio as pin

    return next(frame.name for frame in model.frames if frame.type == pin.FrameType.BODY and frame.parentJoint == joint)


def _end_effector(model: Any, data: Any, end: PlanarEnd, plane: _Plane) -> PlanarEndEffector:
    links = [frame.name for frame in model.frames if model.existBodyName(frame.name)]
    if end.frame not in links:
        rule = f"must name a link of the URDF. {did_you_mean(end.frame, links)}There are: {', '.join(links)}"
        raise InvalidInput(f"ends.{end.name}", rule, shown(end.frame))
    index = model.getBodyId(end.frame)
    joint, placement = model.frames[index].parentJoint, data.oMf[index]
    outward = placement.rotation[:, 1 if abs(plane.normal[2]) > 0.5 else 2]
    if abs(outward @ plane.normal) > _PARALLEL:
        rule = f"must name a link whose {'y' if abs(plane.normal[2]) > 0.5 else 'z'} axis lies in the plane"
        raise InvalidInput(f"ends.{end.name}", rule, shown(end.frame))
    along, above = plane.project(outward)
    return PlanarEndEffector(
        name=end.name,
        body=joint - 1,
        position_B=plane.project(placement.translation - data.oMi[joint].translation),
        angle_B=round(float(np.arctan2(-along, above)), _DIGITS) + 0.0,  # its x axis is 90 degrees clockwise of that
        points=list(end.points),
    )


def _add_capsule(body: PlanarBody, to_B: np.ndarray, radius: float) -> None:
    if np.linalg.norm(to_B) > 1e-6:
        body.capsules = [*body.capsules, Capsule(to_B=to_B, radius=radius)]


def _numbers(values: np.ndarray) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"
