"""What film strips and ghosted postures are painted with: ground, robot, cones, forces, on matplotlib's axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import BODY, COM, FORCE, GROUND, TEXT, WALL, mix, rgb
from mcplan.view.plan_drawing import WEIGHT_ARROW

from .figure import Shape, end_colours, limbs_of, shapes_of, size_of
from .ground import CONE, Slab, cone_outline, slabs_of
from .samples import PlanarSamples, frame_times, rotated, sample_whole_body

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan._core import PlanarPlan

Array = NDArray[np.float64]

#: [1/s] sampling of paths, and of what a picture must show.
RATE = 60.0


@dataclass(frozen=True)
class Drawing:
    """What all frames of a plan have in common."""

    plan: PlanarPlan
    size: float  # [m] of the robot
    weight: float  # [N]
    shapes: list[Shape]
    outlines_B: list[Array]
    colours: list[str]  # of the end-effectors
    path: PlanarSamples
    slabs: list[Slab]
    window: Array  # (2, 2) [m] low and high corner


def drawing_of(plan: PlanarPlan) -> Drawing:
    """Robot, ground and window of a plan, sampled once for all frames."""
    robot = plan.task.robot
    size = size_of(robot)
    shapes = shapes_of(robot)
    path = sample_whole_body(plan, frame_times(float(plan.duration()), RATE))
    outlines = [shape.outline_B() for shape in shapes]
    reached = np.vstack(
        [_moved(o, s.body, path, n) for o, s in zip(outlines, shapes, strict=True) for n in _some(path)]
    )
    thickness = 0.1 * size
    slabs = slabs_of(plan.task, reached, 0.08 * size, thickness)
    ground = np.vstack([slab.outline_W for slab in slabs]) if slabs else reached
    seen = np.vstack([reached, ground, *_all_cones(plan, size)])
    low, high = seen.min(axis=0) - 0.02 * size, seen.max(axis=0) + 0.02 * size
    weight = float(robot.mass()) * float(robot.gravity)
    return Drawing(plan, size, weight, shapes, outlines, end_colours(robot), path, slabs, np.array([low, high]))


def _all_cones(plan: PlanarPlan, size: float) -> list[Array]:
    """Outlines (m, 2) [m] of the friction cones of all contacts, where they should be."""
    outlines = []
    for contact in (c for phase in plan.task.phases for c in phase.contacts):
        surface = plan.task.surfaces[contact.surface]
        wedge = cone_outline(float(surface.angle), float(surface.friction), CONE * size)
        along = np.array([np.cos(contact.angle), np.sin(contact.angle)])
        points = plan.task.robot.end_effectors[contact.end_effector].points
        outlines += [wedge + contact.position_W + float(p) * along for p in points]
    return outlines


def _some(path: PlanarSamples) -> NDArray[np.int64]:
    return np.unique(np.linspace(0, path.count - 1, min(path.count, 40)).astype(int))


def _moved(outline_B: Array, body: int, samples: PlanarSamples, n: int) -> Array:
    return samples.positions_W[n, body] + rotated(np.full(len(outline_B), samples.angles[n, body]), outline_B)


def paint_ground(axes: Any, drawing: Drawing) -> None:
    """Solids hatched, surfaces as lines."""
    from matplotlib.patches import Polygon

    for slab in drawing.slabs:
        if not len(slab.outline_W):
            continue
        fill = mix(WALL if slab.is_wall else GROUND, "#ffffff", 0.45)
        edge = mix(TEXT, "#ffffff", 0.6)
        axes.add_patch(Polygon(slab.outline_W, facecolor=fill, edgecolor=edge, hatch="////", linewidth=0.0, zorder=1))
    for slab in drawing.slabs:
        axes.plot(*slab.front_W.T, color=TEXT, linewidth=1.3, solid_capstyle="butt", zorder=2)


def paint_robot(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int, fade: float = 0.0) -> None:
    """The robot at sample `n`, with a fraction `fade` of white."""
    from matplotlib.patches import Polygon

    for shape, outline in zip(drawing.shapes, drawing.outlines_B, strict=True):
        colour = mix(shape.colour, "#ffffff", fade)
        edge = mix(mix(shape.colour, TEXT, 0.45), "#ffffff", fade)
        corners = _moved(outline, shape.body, samples, n)
        axes.add_patch(Polygon(corners, facecolor=colour, edgecolor=edge, linewidth=0.7, joinstyle="round", zorder=4))


def paint_cones(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int, known: int = 0) -> None:
    """Friction cones at the points in contact; those that an earlier sample showed in the same place only once."""
    from matplotlib.patches import Polygon

    for end, point in np.argwhere(np.isfinite(samples.points_W[n, :, :, 0])):
        apex = samples.points_W[n, end, point]
        before = samples.points_W[:known, end, point]
        if known and np.any(np.linalg.norm(before - apex, axis=1) < 0.01 * drawing.size):
            continue
        surface = drawing.plan.task.surfaces[int(samples.surfaces[n, end])]
        wedge = cone_outline(float(surface.angle), float(surface.friction), CONE * drawing.size)
        colour = drawing.colours[end]
        axes.add_patch(
            Polygon(
                apex + wedge, facecolor=(*rgb(colour), 0.16), edgecolor=(*rgb(colour), 0.55), linewidth=0.6, zorder=3
            )
        )


def paint_forces(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int) -> None:
    """An arrow for the force at every point, from where it acts, along the force on the robot."""
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


def paint_path(axes: Any, drawing: Drawing, until_s: float) -> None:
    """Path of the CoM up to a time."""
    gone = drawing.path.times_s <= until_s + 1e-9
    axes.plot(*drawing.path.com_W[gone].T, color=COM, linewidth=1.3, zorder=5)


def paint_com(axes: Any, drawing: Drawing, samples: PlanarSamples, n: int) -> None:
    """The CoM at sample `n`."""
    axes.plot(*samples.com_W[n], "o", color=COM, markersize=4.5, markeredgecolor="white", markeredgewidth=0.6, zorder=7)


def frame(axes: Any, drawing: Drawing) -> None:
    """One window for all frames, equal axes, no ticks."""
    axes.set_aspect("equal")
    axes.set_xlim(drawing.window[:, 0])
    axes.set_ylim(drawing.window[:, 1])
    axes.set_axis_off()


def legend_entries(drawing: Drawing, forces: bool, cones: bool) -> list[Any]:
    """What the legend explains: limbs with end-effectors, the CoM, force arrows with their scale, cones."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    robot = drawing.plan.task.robot
    limbs = {limb.colour: limb.name for limb in limbs_of(robot) if limb.colour in drawing.colours}
    entries: list[Any] = [Patch(color=colour, label=name.replace("_", " ")) for colour, name in limbs.items()]
    entries.append(Line2D([], [], color=COM, marker="o", markersize=4.5, linewidth=1.3, label="centre of mass"))
    if forces:
        name = f"contact force, {drawing.weight:.0f} N (the weight): {WEIGHT_ARROW * drawing.size:.2f} m"
        entries.append(Line2D([], [], color=FORCE, linewidth=1.6, marker=">", markevery=[1], label=name))
    if cones:
        entries.append(Patch(facecolor=(*rgb(BODY), 0.3), edgecolor=BODY, label="friction cone"))
    return entries


def legend_rows(entries: list[Any], width: float) -> int:
    """Rows that a legend needs below a figure of this width [inch]."""
    lengths = [0.55 + 0.078 * len(entry.get_label()) for entry in entries]
    for rows in range(1, len(entries)):
        # Filled column by column; a column is as wide as its longest entry.
        if sum(max(lengths[i : i + rows]) for i in range(0, len(entries), rows)) < width:
            return rows
    return len(entries)


def add_legend(sheet: Figure, entries: list[Any], rows: int) -> None:
    """The legend at the lower edge of a figure."""
    sheet.legend(
        handles=entries,
        loc="lower center",
        ncol=-(-len(entries) // rows),
        frameon=False,
        fontsize=9.5,
        labelcolor=TEXT,
        handlelength=1.5,
        columnspacing=1.5,
        bbox_to_anchor=(0.5, 0.0),
        borderaxespad=0.3,
    )
