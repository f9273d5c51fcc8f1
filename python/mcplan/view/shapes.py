"""Triangle and polygon meshes that pages and pictures are made of."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import with_axis_z

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mesh:
    """Triangles between vertices [m], counter-clockwise seen from outside."""

    vertices: Array  # (n, 3)
    faces: NDArray[np.int64]  # (m, 3)
    smooth: bool = False  # shade across edges
    two_sided: bool = False  # open, or wound in either sense: seen from both sides

    def moved(self, transform: Array) -> Mesh:
        """The mesh under a homogeneous transform (4, 4)."""
        return replace(self, vertices=self.vertices @ transform[:3, :3].T + transform[:3, 3])


def prism(outline: Array, depth: float) -> Mesh:
    """Solid below a convex planar polygon (n, 3) [m], counter-clockwise about its outward normal."""
    outline = np.asarray(outline, float)
    n = len(outline)
    # Newell's normal: exact for planar polygons, whichever three vertices come first.
    normal = np.cross(outline, np.roll(outline, -1, axis=0)).sum(axis=0)
    below = outline - depth * normal / np.linalg.norm(normal)
    faces = [(0, i, i + 1) for i in range(1, n - 1)]
    faces += [(n, n + i + 1, n + i) for i in range(1, n - 1)]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, n + i, n + j), (i, n + j, j)]
    return Mesh(np.vstack([outline, below]), np.array(faces))


def loft(rings: Array, smooth: bool = True) -> Mesh:
    """Closed skin over rings (n, k, 3), each counter-clockwise seen from the last ring's side."""
    n, k, _ = rings.shape
    # The caps have rims of their own: shading does not run across sharp edges.
    centres = [rings[0].mean(axis=0), rings[-1].mean(axis=0)]
    vertices = np.vstack([rings.reshape(-1, 3), rings[0], rings[-1], *[c[None] for c in centres]])
    faces = []
    for i in range(n - 1):
        for j in range(k):
            a, b = i * k + j, i * k + (j + 1) % k
            faces += [(a, b, b + k), (a, b + k, a + k)]
    first, last, centre = n * k, (n + 1) * k, (n + 2) * k
    for j in range(k):
        faces.append((centre, first + (j + 1) % k, first + j))
        faces.append((centre + 1, last + j, last + (j + 1) % k))
    return Mesh(vertices, np.array(faces), smooth)


def circle(sides: int) -> Array:
    """Unit circle (sides, 2), counter-clockwise."""
    angle = 2.0 * np.pi * np.arange(sides) / sides
    return np.column_stack([np.cos(angle), np.sin(angle)])


def capsule(length: float, radius_start: float, radius_end: float, sides: int = 20) -> Mesh:
    """Tapered capsule along +z, its round ends centred at z = 0 and z = length."""
    bend = np.linspace(-np.pi / 2.0, 0.0, 5)
    levels = [(radius_start * np.cos(a), radius_start * np.sin(a)) for a in bend]
    levels += [(radius_end * np.cos(a), length + radius_end * np.sin(a)) for a in -bend[::-1]]
    ring = circle(sides)
    min_radius = 2e-3 * max(radius_start, radius_end)
    rings = np.array([np.column_stack([max(r, min_radius) * ring, np.full(sides, z)]) for r, z in levels])
    return loft(rings)


def ellipsoid(radii: tuple[float, float, float], sides: int = 28) -> Mesh:
    """Ellipsoid about the origin, half axes [m]."""
    angles = np.linspace(-np.pi / 2.0, np.pi / 2.0, sides // 2 + 1)
    ring = circle(sides)
    rings = np.array([np.column_stack([max(np.cos(a), 1e-3) * ring, np.full(sides, np.sin(a))]) for a in angles])
    return loft(rings * np.asarray(radii))


def rounded_stack(levels: list[tuple[float, float, float, float]], sides: int = 28, refine: int = 1) -> Mesh:
    """Body of rounded-rectangle sections, bottom up.

    Each level is (z, half depth along x, half width along y, shift along x) [m].
    With `refine` > 1 as many sections follow from one level to the next, along Catmull-Rom curves.
    """
    if refine > 1:
        p = np.array([levels[0], *levels, levels[-1]])
        s = np.linspace(0.0, 1.0, refine, endpoint=False)[:, None]
        curves = [
            0.5 * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s**2 + (3 * b - a - 3 * c + d) * s**3)
            for a, b, c, d in zip(p[:-3], p[1:-2], p[2:-1], p[3:], strict=True)
        ]
        levels = [tuple(row) for row in np.vstack([*curves, p[-1:]])]
    ring = circle(sides)
    square = np.sign(ring) * np.abs(ring) ** 0.6  # superellipse of exponent 10/3
    rings = [
        np.column_stack([x * square[:, 0] + shift, y * square[:, 1], np.full(sides, z)]) for z, x, y, shift in levels
    ]
    return loft(np.array(rings))


def box(size: tuple[float, float, float]) -> Mesh:
    """Box about the origin with the given edge lengths [m]."""
    x, y, z = 0.5 * np.asarray(size, float)
    return prism(np.array([[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]]), 2.0 * z)


def plate(half_size: tuple[float, float], thickness: float, corner: float = 0.35) -> Mesh:
    """Rectangle with cut corners on the plane z = 0, its solid above; round when a half size is 0."""
    length, width = float(half_size[0]), float(half_size[1])
    cut = corner * min(length, width)
    corners = [(length, width - cut), (length - cut, width), (cut - length, width), (-length, width - cut)]
    outline = np.array(corners + [(-x, -y) for x, y in corners])
    return prism(np.column_stack([outline, np.full(8, thickness)]), thickness)


def disc(radius: float, thickness: float, sides: int = 24) -> Mesh:
    """Flat cylinder on the plane z = 0."""
    return prism(np.column_stack([radius * circle(sides), np.full(sides, thickness)]), thickness)


def cone(radius: float, height: float, sides: int = 16) -> Mesh:
    """Cone along +z, its base at z = 0."""
    ring = circle(sides)
    rings = [np.column_stack([r * ring, np.full(sides, z)]) for r, z in ((radius, 0.0), (2e-3 * radius, height))]
    return loft(np.array(rings), smooth=False)


def tube(path: Array, radius: float, sides: int = 8) -> Mesh:
    """Round tube along points (n, 3) [m]; points that repeat are left out."""
    path = np.asarray(path, float)
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-4 * radius])
    path = path[keep]
    if len(path) < 2:
        path = np.vstack([path, path[-1] + [0.0, 0.0, 1e-2 * radius]])
    along = np.gradient(path, axis=0)
    ring = circle(sides)
    frame = with_axis_z(along[0], np.array([0.0, 0.0, 1.0]))
    rings = []
    for point, tangent in zip(path, along, strict=True):
        if np.linalg.norm(tangent) > 1e-6 * radius:
            frame = with_axis_z(tangent, frame[:, 0])  # carried along, so that the tube does not twist
        rings.append(point + radius * ring @ frame[:, :2].T)
    return loft(np.array(rings))
