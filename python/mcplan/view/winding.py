"""Which sides of a mesh are to be drawn: files come with triangles wound in either sense, mirrored, or open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .shapes import Mesh

#: Vertices nearer to each other than this ratio of the mesh's size are one.
SAME = 1e-6


def whole(mesh: Mesh) -> Mesh:
    """The mesh so that nothing of it goes missing when only front sides are drawn.

    A closed skin whose triangles are all wound alike is reversed if need be (mirrored links are), and stays
    one-sided. Any other is marked as two-sided: no winding can be right for it.
    """
    if not len(mesh.faces):
        return mesh
    faces, count = _welded(mesh)
    if not _closed(faces, count):
        return replace(mesh, two_sided=True)
    corners = mesh.vertices[mesh.faces] - mesh.vertices.mean(axis=0)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()
    return mesh if volume >= 0.0 else replace(mesh, faces=mesh.faces[:, ::-1])


def both_sides(mesh: Mesh) -> Mesh:
    """A two-sided mesh as a one-sided one of twice the triangles, for painters that know no other; others as they are.

    No two triangles have a vertex in common, so that a painter that averages normals over neighbours finds each side's
    own.
    """
    if not mesh.two_sided:
        return mesh
    corners = mesh.vertices[mesh.faces]
    vertices = np.concatenate([corners, corners[:, ::-1]]).reshape(-1, 3)
    return Mesh(vertices, np.arange(len(vertices)).reshape(-1, 3), mesh.smooth)


def _welded(mesh: Mesh) -> tuple[NDArray[np.int64], int]:
    """Faces between vertices of which those in one place count as one, degenerate ones left out; and their number."""
    size = float(np.ptp(mesh.vertices, axis=0).max()) or 1.0
    places = np.round((mesh.vertices - mesh.vertices.min(axis=0)) / (SAME * size)).astype(np.int64)
    # Three coordinates of at most 1e6 each in one number, which sorts far faster than rows do.
    keys = (places[:, 0] * 2_000_000 + places[:, 1]) * 2_000_000 + places[:, 2]
    unique, inverse = np.unique(keys, return_inverse=True)
    faces = inverse.reshape(-1)[mesh.faces]
    real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 0] != faces[:, 2])
    return faces[real], len(unique)


def _closed(faces: NDArray[np.int64], count: int) -> bool:
    """Whether every edge is passed once in each direction: a closed skin of one winding."""
    start, stop = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    there, back = np.sort(start * count + stop), np.sort(stop * count + start)
    return bool(np.all(there[1:] != there[:-1]) and np.array_equal(there, back))
