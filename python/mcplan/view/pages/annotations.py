"""What a page says about its space: world axes, a scale bar, names and normals of surfaces, start and goal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import pose, with_axis_z
from mcplan.view.colours import AXES, NORMAL, TEXT
from mcplan.view.shapes import Mesh, box, circle, cone, loft

if TYPE_CHECKING:
    from mcplan.view.scene_drawing import SurfaceDrawing
    from mcplan.view.stage import Stage

Array = NDArray[np.float64]

#: Lengths of scale bars that need no thought, over a power of ten.
ROUND = (1.0, 2.0, 5.0)


@dataclass(frozen=True)
class Label:
    """A text at a point of the drawing, upright in every view."""

    text: str
    places_W: Array  # (n, 3) [m] where it may be, best first
    kind: str  # "surface", "axis", "scale", "start" or "goal": what the legend hides at once
    colour: str = TEXT

    def settings(self, digits: int) -> dict[str, Any]:
        """For the page's script."""
        places = np.round(self.places_W, digits).tolist()
        return {"text": self.text, "places": places, "kind": self.kind, "colour": self.colour}


def scale_length(size_m: float) -> float:
    """Length [m] of the bar for a drawing of this size: a metre where that fits, else a round part of it."""
    if 1.8 <= size_m <= 15.0:
        return 1.0
    return round_length(0.25 * size_m)


def round_length(max_m: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is not above a positive length."""
    power = 10.0 ** np.floor(np.log10(max_m) + 1e-9)
    return float(max(r * power for r in ROUND if r == 1.0 or r * power <= max_m))


def length_text(length_m: float) -> str:
    """In the unit in which it is read without zeros."""
    for unit, size in (("km", 1e3), ("m", 1.0), ("cm", 1e-2), ("mm", 1e-3)):
        if length_m >= 0.999 * size:
            return f"{length_m / size:g} {unit}"
    return f"{length_m / 1e-6:g} µm"


def draw_scale(stage: Stage, points_W: Array, direction_W: Array, floor_m: float) -> tuple[Label, Array]:
    """Put a scale bar before the drawing, at its right; its label, and points (3, 3) [m] to be seen for both.

    Args:
        stage: The page's.
        points_W: What the page shows, (n, 3) [m].
        direction_W: From the drawing towards the camera, (3,).
        floor_m: Height on which it lies.
    """
    towards = np.array([direction_W[0], direction_W[1], 0.0]) / np.hypot(direction_W[0], direction_W[1])
    right = np.array([-towards[1], towards[0], 0.0])
    size = float(np.linalg.norm(np.ptp(points_W, axis=0)))
    length, thick = scale_length(size), 0.0022 * size
    along, near = (points_W @ right).max(), (points_W @ towards).max() + 0.03 * size
    ends = np.array([(along - length) * right, along * right]) + near * towards + [0.0, 0.0, floor_m]
    rotation = np.column_stack([right, np.cross([0.0, 0.0, 1.0], right), [0.0, 0.0, 1.0]])
    bar = box((length, thick, thick)).moved(pose(rotation, ends.mean(axis=0)))
    ticks = [box((thick, 9.0 * thick, thick)).moved(pose(rotation, end)) for end in ends]
    stage.mesh("scale", merged([bar, *ticks]), TEXT, glow=0.4)
    below = ends.mean(axis=0) + 7.0 * thick * towards
    return Label(length_text(length), below[None], "scale"), np.vstack([ends, below])


def draw_axes(stage: Stage, points_W: Array, names: Sequence[str] = ("x", "y", "z")) -> list[Label]:
    """Put the axes of the world at its origin, if that is in or near the drawing; labels of their tips.

    Args:
        stage: The page's.
        points_W: What the page shows, (n, 3) [m].
        names: Names of the axes; one without a name is not drawn.
    """
    low, high = points_W.min(axis=0), points_W.max(axis=0)
    size = float(np.linalg.norm(high - low))
    if (low > 0.15 * size).any() or (high < -0.15 * size).any():
        return []
    length = 0.05 * size
    labels = []
    for axis, (name, colour) in enumerate(zip(names, AXES, strict=True)):
        if name:
            tip = length * np.eye(3)[axis]
            stage.mesh(f"axes/{axis}", arrow(np.zeros(3), tip, 0.022 * length), colour, glow=0.5)
            labels.append(Label(name, 1.25 * tip[None], "axis", colour))
    return labels


def draw_normals(stage: Stage, drawings: list[SurfaceDrawing], length_m: float) -> None:
    """Put a thin arrow along the outward normal at the middle of every surface, all in one node."""
    arrows = []
    for drawing in drawings:
        middle = drawing.outline.mean(axis=0)
        arrows.append(arrow(middle, middle + length_m * drawing.normal, 0.03 * length_m))
    if arrows:
        stage.mesh("normals", merged(arrows), NORMAL, glow=0.4)


def surface_labels(drawings: list[SurfaceDrawing], direction_W: Array) -> list[Label]:
    """Names of surfaces: at the edge nearest to the camera if there is space, else at another, last in the middle."""
    labels = []
    for drawing in drawings:
        edges = 0.5 * (drawing.outline + np.roll(drawing.outline, -1, axis=0))
        order = np.argsort(-(edges @ np.asarray(direction_W)), kind="stable")
        places = np.vstack([edges[order[:3]], drawing.outline.mean(axis=0)])
        labels.append(Label(drawing.name, places, "surface"))
    return labels


def arrow(start: Array, end: Array, radius: float) -> Mesh:
    """A thin arrow between two points (3,) [m]."""
    along = np.asarray(end, float) - start
    length, ring = float(np.linalg.norm(along)), circle(8)
    head = min(6.0 * radius, 0.5 * length)
    shaft = loft(np.array([np.column_stack([radius * ring, np.full(8, z)]) for z in (0.0, length - head)]))
    tip = cone(2.4 * radius, head, sides=12).moved(pose(np.eye(3), np.array([0.0, 0.0, length - head])))
    return merged([shaft, tip]).moved(pose(with_axis_z(along, np.array([0.6, 0.7, 0.4])), np.asarray(start, float)))


def merged(meshes: list[Mesh]) -> Mesh:
    """Several solids as one, with flat faces."""
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    faces = [mesh.faces + offset for mesh, offset in zip(meshes, first, strict=True)]
    return Mesh(np.vstack([mesh.vertices for mesh in meshes]), np.vstack(faces))
