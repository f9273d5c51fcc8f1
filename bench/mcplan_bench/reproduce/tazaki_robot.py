"""A rigid-body model of the robot that Tazaki's paper simulates: 44 kg and 30 joints, as a URDF made by code.

The paper gives no more of it than these two numbers; soles, the height of the CoM and the nominal places of feet and hands
are those of `humanoid44`. All else is chosen here: boxes of even density, legs long enough for the reach boxes of
`humanoid44`, limits of joints of the order of those of electric humanoids, but for arms that are made strong for the rail.
The trunk's box is put where the CoM of the nominal posture lies above the soles' middle, 0.70 m high.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.files.outputs import write_whole

if TYPE_CHECKING:
    from mcplan import Robot

Array = NDArray[np.float64]
Vector = tuple[float, float, float]

NAME = "humanoid44_joints"
#: Robot whose soles, places of end-effectors and CoM height the model has.
PLANNED_FOR = "humanoid44"

#: Heights above the soles in the nominal posture, and half the width between hips and between shoulders [m].
HIP_HEIGHT, HIP_Y = 0.66, 0.10
SHOULDER_HEIGHT, SHOULDER_Y = 1.10, 0.18
#: Lengths of thigh, shank, upper arm and forearm, heights of the ankle above the sole, of the
#: foot and of the waist above the hip, from wrist to contact [m].
THIGH = SHANK = 0.38
ANKLE_HEIGHT, FOOT, WAIST = 0.07, 0.05, 0.10
UPPER_ARM, FOREARM, HAND = 0.28, 0.26, 0.08
#: How far soles, shoulders and so the CoM are ahead of ankles and hips [m].
AHEAD = 0.02

X: Vector = (1.0, 0.0, 0.0)
Y: Vector = (0.0, 1.0, 0.0)
Z: Vector = (0.0, 0.0, 1.0)

#: Of joints: range [rad], torque [N m] and speed [rad/s]. Those of left limbs; the right ones are their mirror images.
LIMITS: dict[str, tuple[float, float, float, float]] = {
    "waist_yaw": (-1.2, 1.2, 150.0, 10.0),
    "waist_pitch": (-0.3, 0.8, 200.0, 10.0),
    "neck_yaw": (-1.2, 1.2, 15.0, 8.0),
    "neck_pitch": (-0.6, 0.8, 15.0, 8.0),
    "hip_yaw": (-0.8, 0.8, 120.0, 16.0),
    "hip_roll": (-0.5, 0.7, 200.0, 16.0),
    "hip_pitch": (-2.2, 0.9, 250.0, 16.0),
    "knee": (0.0, 2.5, 300.0, 16.0),
    "ankle_pitch": (-1.3, 0.9, 120.0, 16.0),
    "ankle_roll": (-0.6, 0.6, 80.0, 16.0),
    "shoulder_pitch": (-3.0, 1.5, 120.0, 10.0),
    "shoulder_roll": (-0.4, 2.8, 120.0, 10.0),
    "shoulder_yaw": (-2.0, 2.0, 80.0, 10.0),
    "elbow": (-2.5, 0.0, 120.0, 12.0),
    "wrist_yaw": (-2.0, 2.0, 30.0, 12.0),
    "wrist_pitch": (-1.4, 1.4, 30.0, 12.0),
    "wrist_roll": (-1.2, 1.2, 30.0, 12.0),
}


#: Size and middle [m] of what is drawn of links whose box ends short of their joints, so that boxes do not meet there.
DRAWN: dict[str, tuple[Vector, Vector]] = {
    "waist_yaw": ((0.10, 0.14, 0.10), (0.0, 0.0, 0.0)),
    "waist_pitch": ((0.15, 0.26, 0.39), (0.0, 0.0, 0.215)),
    "neck_yaw": ((0.06, 0.06, 0.12), (0.0, 0.0, 0.03)),
    "hip_pitch": ((0.10, 0.10, THIGH), (0.0, 0.0, -0.5 * THIGH)),
    "knee": ((0.08, 0.08, SHANK), (0.0, 0.0, -0.5 * SHANK)),
    "ankle_pitch": ((0.06, 0.06, 0.06), (0.0, 0.0, 0.0)),
    "shoulder_yaw": ((0.07, 0.07, UPPER_ARM), (0.0, 0.0, -0.5 * UPPER_ARM)),
    "elbow": ((0.06, 0.06, 0.5 * FOREARM), (0.0, 0.0, -0.25 * FOREARM)),
    "wrist_yaw": ((0.06, 0.06, 0.5 * FOREARM), (0.0, 0.0, -0.25 * FOREARM)),
}


@dataclass(frozen=True)
class Part:
    """A rigid body, a box of even density, and the joint that carries it.

    Attributes:
        name: Of the link; of the joint, too.
        parent: Link that carries it; "": it is the base.
        origin: Place of the joint in the parent's axes [m].
        axis: Of the joint.
        mass: [kg].
        size, centre: Edges of the box and its middle in the link's axes [m].
    """

    name: str
    parent: str
    origin: Vector
    axis: Vector
    mass: float
    size: Vector
    centre: Vector


def parts() -> list[Part]:
    """All rigid bodies, each after the one that carries it."""
    shift = _trunk_shift(_parts(0.0, 0.0))
    return _parts(*shift)


def _parts(trunk_x: float, trunk_z: float) -> list[Part]:
    """The bodies with the trunk's box moved by two lengths [m]."""
    shoulder_z = SHOULDER_HEIGHT - HIP_HEIGHT - WAIST
    trunk = (trunk_x, 0.0, 0.19 + trunk_z)
    bodies = [
        Part("pelvis", "", (0.0, 0.0, 0.0), Z, 7.0, (0.16, 0.26, 0.12), (0.0, 0.0, 0.02)),
        Part("waist_yaw", "pelvis", (0.0, 0.0, WAIST), Z, 0.8, (0.08, 0.08, 0.03), (0.0, 0.0, 0.0)),
        Part("waist_pitch", "waist_yaw", (0.0, 0.0, 0.0), Y, 9.0, (0.16, 0.26, 0.28), trunk),
        Part("neck_yaw", "waist_pitch", (0.0, 0.0, shoulder_z + 0.08), Z, 0.3, (0.05, 0.05, 0.05), (0.0, 0.0, 0.02)),
        Part("neck_pitch", "neck_yaw", (0.0, 0.0, 0.05), Y, 1.7, (0.16, 0.14, 0.20), (0.01, 0.0, 0.12)),
    ]
    for side, y in (("left", 1.0), ("right", -1.0)):
        bodies += [*_leg(side, y * HIP_Y), *_arm(side, y * SHOULDER_Y, shoulder_z)]
    return bodies


def _leg(side: str, y: float) -> Iterator[Part]:
    middle = 0.5 * FOOT - ANKLE_HEIGHT
    chain: tuple[tuple[str, Vector, Vector, float, Vector, Vector], ...] = (
        ("hip_yaw", (0.0, y, 0.0), Z, 0.6, (0.06, 0.06, 0.02), (0.0, 0.0, 0.075)),
        ("hip_roll", (0.0, 0.0, 0.0), X, 0.6, (0.06, 0.06, 0.06), (0.0, 0.0, 0.0)),
        ("hip_pitch", (0.0, 0.0, 0.0), Y, 4.0, (0.10, 0.10, 0.28), (0.0, 0.0, -0.5 * THIGH)),
        ("knee", (0.0, 0.0, -THIGH), Y, 2.5, (0.08, 0.08, 0.26), (0.0, 0.0, -0.5 * SHANK)),
        ("ankle_pitch", (0.0, 0.0, -SHANK), Y, 0.3, (0.05, 0.05, 0.05), (0.0, 0.0, 0.0)),
        ("ankle_roll", (0.0, 0.0, 0.0), X, 1.0, (0.20, 0.10, FOOT), (AHEAD, 0.0, middle)),
    )
    return _chain(side, "pelvis", chain)


def _arm(side: str, y: float, z: float) -> Iterator[Part]:
    chain: tuple[tuple[str, Vector, Vector, float, Vector, Vector], ...] = (
        ("shoulder_pitch", (AHEAD, y, z), Y, 0.5, (0.07, 0.06, 0.07), (0.0, 0.0, 0.0)),
        ("shoulder_roll", (0.0, 0.0, 0.0), X, 0.4, (0.06, 0.06, 0.06), (0.0, 0.0, 0.0)),
        ("shoulder_yaw", (0.0, 0.0, 0.0), Z, 1.1, (0.07, 0.07, 0.22), (0.0, 0.0, -0.5 * UPPER_ARM)),
        ("elbow", (0.0, 0.0, -UPPER_ARM), Y, 0.5, (0.06, 0.06, 0.12), (0.0, 0.0, -0.06)),
        ("wrist_yaw", (0.0, 0.0, -0.5 * FOREARM), Z, 0.5, (0.06, 0.06, 0.12), (0.0, 0.0, -0.25 * FOREARM)),
        ("wrist_pitch", (0.0, 0.0, -0.5 * FOREARM), Y, 0.2, (0.04, 0.04, 0.04), (0.0, 0.0, 0.0)),
        ("wrist_roll", (0.0, 0.0, 0.0), X, 0.4, (0.05, 0.05, HAND), (0.0, 0.0, -0.5 * HAND)),
    )
    return _chain(side, "waist_pitch", chain)


def _chain(side: str, parent: str, chain: tuple[Any, ...]) -> Iterator[Part]:
    for name, *rest in chain:
        yield Part(f"{side}_{name}", parent, *rest)
        parent = f"{side}_{name}"


def _trunk_shift(bodies: list[Part]) -> tuple[float, float]:
    """How far to move the trunk's box forward and up so that the CoM lies above the soles' middle, as high as planned."""
    from mcplan.files.robots import load_robot

    com, mass = center_of_mass(bodies)
    away = np.array([AHEAD, 0.0, load_robot(PLANNED_FOR).com_height - HIP_HEIGHT]) - com
    trunk = next(body for body in bodies if body.name == "waist_pitch")
    shift = away * mass / trunk.mass
    return float(shift[0]), float(shift[2])


def posture() -> dict[str, float]:
    """Angle [rad] of each joint that is not at 0 in the nominal posture: knees bent, soles level, palms at the CoM's height."""
    reach = HIP_HEIGHT - ANKLE_HEIGHT
    hip = float(np.arccos((THIGH**2 + reach**2 - SHANK**2) / (2.0 * THIGH * reach)))
    knee = float(np.pi - np.arccos((THIGH**2 + SHANK**2 - reach**2) / (2.0 * THIGH * SHANK)))
    roll, pitch, elbow = _arm_angles()
    angles: dict[str, float] = {}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        angles |= {f"{side}_hip_pitch": -hip, f"{side}_knee": knee, f"{side}_ankle_pitch": hip - knee}
        angles |= {f"{side}_shoulder_pitch": pitch, f"{side}_shoulder_roll": sign * roll, f"{side}_elbow": elbow}
    return angles


def _arm_angles() -> tuple[float, float, float]:
    """Roll and pitch of the left shoulder and angle of its elbow that bring the palm to its nominal place."""
    from mcplan.files.robots import load_robot

    robot = load_robot(PLANNED_FOR)
    palm = np.asarray(robot.end_effectors[robot.end_effector_index("left_hand")].nominal_B)
    out = palm[1] - SHOULDER_Y
    down = SHOULDER_HEIGHT - robot.com_height - palm[2]
    forearm = FOREARM + HAND
    elbow = -float(np.pi - np.arccos((UPPER_ARM**2 + forearm**2 - out**2 - down**2) / (2.0 * UPPER_ARM * forearm)))
    # In the arm's own plane the palm is this far ahead of the shoulder and below it; the roll tilts what is below.
    ahead, below = -forearm * np.sin(elbow), UPPER_ARM + forearm * np.cos(elbow)
    roll = float(np.arcsin(out / below))
    pitch = float(np.arctan2(ahead, below * np.cos(roll)))
    return roll, pitch, elbow


def placements(bodies: list[Part], angles: Mapping[str, float] | None = None) -> dict[str, tuple[Array, Array]]:
    """Rotation (3, 3) and place (3,) [m] of each link in the base's axes; in the nominal posture unless told otherwise."""
    angles = posture() if angles is None else angles
    found: dict[str, tuple[Array, Array]] = {"": (np.eye(3), np.zeros(3))}
    for body in bodies:
        rotation, place = found[body.parent]
        own = _rotation(np.asarray(body.axis), angles.get(body.name, 0.0))
        found[body.name] = (rotation @ own, place + rotation @ np.asarray(body.origin))
    return found


def _rotation(axis: Array, angle: float) -> Array:
    cross = np.cross(axis, np.eye(3)).T
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


def center_of_mass(bodies: list[Part]) -> tuple[Array, float]:
    """CoM (3,) [m] in the base's axes in the nominal posture, and the mass [kg]."""
    placed = placements(bodies)
    mass = sum(body.mass for body in bodies)
    moment = np.sum([b.mass * (placed[b.name][0] @ np.asarray(b.centre) + placed[b.name][1]) for b in bodies], axis=0)
    return moment / mass, mass


def urdf_text(base_inertia: float = 0.0) -> str:
    """The model as a URDF: every link with its inertia, its box, which makes contact, and what is drawn.

    Args:
        base_inertia: What is added to the moments of inertia of the pelvis [kg m^2], about all axes: the paper's set-up.
    """
    robot = ElementTree.Element("robot", name=NAME)
    for body in parts():
        link = ElementTree.SubElement(robot, "link", name=body.name)
        _inertial(link, body, 0.0 if body.parent else base_inertia)
        own = (body.size, body.centre)
        for role, (size, centre) in (("visual", DRAWN.get(_kind(body), own)), ("collision", own)):
            shape = ElementTree.SubElement(link, role)
            ElementTree.SubElement(shape, "origin", xyz=_text(centre), rpy="0 0 0")
            ElementTree.SubElement(ElementTree.SubElement(shape, "geometry"), "box", size=_text(size))
        if body.parent:
            joint = ElementTree.SubElement(robot, "joint", name=body.name, type="revolute")
            ElementTree.SubElement(joint, "parent", link=body.parent)
            ElementTree.SubElement(joint, "child", link=body.name)
            ElementTree.SubElement(joint, "origin", xyz=_text(body.origin), rpy="0 0 0")
            ElementTree.SubElement(joint, "axis", xyz=_text(body.axis))
            ElementTree.SubElement(joint, "limit", _limit(body))
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def _inertial(link: ElementTree.Element, body: Part, added: float) -> None:
    out = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(out, "origin", xyz=_text(body.centre), rpy="0 0 0")
    ElementTree.SubElement(out, "mass", value=repr(body.mass))
    squares = np.square(body.size)
    moments = body.mass / 12.0 * (squares.sum() - squares) + added
    terms = {f"i{axis}{axis}": repr(float(value)) for axis, value in zip("xyz", moments, strict=True)}
    ElementTree.SubElement(out, "inertia", {**terms, "ixy": "0", "ixz": "0", "iyz": "0"})


def _limit(body: Part) -> dict[str, str]:
    low, high, torque, speed = LIMITS[_kind(body)]
    if body.name.startswith("right_") and body.axis != Y:
        low, high = -high, -low
    return {"lower": repr(low), "upper": repr(high), "effort": repr(torque), "velocity": repr(speed)}


def _kind(body: Part) -> str:
    """Name without the side."""
    return body.name.removeprefix("left_").removeprefix("right_")


def _text(vector: Vector) -> str:
    return " ".join(repr(float(value)) for value in vector)


def write_robot(folder: Path, base_inertia: float = 0.0) -> Robot:
    """Write the URDF and the robot's file beside it; the robot, whose numbers for planning are those of `humanoid44`.

    Args:
        folder: Where to; it exists.
        base_inertia: As of urdf_text; above 0 the files have another name.
    """
    from mcplan.files.robots import load_robot, save_robot

    name = f"{NAME}_held" if base_inertia else NAME
    write_whole(urdf_text(base_inertia), folder / f"{name}.urdf")
    robot = load_robot(PLANNED_FOR)
    robot.name, robot.urdf, robot.posture = name, f"{name}.urdf", posture()
    robot.description = "humanoid44 with joints: boxes of even density, 44 kg"
    ends = list(robot.end_effectors)
    for end in ends:
        side, _, kind = end.name.partition("_")
        end.frame = f"{side}_ankle_roll" if kind == "foot" else f"{side}_wrist_roll"
        end.frame_offset = [AHEAD, 0.0, -ANKLE_HEIGHT] if kind == "foot" else [0.0, 0.0, -HAND]
    robot.end_effectors = ends
    save_robot(robot, folder / f"{name}.toml", "Made by: mcplan reproduce tazaki")
    return load_robot(folder / f"{name}.toml")
