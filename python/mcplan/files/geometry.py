"""Geometry that cannot be meant, found before anything is planned.

Scenes serve robots of any size, so what a scene says is compared with itself; lengths are compared with a robot's once there
is one. What no robot can do is refused, what may be meant after all is warned of.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from mcplan._core import PlanarRobot, Polygon, Robot, Scene, Stance, require_ground
from mcplan.errors import InvalidInput, InvalidScene, SuspiciousGeometry

#: Lengths above which they are taken to be millimetres: of a scene [m], of a robot's CoM [m], in CoM heights.
LONG_SCENE_M, HIGH_COM_M, LONG_OVER_COM = 1000.0, 50.0, 50.0
#: Above it a gravity [m/s^2] is taken to be in millimetres: there is none like it on any planet.
STRONG_GRAVITY = 100.0
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
    """Warn of lengths of a robot that look like millimetres.

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
