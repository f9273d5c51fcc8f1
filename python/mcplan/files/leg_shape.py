"""How thick legs are, from a URDF: the capsules of ``LimbLimits`` about thigh and shank."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.files.urdf_shapes import corners_of, visuals_of

if TYPE_CHECKING:
    from mcplan._core import Robot
    from mcplan.files.leg_geometry import Leg, LegModel

Array = NDArray[np.float64]

SLICES = 12  # along thigh and shank, each
#: Quantiles of the slices' half lengths, from back to front, that is the radius, and of what they reach outward, where
#: motors are. Chosen: the rest are edges of covers.
THICK, OUTWARD = 0.75, 0.9


def add_leg_shapes(robot: Robot, urdf: LegModel, source: str) -> None:
    """Set `radius` and `beside` of the legs of a robot that has their joint limits; twins alike. Without shapes: none.

    Args:
        robot: Made from the same URDF.
        urdf: Its legs.
        source: What the model was read from: a name of example-robot-data, or a URDF file.
    """
    import pinocchio as pin

    geometry = visuals_of(urdf.model, source)
    if geometry is None:
        return
    data, placed = urdf.model.createData(), geometry.createData()
    pin.forwardKinematics(urdf.model, data, urdf.nominal)
    pin.updateGeometryPlacements(urdf.model, data, geometry, placed)
    pin.updateFramePlacements(urdf.model, data)
    found: dict[str, tuple[float, float]] = {}
    for name, leg in urdf.legs.items():
        items = [(item, placed.oMg[i]) for i, item in enumerate(geometry.geometryObjects)]
        points = {
            joint: [corners_of(item, place) for item, place in items if item.parentJoint == joint]
            for joint in (leg.own[leg.own.index(leg.joints[0]) - 1], leg.joints[0])
        }
        if all(points.values()):
            found[name] = _thickness(leg, data, *(np.vstack(part) for part in points.values()))
    if set(found) != set(urdf.legs):
        return
    radius = min(radius for radius, _ in found.values())
    outward = min(outward for _, outward in found.values())
    listed = list(robot.end_effectors)
    for end in listed:
        if end.name not in found or not end.limb.given:
            continue
        limb = end.limb
        most = 0.5 * (limb.upper + limb.lower)  # that a robot may have: skirts are wider
        limb.radius = float(np.floor(min(radius, most) * 1e3) / 1e3)
        aside = np.floor(np.clip(outward - radius, 0.0, most) * 1e3) / 1e3
        limb.beside = float(np.sign(limb.hip_B[1]) * aside) + 0.0
        end.limb = limb
    robot.end_effectors = listed


def _thickness(leg: Leg, data: Any, thigh: Array, shank: Array) -> tuple[float, float]:
    """Radius of a leg, and how far it reaches outward from its joints [m]."""
    knee = data.oMi[leg.joints[0]].translation
    ankle = data.oMf[leg.frame].translation + leg.ankle
    left = np.array([0.0, 1.0, 0.0])
    outward = left * np.sign(leg.hip[1])
    halves, reaches = [], []
    for start, end, points in ((leg.hip, knee, thigh), (knee, 0.5 * (knee + ankle), shank)):
        along = (end - start) / np.linalg.norm(end - start)
        ahead = np.cross(along, left)
        share = (points - start) @ along / np.linalg.norm(end - start)
        for low in np.arange(SLICES) / SLICES:
            inside = points[(share >= low) & (share <= low + 1.0 / SLICES)] - start
            if len(inside) < 3:
                continue
            halves.append(0.5 * float(np.ptp(inside @ ahead)))
            reaches.append(float((inside @ outward).max()))
    if not halves:
        return 0.0, 0.0
    return float(np.quantile(halves, THICK)), float(np.quantile(reaches, OUTWARD))
