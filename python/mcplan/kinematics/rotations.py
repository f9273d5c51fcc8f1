"""Rotations and poses: small, vectorised where frames are many."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def from_rpy(rpy: Array) -> Array:
    """R = Rz(yaw) Ry(pitch) Rx(roll), shape (..., 3, 3), of roll, pitch, yaw [rad], shape (..., 3)."""
    rpy = np.asarray(rpy, float)
    cr, cp, cy = np.moveaxis(np.cos(rpy), -1, 0)
    sr, sp, sy = np.moveaxis(np.sin(rpy), -1, 0)
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def with_axis_z(z: Array, x_hint: Array) -> Array:
    """Rotation whose third column points along z and whose first is as close as it can be to x_hint."""
    z = np.asarray(z, float) / np.linalg.norm(z)
    x = np.asarray(x_hint, float) - z * np.dot(z, x_hint)
    if np.linalg.norm(x) < 1e-3 * np.linalg.norm(x_hint):
        across = np.eye(3)[np.argmin(np.abs(z))]
        x = across - z * np.dot(z, across)
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def about_z(angles: Array) -> Array:
    """Rotations (..., 3, 3) by angles (...) [rad] about the world's vertical."""
    angles = np.asarray(angles, float)
    found = np.zeros((*angles.shape, 3, 3))
    found[..., 0, 0] = found[..., 1, 1] = np.cos(angles)
    found[..., 1, 0] = np.sin(angles)
    found[..., 0, 1] = -found[..., 1, 0]
    found[..., 2, 2] = 1.0
    return found


def sole_frame(normal: Array, yaw: float) -> Array:
    """Frame of a sole on a surface: z along the unit normal, x along its heading yaw [rad], or up where it faces a wall."""
    heading = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    faces = np.linalg.norm(heading - normal * np.dot(normal, heading)) < 0.1
    return with_axis_z(normal, np.array([0.0, 0.0, 1.0]) if faces else heading)


def between(start: Array, end: Array, fraction: float) -> Array:
    """Rotation at a fraction of the shortest arc from start to end."""
    relative = start.T @ end
    angle = float(np.arccos(np.clip((np.trace(relative) - 1.0) / 2.0, -1.0, 1.0)))
    if angle < 1e-9:
        return end.copy()
    skew = np.array([relative[2, 1] - relative[1, 2], relative[0, 2] - relative[2, 0], relative[1, 0] - relative[0, 1]])
    if np.linalg.norm(skew) < 1e-9:  # half a revolution: the axis is the eigenvector of eigenvalue 1
        values, vectors = np.linalg.eigh(0.5 * (relative + relative.T))
        axis = vectors[:, np.argmax(values)]
    else:
        axis = skew / np.linalg.norm(skew)
    return start @ about(axis, fraction * angle)


def about(axis: Array, angle: float) -> Array:
    """Rotation by an angle [rad] about a unit axis."""
    k = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k)


def rotation_vector(rotation: Array) -> Array:
    """Axis times angle of a rotation matrix by less than half a revolution [rad]."""
    vee = 0.5 * np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    sine = float(np.sqrt(vee @ vee))
    if sine < 1e-9:
        return vee
    trace = rotation[0, 0] + rotation[1, 1] + rotation[2, 2]
    return vee * (np.arctan2(sine, 0.5 * (trace - 1.0)) / sine)


def minimal_rotation(start: Array, goal: Array) -> Array:
    """The smallest rotation that takes one unit vector to another."""
    axis = np.cross(start, goal)
    cosine = float(start @ goal)
    skew = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + skew + skew @ skew / max(1.0 + cosine, 1e-9)


def quat_xyzw(rotations: Array) -> Array:
    """Unit quaternions (x, y, z, w), shape (n, 4), of rotations (n, 3, 3), without jumps of sign."""
    r = np.asarray(rotations, float)
    # The largest of the four squared components is at least 1/4: dividing by it is safe.
    trace = np.trace(r, axis1=1, axis2=2)
    squared = np.stack([1 + 2 * r[:, i, i] - trace for i in range(3)] + [1 + trace], axis=1) / 4.0
    products = np.empty((len(r), 4, 4))
    for i, j in ((0, 1), (0, 2), (1, 2)):
        products[:, i, j] = products[:, j, i] = (r[:, i, j] + r[:, j, i]) / 4.0
    for i, (j, k) in enumerate(((2, 1), (0, 2), (1, 0))):
        products[:, i, 3] = products[:, 3, i] = (r[:, j, k] - r[:, k, j]) / 4.0
    for i in range(4):
        products[:, i, i] = squared[:, i]
    best = np.argmax(squared, axis=1)
    quats = products[np.arange(len(r)), best]
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    for n in range(1, len(quats)):
        if np.dot(quats[n], quats[n - 1]) < 0.0:
            quats[n] *= -1.0
    return quats


def rotations_of(quats_xyzw: Array) -> Array:
    """Rotations (n, 3, 3) of unit quaternions (x, y, z, w), shape (n, 4)."""
    x, y, z, w = np.asarray(quats_xyzw, float).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def pose(rotation: Array, position: Array) -> Array:
    """Homogeneous transforms (..., 4, 4) of rotations (..., 3, 3) and positions (..., 3)."""
    position = np.asarray(position, float)
    result = np.zeros((*position.shape[:-1], 4, 4))
    result[..., :3, :3] = rotation
    result[..., :3, 3] = position
    result[..., 3, 3] = 1.0
    return result


def polygon_normal(outline: Array) -> Array:
    """Unit normal of a planar polygon (n, 3), counter-clockwise about it."""
    outline = np.asarray(outline, float)
    normal = np.cross(outline, np.roll(outline, -1, axis=0)).sum(axis=0)
    return np.asarray(normal / np.linalg.norm(normal))
