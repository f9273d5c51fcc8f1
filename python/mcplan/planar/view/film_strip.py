"""Still pictures of whole-body plans: film strips, and ghosted postures over one scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.view.colours import TEXT
from mcplan.view.sheets import blank_sheet

from .picture import (
    add_legend,
    drawing_of,
    frame,
    legend_entries,
    legend_rows,
    paint_com,
    paint_cones,
    paint_forces,
    paint_ground,
    paint_path,
    paint_robot,
)
from .samples import sample_whole_body

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import PlanarPlan

#: [inch] height that a picture of postures may have.
TALLEST = 7.5


def film_strip(
    plan: PlanarPlan,
    frames: int | Sequence[float] = 8,
    columns: int | None = None,
    forces: bool = True,
    cones: bool = True,
    width: float = 12.0,
) -> Figure:
    """The robot at several instants, side by side at one scale, with the time under each frame.

    Args:
        plan: The plan.
        frames: Number of instants, equally spaced from start to end, or the instants [s].
        columns: Number of frames in a row; None: as many as there is space for.
        forces: Draw the contact forces at their points.
        cones: Draw the friction cones at the points in contact.
        width: Width of the figure [inch].

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        InvalidInput: No frame, or an instant outside of the plan.
    """
    require("mcplan.planar.view.film_strip", "view", "matplotlib")
    times = _instants(plan, "frames", frames)
    drawing = drawing_of(plan)
    span = drawing.window[1] - drawing.window[0]
    if columns is None:
        columns = _columns(len(times), float(span[0] / span[1]), width)
    rows = -(-len(times) // columns)
    cell = width / columns
    entries = legend_entries(drawing, forces, cones)
    lines = legend_rows(entries, width)
    # inches: a frame, the time below it, the legend
    height, line, band = cell * float(span[1] / span[0]), 0.27, 0.20 + 0.24 * lines
    total = rows * (height + line) + band
    sheet = blank_sheet((width, total))
    samples = sample_whole_body(plan, np.array(times))
    for n, t in enumerate(times):
        row, column = divmod(n, columns)
        low = (total - row * (height + line) - height) / total
        axes = sheet.add_axes((column / columns + 0.004, low, 1.0 / columns - 0.008, height / total))
        paint_ground(axes, drawing)
        paint_path(axes, drawing, until_s=t)
        if cones:
            paint_cones(axes, drawing, samples, n)
        paint_robot(axes, drawing, samples, n)
        if forces:
            paint_forces(axes, drawing, samples, n)
        paint_com(axes, drawing, samples, n)
        frame(axes, drawing)
        axes.text(0.5, -0.02, f"{t:.2f} s", transform=axes.transAxes, ha="center", va="top", fontsize=10, color=TEXT)
    add_legend(sheet, entries, lines)
    return sheet


def stroboscope(
    plan: PlanarPlan,
    postures: int | Sequence[float] = 6,
    forces: bool = True,
    cones: bool = True,
    width: float = 10.0,
) -> Figure:
    """Postures of the robot over one scene: earlier ones pale, the last in full colour with its forces.

    Args:
        plan: The plan.
        postures: Number of instants, equally spaced from start to end, or the instants [s].
        forces: Draw the contact forces of the last posture at their points.
        cones: Draw the friction cones at all points that are in contact at an instant drawn.
        width: Width of the figure [inch].

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        InvalidInput: No posture, or an instant outside of the plan.
    """
    require("mcplan.planar.view.stroboscope", "view", "matplotlib")
    times = _instants(plan, "postures", postures)
    drawing = drawing_of(plan)
    span = drawing.window[1] - drawing.window[0]
    height = width * float(span[1] / span[0])
    if height > TALLEST:
        width, height = max(TALLEST * width / height, 5.0), TALLEST
    entries = legend_entries(drawing, forces, cones)
    lines = legend_rows(entries, width)
    band = 0.20 + 0.24 * lines
    sheet = blank_sheet((width, height + band))
    axes = sheet.add_axes((0.0, band / (height + band), 1.0, height / (height + band)))
    samples = sample_whole_body(plan, np.array(times))
    paint_ground(axes, drawing)
    if cones:
        for n in range(samples.count):
            paint_cones(axes, drawing, samples, n, known=n)
    for n in range(samples.count):
        fraction = n / max(samples.count - 1, 1)
        paint_robot(axes, drawing, samples, n, fade=0.0 if n == samples.count - 1 else 0.78 - 0.33 * fraction)
    paint_path(axes, drawing, until_s=times[-1])
    if forces:
        paint_forces(axes, drawing, samples, samples.count - 1)
    for n in range(samples.count):
        paint_com(axes, drawing, samples, n)
    frame(axes, drawing)
    add_legend(sheet, entries, lines)
    return sheet


def _instants(plan: PlanarPlan, name: str, chosen: int | Sequence[float]) -> list[float]:
    plan.validate()
    last = float(plan.duration())
    if isinstance(chosen, int):
        if chosen < 1:
            raise InvalidInput(name, "must be at least 1", str(chosen))
        return [float(t) for t in np.linspace(0.0, last, chosen)]
    times = [float(t) for t in chosen]
    if not times:
        raise InvalidInput(name, "needs at least one instant", "none")
    for i, t in enumerate(times):
        if not 0.0 <= t <= last + 1e-9:
            raise InvalidInput(f"{name}[{i}]", f"must lie in the plan, from 0 to {last:.6g} s", f"{t:g}")
    return times


def _columns(count: int, aspect: float, width: float) -> int:
    """Number of frames in a row: wide enough to be read, and rows as even as can be."""
    max_columns = max(1, int(width / max(1.3, 2.2 * aspect**0.5)))
    rows = -(-count // max_columns)
    return -(-count // rows)
