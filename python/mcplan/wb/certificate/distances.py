"""Distances between the links of a robot, on the meshes of its URDF.

A pair that is d apart can be nearer than d' no sooner than its links have moved by d - d' against each other. So a distance
is worked out at some instants only, and the least of all is known at each of them. That of the convex hulls is a lower bound,
and found a hundred times faster than that of meshes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import package_folders, read_xml

from .result import MotionViolation
from .robot import CertifiedRobot, configurations
from .states import States
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: Links that are nearer in the robot's own posture do not count [m].
NEAR_M = 0.005
#: How exactly the least distance is told where it keeps its limit [m].
RESOLUTION_M = 5e-4
#: Every so many instants hulls are compared before meshes are.
COARSE = 40
#: By so much the distance of convex shapes, which is found by iterations, may be too large [m].
HULL_M = 1e-5


@dataclass(frozen=True)
class Shape:
    """A collision shape of a link.

    Attributes:
        link: Name of the link.
        joint: Index of the joint that carries it.
        body: The nearest joint towards the base that moves: shapes with the same one are rigid with each other.
        geometry: As coal has it.
        hull: Convex hull of a mesh; of other shapes the shape itself.
        placement: In the joint's axes, pinocchio.SE3.
        center, radius: Ball that contains it, in the joint's axes [m].
    """

    link: str
    joint: int
    body: int
    geometry: Any
    hull: Any
    placement: Any
    center: Array
    radius: float


@dataclass(frozen=True)
class Posture:
    """A posture as far as distances ask for it, at a single instant; see States."""

    joint_rotations_W: Array
    joint_positions_W: Array


def self_distance(robot: CertifiedRobot, states: States, tolerances: MotionTolerances) -> MotionViolation:
    """The least distance of two links that count; infinite where the URDF has no collision shapes."""
    least = MotionViolation("self_distance", np.inf, tolerances.self_distance_m, "m", at_least=True)
    shapes, pairs = counted(robot)
    centers = [_centers(states, shape) for shape in shapes]
    gaps = [np.linalg.norm(centers[a] - centers[b], axis=1) - shapes[a].radius - shapes[b].radius for a, b in pairs]
    for index in np.argsort([gap.min() for gap in gaps], kind="stable"):
        first, second = (shapes[i] for i in pairs[index])
        least = _least_of(states, (first, second), gaps[index], least)
    return least


def distance_curve(robot: CertifiedRobot, states: States, at: NDArray[np.int64]) -> tuple[Array, list[str]]:
    """Distance of the nearest two links that count at some of the instants [m], and their names.

    Of each pair a lower bound is known: its last distance less what it has moved since, or that of its balls. Pairs are
    worked out in the order of their bounds until none is below the least.
    """
    shapes, pairs = counted(robot)
    if not pairs:
        return np.full(len(at), np.inf), [""] * len(at)
    centers = np.array([_centers(states, shape) for shape in shapes])[:, at]
    first, second = np.array(pairs).T
    radii = np.array([shape.radius for shape in shapes])
    balls = np.linalg.norm(centers[first] - centers[second], axis=2) - (radii[first] + radii[second])[:, None]
    bounds, last = np.full(len(pairs), -np.inf), np.full(len(pairs), -1)
    travels: dict[int, Array] = {}
    least, names = np.full(len(at), np.inf), [""] * len(at)
    for n, k in enumerate(at.tolist()):
        lower = balls[:, n].copy()
        for pair, travel in travels.items():
            lower[pair] = max(lower[pair], bounds[pair] - (travel[k] - travel[last[pair]]))
        for pair in np.argsort(lower, kind="stable").tolist():
            if lower[pair] >= least[n]:
                break
            both = (shapes[first[pair]], shapes[second[pair]])
            if pair not in travels:
                travels[pair] = _travel(states, both)
            bounds[pair], last[pair] = distance(states, both, k, hulls=True), k
            if bounds[pair] < least[n]:
                bounds[pair] = distance(states, both, k)
            if bounds[pair] < least[n]:
                least[n], names[n] = bounds[pair], f"{both[0].link} and {both[1].link}"
    return least, names


def _least_of(states: States, pair: tuple[Shape, Shape], gaps: Array, least: MotionViolation) -> MotionViolation:
    """The least distance so far, or that of a pair at some instant."""
    if gaps.min() >= _target(least):
        return least
    travel, k, count = _travel(states, pair), 0, len(gaps)
    guess = _nearest_by_hulls(states, pair, gaps, _target(least))
    if guess is not None:
        least = _nearer(states, pair, guess, distance(states, pair, guess), least)
    target = _target(least)
    while k < count:
        if gaps[k] >= target:
            near = np.flatnonzero(gaps[k:] < target)
            if not near.size:
                break
            k += int(near[0])
        value = distance(states, pair, k, hulls=True)
        if value < target:
            value = distance(states, pair, k)
            least = _nearer(states, pair, k, value, least)
            target = _target(least)
        k = max(k + 1, int(np.searchsorted(travel, travel[k] + value - target, side="right")))
    return least


def _nearest_by_hulls(states: States, pair: tuple[Shape, Shape], gaps: Array, target: float) -> int | None:
    """The instant, of every COARSE-th, at which hulls are nearest; None: nowhere below the target.

    Begun there, the least distance is known early, and little is left that has to be known better.
    """
    at = np.arange(0, len(gaps), COARSE)
    at = at[gaps[at] < target]
    values = np.array([distance(states, pair, k, hulls=True) for k in at.tolist()])
    return int(at[values.argmin()]) if (values < target).any() else None


def _nearer(states: States, pair: tuple[Shape, Shape], k: int, value: float, least: MotionViolation) -> MotionViolation:
    """The least distance so far, or this one at an instant."""
    if not value < least.value:
        return least
    return replace(least, value=value, time_s=float(states.times[k]), links=(pair[0].link, pair[1].link))


def _target(least: MotionViolation) -> float:
    """Distances above this need not be known."""
    below = least.value - RESOLUTION_M
    return max(below, least.limit) if least.value > least.limit else below


def distance(states: States | Posture, pair: tuple[Shape, Shape], k: int, hulls: bool = False) -> float:
    """Distance of two shapes at an instant [m]; 0 or below where they overlap.

    Args:
        states: Where the links are.
        pair: The shapes.
        k: The instant.
        hulls: A lower bound instead, by the convex hulls.
    """
    import coal  # type: ignore[import-untyped]

    places = []
    for shape in pair:
        rotation, position = states.joint_rotations_W[k, shape.joint], states.joint_positions_W[k, shape.joint]
        place = shape.placement
        places.append(coal.Transform3s(rotation @ place.rotation, position + rotation @ place.translation))
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    first, second = (shape.hull if hulls else shape.geometry for shape in pair)
    found = float(coal.distance(first, places[0], second, places[1], request, result))
    return found - HULL_M if hulls else found


def _centers(states: States | Posture, shape: Shape) -> Array:
    return np.asarray(
        states.joint_positions_W[:, shape.joint] + states.joint_rotations_W[:, shape.joint] @ shape.center
    )


def _ball_gaps(states: States | Posture, first: Shape, second: Shape) -> Array:
    """(N,) distances of the balls of two shapes: lower bounds of those of the shapes."""
    apart = np.linalg.norm(_centers(states, first) - _centers(states, second), axis=1)
    return np.asarray(apart - first.radius - second.radius)


def _travel(states: States, pair: tuple[Shape, Shape]) -> Array:
    """(N,) how far points of the second shape have moved at most, seen from the first: displacement of its ball's
    center and the angle times the radius, added up."""
    first, second = pair
    frame, origin = states.joint_rotations_W[:, first.joint], states.joint_positions_W[:, first.joint]
    center = np.einsum("kji,kj->ki", frame, _centers(states, second) - origin)
    relative = np.einsum("kji,kjl->kil", frame, states.joint_rotations_W[:, second.joint])
    shifts = np.linalg.norm(np.diff(center, axis=0), axis=1)
    chords = np.linalg.norm(np.diff(relative, axis=0), axis=(1, 2)) / np.sqrt(2.0)
    return np.concatenate([[0.0], np.cumsum(shifts + second.radius * chords)])


@lru_cache(maxsize=8)
def counted(robot: CertifiedRobot) -> tuple[list[Shape], list[tuple[int, int]]]:
    """The collision shapes of a robot, and the pairs of them whose distance counts.

    Left out are shapes of one link or of links rigid with each other, of links that share a joint, and those that are
    nearer than NEAR_M in the robot's posture.
    """
    shapes = shapes_of(robot)
    neutral = _neutral(robot)
    parents = _bodies(robot)
    found = []
    for i, first in enumerate(shapes):
        for j in range(i + 1, len(shapes)):
            second = shapes[j]
            if first.body == second.body or first.body == parents[second.body] or second.body == parents[first.body]:
                continue
            if _ball_gaps(neutral, first, second)[0] < NEAR_M and distance(neutral, (first, second), 0) < NEAR_M:
                continue
            found.append((i, j))
    return shapes, found


def _bodies(robot: CertifiedRobot) -> dict[int, int]:
    """For each joint that moves, and the base (1), the next one towards the base that does."""
    moving = {1, *_moving_joints(robot)}
    parents = {1: 0}
    for joint in moving - {1}:
        parents[joint] = _body_of(robot, int(robot.model.parents[joint]), moving)
    return parents


def _moving_joints(robot: CertifiedRobot) -> set[int]:
    return {int(robot.model.getJointId(name)) for name in robot.names}


def _body_of(robot: CertifiedRobot, joint: int, moving: set[int]) -> int:
    while joint not in moving:
        joint = int(robot.model.parents[joint])
    return joint


def _neutral(robot: CertifiedRobot) -> Posture:
    """The robot's posture."""
    import pinocchio as pin  # type: ignore[import-untyped]

    model, data = robot.model, robot.model.createData()
    posture = robot.urdf_model.neutral
    angles = []
    for name in robot.names:
        joint = model.joints[model.getJointId(name)]
        own = posture[joint.idx_q : joint.idx_q + joint.nq]
        angles.append(own[0] if joint.nq == 1 else np.arctan2(own[1], own[0]))
    q = configurations(robot, posture[None, :7], np.array([angles]))[0]
    pin.forwardKinematics(model, data, q)
    rotations = np.array([[place.rotation for place in data.oMi]])
    positions = np.array([[place.translation for place in data.oMi]])
    return Posture(rotations, positions)


def shapes_of(robot: CertifiedRobot) -> list[Shape]:
    """The collision shapes of a robot; none where the URDF has none or they cannot be read."""
    import pinocchio as pin

    urdf_model = robot.urdf_model
    path, model = urdf_model.path, robot.model
    try:
        text = read_xml(path, InvalidRobot, "urdf", urdf_model.robot.name).text
        folders = package_folders(path)
        items = pin.buildGeomFromUrdfString(model, text, pin.GeometryType.COLLISION, None, folders).geometryObjects
    except (ValueError, RuntimeError):  # a mesh is missing or of a kind that is not read
        return []
    moving, found = {1, *_moving_joints(robot)}, []
    for item in items:
        geometry, joint, place = item.geometry, int(item.parentJoint), item.placement
        geometry.computeLocalAABB()
        center = place.act(np.asarray(geometry.aabb_center, float))
        link = str(model.frames[item.parentFrame].name)
        body = _body_of(robot, joint, moving)
        ball = (np.asarray(center), float(geometry.aabb_radius))
        found.append(Shape(link, joint, body, geometry, _hull(geometry), place, *ball))
    return found


def _hull(geometry: Any) -> Any:
    if not hasattr(geometry, "buildConvexHull"):
        return geometry
    geometry.buildConvexHull(True, "Qt")
    return geometry if geometry.convex is None else geometry.convex
