"""What a run that is laid out for rendering consists of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import FORCE_BRIGHT
from mcplan.view.figure import Figure
from mcplan.view.plan_drawing import WEIGHT_ARROW
from mcplan.view.scene_drawing import SurfaceDrawing

from .rendering import Arrow, Eye

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RunScene:
    """What pictures of a run are made from: n instants that may be drawn.

    Attributes:
        times_s: (n,).
        com_W: (n, 3) [m].
        reach_W: (n, k, 3) [m] points that a picture of an instant should show.
        figure: The robot at those instants.
        arrows: For each instant: contact forces, and the push.
        drawings: The terrain as simulated.
        footholds: Outlines of the planned contacts: segments (m, 2, 3) [m] and their colour.
        forward: (2,) unit vector of travel.
        sun_W: (3,) from the scene towards the light.
        height_m: Height of the CoM in the nominal stance, by which distances are scaled.
    """

    times_s: Array
    com_W: Array
    reach_W: Array
    figure: Figure
    arrows: list[list[Arrow]]
    drawings: list[SurfaceDrawing]
    footholds: list[tuple[Array, str]]
    forward: Array
    sun_W: Array
    height_m: float

    def nearest(self, time_s: float) -> int:
        """Index of the instant nearest to a time."""
        return int(np.argmin(np.abs(self.times_s - time_s)))

    def eye(self, target_W: Array, distance_m: float, ahead: float = 0.45) -> Eye:
        """From the right of the path; `ahead` 0: square to it, 1: by 45 degrees from ahead."""
        left = np.array([-self.forward[1], self.forward[0]])
        towards = left - ahead * self.forward
        azimuth = float(np.degrees(np.arctan2(towards[1], towards[0])))
        return Eye(np.asarray(target_W, float), distance_m, azimuth, -12.0)


def force_arrow(start_W: Array, force_W: Array, weight_N: float, height_m: float) -> list[Arrow]:
    """The arrow of a contact force; none for one of less than a hundredth of the weight."""
    if not np.linalg.norm(force_W) > 0.01 * weight_N:  # NaN: no contact
        return []
    tip = start_W + WEIGHT_ARROW * height_m * force_W / weight_N
    return [Arrow(start_W, tip, FORCE_BRIGHT, 0.012 * height_m)]
