"""The trunk of a robot from its URDF: capsules about as large as what turns with the base, and across its shoulders.

What carries two end-effectors or more, or hangs from it without an end-effector of its own, is the trunk: torso and head.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import TrunkPart
from mcplan.files.urdf_shapes import corners_of, visuals_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from mcplan.files.urdf_setups import End

Array = NDArray[np.float64]

SLICES = 12  # across the longer side of the trunk
#: Quantile of the half sizes of slices that is the radius. Chosen: most of the trunk, and all of heads and necks.
THICK = 0.75
#: Joint of an arm, counted from the trunk, at whose axis the shoulder is: those of roll and yaw meet there.
SHOULDER = 1


def trunk_of(
    model: Any, posture: Array, ends: Sequence[End], own_joints: Mapping[str, Sequence[int]], source: str
) -> list[TrunkPart]:
    """Capsules of a trunk, positions relative to the CoM in the nominal posture.

    Args:
        model: Pinocchio model with a free base.
        posture: (nq,) nominal configuration.
        ends: End-effectors.
        own_joints: Of each, the joints that carry no other one, from the trunk on.
        source: What the model was read from: a name of example-robot-data, or a URDF file.

    Returns:
        Spine and shoulders; empty where the trunk has no shapes, or meshes that cannot be read.
    """
    import pinocchio as pin

    geometry = visuals_of(model, source)
    if geometry is None:
        return []
    data, placed = model.createData(), geometry.createData()
    pin.forwardKinematics(model, data, posture)
    com = pin.centerOfMass(model, data, posture).copy()
    pin.updateGeometryPlacements(model, data, geometry, placed)
    limbs = {joint for joints in own_joints.values() for joint in joints}

    def points(carried: Any) -> Array:
        shapes = [i for i, item in enumerate(geometry.geometryObjects) if carried(item.parentJoint)]
        return np.vstack(
            [np.empty((0, 3)), *(corners_of(geometry.geometryObjects[i], placed.oMg[i]) - com for i in shapes)]
        )

    trunk = points(lambda joint: joint > 0 and limbs.isdisjoint(model.supports[joint]))
    if not len(trunk):
        return []
    return [_spine(trunk), *_shoulders(ends, own_joints, lambda joint: data.oMi[joint].translation - com, points)]


def _spine(points: Array) -> TrunkPart:
    """A capsule along the longer of the upright and the level side: as thick as most slices across it, the thinner way."""
    low, high = points.min(axis=0), points.max(axis=0)
    along = 2 if high[2] - low[2] > high[0] - low[0] else 0
    edges = np.linspace(low[along], high[along], SLICES + 1)
    middles, centres, halves = [], [], []
    for left, right in zip(edges[:-1], edges[1:], strict=True):
        inside = points[(points[:, along] >= left) & (points[:, along] <= right)]
        if len(inside) < 3:
            continue
        middles.append(0.5 * (left + right))
        centres.append(0.5 * (inside.min(axis=0) + inside.max(axis=0)))
        halves.append(np.delete(0.5 * (inside.max(axis=0) - inside.min(axis=0)), along).min())
    length = float(high[along] - low[along])
    radius = min(float(np.quantile(halves, THICK)) if halves else 0.5 * length, 0.5 * length)
    ends = np.clip([low[along] + radius, high[along] - radius], low[along], high[along])
    line = np.empty((2, 3))
    for axis in range(3):
        if axis == along or not middles:
            line[:, axis] = ends if axis == along else 0.5 * (low[axis] + high[axis])
        else:
            line[:, axis] = np.polyval(np.polyfit(middles, np.array(centres)[:, axis], 1), ends)
    line[:, 1] = 0.0 if abs(line[:, 1]).max() < 0.1 * radius else line[:, 1]
    return _part(line[0], line[1], radius)


def _shoulders(
    ends: Sequence[End], own_joints: Mapping[str, Sequence[int]], place: Any, points: Any
) -> list[TrunkPart]:
    """A capsule from each right shoulder to the left one, for hands that are twins."""
    parts: list[TrunkPart] = []
    done: set[str] = set()
    for end in ends:
        if end.kind == "foot" or end.twin not in own_joints or end.name in done:
            continue
        done |= {end.name, end.twin}
        sides = [own_joints[end.name], own_joints[end.twin]]
        if min(map(len, sides)) <= SHOULDER:
            continue
        right, left = sorted((place(joints[SHOULDER]) for joints in sides), key=lambda at: float(at[1]))
        upper = points(lambda joint, first=sides: any(joint in joints[: SHOULDER + 1] for joints in first))
        if not len(upper) or not left[1] > right[1]:
            continue
        radius = min(float(upper[:, 1].max() - left[1]), float(right[1] - upper[:, 1].min()))
        if radius > 0.0:
            parts.append(_part(right, left, radius))
    return parts


def _part(start: Array, end: Array, radius: float) -> TrunkPart:
    part = TrunkPart()
    part.from_B, part.to_B, part.radius = start.round(3) + 0.0, end.round(3) + 0.0, float(np.floor(radius * 1e3) / 1e3)
    return part
