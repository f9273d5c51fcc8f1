"""A painter for still pictures: shaded polygons in perspective, far ones first, drawn by matplotlib."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import rgb
from mcplan.view.shapes import Mesh

Array = NDArray[np.float64]

#: Polygons of a layer that a picture in vectors has as such; more are an image in it.
_MAX_IN_VECTORS = 20_000


@dataclass(frozen=True)
class Paint:
    """How a mesh is painted.

    Attributes:
        colour: "#rrggbb".
        opacity: 1 is solid.
        fade: Share of white mixed into the shaded colour.
    """

    colour: str
    opacity: float = 1.0
    fade: float = 0.0


class Canvas:
    """Collects polygons of a picture in layers; within a layer, nearer ones cover farther ones.

    Args:
        points_W: Points that the picture must show, (n, 3) [m].
        direction_W: From the drawing towards the camera, (3,).
        sun_W: From the drawing towards the light, (3,).
        distance: From the middle of the points to the camera, in units of their radius.
    """

    def __init__(self, points_W: Array, direction_W: Array, sun_W: Array, distance: float = 6.0) -> None:
        self.centre = 0.5 * (points_W.min(axis=0) + points_W.max(axis=0))
        radius = float(np.linalg.norm(points_W - self.centre, axis=1).max())
        back = direction_W / np.linalg.norm(direction_W)
        right = np.cross([0.0, 0.0, 1.0], back)
        right /= np.linalg.norm(right)
        self.axes = np.array([right, np.cross(back, right), back])
        self.distance = distance * radius
        self.sun = sun_W / np.linalg.norm(sun_W)
        self._layers: dict[int, list[tuple[Array, Array, Array]]] = {}

    def project(self, points_W: Array) -> tuple[Array, Array]:
        """Picture coordinates (..., 2) [m, at the centre's distance] and depths (...) [m] of points."""
        seen = (points_W - self.centre) @ self.axes.T
        depth = self.distance - seen[..., 2]
        return seen[..., :2] * (self.distance / depth)[..., None], depth

    def mesh(
        self,
        mesh: Mesh,
        paint: Paint,
        layer: int = 0,
        lift: float = 0.0,
        whole: bool = False,
    ) -> None:
        """Add the triangles of a mesh that face the camera.

        Args:
            mesh: Solid in the world frame.
            paint: Colour, opacity and paleness.
            layer: Higher ones cover lower ones.
            lift: [m] by which it counts as nearer, to settle who covers whom.
            whole: A convex solid, put before or behind others as one piece.
        """
        corners = mesh.vertices[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.linalg.norm(normals, axis=1)
        towards = self.centre + self.distance * self.axes[2] - corners.mean(axis=1)
        front = (size > 1e-12) & (np.sum(normals * towards, axis=1) > 0.0)
        corners, normals = corners[front], normals[front] / size[front, None]
        bright = 0.66 + 0.36 * np.clip(normals @ self.sun, 0.0, 1.0) + 0.06 * normals[:, 2]
        shaded = np.clip(np.outer(bright, rgb(paint.colour)), 0.0, 1.0)
        shaded = (1.0 - paint.fade) * shaded + paint.fade
        flat, depth = self.project(corners)
        middle = depth.mean(axis=1)
        if whole:
            _, one = self.project(0.5 * (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)))
            middle = np.full(len(flat), float(one))
        self._add(layer, flat, middle - lift, shaded, paint.opacity)

    def line(
        self,
        path_W: Array,
        colour: str,
        width: float,
        layer: int = 0,
        opacity: float = 1.0,
        lift: float = 0.0,
    ) -> None:
        """Add a polyline (n, 3) [m] with a width [m]; its pieces are covered by what is nearer."""
        flat, depth = self.project(np.asarray(path_W, float))
        step = np.diff(flat, axis=0)
        length = np.linalg.norm(step, axis=1)
        keep = length > 1e-9
        flat = np.vstack([flat[:-1][keep], flat[-1:]])
        depth = np.append(depth[:-1][keep], depth[-1])
        if len(flat) < 2:
            return
        step = step[keep] / length[keep, None]
        side = np.column_stack([-step[:, 1], step[:, 0]])
        # Mean normals at the joints: neighbouring pieces have corners in common.
        joints = np.vstack([side[:1], side[1:] + side[:-1], side[-1:]])
        joints /= np.maximum(np.linalg.norm(joints, axis=1, keepdims=True), 0.3)
        reach = 0.5 * width * joints * (self.distance / depth)[:, None]
        quads = np.stack(
            [flat[:-1] + reach[:-1], flat[1:] + reach[1:], flat[1:] - reach[1:], flat[:-1] - reach[:-1]],
            axis=1,
        )
        colours = np.tile(rgb(colour), (len(quads), 1))
        self._add(layer, quads, 0.5 * (depth[1:] + depth[:-1]) - lift, colours, opacity)

    def segments(self, segments_W: Array, colour: str, width: float, layer: int = 0) -> None:
        """Add separate lines (n, 2, 3) [m] with a width [m]."""
        for segment in segments_W:
            self.line(segment, colour, width, layer)

    def paint(self, axes: Any) -> None:
        """Draw everything onto matplotlib axes, with equal scales."""
        from matplotlib.collections import PolyCollection

        for layer in sorted(self._layers):
            polygons: list[Array] = []
            depths, colours = [], []
            for flat, depth, colour in self._layers[layer]:
                polygons += list(flat)
                depths.append(depth)
                colours.append(colour)
            order = np.argsort(-np.concatenate(depths), kind="stable")
            faces = np.vstack(colours)[order]
            # A hairline in the face's own colour closes the seams between neighbours.
            edges = np.where(faces[:, 3:] < 1.0, np.zeros(4), faces)
            shown = PolyCollection(
                [polygons[i] for i in order],
                facecolors=faces,
                edgecolors=edges,
                linewidths=0.35,
                zorder=layer,
                rasterized=len(polygons) > _MAX_IN_VECTORS,
            )
            axes.add_collection(shown)
        axes.set_aspect("equal")
        axes.set_axis_off()

    def _add(self, layer: int, flat: Array, depth: Array, colours: Array, opacity: float) -> None:
        painted = np.column_stack([colours, np.full(len(colours), opacity)])
        self._layers.setdefault(layer, []).append((flat, depth, painted))
