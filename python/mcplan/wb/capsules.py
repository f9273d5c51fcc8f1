"""Links as capsules, and pairs of them that keep a distance."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import package_folders, read_xml

if TYPE_CHECKING:
    from mcplan._core import wb as _core

    from .certificate.result import MotionViolation
    from .motion_model import MotionModel

Array = NDArray[np.float64]

#: Distance that links are to keep: twice what the certificate asks for, as it looks between nodes [m].
APART_M = 0.01
#: Points on a sphere or a circle of a primitive shape, and steps towards the centre of the circle round points.
POINTS, STEPS = 24, 60


@dataclass(frozen=True)
class LinkCapsule:
    """All points nearer than `radius` to a segment, in the axes of a joint of the reduced model [m]."""

    joint: int
    start: Array
    end: Array
    radius: float


def link_capsules(model: MotionModel) -> dict[str, LinkCapsule]:
    """By name of the link the capsule of least volume round its collision shapes; none where they cannot be read."""
    import pinocchio as pin  # type: ignore[import-untyped]

    whole, path = model.complete.model, model.complete.path
    try:
        text = read_xml(path, InvalidRobot, "urdf", model.complete.robot.name).text
        shapes = pin.buildGeomFromUrdfString(whole, text, pin.GeometryType.COLLISION, None, package_folders(path))
    except (ValueError, RuntimeError):
        return {}
    moving = set(model.model.names)
    locked = [joint for joint in range(2, whole.njoints) if whole.names[joint] not in moving]
    _, shapes = pin.buildReducedModel(whole, shapes, locked, model.locked)
    points: dict[str, tuple[int, list[Array]]] = {}
    for shape in shapes.geometryObjects:
        name, own = shape.name.rpartition("_")[0], _points(shape.geometry)
        if own is None:
            continue
        placed = own @ shape.placement.rotation.T + shape.placement.translation
        points.setdefault(name, (int(shape.parentJoint), []))[1].append(placed)
    return {name: _fitted(joint, np.vstack(parts)) for name, (joint, parts) in points.items()}


def _points(geometry: Any) -> Array | None:
    """Points whose hull is a shape, or nearly so; None of kinds that are not known."""
    if hasattr(geometry, "vertices"):
        return np.array(geometry.vertices(), float)
    circle = 2.0 * np.pi * np.arange(POINTS) / POINTS
    if hasattr(geometry, "halfSide"):
        signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
        return np.asarray(signs * geometry.halfSide)
    if hasattr(geometry, "halfLength"):
        ring = geometry.radius * np.column_stack([np.cos(circle), np.sin(circle), 0.0 * circle])
        return np.vstack([ring + [0.0, 0.0, sign * geometry.halfLength] for sign in (-1.0, 1.0)])
    if hasattr(geometry, "radius"):
        return np.vstack([sign * geometry.radius * np.eye(3) for sign in (-1.0, 1.0)])
    return None


def _fitted(joint: int, points: Array) -> LinkCapsule:
    """The capsule of least volume of those along some axes."""
    axes = np.vstack([np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2], np.eye(3)])
    best, least = None, np.inf
    for axis in axes:
        along = points @ axis
        across = points - along[:, None] * axis
        centre = 0.5 * (across.min(axis=0) + across.max(axis=0))
        for step in range(1, STEPS):  # Badoiu and Clarkson: towards the farthest point, by less each time
            far = across[np.argmax(np.linalg.norm(across - centre, axis=1))]
            centre = centre + (far - centre) / (step + 1.0)
        off = np.linalg.norm(across - centre, axis=1)
        radius = float(off.max())
        cap = np.sqrt(np.maximum(radius**2 - off**2, 0.0))
        low, high = float((along + cap).min()), float((along - cap).max())
        low, high = (low, high) if low < high else (0.5 * (low + high),) * 2
        volume = np.pi * radius**2 * (high - low + 4.0 / 3.0 * radius)
        if volume < least:
            least, best = volume, LinkCapsule(joint, centre + low * axis, centre + high * axis, radius)
    assert best is not None
    return best


def keep_apart(
    problem: _core.Problem, model: MotionModel, capsules: dict[str, LinkCapsule], found: MotionViolation, q: Array
) -> bool:
    """Let two links that a certificate finds too near, what moves with them, and the other side of the body keep a distance.

    Capsules are wider than links: theirs is to grow by as much as that of the links lacks.

    Args:
        problem: Gets the capsules and pairs.
        model: The robot.
        capsules: Of its links.
        found: What the certificate says of the nearest links.
        q: The configuration in which they are so near.

    Returns:
        Whether there are such capsules.
    """
    if len(found.links) != 2 or not set(found.links) <= set(capsules):
        return False
    least = _apart(model, q, *(capsules[link] for link in found.links)) + APART_M - found.value
    first, second = found.links
    for one, other in sorted({(first, second), (_opposite(first), _opposite(second))}):
        if one in capsules and other in capsules:
            numbers = [[_added(problem, own) for own in _rigid(capsules, link)] for link in (one, other)]
            for i, j in itertools.product(*numbers):
                problem.add_pair(i, j, least)
    return True


def _added(problem: _core.Problem, own: LinkCapsule) -> int:
    # The base's six joints, of which the last carries it, come before those of the reduced model.
    return problem.add_capsule(own.joint + 4, own.start, own.end, own.radius)


def _rigid(capsules: dict[str, LinkCapsule], link: str) -> list[LinkCapsule]:
    """The capsules of a link and of those that move with it."""
    return [own for own in capsules.values() if own.joint == capsules[link].joint]


def _opposite(link: str) -> str:
    if ("left" in link) == ("right" in link):
        return link
    return link.replace("left", "right") if "left" in link else link.replace("right", "left")


def _apart(model: MotionModel, q: Array, first: LinkCapsule, second: LinkCapsule) -> float:
    """Distance of two capsules, to a thousandth of their lengths; negative where they overlap."""
    import pinocchio as pin

    data, parts = model.model.createData(), np.linspace(0.0, 1.0, 200)[:, None]
    pin.forwardKinematics(model.model, data, q)
    points = []
    for own in (first, second):
        start, end = (data.oMi[own.joint].act(point) for point in (own.start, own.end))
        points.append((1.0 - parts) * start + parts * end)
    return float(np.linalg.norm(points[0][:, None] - points[1][None], axis=2).min()) - first.radius - second.radius
