"""Links of postures against the solids below a scene's surfaces: heads, elbows and shins, of which plans know little."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .findings import Finding
from .link_shapes import link_shapes

if TYPE_CHECKING:
    from mcplan._core import Scene
    from mcplan.kinematics.inverse_kinematics import Postures
    from mcplan.kinematics.samples import Samples
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Solids are taken to be so thick at least and at most [m]: convex hulls of what is flat, or without end, are none.
THICKNESS = (1e-3, 10.0)
#: Depth in a solid that is accepted [m]: shins graze edges of treads, and controllers yield by so much.
LINK_DEPTH = 0.03


@dataclass(frozen=True)
class _Body:
    """A convex body of coal and a ball about it, in its own axes [m]."""

    shape: Any
    center: Array
    radius: float


def link_findings(scene: Scene, urdf_model: UrdfModel, samples: Samples, postures: Postures) -> list[Finding]:
    """How deep the links of a robot enter solids, by the convex shapes with which it is simulated.

    Soles and hands are no matter of this: feet begin some centimetres above the ground on which they stand. Only what is
    in a solid is told, one finding a link.

    Args:
        scene: Its surfaces are the tops of the solids.
        urdf_model: The robot's model.
        samples: The plan.
        postures: That follow it.
    """
    import coal  # type: ignore[import-untyped]
    import pinocchio as pin  # type: ignore[import-untyped]

    hulls = [(shape, _body(shape.points)) for shape in link_shapes(urdf_model) if shape.on_terrain]
    shapes = [(shape, body) for shape, body in hulls if body is not None]
    prisms = [(surface.name, _body(_prism(surface))) for surface in scene.surfaces]
    solids = [(name, body) for name, body in prisms if body is not None]
    if not shapes or not solids:
        return []
    centers, radii = np.array([body.center for _, body in solids]), np.array([body.radius for _, body in solids])
    still, request = coal.Transform3s(), coal.DistanceRequest()
    data, deepest = urdf_model.model.createData(), dict[str, Finding]()
    for time_s, q in zip(samples.times_s, postures.configurations, strict=True):
        pin.forwardKinematics(urdf_model.model, data, q)
        for shape, body in shapes:
            place = data.oMi[shape.joint]
            apart = np.linalg.norm(centers - place.act(body.center), axis=1)
            for i in np.flatnonzero(apart < radii + body.radius):
                name, solid = solids[i]
                at = coal.Transform3s(place.rotation, place.translation)
                depth = -float(coal.distance(body.shape, at, solid.shape, still, request, coal.DistanceResult()))
                if depth > 0.0 and (shape.link not in deepest or depth > deepest[shape.link].value):
                    found = Finding("link", depth, LINK_DEPTH, "m", shape.link, float(time_s), f"surface {name}")
                    deepest[shape.link] = found
    return list(deepest.values())


def _body(points: Array) -> _Body | None:
    """The convex hull of points; None where they have none."""
    import coal

    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(0, len(points))
    mesh.addVertices(points)
    mesh.endModel()
    mesh.buildConvexHull(True, "Qt")
    if mesh.convex is None:
        return None
    center = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return _Body(mesh.convex, center, float(np.linalg.norm(points - center, axis=1).max()))


def _prism(surface: Any) -> Array:
    """(2 n, 3) corners of the solid below a surface [m]."""
    top = np.asarray(surface.vertices_W, float)
    return np.vstack([top, top - float(np.clip(surface.thickness, *THICKNESS)) * polygon_normal(top)])
