"""Where pages and pictures are seen from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import Samples

from .extent import SMALL, Extent, scale_of
from .scene_drawing import SurfaceDrawing

if TYPE_CHECKING:
    from mcplan._core import Robot

Array = NDArray[np.float64]


def view_points(drawings: list[SurfaceDrawing], samples: Samples, robot: Robot) -> Array:
    """Points (n, 3) [m] that a picture of a plan must show: motion, heads, small surfaces near it."""
    above = np.array([0.0, 0.0, 0.95 * float(robot.com_height)])
    motion = [samples.com_W + above, samples.positions_W.reshape(-1, 3)]
    low, high = np.vstack(motion).min(axis=0), np.vstack(motion).max(axis=0)
    scale = scale_of(robot)
    # Large surfaces may run out of the picture; the robot's contacts may not.
    small = [d.outline for d in drawings if np.ptp(d.outline, axis=0).max() < SMALL * scale]
    near = [
        p
        for p in (np.vstack(small) if small else np.zeros((0, 3)))
        if np.all(p > low - scale) and np.all(p < high + scale)
    ]
    margin = scale * np.array([[-0.35, 0.0, 0.0], [0.35, 0.0, 0.0], [0.0, -0.35, 0.0], [0.0, 0.35, 0.0]])
    floor = (samples.positions_W[[0, -1]].reshape(-1, 1, 3) + margin).reshape(-1, 3)
    return np.vstack([*motion, floor, *[p[None] for p in near]])


def camera_direction(extent: Extent) -> Array:
    """From the right of the path and a little ahead: it runs from left to right, and faces are seen."""
    return np.append(-1.0 * extent.left + 0.16 * extent.forward, 0.34)


def sun_direction(extent: Extent) -> Array:
    """From the drawing towards the light, (3,): over the camera's shoulder."""
    return np.append(-0.55 * extent.left + 0.45 * extent.forward, 1.3)
