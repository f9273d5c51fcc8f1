"""One still picture of a plan: scene, paths and the robot at several instants. Needs no browser."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot, MissingExtra, SimplerDrawing
from mcplan.extras import require
from mcplan.kinematics.rotations import pose, with_axis_z
from mcplan.kinematics.samples import Samples, sample
from mcplan.view.coarse import coarse
from mcplan.view.colours import COM, FORCE, GRASP, OUTLINE, PAD, TEXT, end_effector_colours, mix, plain, rgb
from mcplan.view.extent import extent_of, require_drawable
from mcplan.view.figure import Figure
from mcplan.view.figure_choice import figure_of
from mcplan.view.plan_drawing import WEIGHT_ARROW, contact_plate
from mcplan.view.robot_stick import stick_robot
from mcplan.view.scene_drawing import SurfaceDrawing, edges, for_hands, surface_drawings
from mcplan.view.shapes import cone, ellipsoid
from mcplan.view.sheets import save_figure
from mcplan.view.viewpoint import camera_direction, sun_direction, view_points
from mcplan.view.winding import both_sides

from .canvas import Canvas, Paint

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot, Scene

Array = NDArray[np.float64]

#: Smallest details of meshes that are drawn, in CoM heights.
CELL = 0.012
#: Displacement of the CoM between two postures: at least so many CoM heights, and so many lengths of the stance, that of
#: a robot on four feet, whose trunks would cover each other otherwise.
SPACING, SPACING_STANCE = 0.5, 1.5
#: The lightest colour of a link, as a share of white: the paper is white, and lit from above a white link is as well.
LIGHTEST = 0.78
#: Share of white in the first posture, whose links are shaded as well.
PALEST = 0.62
#: Layers of the canvas, back to front.
SOLIDS, LINES, MARKS, BODIES, FORCES, COM_PATH = range(1, 7)


def picture(
    plan: Plan,
    scene: Scene | None = None,
    robot: Robot | None = None,
    path: str | Path = "plan.png",
    poses: int | None = None,
    meshes: bool = True,
) -> Path:
    """Write a PNG of a plan.

    Args:
        plan: The plan.
        scene: Drawn around it; None: the plan's own.
        robot: Drawn along it; None: the plan's own.
        path: File to write.
        poses: Number of postures drawn, at equal displacements of the CoM; None: as many as there is space for.
        meshes: Draw a robot with a URDF with its meshes, as ``show`` does, and as a stick robot where a warning says why
            they cannot be; False: always as a stick robot.

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        InvalidScene: A surface has no vertices, or a position is no number.
        InvalidRobot: A number of the robot is out of its range.
    """
    require("mcplan.view.picture", "view", "matplotlib")
    scene = scene if scene is not None else plan.scene
    robot = robot if robot is not None else plan.robot
    require_drawable(scene)
    robot.validate()
    plan.validate()
    colours = end_effector_colours(robot)
    samples = sample(plan, scene, robot, 60.0)
    figure = _figure(samples, robot, colours) if meshes else stick_robot(samples, robot, colours)
    return paint(scene, robot, samples, figure, path, poses)


def paint(
    scene: Scene, robot: Robot, samples: Samples, figure: Figure, path: str | Path, poses: int | None = None
) -> Path:
    """Write a picture of a robot in a scene.

    Args:
        scene: Its surfaces.
        robot: Its end-effectors.
        samples: Paths, contacts and forces.
        figure: The robot at each sample.
        path: File to write.
        poses: Number of postures drawn, at equal displacements of the CoM; None: as many as there is space for.
    """
    colours = end_effector_colours(robot)
    extent = extent_of(scene, robot, samples, length=0.45, width=0.45)
    drawings = surface_drawings(scene, extent)
    chosen = pose_indices(samples, robot, poses)
    points = np.vstack([view_points(drawings, samples, robot), *(figure.points_W(n) for n in chosen)])
    canvas = Canvas(points, camera_direction(extent), sun_direction(extent))
    _paint_surfaces(canvas, drawings)
    _paint_plan(canvas, samples, robot, colours)
    shown = _Shown(canvas, figure, samples, robot, float(robot.mass) * float(scene.gravity))
    for rank, n in enumerate(chosen):
        # The past is pale; the last posture has full colour.
        fade = PALEST * (1.0 - rank / max(len(chosen) - 1, 1)) ** 0.8
        _paint_robot(shown, n, fade)
    sheet = _sheet(canvas, points, [drawing.mesh.vertices for drawing in drawings])
    _legend(sheet, scene, robot, colours)
    return save_figure(sheet, path)


def _sheet(canvas: Canvas, points: Array, solids: list[Array]) -> Any:
    """A figure of matplotlib with what the canvas has: the points, and solids that reach a little beyond."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Sheet

    flat, _ = canvas.project(np.vstack([points, *solids]))
    need, _ = canvas.project(points)
    low, high = need.min(axis=0), need.max(axis=0)
    # Solids that reach a little beyond what must be seen are shown whole.
    low = np.maximum(flat.min(axis=0), low - 0.25 * (high - low)) - 0.04
    high = np.minimum(flat.max(axis=0), high + 0.25 * (high - low)) + 0.04
    width = 11.0
    height = width * float((high[1] - low[1]) / (high[0] - low[0]))
    band = 0.42  # inches for the legend
    sheet = Sheet(figsize=(width, height + band), dpi=150, facecolor="white")
    FigureCanvasAgg(sheet)
    axes = sheet.add_axes((0.0, band / (height + band), 1.0, height / (height + band)))
    canvas.paint(axes)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    return sheet


def pose_indices(samples: Samples, robot: Robot, poses: int | None = None) -> list[int]:
    """Samples at which the robot is drawn: first, last, and at equal displacements of the CoM between."""
    displacement = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(samples.com_W, axis=0), axis=1))])
    if poses is None:
        poses = int(np.clip(round(displacement[-1] / _spacing(robot)) + 1, 2, 9))
    return sorted(
        {
            int(np.argmin(np.abs(displacement - fraction * displacement[-1])))
            for fraction in np.linspace(0.0, 1.0, poses)
        }
    )


def _spacing(robot: Robot) -> float:
    """Displacement [m] between two postures that can be told apart."""
    along = [float(end.nominal_B[0]) for end in robot.end_effectors if end.kind == "foot"] or [0.0]
    return max(SPACING * float(robot.com_height), SPACING_STANCE * (max(along) - min(along)))


def _off_white(colour: str) -> str:
    """The colour, or a grey as light as can be told from the paper in its place."""
    lightness = float(np.dot(rgb(colour), [0.299, 0.587, 0.114]))
    return mix(colour, "#000000", 1.0 - LIGHTEST / lightness) if lightness > LIGHTEST else colour


def _figure(samples: Samples, robot: Robot, colours: list[str]) -> Figure:
    """The robot with its meshes, as coarse as the picture allows, or as a stick robot."""
    try:
        figure = figure_of(samples, robot, colours)
    except (InvalidRobot, MissingExtra) as found:
        warnings.warn(f"{found}; drawing a stick robot instead", SimplerDrawing, stacklevel=3)
        return stick_robot(samples, robot, colours)
    return figure if figure.kind == "stick" else coarse_figure(figure, robot)


def coarse_figure(figure: Figure, robot: Robot) -> Figure:
    """The robot with meshes as coarse as the picture allows."""
    cell_m = CELL * float(robot.com_height)
    return replace(figure, parts=[replace(part, mesh=both_sides(coarse(part.mesh, cell_m))) for part in figure.parts])


def _paint_surfaces(canvas: Canvas, drawings: list[SurfaceDrawing]) -> None:
    for drawing in drawings:
        # Ground lies below a robot; pads and walls may be before or behind a limb.
        floor = drawing.normal[2] > 0.3 and drawing.colour not in (GRASP, PAD)
        layer = SOLIDS if floor else BODIES
        opacity = 1.0 if floor else max(drawing.opacity, 0.3)
        canvas.mesh(drawing.mesh, Paint(drawing.colour, opacity), layer)
        rim = edges(drawing)[: len(drawing.outline)]
        canvas.segments(rim, mix(OUTLINE, "#ffffff", 0.3), 0.004, LINES if floor else BODIES)
        canvas.segments(drawing.grid, mix(drawing.colour, "#ffffff", 0.6), 0.004, LINES)


def _paint_plan(canvas: Canvas, samples: Samples, robot: Robot, colours: list[str]) -> None:
    scale = float(robot.com_height) / 0.7
    for interval in samples.intervals:
        mark = contact_plate(robot, interval.end_effector).moved(pose(interval.rotation_W, interval.position_W))
        up = interval.rotation_W[2, 2] > 0.3
        canvas.mesh(
            mark,
            Paint(mix(colours[interval.end_effector], "#ffffff", 0.25)),
            MARKS if up else BODIES,
            lift=0.0 if up else 0.05,
        )
    for end, colour in enumerate(colours):
        canvas.line(samples.positions_W[:, end], colour, 0.011 * scale, BODIES)
    canvas.line(samples.com_W, COM, 0.024 * scale, COM_PATH)


@dataclass(frozen=True)
class _Shown:
    """What is painted along a plan, and the robot's weight [N]."""

    canvas: Canvas
    figure: Figure
    samples: Samples
    robot: Robot
    weight: float


def _paint_robot(shown: _Shown, n: int, fade: float) -> None:
    canvas, figure, samples, robot = shown.canvas, shown.figure, shown.samples, shown.robot
    scale = float(robot.com_height) / 0.7
    for part in figure.parts:
        paint = Paint(part.colour if figure.kind == "stick" else _off_white(part.colour), fade=fade)
        canvas.mesh(part.mesh.moved(part.poses[n]), paint, BODIES, whole=figure.kind == "stick")
    ball = ellipsoid((0.030 * scale,) * 3).moved(pose(np.eye(3), samples.com_W[n]))
    canvas.mesh(ball, Paint(COM), COM_PATH, whole=True, lift=0.1)
    _paint_forces(shown, n, fade)


def _paint_forces(shown: _Shown, n: int, fade: float) -> None:
    """Arrows from the centres of pressure; over links they have a light rim, so that links as dark do not hide them."""
    canvas, samples, robot = shown.canvas, shown.samples, shown.robot
    over_links = shown.figure.kind != "stick"
    scale = float(robot.com_height) / 0.7
    layer = FORCES if over_links else BODIES
    for end in range(len(robot.end_effectors)):
        force = samples.forces_W[n, end]
        size = float(np.linalg.norm(force))
        length = WEIGHT_ARROW * float(robot.com_height) * size / shown.weight
        if length < 0.05 * scale:
            continue
        direction = force / size
        head = min(0.055 * scale, 0.5 * length)
        start = samples.pressure_W[n, end]
        shaft = np.linspace(start, start + (length - head) * direction, 6)
        tip = pose(with_axis_z(direction, np.array([1.0, 0.0, 0.0])), shaft[-1])
        if over_links:
            canvas.line(shaft, "#ffffff", 0.026 * scale, layer, lift=0.15)
            canvas.mesh(cone(0.034 * scale, 1.35 * head).moved(tip), Paint(FORCE, fade=1.0), layer, lift=0.15)
        canvas.line(shaft, mix(FORCE, "#ffffff", fade), 0.012 * scale, layer, lift=0.2 if over_links else 0.15)
        canvas.mesh(
            cone(0.022 * scale, head).moved(tip), Paint(FORCE, fade=fade), layer, lift=0.2 if over_links else 0.15
        )


def _legend(sheet, scene: Scene, robot: Robot, colours: list[str]) -> None:  # type: ignore[no-untyped-def]
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    entries: list[Line2D | Patch] = [Line2D([], [], color=COM, linewidth=4, label="centre of mass")]
    for end, colour in zip(robot.end_effectors, colours, strict=True):
        entries.append(Line2D([], [], color=colour, linewidth=2.2, label=plain(end.name)))
    entries.append(Line2D([], [], color=FORCE, linewidth=1.6, marker=">", markevery=[1], label="contact force"))
    if any(s.grasp for s in scene.surfaces):
        entries.append(Patch(color=GRASP, label="may be held"))
    entries += [Patch(color=colour, label=text) for _, colour, text in for_hands(scene)]
    sheet.legend(
        handles=entries,
        loc="lower center",
        ncol=len(entries),
        frameon=False,
        fontsize=11,
        labelcolor=TEXT,
        handlelength=1.5,
        columnspacing=1.6,
        bbox_to_anchor=(0.5, 0.0),
    )
