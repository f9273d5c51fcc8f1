"""Geometry that cannot be meant, found before anything is planned.

Scenes serve robots of any size, so what a scene says is compared with itself; lengths are compared with a robot's once there
is one. What no robot can do is refused, what may be meant after all is warned of.
"""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

from mcplan._core import PlanarRobot, Polygon, Robot, Scene, Stance, require_ground
from mcplan.errors import InvalidInput, InvalidScene, SuspiciousGeometry

#: Lengths above which they are taken to be millimetres: of a scene [m], of a robot's CoM [m], in CoM heights.
LONG_SCENE_M, HIGH_COM_M, LONG_OVER_COM = 1000.0, 50.0, 50.0
#: Above it a gravity [m/s^2] is taken to be in millimetres: there is none like it on any planet.
STRONG_GRAVITY = 100.0
#: Angles above it are taken to be degrees; durations, over the time sqrt(h / g) in which a pendulum as high as the CoM
#: falls, to be milliseconds; masses over the cube of a robot's size [kg/m^3], twice that of steel, to be grams.
LARGE_ANGLE, LONG_OVER_FALL, HEAVY_DENSITY = 2.0 * math.pi, 100.0, 16e3
_GRAVITY_RULE = "goes with lengths in metres, which these look like, and this looks like one for millimetres"
_WALKABLE = 0.5  # z of the normal of ground


def require_meant(scene: Scene, source: str) -> None:
    """Refuse a scene that no robot can use as it stands, and warn of what looks wrong.

    Args:
        scene: A valid one.
        source: Its file, for messages.

    Raises:
        InvalidScene: Start or goal hangs in the air, under its ground, or far beside all surfaces that it names.
    """
    try:
        require_ground(scene)
    except InvalidScene as found:
        raise found.moved(source=source) from None
    warn_of_geometry(scene, source)


def warn_of_geometry(scene: Scene, source: str) -> None:
    """Warn of what looks wrong in a scene that can be read.

    Args:
        scene: A valid one.
        source: Its file, for messages.
    """
    for field, stance in (("start", scene.start), ("goal", scene.goal)):
        _warn_of_ground_that_faces_down(scene, stance, field, source)
    size = scene_size(scene)
    if size > LONG_SCENE_M and scene.gravity <= STRONG_GRAVITY:
        _warn(source, "surfaces", "lengths are in metres, and these look like millimetres", f"a scene of {size:.4g} m")
    if size <= LONG_SCENE_M and scene.gravity > STRONG_GRAVITY:
        _warn(source, "gravity", _GRAVITY_RULE, f"{scene.gravity:g} m/s^2 in a scene of {size:.4g} m")


def require_robot_meant(robot: Robot, source: str) -> None:
    """Warn of numbers of a robot that look like millimetres, degrees, milliseconds or grams, or that no body has.

    Args:
        robot: A valid one.
        source: Its file, for messages.
    """
    rule = "lengths are in metres, and this looks like millimetres"
    if robot.com_height > HIGH_COM_M:
        _warn(source, "com_height", rule, f"{robot.com_height:g} m")
        return
    lengths = {"swing_height": [robot.swing_height]}
    for i, end in enumerate(robot.end_effectors):
        for name in ("half_size", "nominal_B", "reach_min_B", "reach_max_B", "frame_offset"):
            lengths[f"end_effectors[{i}].{name.removesuffix('_B')}"] = list(getattr(end, name))
    for field, values in lengths.items():
        longest = max(map(abs, values))
        if longest > LONG_OVER_COM * robot.com_height:
            _warn(source, field, rule, f"{longest:g} m beside a com_height of {robot.com_height:g} m")
    _warn_of_other_units(robot, source)


def _warn_of_other_units(robot: Robot, source: str) -> None:
    for i, end in enumerate(robot.end_effectors):
        if np.isfinite(end.yaw_range).all() and np.abs(end.yaw_range).max() > LARGE_ANGLE:
            rule = "angles are in radians, and these look like degrees"
            _warn(source, f"end_effectors[{i}].yaw_range", rule, _text(end.yaw_range))
    fall_s = math.sqrt(robot.com_height / 9.81)
    if robot.phase_duration[0] > LONG_OVER_FALL * fall_s:
        rule = "durations are in seconds, and these look like milliseconds"
        _warn(
            source, "phase_duration", rule, f"{_text(robot.phase_duration)} at a com_height of {robot.com_height:g} m"
        )
    places = np.array([[0.0, 0.0, 0.0], *(end.nominal_B for end in robot.end_effectors)])
    size = float(np.linalg.norm(np.ptp(places, axis=0)))
    if robot.mass > HEAVY_DENSITY * max(size, robot.com_height) ** 3:
        rule = "must be in kilograms, and this looks like grams"
        _warn(source, "mass", rule, f"{robot.mass:g} kg in a robot of {max(size, robot.com_height):.3g} m")
    moments = sorted(robot.inertia)
    if moments[2] > (1.0 + 1e-6) * (moments[0] + moments[1]):
        _warn(source, "inertia", "of a body, no moment is above the sum of the other two", _text(robot.inertia))


def require_planar_robot_meant(robot: PlanarRobot, source: str, prefix: str = "") -> None:
    """Warn of a gravity that goes with millimetres where the lengths of a planar robot are those of metres.

    Args:
        robot: A valid one.
        source: Its file, for messages.
        prefix: What stands before its fields there.
    """
    length = sum(float(np.linalg.norm(body.joint_P)) for body in robot.bodies)
    if robot.gravity > STRONG_GRAVITY and length <= HIGH_COM_M:
        _warn(
            source,
            f"{prefix}gravity",
            _GRAVITY_RULE,
            f"{robot.gravity:g} m/s^2 beside limbs of {length:.3g} m together",
        )


def scene_size(scene: Scene) -> float:
    """Length of the diagonal of the box around all surfaces [m]."""
    corners = np.concatenate([surface.vertices_W for surface in scene.surfaces])
    return float(np.linalg.norm(corners.max(axis=0) - corners.min(axis=0)))


def _warn_of_ground_that_faces_down(scene: Scene, stance: Stance, field: str, source: str) -> None:
    for who, name in stance.contacts.items():
        index = scene.surface_index(name)
        surface = scene.surfaces[index]
        polygon = Polygon(surface.vertices_W)
        above = stance.position_W[2] >= polygon.nearest(stance.position_W)[2] - 1e-3
        if polygon.normal_W[2] < -_WALKABLE and above and not surface.grasp:
            rule = f"faces down, and {who} stands on it at the {field}: corners run counter-clockwise seen from above"
            _warn(source, f"surfaces[{index}].vertices", rule, f"normal {_text(polygon.normal_W)}")


def _text(values: Any) -> str:
    return "[" + ", ".join(f"{value:.4g}" for value in values) + "]"


def _warn(source: str, field: str, rule: str, value: str) -> None:
    finding = InvalidInput(field, rule, value, source)
    warnings.warn(str(finding), SuspiciousGeometry, stacklevel=2)
