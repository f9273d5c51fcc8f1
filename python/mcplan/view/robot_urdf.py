"""A robot drawn with the visual meshes of its URDF, posed along a plan by inverse kinematics."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import Samples
from mcplan.kinematics.urdf_model import UrdfModel, load_model

from .colours import mix
from .figure import Figure, Part
from .shapes import Mesh, box, capsule, circle, ellipsoid, loft
from .winding import whole

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]

#: [m] by which CoM and contacts may miss the plan; beyond, a picture of the posture would mislead.
LARGEST_MISS = 0.05
#: Share of its end-effector's colour that a tinted link takes.
TINT = 0.65


class CannotFollow(RuntimeError):
    """No posture of the URDF follows the plan; the message says by how much it misses, where and when."""


def urdf_robot(samples: Samples, robot: Robot, tints: list[str] | None = None) -> Figure:
    """Pose a URDF's visual meshes along a plan; `tints` as for ``mesh_figure``.

    Raises:
        MissingExtra: Pinocchio (or example-robot-data) is not installed.
        InvalidRobot: The URDF cannot be read, or lacks a frame or joint that the robot names.
        CannotFollow: Some posture misses the plan by more than 5 cm.
    """
    require(f"drawing {robot.name} with its meshes", "view", "pinocchio")
    urdf_model = load_model(robot)
    postures = follow(urdf_model, samples)
    if postures.residual > LARGEST_MISS:
        raise CannotFollow(
            f"inverse kinematics of {robot.name} misses {postures.where} by {100.0 * postures.residual:.1f} cm"
        )
    return mesh_figure(urdf_model, postures.configurations, tints)


def mesh_figure(urdf_model: UrdfModel, configurations: Array, tints: list[str] | None = None) -> Figure:
    """The visual meshes of a URDF at given configurations.

    Args:
        urdf_model: The robot's model.
        configurations: (n, nq) in Pinocchio's order, free-flyer first.
        tints: A colour for each end-effector's link, "#rrggbb"; None: links keep their own colours.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    model = urdf_model.model
    data = model.createData()
    placements = []
    for q in configurations:
        pin.forwardKinematics(model, data, q)
        placements.append([joint.homogeneous for joint in data.oMi])
    poses = np.array(placements)
    tint_of = {model.frames[f].parentJoint: c for f, c in zip(urdf_model.frames, tints or [], strict=False)}
    parts = []
    for item in urdf_model.visual.geometryObjects:
        mesh = _mesh(item)
        if mesh is not None:
            moved = mesh.moved(item.placement.homogeneous)
            name = f"{model.names[item.parentJoint]}/{item.name}"
            colour = _colour(item.meshColor)
            if item.parentJoint in tint_of:
                colour = mix(colour, tint_of[item.parentJoint], TINT)
            parts.append(Part(name, moved, colour, poses[:, item.parentJoint]))
    return Figure("urdf", parts)


def _mesh(item: Any) -> Mesh | None:
    """The shape of a visual as triangles, in its own frame; None for shapes that are not drawn (planes)."""
    shape = item.geometry
    kind = type(shape).__name__
    if kind.startswith("BVHModel"):
        triangles = (shape.tri_indices(i) for i in range(shape.num_tris))
        faces = np.array([(t[0], t[1], t[2]) for t in triangles], dtype=np.int64)
        vertices = np.asarray(shape.vertices(), float)
        return whole(Mesh(vertices, own_vertices(faces, len(vertices))))
    if kind == "Box":
        x, y, z = 2.0 * np.asarray(shape.halfSide, float)
        return box((x, y, z))
    if kind == "Sphere":
        return ellipsoid((float(shape.radius),) * 3)
    if kind == "Cylinder":
        ring = float(shape.radius) * circle(24)
        half = float(shape.halfLength)
        return loft(np.array([np.column_stack([ring, np.full(24, z)]) for z in (-half, half)]))
    if kind == "Capsule":
        half = float(shape.halfLength)
        mesh = capsule(2.0 * half, float(shape.radius), float(shape.radius))
        return replace(mesh, vertices=mesh.vertices - [0.0, 0.0, half])
    return None


def own_vertices(faces: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Faces of a mesh of several materials, each with the vertices of its own part.

    Pinocchio's reader of meshes puts the vertices of all materials one behind the other and lets the indices of each
    begin with 0, so that every part but the first is drawn between the first one's vertices: the thighs of Go2 were
    not there. A part begins with the face 0, 1, 2, since its vertices are numbered as they occur.

    Args:
        faces: (n, 3), the parts in the order of their vertices.
        count: Number of vertices of all parts.

    Returns:
        The faces with the numbers of the vertices before their part added; as they were if these do not come out even.
    """
    if not len(faces) or faces.max() + 1 == count:
        return faces
    starts = np.flatnonzero((faces == [0, 1, 2]).all(axis=1))
    if not len(starts) or starts[0] != 0:
        return faces
    parts = np.split(faces, starts[1:])
    sizes = [int(part.max()) + 1 for part in parts]
    if sum(sizes) != count or any(len(np.unique(part)) != size for part, size in zip(parts, sizes, strict=True)):
        return faces
    before = np.concatenate([[0], np.cumsum(sizes[:-1])])
    return np.concatenate([part + first for part, first in zip(parts, before, strict=True)])


def _colour(rgba: Array) -> str:
    # Very dark meshes lose their shape on white paper.
    lifted = [0.12 + 0.88 * float(np.clip(c, 0.0, 1.0)) for c in rgba[:3]]
    return "#" + "".join(f"{round(255 * c):02x}" for c in lifted)
