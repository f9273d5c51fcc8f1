"""Surfaces of a scene as solids with colours, for pages and pictures alike."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal

from .colours import GRASP, GROUND, OUTLINE, PAD, WALL, mix
from .extent import Extent
from .shapes import Mesh, prism
from .stage import node

if TYPE_CHECKING:
    from mcplan._core import Scene, Surface

    from .stage import Stage

Array = NDArray[np.float64]

#: [m] between the lines drawn on surfaces to walk on, for drawings of usual size; and how many there are at most
#: across.
GRID, MAX_LINES = 0.5, 60


@dataclass(frozen=True)
class SurfaceDrawing:
    """A surface, cut to the extent that is drawn."""

    name: str
    outline: Array  # (n, 3) [m]
    normal: Array  # (3,)
    mesh: Mesh  # the solid below it
    colour: str
    opacity: float
    grid: Array  # (m, 2, 3) [m] lines on the surface


def is_pad(surface: Surface) -> bool:
    """Whether a surface without grasp is for hands alone: none of its end-effectors or their kinds is a foot."""
    own = list(surface.end_effectors)
    return bool(own) and not surface.grasp and not any("foot" in name or "leg" in name for name in own)


def for_hands(scene: Scene) -> list[tuple[list[str], str, str]]:
    """Surfaces for hands alone for a legend, those of each colour: their names, the colour and what to say of them."""
    pads = [
        (surface.name, _is_wall(polygon_normal(surface.vertices_W))) for surface in scene.surfaces if is_pad(surface)
    ]
    kinds = ((False, PAD, "for hands"), (True, WALL, "walls for hands"))
    found = [([name for name, wall in pads if wall == kind], colour, text) for kind, colour, text in kinds]
    return [each for each in found if each[0]]


def _is_wall(normal: Array) -> bool:
    """Whether a surface with this normal (3,) is drawn as a wall, through which what is behind can be seen."""
    return bool(abs(normal[2]) < 0.3)


def grid_spacing(extent: Extent) -> float:
    """[m] between grid lines: half a metre, or for drawings that are far smaller or larger as round a number."""
    size = 2.0 * max(extent.half_length, extent.half_width)
    if GRID <= size <= MAX_LINES * GRID:
        return GRID
    power = 10.0 ** np.floor(np.log10(size / 8.0) + 1e-9)
    return float(max(r * power for r in (1.0, 2.0, 5.0) if r == 1.0 or r * power <= size / 8.0))


def surface_drawings(scene: Scene, extent: Extent) -> list[SurfaceDrawing]:
    """The surfaces that reach into the extent, in the scene's order."""
    drawings = []
    spacing = grid_spacing(extent)
    for surface in scene.surfaces:
        outline = extent.clip(np.asarray(surface.vertices_W, float))
        if len(outline) < 3 or not _has_area(outline, surface.vertices_W):
            continue
        normal = polygon_normal(outline)
        wall = _is_wall(normal)
        colour = GRASP if surface.grasp else WALL if wall else PAD if is_pad(surface) else GROUND
        grid = grid_lines(outline, spacing) if normal[2] > 0.3 and not surface.grasp else np.zeros((0, 2, 3))
        # No deeper than the scene is long: files of millimetres may leave the thickness at its default of centimetres.
        mesh = prism(outline, min(float(surface.thickness), extent.half_length))
        drawings.append(SurfaceDrawing(surface.name, outline, normal, mesh, colour, 0.35 if wall else 1.0, grid))
    return drawings


def _has_area(outline: Array, of: Array) -> bool:
    """Whether what is left of a surface is more than an edge on the boundary of the extent."""
    left, whole = (
        np.linalg.norm(np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0)) for p in (outline - outline[0], of - of[0])
    )
    return bool(left > 1e-9 * whole)


def raised(drawing: SurfaceDrawing, by_m: float) -> SurfaceDrawing:
    """A drawing moved upwards."""
    up = np.array([0.0, 0.0, by_m])
    mesh = replace(drawing.mesh, vertices=drawing.mesh.vertices + up)
    return replace(drawing, outline=drawing.outline + up, mesh=mesh, grid=drawing.grid + up)


def grid_lines(outline: Array, spacing: float) -> Array:
    """Where the planes x = i spacing and y = i spacing cut a convex polygon, (n, 2, 3) [m]."""
    segments = []
    for axis in (0, 1):
        first = int(np.floor(outline[:, axis].min() / spacing)) + 1
        last = int(np.ceil(outline[:, axis].max() / spacing)) - 1
        for i in range(first, last + 1):
            height = outline[:, axis] - i * spacing
            crossings = []
            for a in range(len(outline)):
                b = (a + 1) % len(outline)
                if (height[a] < 0.0) != (height[b] < 0.0):
                    fraction = height[a] / (height[a] - height[b])
                    crossings.append(outline[a] + fraction * (outline[b] - outline[a]))
            if len(crossings) == 2:
                segments.append(crossings)
    return np.array(segments).reshape(-1, 2, 3)


def edges(drawing: SurfaceDrawing) -> Array:
    """Outline of the solid: rims above and below and the edges between, (m, 2, 3) [m]."""
    n = len(drawing.outline)
    top, below = drawing.mesh.vertices[:n], drawing.mesh.vertices[n:]
    pairs = [(ring[i], ring[(i + 1) % n]) for ring in (top, below) for i in range(n)]
    return np.array(pairs + [(top[i], below[i]) for i in range(n)])


def draw_surfaces(stage: Stage, drawings: list[SurfaceDrawing]) -> None:
    """Put surfaces onto a page, under "scene"."""
    for drawing in drawings:
        path = f"scene/{node(drawing.name)}"
        stage.mesh(f"{path}/solid", drawing.mesh, drawing.colour, drawing.opacity)
        stage.lines(f"{path}/outline", edges(drawing), OUTLINE, 0.9)
        if len(drawing.grid):
            lifted = drawing.grid + 2e-4 * float(np.ptp(drawing.outline, axis=0).max()) * drawing.normal
            stage.lines(f"{path}/grid", lifted, mix(drawing.colour, "#ffffff", 0.55), 0.8)
