"""Still pictures of whole-body plans: film strips, and ghosted postures over one scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .colours import BODY, COM, FORCE, GROUND, TEXT, WALL, mix, rgb
from .planar_figure import Shape, end_colours, limbs_of, shapes_of, size_of
from .planar_ground import Slab, slabs_of
from .planar_samples import PlanarSamples, frame_times, sample_whole_body, turned
from .sheets import blank_sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan import WholeBodyPlan

Array = NDArray[np.float64]

#: Length of a force arrow as large as the weight, as a share of the robot's size.
WEIGHT_ARROW = 0.55
#: Radius of a friction cone, as a share of the robot's size.
CONE = 0.16
#: [1/s] sampling of paths, and of what a picture must hold.
RATE = 60.0


@dataclass(frozen=True)
class Drawing:
    """What all frames of a plan share."""

    plan: WholeBodyPlan
    size: float  # [m] of the robot
    weight: float  # [N]
    shapes: list[Shape]
    outlines_B: list[Array]
    colours: list[str]  # of the end-effectors
    path: PlanarSamples
    slabs: list[Slab]
    window: Array  # (2, 2) [m] low and high corner


def film_strip(
    plan: WholeBodyPlan,
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
        columns: Frames in a row; None: as many as there is room for.
        forces: Draw the contact forces at their points.
        cones: Draw the friction cones at the points in contact.
        width: Of the figure [inch].

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        ValueError: No frame, or an instant outside of the plan.
    """
    times = _instants(plan, frames)
    drawing = _drawing(plan)
    span = drawing.window[1] - drawing.window[0]
    if columns is None:
        columns = _columns(len(times), float(span[0] / span[1]), width)
    rows = -(-len(times) // columns)
    cell = width / columns
    height, band, line = cell * span[1] / span[0], 0.44, 0.27  # inches: a frame, the legend, the time below a frame
    total = rows * (height + line) + band
    sheet = blank_sheet("mcplan.view.film_strip", (width, total))
    samples = sample_whole_body(plan, np.array(times))
    for n, t in enumerate(times):
        row, column = divmod(n, columns)
        low = (total - row * (height + line) - height) / total
        axes = sheet.add_axes((column / columns + 0.004, low, 1.0 / columns - 0.008, height / total))
        _scene(axes, drawing)
        _trace(axes, drawing, until_s=t)
        if cones:
            _cones(axes, drawing, samples, n)
        _robot(axes, drawing, samples, n)
        if forces:
            _forces(axes, drawing, samples, n)
        _com(axes, drawing, samples, n)
        _close(axes, drawing)
        axes.text(0.5, -0.02, f"{t:.2f} s", transform=axes.transAxes, ha="center", va="top", fontsize=10, color=TEXT)
    _legend(sheet, drawing, forces, cones)
    return sheet


def stroboscope(
    plan: WholeBodyPlan,
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
        width: Of the figure [inch].

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        ValueError: No posture, or an instant outside of the plan.
    """
    times = _instants(plan, postures)
    drawing = _drawing(plan)
    span = drawing.window[1] - drawing.window[0]
    band = 0.44
    height = width * float(span[1] / span[0])
    if height > 7.5:
        width, height = 7.5 * width / height, 7.5
    sheet = blank_sheet("mcplan.view.stroboscope", (max(width, 6.0), height + band))
    axes = sheet.add_axes((0.0, band / (height + band), 1.0, height / (height + band)))
    samples = sample_whole_body(plan, np.array(times))
    _scene(axes, drawing)
    if cones:
        for n in range(samples.count):
            _cones(axes, drawing, samples, n, known=n)
    for n in range(samples.count):
        share = n / max(samples.count - 1, 1)
        _robot(axes, drawing, samples, n, fade=0.0 if n == samples.count - 1 else 0.78 - 0.33 * share)
    _trace(axes, drawing, until_s=times[-1])
    if forces:
        _forces(axes, drawing, samples, samples.count - 1)
    for n in range(samples.count):
        _com(axes, drawing, samples, n)
    _close(axes, drawing)
    _legend(sheet, drawing, forces, cones)
    return sheet


def _instants(plan: WholeBodyPlan, chosen: int | Sequence[float]) -> list[float]:
    plan.validate()
    last = float(plan.duration())
    if isinstance(chosen, int):
        if chosen < 1:
            raise ValueError(f"frames: must be at least 1, got {chosen}")
        return [float(t) for t in np.linspace(0.0, last, chosen)] if chosen > 1 else [0.0]
    times = [float(t) for t in chosen]
    if not times:
        raise ValueError("frames: must hold at least one instant, got none")
    for t in times:
        if not 0.0 <= t <= last + 1e-9:
            raise ValueError(f"frames: instants must lie in [0, {last:.6g}] s, got {t:g}")
    return times


def _drawing(plan: WholeBodyPlan) -> Drawing:
    robot = plan.motion.robot
    size = size_of(robot)
    shapes = shapes_of(robot)
    path = sample_whole_body(plan, frame_times(float(plan.duration()), RATE))
    outlines = [shape.outline_B() for shape in shapes]
    reached = np.vstack(
        [_moved(o, s.body, path, n) for o, s in zip(outlines, shapes, strict=True) for n in _some(path)]
    )
    thickness = 0.1 * size
    slabs = slabs_of(plan.motion, reached, 0.08 * size, thickness)
    ground = np.vstack([slab.outline_W for slab in slabs]) if slabs else reached
    seen = np.vstack([reached, ground, *_all_cones(plan, size)])
    low, high = seen.min(axis=0) - 0.02 * size, seen.max(axis=0) + 0.02 * size
    weight = float(robot.mass()) * float(robot.gravity)
    return Drawing(plan, size, weight, shapes, outlines, end_colours(robot), path, slabs, np.array([low, high]))


def _all_cones(plan: WholeBodyPlan, size: float) -> list[Array]:
    """Outlines (m, 2) [m] of the friction cones of all contacts, where they should be."""
    outlines = []
    for contact in (c for phase in plan.motion.phases for c in phase.contacts):
        surface = plan.motion.surfaces[contact.surface]
        wedge = cone_outline(float(surface.angle), float(surface.friction), CONE * size)
        along = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        points = plan.motion.robot.end_effectors[contact.end_effector].points
        outlines += [wedge + contact.position_W + float(p) * along for p in points]
    return outlines


def _some(path: PlanarSamples) -> NDArray[np.int64]:
    return np.unique(np.linspace(0, path.count - 1, min(path.count, 40)).astype(int))


def _moved(outline_B: Array, body: int, samples: PlanarSamples, n: int) -> Array:
    return samples.positions_W[n, body] + turned(np.full(len(outline_B), samples.angles[n, body]), outline_B)


def _columns(count: int, aspect: float, width: float) -> int:
    """Frames in a row: at least 1.9 inches wide and rows as even as can be."""
    most = max(1, int(width / max(1.3, 2.2 * aspect**0.5)))
    rows = -(-count // most)
    return -(-count // rows)


def _scene(axes: Any, drawing: Drawing) -> None:
    from matplotlib.patches import Polygon

    for slab in drawing.slabs:
        fill = mix(WALL if slab.is_wall else GROUND, "#ffffff", 0.45)
        edge = mix(TEXT, "#ffffff", 0.6)
        axes.add_patch(Polygon(slab.outline_W, facecolor=fill, edgecolor=edge, hatch="////", linewidth=0.0, zorder=1))
    for slab in drawing.slabs:
        axes.plot(*slab.front_W.T, color=TEXT, linewidth=1.3, solid_capstyle="butt", zorder=2)


def _robot(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int, fade: float = 0.0) -> None:
    from matplotlib.patches import Polygon

    for shape, outline in zip(drawing.shapes, drawing.outlines_B, strict=True):
        colour = mix(shape.colour, "#ffffff", fade)
        edge = mix(mix(shape.colour, TEXT, 0.45), "#ffffff", fade)
        corners = _moved(outline, shape.body, samples, n)
        axes.add_patch(Polygon(corners, facecolor=colour, edgecolor=edge, linewidth=0.7, joinstyle="round", zorder=4))


def _cones(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int, known: int = 0) -> None:
    """Friction cones at the points in contact; those that an earlier sample showed in the same place only once."""
    from matplotlib.patches import Polygon

    for end, point in np.argwhere(np.isfinite(samples.points_W[n, :, :, 0])):
        apex = samples.points_W[n, end, point]
        before = samples.points_W[:known, end, point]
        if known and np.any(np.linalg.norm(before - apex, axis=1) < 0.01 * drawing.size):
            continue
        surface = drawing.plan.motion.surfaces[int(samples.surfaces[n, end])]
        wedge = cone_outline(float(surface.angle), float(surface.friction), CONE * drawing.size)
        colour = drawing.colours[end]
        axes.add_patch(
            Polygon(
                apex + wedge, facecolor=(*rgb(colour), 0.16), edgecolor=(*rgb(colour), 0.55), linewidth=0.6, zorder=3
            )
        )


def cone_outline(angle: float, friction: float, radius: float) -> Array:
    """Sector (m, 2) [m] of the directions within a friction cone, its apex at the origin, on a surface at `angle`."""
    half = float(np.arctan(friction))
    turn = angle + 0.5 * np.pi + np.linspace(-half, half, 17)
    return np.vstack([np.zeros((1, 2)), radius * np.column_stack([np.cos(turn), np.sin(turn)])])


def _forces(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int) -> None:
    from matplotlib.patches import FancyArrow

    for end, point in np.argwhere(np.isfinite(samples.points_W[n, :, :, 0])):
        arrow = WEIGHT_ARROW * drawing.size / drawing.weight * samples.forces_W[n, end, point]
        length = float(np.linalg.norm(arrow))
        if length < 0.012 * drawing.size:
            continue
        head = min(0.07 * drawing.size, 0.6 * length)
        axes.add_patch(
            FancyArrow(
                *samples.points_W[n, end, point],
                *arrow,
                width=0.014 * drawing.size,
                head_width=0.7 * head,
                head_length=head,
                length_includes_head=True,
                facecolor=FORCE,
                edgecolor="white",
                linewidth=0.4,
                zorder=6,
            )
        )


def _trace(axes: Any, drawing: Drawing, until_s: float) -> None:
    gone = drawing.path.times_s <= until_s + 1e-9
    axes.plot(*drawing.path.com_W[gone].T, color=COM, linewidth=1.3, zorder=5)


def _com(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int) -> None:
    axes.plot(*samples.com_W[n], "o", color=COM, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6, zorder=7)


def _close(axes: Any, drawing: Drawing) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(drawing.window[:, 0])
    axes.set_ylim(drawing.window[:, 1])
    axes.set_axis_off()


def _legend(sheet: Figure, drawing: Drawing, forces: bool, cones: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    robot = drawing.plan.motion.robot
    limbs = {limb.colour: limb.name for limb in limbs_of(robot) if limb.colour in drawing.colours}
    entries: list[Any] = [Patch(color=colour, label=name.replace("_", " ")) for colour, name in limbs.items()]
    entries.append(Line2D([], [], color=COM, marker="o", markersize=4.5, linewidth=1.3, label="centre of mass"))
    if forces:
        name = f"contact force, {drawing.weight:.0f} N (the weight): {WEIGHT_ARROW * drawing.size:.2f} m"
        entries.append(Line2D([], [], color=FORCE, linewidth=1.6, marker=">", markevery=[1], label=name))
    if cones:
        entries.append(Patch(facecolor=(*rgb(BODY), 0.3), edgecolor=BODY, label="friction cone"))
    sheet.legend(
        handles=entries,
        loc="lower center",
        ncol=len(entries),
        frameon=False,
        fontsize=9.5,
        labelcolor=TEXT,
        handlelength=1.5,
        columnspacing=1.5,
        bbox_to_anchor=(0.5, 0.0),
        borderaxespad=0.3,
    )
