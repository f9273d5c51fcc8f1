"""Geometry that cannot be meant, found before anything is planned.

Scenes serve robots of any size, so what a scene says is compared with itself; lengths are compared with a robot's once there
is one. What no robot can do is refused, what may be meant after all is warned of. Both are found by C++ (scene_files.hpp).
"""

from __future__ import annotations

import warnings

from mcplan._core import PlanarRobot, Robot, Scene, require_ground, suspicious_geometry
from mcplan.errors import InvalidInput, InvalidScene, SuspiciousGeometry


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


def warn_of_geometry(model: Scene | Robot | PlanarRobot, source: str, prefix: str = "") -> None:
    """Warn of numbers that look like other units, of ground that faces down, and of an inertia that no body has.

    Args:
        model: A valid one.
        source: Its file, for messages.
        prefix: What stands before its fields there.
    """
    for field, rule, value in suspicious_geometry(model):
        warnings.warn(str(InvalidInput(prefix + field, rule, value, source)), SuspiciousGeometry, stacklevel=2)
