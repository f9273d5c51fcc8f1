"""What pages of planar robots say about their plane: axes, scale, names of surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.view.pages.annotations import Label, draw_axes, draw_scale
from mcplan.view.pages.overlay import entry, space_legend

from .drawing import GROUND_RIGHT, into_space, side_direction

if TYPE_CHECKING:
    from mcplan.view.stage import Stage

    from .ground import Slab

Array = NDArray[np.float64]

#: The plane's y is up; nothing happens across it.
PLANAR_AXES = ("x", "", "y")


def annotated_planar(stage: Stage, slabs: list[Slab], points_W: Array, size: float) -> tuple[Array, list[Label]]:
    """Put axes and a scale bar onto a page; the points (n, 3) [m] to be seen with it, and all labels.

    Args:
        stage: The page's.
        slabs: Its surfaces, whose names the labels carry.
        points_W: What it shows without, (n, 3) [m].
        size: Size of the robot [m].
    """
    scale, ends = draw_scale(stage, points_W, side_direction(), float(points_W[:, 2].min()))
    labels = [scale, *draw_axes(stage, points_W, PLANAR_AXES)]
    for slab in slabs:
        if len(slab.outline_W):
            middle = into_space(slab.outline_W, GROUND_RIGHT * size).mean(axis=0)
            labels.append(Label(slab.name, middle[None], "surface"))
    return np.vstack([points_W, ends]), labels


def planar_legend() -> list[str]:
    """Legend entries of axes, scale and names."""
    return [*space_legend(), entry(":surface", "text", "", "names of surfaces", shown=False)]


def corners_of(points: Array) -> Array:
    """Corners (4, 2) of the box around points (n, 2)."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([[x, y] for x in (low[0], high[0]) for y in (low[1], high[1])])
