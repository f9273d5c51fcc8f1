"""The base as six coordinates, position and Z-Y-X angles, and as Pinocchio's free-flyer.

With R = Rz(rz) Ry(ry) Rx(rx) and the position p in the world: the free-flyer's velocity is (R^T p', omega_B), in the
base's axes, its acceleration the derivative of these six numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rotations(angles: Array) -> Array:
    """R (k, 3, 3) of angles (k, 3): rz, ry, rx [rad]."""
    (cz, cy, cx), (sz, sy, sx) = np.cos(angles).T, np.sin(angles).T
    rows = [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def quats_xyzw(angles: Array) -> Array:
    """Unit quaternions (k, 4) of angles (k, 3): the product of those about z, y and x, continuous where angles are."""
    (cz, cy, cx), (sz, sy, sx) = np.cos(0.5 * angles).T, np.sin(0.5 * angles).T
    return np.stack(
        [
            cz * cy * sx - sz * sy * cx,
            cz * sy * cx + sz * cy * sx,
            sz * cy * cx - cz * sy * sx,
            cz * cy * cx + sz * sy * sx,
        ],
        axis=1,
    )


def velocities(x: Array, dx: Array, ddx: Array) -> tuple[Array, Array]:
    """Velocity and acceleration (k, 6) of the free-flyer.

    Args:
        x: (k, 6) px, py, pz, rz, ry, rx.
        dx: Its first derivative.
        ddx: Its second derivative.
    """
    rotation = rotations(x[:, 3:])
    _, ry, rx = x[:, 3:].T
    dz, dy, dr = dx[:, 3:].T
    ddz, ddy, ddr = ddx[:, 3:].T
    cy, sy, cx, sx = np.cos(ry), np.sin(ry), np.cos(rx), np.sin(rx)
    omega = np.stack([dr - sy * dz, cx * dy + sx * cy * dz, -sx * dy + cx * cy * dz], axis=1)
    d_omega = np.stack(
        [
            ddr - sy * ddz - cy * dy * dz,
            cx * ddy - sx * dr * dy + sx * cy * ddz + (cx * cy * dr - sx * sy * dy) * dz,
            -sx * ddy - cx * dr * dy + cx * cy * ddz - (sx * cy * dr + cx * sy * dy) * dz,
        ],
        axis=1,
    )
    linear = np.einsum("kji,kj->ki", rotation, dx[:, :3])
    d_linear = np.einsum("kji,kj->ki", rotation, ddx[:, :3]) - np.cross(omega, linear)
    return np.hstack([linear, omega]), np.hstack([d_linear, d_omega])
