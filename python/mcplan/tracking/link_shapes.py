"""Convex shapes of a robot's links for contact, from the collision shapes of its URDF.

Each collision shape becomes the convex hull of its points. Of a link that carries a foot, what lies near to the ground on
which the foot stands is cut off: there the sole's own box, or the ball of a point foot, makes contact. A hand makes contact
with the terrain by its ball alone: its link is left out there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import package_folders, read_xml

if TYPE_CHECKING:
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Points of a circle of round shapes; directions in which the outermost points of a shape make its hull.
CIRCLE_POINTS, DIRECTIONS = 12, 64
#: Shapes of a foot's link begin so high above the ground on which it stands [m]: twice the height of what makes contact.
ABOVE_SOLE_M, ABOVE_POINT_M = 0.02, 0.04


@dataclass(frozen=True)
class LinkShape:
    """A convex shape that is fixed to a link.

    Attributes:
        joint: Index of the joint that carries it, in Pinocchio's model; 1: the base.
        link: Name of the URDF's link.
        on_terrain: Whether it makes contact with the terrain.
        points: (n, 3) whose convex hull it is, in the joint's axes [m].
    """

    joint: int
    link: str
    on_terrain: bool
    points: Array


def link_shapes(urdf_model: UrdfModel) -> list[LinkShape]:
    """The convex shapes of a robot's links; none where the URDF has no collision shapes or they cannot be read."""
    model, robot, found = urdf_model.model, urdf_model.robot, []
    hands = {
        int(model.frames[frame].parentJoint)
        for end, frame in zip(robot.end_effectors, urdf_model.frames, strict=True)
        if end.kind != "foot"
    }
    for item in _collision_geometry(urdf_model):
        corners = _corners(item.geometry)
        if corners is None:
            continue
        joint = int(item.parentJoint)
        points = _outermost(corners @ item.placement.rotation.T + item.placement.translation)
        hull = _hull(points)
        for height_m, placement in _cuts(urdf_model, joint):
            hull = None if hull is None else _above(hull, placement, height_m)
        if hull is not None:
            found.append(LinkShape(joint, model.frames[item.parentFrame].name, joint not in hands, hull[0]))
    return found


def _collision_geometry(urdf_model: UrdfModel) -> Any:
    import pinocchio as pin  # type: ignore[import-untyped]

    path = urdf_model.path
    kind, folders = pin.GeometryType.COLLISION, package_folders(path)
    try:
        text = read_xml(path, InvalidRobot, "urdf", urdf_model.robot.name).text
        return pin.buildGeomFromUrdfString(urdf_model.model, text, kind, None, folders).geometryObjects
    except (ValueError, RuntimeError):  # a mesh is missing or of a kind that is not read
        return ()


def _corners(geometry: Any) -> Array | None:
    """(n, 3) points of a shape of coal, in its own axes; None: of a kind that has none."""
    kind = type(geometry).__name__
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    angles = 2.0 * np.pi * np.arange(CIRCLE_POINTS) / CIRCLE_POINTS
    circle = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(CIRCLE_POINTS)])
    up = np.array([0.0, 0.0, 1.0])
    ball = np.vstack([np.cos(a) * circle + np.sin(a) * up for a in np.pi / 8 * np.arange(-4, 5)])
    if hasattr(geometry, "vertices"):
        return np.asarray(geometry.vertices(), float) if callable(geometry.vertices) else None
    if kind == "Box":
        return signs * np.asarray(geometry.halfSide)
    if kind == "Sphere":
        return geometry.radius * ball
    if kind == "Ellipsoid":
        return np.asarray(geometry.radii) * ball
    if kind == "Cylinder":
        return np.vstack([geometry.radius * circle + side * geometry.halfLength * up for side in (-1, 1)])
    if kind == "Capsule":
        return np.vstack([geometry.radius * ball + side * geometry.halfLength * up for side in (-1, 1)])
    if kind == "Cone":
        return np.vstack([geometry.radius * circle - geometry.halfLength * up, geometry.halfLength * up])
    return None


def _outermost(points: Array) -> Array:
    """The points (n, 3) that lie outermost in one of many directions: a hull of some dozens of corners inside that of all."""
    turn = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(DIRECTIONS)
    height = 1.0 - 2.0 * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
    across = np.sqrt(1.0 - height**2)
    directions = np.vstack(
        [np.column_stack([across * np.cos(turn), across * np.sin(turn), height]), np.eye(3), -np.eye(3)]
    )
    return points[np.unique(np.argmax(points @ directions.T, axis=0))]


def _cuts(urdf_model: UrdfModel, joint: int) -> list[tuple[float, Any]]:
    """Height above which the shapes of a joint's links count, and the contact frame in which it is one, of each foot."""
    model, cuts = urdf_model.model, []
    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        if end.kind == "foot" and int(model.frames[frame].parentJoint) == joint:
            height = ABOVE_SOLE_M if np.asarray(end.half_size).all() else ABOVE_POINT_M
            cuts.append((height, model.frames[frame].placement))
    return cuts


def _hull(points: Array) -> tuple[Array, NDArray[np.int64]] | None:
    """Corners (n, 3) and triangles of the convex hull; None: the points lie in a plane, on a line, or are not finite."""
    from scipy.spatial import ConvexHull, QhullError

    if len(points) < 4 or not np.isfinite(points).all():
        return None
    try:
        hull = ConvexHull(points)
    except QhullError:
        return None
    number = np.full(len(points), -1)
    number[hull.vertices] = np.arange(len(hull.vertices))
    return points[hull.vertices], number[hull.simplices]


def _above(
    hull: tuple[Array, NDArray[np.int64]], placement: Any, height_m: float
) -> tuple[Array, NDArray[np.int64]] | None:
    """The part of a hull that lies above a height in a frame; None: there is none."""
    points, triangles = hull
    above = (points - placement.translation) @ placement.rotation[:, 2] - height_m
    edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    crossing = edges[above[edges[:, 0]] * above[edges[:, 1]] < 0.0]
    start, end = above[crossing[:, 0], None], above[crossing[:, 1], None]
    cut = points[crossing[:, 0]] + start / (start - end) * (points[crossing[:, 1]] - points[crossing[:, 0]])
    return _hull(np.vstack([points[above >= 0.0], cut]))
