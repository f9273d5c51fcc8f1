"""Pages of plans and scenes."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.loads import loads_of
from mcplan.kinematics.samples import sample
from mcplan.view.colours import GOAL, NORMAL, START, end_effector_colours
from mcplan.view.extent import extent_of, require_drawable, scale_of, scale_of_scene
from mcplan.view.figure_choice import figure_of
from mcplan.view.plan_drawing import WEIGHT_ARROW, draw_plan
from mcplan.view.scene_drawing import SurfaceDrawing, draw_surfaces, surface_drawings
from mcplan.view.stage import Stage
from mcplan.view.viewpoint import camera_direction, sun_direction, view_points

from .annotations import Label, draw_axes, draw_normals, draw_scale, surface_labels
from .overlay import Bars, caption, entry, plan_legend, scene_legend, space_legend, timeline
from .page import Page
from .stances import draw_stances

if TYPE_CHECKING:
    from mcplan._core import Plan, Report, Robot, Scene

Array = NDArray[np.float64]

#: [1/s] frames of the animation; the browser blends between them.
FRAME_RATE = 30.0


def show(plan: Plan, scene: Scene | None = None, robot: Robot | None = None, report: Report | None = None) -> Page:
    """Draw a plan for the browser.

    Args:
        plan: The plan.
        scene: Drawn around it; None: the plan's own.
        robot: Drawn along it; None: the plan's own. With a URDF its meshes follow the plan by inverse
            kinematics; without, or when no posture follows it within 5 cm (a warning says so), it is a stick
            robot.
        report: Named in the caption.

    Raises:
        MissingExtra: meshcat (or Pinocchio, for a robot with a URDF) is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        InvalidScene: A surface has no vertices, or a position is no number.
        InvalidRobot: A number of the robot is out of its range.
    """
    if scene is not None or robot is not None:
        plan = copy.copy(plan)
        plan.scene = scene if scene is not None else plan.scene
        plan.robot = robot if robot is not None else plan.robot
    scene, robot = plan.scene, plan.robot
    require_drawable(scene)
    robot.validate()
    plan.validate()  # with what it is drawn with: another robot may have other end-effectors
    colours = end_effector_colours(robot)
    samples = sample(plan, scene, robot, FRAME_RATE)
    extent = extent_of(scene, robot, samples, length=0.6, width=0.6)
    drawings = surface_drawings(scene, extent)
    stage = Stage(scale_of(robot))
    draw_surfaces(stage, drawings)
    draw_plan(stage, samples, scene, robot, figure_of(samples, robot, colours), colours)
    phases = len(plan.phases)
    lines = [f"{robot.name}: {phases} phases, {samples.times_s[-1]:.2f} s"]
    loads = loads_of(plan)
    if loads is not None:
        swing = loads.angular_momentum
        momentum = f"{swing:.1f}" if 0.1 <= swing < 1e4 else f"{swing:.3g}"
        lines.append(f"angular momentum up to {momentum} kg m²/s")
    if report is not None:
        lines.append(f"{report.status}: {report.iterations} iterations, {report.time_s:.2f} s of planning")
    newton_per_metre = float(robot.mass) * float(scene.gravity) / (WEIGHT_ARROW * float(robot.com_height))
    legend = plan_legend(scene, robot, colours, newton_per_metre)
    overlay = caption(scene.name, lines, legend) + timeline(
        scene, robot, Bars(samples.intervals), colours, float(samples.times_s[-1])
    )
    points, labels = annotated(stage, drawings, view_points(drawings, samples, robot), camera_direction(extent))
    return Page(
        title=f"{scene.name}, {robot.name}",
        payload=stage.payload(),
        overlay=overlay,
        points_W=points,
        direction_W=camera_direction(extent),
        sun_W=sun_direction(extent),
        duration_s=float(samples.times_s[-1]),
        knots_s=plan.knot_times(),
        labels=labels,
    )


def annotated(
    stage: Stage, drawings: list[SurfaceDrawing], points_W: Array, direction_W: Array
) -> tuple[Array, list[Label]]:
    """Put world axes and a scale bar onto a page; the points (n, 3) [m] to be seen with it, and all labels.

    Args:
        stage: The page's.
        drawings: Its surfaces, whose names the labels carry.
        points_W: What it shows without, (n, 3) [m].
        direction_W: From the drawing towards the camera.
    """
    floor = float(points_W[:, 2].min())
    scale, ends = draw_scale(stage, points_W, direction_W, floor)
    labels = [scale, *draw_axes(stage, points_W), *surface_labels(drawings, direction_W)]
    return np.vstack([points_W, ends]), labels


def show_scene(scene: Scene, robot: Robot | None = None) -> Page:
    """Draw a scene for the browser: surfaces with their names and outward normals, the axes of the world, a scale bar,
    start and goal.

    Args:
        scene: The scene.
        robot: Stands at the start, and pale at the goal, with its footprints; None: flags at start and goal alone.

    Raises:
        InvalidScene: The robot cannot take the scene's start or goal; a surface has no vertices, or a position is no number.
        InvalidRobot: A number of the robot is out of its range.
        MissingExtra: meshcat is not installed.
    """
    require_drawable(scene)
    if robot is not None:
        robot.validate()
    extent = extent_of(scene, robot, None, length=0.9, width=0.9)
    direction = camera_direction(extent)
    drawings = surface_drawings(scene, extent)
    stage = Stage(scale_of_scene(scene, robot))
    draw_surfaces(stage, drawings)
    outlines = [d.mesh.vertices for d in drawings]
    stood = [np.asarray([stance.position_W], float) for stance in (scene.start, scene.goal)]
    spread = np.ptp(np.vstack([*(d.outline for d in drawings), *stood]), axis=0)
    standing, marks = draw_stances(stage, scene, robot, float(np.linalg.norm(spread)) or 1.0)
    points = np.vstack([*outlines, standing])
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    near = min(0.05 * size, 0.2 * scale_of_scene(scene, robot))
    draw_normals(stage, drawings, near)
    points, labels = annotated(stage, drawings, points, direction)
    lines = [scene.description] if scene.description else []
    count = len(scene.surfaces)
    lines.append(f"{count} surface{'' if count == 1 else 's'}")
    if len(drawings) < count:
        lines[-1] += f", {count - len(drawings)} of them out of the picture"
    legend = [
        entry("stances/start marks/start :start", "", START, "start"),
        entry("stances/goal marks/goal :goal", "", GOAL, "goal"),
        entry("normals", "line", NORMAL, "outward normals"),
        entry(":surface", "text", "", "names of surfaces"),
        *space_legend(),
        *scene_legend(scene),
    ]
    return Page(
        title=scene.name,
        payload=stage.payload(),
        overlay=caption(scene.name, lines, legend),
        points_W=points,
        direction_W=direction,
        sun_W=sun_direction(extent),
        duration_s=0.0,
        labels=[*marks, *labels],
    )
