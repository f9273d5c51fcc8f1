"""Pages of plans and scenes."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from mcplan._core import WholeBodyPlan
from mcplan.errors import InvalidInput
from mcplan.kinematics.loads import loads_of
from mcplan.kinematics.samples import Samples, sample, stance_samples

from .colours import end_effector_colours
from .extent import extent_of
from .figure import Figure
from .overlay import caption, plan_legend, scene_legend, timeline
from .page import Page
from .plan_drawing import WEIGHT_ARROW, draw_plan, draw_standing
from .robot_stick import stick_robot
from .scene_drawing import draw_surfaces, surface_drawings
from .show_whole_body import show_whole_body
from .stage import Stage
from .viewpoint import camera_direction, sun_direction, view_points

if TYPE_CHECKING:
    from mcplan import Plan, Report, Robot, Scene

#: [1/s] frames of the animation; the browser blends between them.
FRAME_RATE = 30.0


def show(
    plan: Plan | WholeBodyPlan, scene: Scene | None = None, robot: Robot | None = None, report: Report | None = None
) -> Page:
    """Draw a plan for the browser.

    Args:
        plan: The plan; a whole-body plan brings its ground and its robot along, and takes no others.
        scene: Drawn around it; None: the plan's own.
        robot: Drawn along it; None: the plan's own. With a URDF its meshes follow the plan by inverse
            kinematics; without, or when no posture follows it within 5 cm (a warning says so), it is a stick
            robot.
        report: Named in the caption.

    Raises:
        MissingExtra: meshcat (or Pinocchio, for a robot with a URDF) is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        InvalidInput: A scene or a robot for a whole-body plan.
    """
    if isinstance(plan, WholeBodyPlan):
        for name, given in (("scene", scene), ("robot", robot)):
            if given is not None:
                raise InvalidInput(name, "a whole-body plan is drawn with its own motion", repr(given.name))
        return show_whole_body(plan, report)
    scene = scene if scene is not None else plan.scene
    robot = robot if robot is not None else plan.robot
    plan.validate()
    colours = end_effector_colours(robot)
    samples = sample(plan, scene, robot, FRAME_RATE)
    extent = extent_of(scene, robot, samples, length=0.6, width=0.6)
    drawings = surface_drawings(scene, extent)
    stage = Stage()
    draw_surfaces(stage, drawings)
    draw_plan(stage, samples, scene, robot, figure_of(samples, robot, colours), colours)
    phases = len(plan.phases)
    lines = [f"{robot.name}: {phases} phases, {samples.times_s[-1]:.2f} s"]
    loads = loads_of(plan)
    if loads is not None:
        lines.append(f"angular momentum up to {loads.angular_momentum:.1f} kg m²/s")
    if report is not None:
        lines.append(f"{report.status}: {report.iterations} iterations, {report.time_s:.2f} s of planning")
    newton_per_metre = float(robot.mass) * float(scene.gravity) / (WEIGHT_ARROW * float(robot.com_height))
    legend = plan_legend(scene, robot, colours, newton_per_metre)
    overlay = caption(scene.name, lines, legend) + timeline(
        scene, robot, samples.intervals, colours, float(samples.times_s[-1])
    )
    return Page(
        title=f"{scene.name}, {robot.name}",
        payload=stage.payload(),
        overlay=overlay,
        points_W=view_points(drawings, samples, robot),
        direction_W=camera_direction(extent),
        sun_W=sun_direction(extent),
        duration_s=float(samples.times_s[-1]),
    )


def show_scene(scene: Scene, robot: Robot | None = None) -> Page:
    """Draw a scene for the browser; a robot, if given, stands at the start, and pale at the goal.

    Raises:
        InvalidScene: The robot cannot take the scene's start or goal.
        MissingExtra: meshcat is not installed.
    """
    extent = extent_of(scene, robot, None, length=0.9, width=0.9)
    from mcplan._core import resolve_stance

    drawings = surface_drawings(scene, extent)
    stage = Stage()
    draw_surfaces(stage, drawings)
    points = [d.mesh.vertices for d in drawings]
    if robot is not None:
        colours = end_effector_colours(robot)
        for name, stance, opacity in (("start", scene.start, 1.0), ("goal", scene.goal, 0.35)):
            standing = stance_samples(scene, robot, resolve_stance(scene, robot, stance, name))
            draw_standing(stage, name, standing, figure_of(standing, robot, colours), opacity)
            head = np.array([0.0, 0.0, 0.95 * float(robot.com_height)])
            points += [standing.com_W + head, standing.positions_W[0]]
    lines = [scene.description] if scene.description else []
    count = len(scene.surfaces)
    lines.append(f"{count} surface{'' if count == 1 else 's'}")
    return Page(
        title=scene.name,
        payload=stage.payload(),
        overlay=caption(scene.name, lines, scene_legend(scene)),
        points_W=np.vstack(points),
        direction_W=camera_direction(extent),
        sun_W=sun_direction(extent),
        duration_s=0.0,
    )


def figure_of(samples: Samples, robot: Robot, colours: list[str]) -> Figure:
    """The robot over the samples: its URDF's meshes if it has one and they can follow, else a stick robot."""
    if not robot.urdf:
        return stick_robot(samples, robot, colours)
    from .robot_urdf import CannotFollow, urdf_robot

    try:
        return urdf_robot(samples, robot)
    except CannotFollow as error:
        warnings.warn(f"{error}; drawing a stick robot instead", stacklevel=3)
        return stick_robot(samples, robot, colours)
