"""A stick robot for robots without a URDF: torso, head, and limbs with one bending joint each.

Two feet make a humanoid (further end-effectors become its arms), any other number a trunk with legs. Limb
roots are guesses from the robot's nominal stance. Links are as long as the plan asks for, and rigid.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import pose
from mcplan.kinematics.samples import Samples

from .colours import BODY, HEAD, LIMB, VISOR, mix
from .figure import Figure, Part
from .shapes import Mesh, capsule, ellipsoid, rounded_stack
from .stage import node

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]

#: [m] CoM height of the figure that the proportions below are written for.
REFERENCE_HEIGHT = 0.7


@dataclass(frozen=True)
class Limb:
    """Where a limb begins and how it bends."""

    root_B: Array  # (3,) [m] hip or shoulder
    bend_B: Array  # (3,) direction in which the middle joint moves out
    thickness: tuple[float, float, float]  # [m] radius at root, middle joint and end
    end_offset: float  # [m] of the last joint above the contact point, along the sole normal
    is_arm: bool


def stick_robot(samples: Samples, robot: Robot, colours: list[str]) -> Figure:
    """Draw a robot as a stick figure.

    Args:
        samples: The plan, sampled.
        robot: Its end-effectors give the limbs.
        colours: One per end-effector, for feet and hands.
    """
    scale = float(robot.com_height) / REFERENCE_HEIGHT
    humanoid = is_humanoid(robot)
    limbs = limbs_of(robot)
    base = pose(samples.rotation_WB, samples.com_W)
    parts = _humanoid_trunk(scale, base) if humanoid else _trunk(robot, scale, base)
    joints: list[tuple[Array, ...]] = []
    for end, (limb, colour) in enumerate(zip(limbs, colours, strict=True)):
        name = node(robot.end_effectors[end].name)  # a slash would part a limb from the rest of it
        points = limb_joints(samples, end, limb)
        joints.append(points)
        bend = samples.rotation_WB @ limb.bend_B
        radii = limb.thickness
        shades = (LIMB, mix(LIMB, colour, 0.35))
        for i, link in enumerate(("upper", "lower")):
            length = float(np.linalg.norm(points[i + 1][0] - points[i][0]))
            poses = _along(points[i], points[i + 1], bend)
            parts.append(Part(f"{name}_{link}", capsule(length, radii[i], radii[i + 1]), shades[i], poses))
        half_size = np.asarray(robot.end_effectors[end].half_size, float)
        tip = _hand(limb, scale) if limb.is_arm else _foot(half_size, limb, scale, humanoid)
        parts.append(Part(f"{name}_tip", tip, colour, pose(samples.rotations_W[:, end], samples.positions_W[:, end])))
    return Figure("stick", parts, joints)


def is_humanoid(robot: Robot) -> bool:
    """Whether the robot is a biped."""
    return sum(e.kind == "foot" for e in robot.end_effectors) == 2


def limbs_of(robot: Robot) -> list[Limb]:
    """One limb per end-effector."""
    scale = float(robot.com_height) / REFERENCE_HEIGHT
    humanoid = is_humanoid(robot)
    limbs = []
    for end in robot.end_effectors:
        nominal = np.asarray(end.nominal_B, float)
        side = 1.0 if nominal[1] > 0.0 else -1.0
        if humanoid and end.kind == "foot":
            root = np.array([0.0, 0.85 * nominal[1], -0.07 * scale])
            limbs.append(
                Limb(
                    root,
                    np.array([1.0, 0.06 * side, 0.0]),
                    _scaled(scale, 0.055, 0.042, 0.032),
                    0.065 * scale,
                    False,
                )
            )
        elif humanoid:
            root = np.array([0.0, side * 0.165 * scale, 0.37 * scale])
            bend = np.array([-1.0, 0.55 * side, -0.15])
            limbs.append(Limb(root, bend, _scaled(scale, 0.038, 0.030, 0.024), 0.036 * scale, True))
        else:
            root = np.array([0.85 * nominal[0], 0.7 * nominal[1], 0.0])
            forward = 1.0 if nominal[0] <= 0.0 else -1.0
            limbs.append(
                Limb(
                    root,
                    np.array([forward, 0.0, 0.0]),
                    _scaled(scale, 0.040, 0.030, 0.022),
                    0.022 * scale,
                    False,
                )
            )
    return limbs


def limb_joints(samples: Samples, end: int, limb: Limb) -> tuple[Array, Array, Array]:
    """Root, middle joint and end of a limb over the samples, each (n, 3) [m]; both links are rigid."""
    root = samples.com_W + samples.rotation_WB @ limb.root_B
    last = samples.positions_W[:, end] + limb.end_offset * samples.rotations_W[:, end, :, 2]
    distance = np.linalg.norm(last - root, axis=1)
    link = 0.5 * max(1.004 * float(distance.max()), 1.03 * float(np.median(distance)))
    along = (last - root) / distance[:, None]
    bend = samples.rotation_WB @ limb.bend_B
    out = bend - along * np.sum(along * bend, axis=1, keepdims=True)
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
    rise = np.sqrt(np.maximum(link**2 - 0.25 * distance**2, 0.0))
    return root, 0.5 * (root + last) + rise[:, None] * out, last


def _along(start: Array, end: Array, hint: Array) -> Array:
    """Poses (n, 4, 4) with z from start to end and x towards the hint."""
    z = end - start
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    x = hint - z * np.sum(z * hint, axis=1, keepdims=True)
    x /= np.maximum(np.linalg.norm(x, axis=1, keepdims=True), 1e-9)
    return pose(np.stack([x, np.cross(z, x), z], axis=-1), start)


def _scaled(scale: float, *lengths: float) -> tuple[float, float, float]:
    a, b, c = (scale * length for length in lengths)
    return a, b, c


def _humanoid_trunk(scale: float, base: Array) -> list[Part]:
    # (height, half depth, half width, shift forward) from the crotch to the neck, CoM at 0.
    torso = [
        (-0.130, 0.030, 0.040, 0.000),
        (-0.115, 0.060, 0.095, 0.000),
        (-0.050, 0.075, 0.125, 0.000),
        (0.020, 0.068, 0.105, 0.000),
        (0.100, 0.066, 0.100, 0.004),
        (0.200, 0.082, 0.125, 0.008),
        (0.300, 0.088, 0.145, 0.006),
        (0.370, 0.074, 0.150, 0.000),
        (0.410, 0.052, 0.110, 0.000),
        (0.430, 0.030, 0.050, 0.000),
    ]
    mesh = rounded_stack([(z * scale, x * scale, y * scale, shift * scale) for z, x, y, shift in torso], refine=4)
    neck = capsule(0.07 * scale, 0.035 * scale, 0.032 * scale).moved(_shift(0.0, 0.0, 0.42 * scale))
    head = ellipsoid((0.078 * scale, 0.066 * scale, 0.096 * scale)).moved(_shift(0.012 * scale, 0.0, 0.575 * scale))
    visor = ellipsoid((0.040 * scale, 0.054 * scale, 0.024 * scale)).moved(_shift(0.058 * scale, 0.0, 0.592 * scale))
    meshes = {"torso": (mesh, BODY), "neck": (neck, LIMB), "head": (head, HEAD), "visor": (visor, VISOR)}
    return [Part(f"base/{name}", shape, colour, base) for name, (shape, colour) in meshes.items()]


def _trunk(robot: Robot, scale: float, base: Array) -> list[Part]:
    roots = np.array([limb.root_B for limb in limbs_of(robot)])
    half = np.maximum(np.abs(roots).max(axis=0), 0.06 * scale)
    levels = [
        (x * half[0], z * scale, y * half[1], 0.0)
        for x, z, y in (
            (-1.22, 0.02, 0.4),
            (-1.18, 0.05, 0.75),
            (-0.9, 0.068, 0.85),
            (0.9, 0.068, 0.85),
            (1.16, 0.055, 0.7),
            (1.24, 0.02, 0.35),
        )
    ]
    lying = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])  # the stack's z becomes the trunk's x
    trunk = rounded_stack(levels).moved(pose(lying, np.array([0.0, 0.0, 0.02 * scale])))
    head = ellipsoid((0.05 * scale, 0.05 * scale, 0.03 * scale)).moved(_shift(1.22 * half[0], 0.0, 0.03 * scale))
    return [Part("base/torso", trunk, BODY, base), Part("base/head", head, VISOR, base)]


def _foot(half_size: Array, limb: Limb, scale: float, humanoid: bool) -> Mesh:
    if not humanoid:
        return ellipsoid((limb.end_offset,) * 3).moved(_shift(0.0, 0.0, limb.end_offset))
    if not half_size.all():  # a point contact: a foot of usual size reads better than a dot
        half_size = scale * np.array([0.09, 0.04])
    x, y = float(half_size[0]), float(half_size[1])
    ankle = limb.end_offset
    return rounded_stack(
        [
            (0.0, x, y, 0.0),
            (0.25 * ankle, x, y, 0.0),
            (0.5 * ankle, 0.85 * x, 0.9 * y, -0.08 * x),
            (ankle, 0.42 * x, 0.62 * y, -0.1 * x),
        ]
    )


def _hand(limb: Limb, scale: float) -> Mesh:
    return ellipsoid((0.042 * scale, 0.034 * scale, 0.042 * scale)).moved(_shift(0.0, 0.0, limb.end_offset))


def _shift(x: float, y: float, z: float) -> Array:
    return pose(np.eye(3), np.array([x, y, z]))
