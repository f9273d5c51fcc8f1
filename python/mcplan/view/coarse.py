"""Meshes with fewer triangles: those of a URDF have hundreds of thousands, a small picture shows a few."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .shapes import Mesh


def coarse(mesh: Mesh, cell_m: float) -> Mesh:
    """The mesh with all vertices that lie in a cube of a grid moved to their mean, which most triangles do not survive.

    Args:
        mesh: Any; one that is coarse already stays much as it is.
        cell_m: Edge of the cubes [m]; details smaller than that are lost.
    """
    cells = np.floor((mesh.vertices - mesh.vertices.min(axis=0)) / cell_m).astype(np.int64)
    _, cluster, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    cluster = cluster.reshape(-1)
    vertices = np.column_stack([np.bincount(cluster, axis) for axis in mesh.vertices.T]) / count[:, None]
    faces = cluster[mesh.faces]
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 0] != faces[:, 2])]
    # Of triangles between the same corners, however they are wound, one is drawn.
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    return replace(mesh, vertices=vertices, faces=faces[np.sort(first)])
